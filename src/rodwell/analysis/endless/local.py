"""The state of a long rod, place by place, from a table: for torque and drag, where it is asked for very often.

Where a rod is long against ℓ = (BD/q)^¼ and its load changes slowly along it, each place is in a state of the endless
rod, that of its own β = P/√(Bq/D). This is the interface::

    from rodwell.analysis.endless.local import LIMITS, helical_contact, local_state, load_and_slope

    beta, slope = load_and_slope(compression, load, stiffness, clearance)   # P in N, q in N/m, B in N m², D in m
    here = local_state(beta, "sinusoidal", slope)                           # or "helical"; arrays as well as numbers
    contact = load * here.contact_mean                                      # N/m

    LIMITS.buckling, LIMITS.sinusoidal_lift_off, LIMITS.helix_lift_off, LIMITS.sinusoidal_helix_equal_energy

``local_state`` holds from buckling, β = 2, to lift-off for the sinusoidal state, and from the helix's lift-off to
any load for the helix; elsewhere it raises. Forces are compression. The table is written by
:mod:`rodwell.analysis.endless.tabulate`; its error stands in each state. As q → 0 a helix has a contact force, while β
grows without bound: ``helical_contact`` gives that force at once, q = 0 included. Numbers are those of
:class:`rodwell.analysis.endless.state.PeriodicState`, under the same names.
"""

from __future__ import annotations

import json
import math
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

SINUSOIDAL, HELICAL = "sinusoidal", "helical"

STEEPEST = 0.02
"""Largest ε²β for which the table holds, in first order: slopes up to 6° in a helix."""

PULLS = 1e-9
"""Part of the mean contact force by which the least one may be negative at lift-off, beside the table's own error."""

Numbers = float | FloatArray


class LocalState(NamedTuple):
    """Numbers of a state of the endless rod, floats or arrays of the shape of β.

    Attributes
    ----------
    frequency
        Angular frequency along the rod, per ℓ = (BD/q)^¼.
    amplitude
        Largest angle from the low side, of a helix from uniform winding, in rad.
    energy
        Mean energy per length in qD; −1 for the straight rod.
    contact_mean, contact_largest, contact_least
        Contact force per length in q.
    rate_largest
        Largest rate of the angle, in rad per ℓ.
    curvature_largest
        Largest curvature in √(qD/B).
    shortening
        Axial shortening per length in √(qD³/B).
    error
        Largest error of these numbers, relative to each (the least contact force: to the mean one); amplitude and
        rate of a sinusoidal state near buckling included.
    """

    frequency: Numbers
    amplitude: Numbers
    energy: Numbers
    contact_mean: Numbers
    contact_largest: Numbers
    contact_least: Numbers
    rate_largest: Numbers
    curvature_largest: Numbers
    shortening: Numbers
    error: Numbers


class _Piece(NamedTuple):
    first: float
    last: float
    series: FloatArray  # (numbers, degree + 1)
    slope_series: FloatArray
    error: float
    slope_error: float


class _Table(NamedTuple):
    powers: FloatArray
    orders: FloatArray
    pieces: tuple[_Piece, ...]


def local_state(beta: ArrayLike, state: str = SINUSOIDAL, slope: ArrayLike = 0.0) -> LocalState:
    """State of the endless rod at β, from the table: some microseconds for one, less for each of many.

    Parameters
    ----------
    beta
        β = P/√(Bq/D), P compression; a number or an array.
    state
        ``"sinusoidal"`` or ``"helical"``.
    slope
        ε = (qD³/B)^¼, a number or an array like ``beta``; its effect is taken in first order of ε²β ≤ 0.02.

    Raises
    ------
    InputError
        If ``beta`` lies outside of the loads at which the state exists without a wall that pulls, or the slope is too
        large (then :func:`rodwell.endless` computes the state itself).

    Notes
    -----
    Relative errors are below 1e-10 and 0.4 (ε²β)² on top; see ``error`` of the result.
    """
    try:
        table = _tables()[state]
    except KeyError:
        raise InputError("state", state, f"must be {SINUSOIDAL!r} or {HELICAL!r}") from None
    if isinstance(beta, float) and isinstance(slope, float):
        return LocalState(*_one(table, state, beta, slope))
    loads, slopes = np.broadcast_arrays(np.asarray(beta, dtype=float), np.asarray(slope, dtype=float))
    found = _many(table, state, loads.ravel(), slopes.ravel())
    return LocalState(*(row.reshape(loads.shape) if loads.shape else float(row[0]) for row in found))


