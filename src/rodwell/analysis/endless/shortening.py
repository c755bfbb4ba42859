"""How much shorter a long string is for being buckled, where its compression falls linearly along it.

Each place is in a state of the endless rod, that of its own β. In a vertical hole nothing presses the rod to the wall
but its own helix, and the sum has a closed form; in an inclined one it is taken over the table of states. Between the
lift-offs of helix and sinusoidal state both exist, so the history decides: both answers can be had.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from rodwell.analysis.endless.local import HELICAL, LIMITS, SINUSOIDAL, load_and_slope, local_state
from rodwell.errors import InputError
from rodwell.physics.exact.helix import LARGEST, helix_shortening, sine_squared
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

LOADING, UNLOADING = "loading", "unloading"
RULES = (LOADING, UNLOADING)

NODES = 24, 40
"""Places of the two quadratures, by Gauss and Legendre, whose difference tells the error."""

ROUND_OFF = 1e-14


def string_shortening(
    compression: float, axial: float, lateral: float, length: float, stiffness: float, clearance: float, rule: str
) -> Value:
    """Shortening of a string by buckling, in the unit of its length.

    Parameters
    ----------
    compression
        Effective compression P at the lower end, tension negative.
    axial, lateral
        Weight per length along the hole and across it, in the fluids, at least 0; P falls by ``axial`` per length.
    length, stiffness, clearance
        L, B, D, in one system of units with the rest.
    rule
        ``"loading"``: a place is sinusoidal as long as it can be; ``"unloading"``: helical as long as it can be.

    Raises
    ------
    InputError
        If no helix bears the compression, or slopes are beyond the table's.
    """
    low = max(compression - axial * length, 0.0)
    if compression <= 0.0:
        return Value(0.0)
    if lateral == 0.0:
        return _vertical(compression, low, axial, length, stiffness, clearance)
    if axial == 0.0:
        strain, error = _strain(compression, lateral, stiffness, clearance, rule)
        return Value(length * strain, length * error)
    (coarse, _), (fine, error) = (_inclined(low, compression, lateral, stiffness, clearance, rule, n) for n in NODES)
    return Value(float(fine / axial), float((abs(fine - coarse) + error) / axial))


def largest_curvature(compression: float, lateral: float, stiffness: float, clearance: float, rule: str) -> float:
    """Largest curvature at a place under effective compression, by the same states; 0 where it is straight."""
    if compression <= 0.0:
        return 0.0
    if lateral == 0.0:
        return sine_squared(_checked(compression, stiffness, clearance)) / clearance
    beta, slope = load_and_slope(compression, lateral, stiffness, clearance)
    kind = _kind(float(beta), rule)
    if kind is None:
        return 0.0
    curvature = local_state(float(beta), kind, float(slope)).curvature_largest
    return float(curvature) * float(np.sqrt(lateral * clearance / stiffness))


def state_at(compression: float, lateral: float, stiffness: float, clearance: float, rule: str) -> str:
    """``"straight"``, ``"sinusoidal"`` or ``"helical"``: the state of a place."""
    if compression <= 0.0 or lateral == 0.0:
        return HELICAL if compression > 0.0 else "straight"
    beta, _ = load_and_slope(compression, lateral, stiffness, clearance)
    return _kind(float(beta), rule) or "straight"


def _vertical(p: float, low: float, axial: float, length: float, stiffness: float, clearance: float) -> Value:
    """Of a weightless helix at each place: in closed form."""
    unit = stiffness / clearance**2
    loads = [_checked(each, stiffness, clearance) for each in (p, low)]
    if axial == 0.0:
        u = sine_squared(loads[0])
        value = length * u / (1.0 + np.sqrt(1.0 - u))
    else:
        value = unit * (helix_shortening(loads[0]) - helix_shortening(loads[1])) / axial
    return Value(float(value), 8.0 * ROUND_OFF * unit * helix_shortening(loads[0]) / (axial or unit / length))


def _checked(compression: float, stiffness: float, clearance: float) -> float:
    """½PΔ²/B, if a helix bears it."""
    load = 0.5 * compression * clearance**2 / stiffness
    if load > LARGEST:
        most = 2.0 * LARGEST * stiffness / clearance**2
        raise InputError("compression", compression, f"no helix bears it: the largest is 0.7698 B/D² = {most:.6g}")
    return load


def _kind(beta: float, rule: str) -> str | None:
    up, down = LIMITS.sinusoidal_lift_off.value, LIMITS.helix_lift_off.value
    if beta <= LIMITS.buckling.value:
        return None
    return SINUSOIDAL if beta < (up if rule == LOADING else down) else HELICAL


def _strain(compression: float, lateral: float, stiffness: float, clearance: float, rule: str) -> tuple[float, float]:
    """Shortening per length at a place under compression, and its error."""
    beta, slope = load_and_slope(compression, lateral, stiffness, clearance)
    kind = _kind(float(beta), rule)
    if kind is None:
        return 0.0, 0.0
    state = local_state(float(beta), kind, float(slope))
    strain = float(np.sqrt(lateral * clearance**3 / stiffness)) * float(state.shortening)
    return strain, strain * float(state.error)


def _inclined(
    low: float, high: float, lateral: float, stiffness: float, clearance: float, rule: str, nodes: int
) -> tuple[float, float]:
    """Integral of the shortening per length over compression, piece by piece of the states, and the table's error."""
    (b0, b1), slope = load_and_slope(np.array([low, high]), lateral, stiffness, clearance)
    t, weights = np.polynomial.legendre.leggauss(nodes)
    total = error = 0.0
    for kind, first, last, variable in _pieces(float(b0), float(b1), rule):
        ends = variable(np.array([first, last]))
        half = 0.5 * float(ends[1] - ends[0])
        x = ends[0] + half * (t + 1.0)
        beta, rate = (2.0 + x * x, 2.0 * x) if kind == SINUSOIDAL else (np.exp(x), np.exp(x))
        state = local_state(np.clip(beta, first, last), kind, float(slope))
        strain = half * weights * rate * state.shortening
        total += float(np.sum(strain))
        error += float(np.sum(strain * state.error))
    unit = float(np.sqrt(lateral * clearance**3 / stiffness)) * high / float(b1)
    return total * unit, error * unit


def _pieces(b0: float, b1: float, rule: str) -> Iterator[tuple[str, float, float, Callable[[FloatArray], FloatArray]]]:
    """States between two loads: kind, ends, and the variable in which the numbers are smooth."""
    switch = (LIMITS.sinusoidal_lift_off if rule == LOADING else LIMITS.helix_lift_off).value
    first, last = max(b0, 2.0), min(b1, switch)
    if last > first:
        yield SINUSOIDAL, first, last, lambda beta: np.sqrt(beta - 2.0)
    first = max(b0, switch)
    while b1 > first:
        last = min(b1, 4.0 * first)
        yield HELICAL, first, last, np.log
        first = last
