"""Friction factors from measured hook loads and torques, by least squares, with their uncertainty."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value
from rodwell.studies.drag.laws import contact_named
from rodwell.studies.drag.measured import Measured
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.run import run
from rodwell.studies.drag.well_case import Well

RULE = "equal-energy"
"""Measured loads are met best, not bounded: the states are those of least energy."""

STEP, MOST_STEPS, SETTLED = 1e-5, 60, 1e-10
LARGEST, WEAK = 1.0, 1e-10
"""Largest friction factor; eigenvalue of the normal matrix, as a part of the largest, below which nothing is told."""

FEW, LARGE_SPREAD = 3, 0.2
"""Residuals of one sign from which on they are an offset; mean residual, as a part of the loads, that is large."""


@dataclass(frozen=True)
class Calibration:
    """What was found.

    Attributes
    ----------
    well
        The well with the friction factors found.
    names, friction
        Sections of the hole; factors with standard errors.
    correlation
        Of the errors of the factors, (k, k).
    measured
        What was measured.
    residuals
        Measured less computed hook loads in N, and torques in N m, (m, 2); NaN where not measured.
    spread
        Standard deviations of the residuals in N and in N m.
    not_told
        Sections on whose factors the measurements say nothing: they keep that of the file.
    notes
        What makes the factors doubtful: one at its bound, a fit that has not settled, residuals of one sign.
    """

    well: Well
    names: tuple[str, ...]
    friction: tuple[Value, ...]
    correlation: FloatArray
    measured: tuple[Measured, ...]
    residuals: FloatArray
    spread: tuple[float, float]
    not_told: tuple[str, ...]
    notes: tuple[str, ...]


def calibrate(
    well: Well, measured: Sequence[Measured], progress: Callable[[str, float], None] | None = None
) -> Calibration:
    """Fit the friction factor of every section of the hole to measurements, by least squares (Gauss and Newton).

    Hook loads and torques are weighed by their own spread, found from the residuals of the first fit. Standard errors
    are those of a linear fit at the solution.

    Raises
    ------
    InputError
        If there are fewer measurements than factors, none of them depends on friction, or the string is stiff.
    """
    if well.settings.string == "stiff":
        raise InputError("--calibrate", None, 'is made for the soft string only: leave well.string = "stiff" out')
    tell = progress or (lambda _what, _done: None)
    start = np.array([part.friction for part in well.hole])
    told = _told(well, measured, start)
    if not np.any(told):
        raise InputError("--calibrate", None, "measures nothing that depends on friction: rotating hook loads do not")
    count = int(np.sum(~np.isnan([[one.hook_load, one.torque] for one in measured])))
    if count <= int(np.sum(told)):
        raise InputError("--calibrate", count, f"measurements are too few for {int(np.sum(told))} friction factors")
    scale, mu = np.array([1.0, 1.0]), start.copy()
    for again in range(2):
        tell("friction factors", 0.5 * again)
        mu, jacobian, left, settled = _fitted(well, measured, mu, told, scale)
        scale = _spread(left, int(np.sum(told)))
    weighed = (jacobian / scale[None, :, None]).reshape(-1, int(np.sum(told)))
    weighed = weighed[~np.isnan(left).ravel()]
    normal = weighed.T @ weighed
    size, vectors = np.linalg.eigh(normal)
    weak = size <= WEAK * size[-1]
    inverse = (vectors / np.where(weak, np.inf, size)) @ vectors.T
    sigma = np.where(np.any(np.abs(vectors[:, weak]) > 1e-3, axis=1), np.inf, np.sqrt(np.diag(inverse)))
    errors = np.full(len(mu), np.nan)
    errors[told] = sigma
    safe = np.where(np.isfinite(sigma) & (sigma > 0.0), sigma, 1.0)
    names = tuple(part.name for part in well.hole)
    hole = tuple(replace(part, friction=float(value)) for part, value in zip(well.hole, mu, strict=True))
    return Calibration(
        replace(well, hole=hole), names, tuple(Value(float(m), float(e)) for m, e in zip(mu, errors, strict=True)),
        inverse / np.outer(safe, safe), tuple(measured), left, (float(scale[0]), float(scale[1])),
        tuple(name for name, one in zip(names, told, strict=True) if not one),
        _notes(np.array(names)[told], mu[told], left, _given(measured), settled),
    )  # fmt: skip


def _notes(names: Sequence[str], mu: FloatArray, left: FloatArray, given: FloatArray, settled: bool) -> tuple[str, ...]:
    """What makes the factors doubtful, in words."""
    check = "check units, block weight and string"
    out = [
        f"The friction factor of {name} is at its bound, {value:g}: no factor between 0 and {LARGEST:g} meets the "
        f"measurements, and its standard error means nothing; {check}."
        for name, value in zip(names, mu, strict=True) if value in (0.0, LARGEST)
    ]  # fmt: skip
    if not settled:
        out.append(f"The fit has not settled in {MOST_STEPS} steps: the factors are no best ones.")
    for what, column, values in zip(("hook loads", "torques"), left.T, given.T, strict=True):
        known = column[~np.isnan(column)]
        if len(known) >= FEW and (np.all(known > 0.0) or np.all(known < 0.0)):
            side = "above" if known[0] > 0.0 else "below"
            out.append(f"All measured {what} are {side} those computed: an offset, no scatter; {check}.")
        share = math.sqrt(float(np.mean(known**2) / np.nanmean(values**2))) if np.any(known) else 0.0
        if share > LARGE_SPREAD:
            out.append(f"Measured {what} are off those computed by {100.0 * share:.0f} % of their size: {check}.")
    return tuple(out)


def _computed(well: Well, measured: Sequence[Measured], mu: FloatArray) -> FloatArray:
    """Hook loads and torques, (m, 2)."""
    cutter, contact = Cutter(well, mu.tolist()), contact_named(well.settings.contact)
    out = np.empty((len(measured), 2))
    for i, one in enumerate(measured):
        found = run(cutter, one.operation, contact, RULE, coarse=True, record=False)
        if not found.arrived:
            what = f"was measured, but the string locks up with friction {', '.join(f'{v:.3g}' for v in mu)}"
            raise InputError(f"line {one.line}, hook_load", None, what)
        out[i] = found.force, found.torque
    return out


def _told(well: Well, measured: Sequence[Measured], mu: FloatArray) -> FloatArray:
    """Which factors any measurement depends on, (k,)."""
    base, known = _computed(well, measured, mu), _given(measured)
    out = np.zeros(len(mu), dtype=bool)
    for k in range(len(mu)):
        moved = mu.copy()
        moved[k] += 0.01
        change = np.where(np.isnan(known), 0.0, _computed(well, measured, moved) - base)
        out[k] = bool(np.any(np.abs(change) > 1e-6 * (1.0 + np.abs(base))))
    return out


def _given(measured: Sequence[Measured]) -> FloatArray:
    return np.array([[one.hook_load, one.torque] for one in measured])


def _fitted(
    well: Well, measured: Sequence[Measured], start: FloatArray, told: FloatArray, scale: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, bool]:
    """Factors, derivatives (m, 2, k) of what was computed, residuals (m, 2), and whether the fit has settled."""
    mu, given = start.copy(), _given(measured)
    which = np.flatnonzero(told)
    jacobian = np.zeros((len(measured), 2, len(which)))
    settled = False
    for _ in range(MOST_STEPS):
        base = _computed(well, measured, mu)
        for j, k in enumerate(which):
            moved = mu.copy()
            moved[k] += STEP
            jacobian[:, :, j] = (_computed(well, measured, moved) - base) / STEP
        rows = (jacobian / scale[None, :, None]).reshape(-1, len(which))
        left = ((given - base) / scale).ravel()
        known = ~np.isnan(left)
        step = np.linalg.lstsq(rows[known], left[known], rcond=1e-8)[0]
        new = mu.copy()
        new[which] = np.clip(mu[which] + step, 0.0, LARGEST)
        settled = bool(np.max(np.abs(new - mu)) <= SETTLED)
        mu = new
        if settled:
            break
    return mu, jacobian, given - _computed(well, measured, mu), settled


def _spread(left: FloatArray, factors: int) -> FloatArray:
    """Standard deviations of both columns of residuals; those of a column that is not measured do not matter."""
    out = np.ones(2)
    free = max(int(np.sum(~np.isnan(left))) - factors, 1)
    for i in range(2):
        column = left[:, i][~np.isnan(left[:, i])]
        if len(column):
            share = max(free * len(column) / max(int(np.sum(~np.isnan(left))), 1), 1e-12)
            out[i] = max(math.sqrt(float(np.sum(column**2)) / share), 1e-9)
    return out