def _one(table: _Table, state: str, beta: float, slope: float) -> list[float]:
    """Numbers and error at one load: what :func:`_many` does, without the cost of masks."""
    tilt = slope * slope * beta
    if state == SINUSOIDAL:
        x = base = math.sqrt(beta - 2.0) if beta >= 2.0 else math.nan
    else:
        x, base = (1.0 / (beta * beta), beta) if beta > 0.0 else (math.nan, beta)
    for piece in table.pieces:
        if x <= piece.last:
            break
    if not (x <= piece.last and beta < math.inf and 0.0 <= tilt <= STEEPEST):
        _refuse(state, beta, slope)
    t = (2.0 * x - piece.first - piece.last) / (piece.last - piece.first)
    terms = np.cos(table.orders * math.acos(max(-1.0, min(1.0, t))))
    series = piece.series + tilt * piece.slope_series if tilt else piece.series
    numbers: list[float] = (base**table.powers * (series @ terms)).tolist()
    error = piece.error + tilt * tilt * piece.slope_error
    if numbers[5] < -(PULLS + error) * numbers[3]:
        _refuse(state, beta, slope)
    return [*numbers, error]


def _many(table: _Table, state: str, beta: FloatArray, slope: FloatArray) -> FloatArray:
    """Numbers and errors (10, m) at loads (m,)."""
    with np.errstate(invalid="ignore", divide="ignore"):
        tilt = slope * slope * beta
        x = np.sqrt(beta - 2.0) if state == SINUSOIDAL else np.where(beta > 0.0, 1.0 / beta**2, np.nan)
    base = x if state == SINUSOIDAL else beta
    bad = ~((x <= table.pieces[-1].last) & (beta < np.inf) & (slope >= 0.0) & (tilt <= STEEPEST))
    if np.any(bad):
        first = int(np.argmax(bad))
        _refuse(state, float(beta[first]), float(slope[first]))
    found = np.empty((len(LocalState._fields), len(beta)))
    which = np.searchsorted([piece.last for piece in table.pieces[:-1]], x)
    for number, piece in enumerate(table.pieces):
        here = which == number
        t = (2.0 * x[here] - piece.first - piece.last) / (piece.last - piece.first)
        terms = np.cos(np.outer(table.orders, np.arccos(np.clip(t, -1.0, 1.0))))
        values = piece.series @ terms + tilt[here] * (piece.slope_series @ terms)
        found[:-1, here] = base[here] ** table.powers[:, None] * values
        found[-1, here] = piece.error + tilt[here] ** 2 * piece.slope_error
    pulls = found[5] < -(PULLS + found[-1]) * found[3]
    if np.any(pulls):
        first = int(np.argmax(pulls))
        _refuse(state, float(beta[first]), float(slope[first]))
    return found


def _refuse(state: str, beta: float, slope: float) -> None:
    """Say why there is no such state."""
    if not (slope >= 0.0 and (slope == 0.0 or slope * slope * beta <= STEEPEST)):
        allowed = (
            f"must be at least 0, with slope² × beta at most {STEEPEST:g}: the table holds slopes in first order; "
        )
        raise InputError("slope", slope, allowed + "rodwell.endless(beta, slope) computes the state itself")
    limits = _limits()
    if state == SINUSOIDAL:
        end = limits.sinusoidal_lift_off.value
        raise InputError(
            "beta",
            beta,
            f"a sinusoidal state is on the wall from 2, where the rod buckles, to {end:.7g}, where it lifts off",
        )
    end = limits.helix_lift_off.value
    raise InputError(
        "beta", beta, f"a helix is on the wall from {end:.7g}, where it lifts off on unloading, to any finite load"
    )


def load_and_slope(
    compression: ArrayLike, load: ArrayLike, stiffness: ArrayLike, clearance: ArrayLike
) -> tuple[Any, Any]:
    """Load β = P/√(Bq/D) and slope ε = (qD³/B)^¼ of a long rod, numbers or arrays in one system of units.

    Parameters
    ----------
    compression
        Effective compression P, tension negative.
    load
        Force per length q that presses the straight rod to the wall: of lateral weight and the hole's curvature, as
        vectors. It must be positive.
    stiffness, clearance
        Bending stiffness B; distance D of the rod's axis from the hole's.
    """
    q, b, d = (np.asarray(x, dtype=float) for x in (load, stiffness, clearance))
    if not (np.all(q > 0.0) and np.all(b > 0.0) and np.all(d > 0.0)):
        raise InputError("load", load, "force per length, stiffness and clearance must be positive")
    return np.asarray(compression) / np.sqrt(b * q / d), (q * d**3 / b) ** 0.25


def helical_contact(compression: ArrayLike, load: ArrayLike, stiffness: ArrayLike, clearance: ArrayLike) -> Any:
    """Mean contact force per length of a helix, small slopes, for any q ≥ 0: P²D/(4B) in a weightless rod.

    Arguments as in :func:`load_and_slope`; numbers or arrays in one system of units.

    Raises
    ------
    InputError
        If β lies below the helix's lift-off.
    """
    p, q, b, d = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in (compression, load, stiffness, clearance)))
    (piece,) = _tables()[HELICAL].pieces
    with np.errstate(invalid="ignore", divide="ignore"):
        x = b * q / (d * p * p)
    if not np.all((p > 0.0) & (q >= 0.0) & (x <= _limits().helix_lift_off.value ** -2 * (1.0 + PULLS))):
        raise InputError("compression", compression, "a helix needs beta = P/sqrt(Bq/D) of at least "
                         f"{_limits().helix_lift_off.value:.7g}, where it lifts off on unloading")  # fmt: skip
    found = p * p * d / b * np.polynomial.chebyshev.chebval(2.0 * x / piece.last - 1.0, piece.series[3])
    return found if found.shape else float(found)


@cache
def _plain() -> Any:
    return json.loads(Path(__file__).with_name("table.json").read_text(encoding="utf-8"))


@cache
def _tables() -> dict[str, _Table]:
    """The series of each state."""
    tables = {}
    for state, table in _plain()["states"].items():
        pieces = tuple(
            _Piece(p["from"], p["to"], np.array(p["series"]), np.array(p["slope_series"]), p["error"], p["slope_error"])
            for p in table["pieces"]
        )
        tables[state] = _Table(np.array(table["powers"]), np.arange(float(pieces[0].series.shape[1])), pieces)
    return tables


class LimitLoads(NamedTuple):
    """Loads β of the endless rod for small slopes; see :class:`rodwell.analysis.endless.limits.Limits`."""

    buckling: Value
    sinusoidal_lift_off: Value
    sinusoidal_ceases: Value
    helix_lift_off: Value
    helix_ceases: Value
    sinusoidal_helix_equal_energy: Value
    straight_helix_equal_energy: Value


@cache
def _limits() -> LimitLoads:
    return LimitLoads(**{name: Value(*pair) for name, pair in _plain()["loads"].items()})


LIMITS = _limits()
"""Loads β at which states begin, end, and cost the same, with their errors, for small slopes."""
