"""From where a state is known to where it is asked for: starts, and steps in the load."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from rodwell.analysis.endless.waves import SINUSOIDAL, Wave, wave
from rodwell.errors import NotConvergedError
from rodwell.physics.exact.helix import LARGEST, sine_squared

BUCKLING = 2.0
"""β at which the straight endless rod buckles, whatever its slope: R. Dawson and P. R. Paslay (1984), with k = 1."""

FEWEST, MOST = 12, 96
"""Harmonics to begin with, and at most."""

RESOLVED = 1e-13
"""Part of the largest amplitude below which the last ones must lie."""

FIRST, STEP, SHORTEST = 0.02, 0.15, 1e-5
"""Distance of the first state from buckling, and lengths of the steps in β that follow."""

HELIX_START, PART = 4.0, 0.9
"""β from which helices are followed downward, and at most which part of what a weightless one bears: there its closed
form is start enough, and above."""


def amplitude_near_buckling(beta: float, slope: float) -> float:
    """Amplitude of the sinusoidal state for β → 2⁺: θ = A sin x, A² = 8(β − 2)/(11 − 2ε²)."""
    return math.sqrt(8.0 * (beta - BUCKLING) / (11.0 - 2.0 * slope**2))


def helix_bears(slope: float) -> float:
    """Largest β that a weightless helix bears, 4/(3√3 ε²): at sin²η = 2/3."""
    return 2.0 * LARGEST / slope**2 if slope > 0.0 else math.inf


def helix_start(slope: float) -> float:
    """The load from which helices are followed downward."""
    return min(HELIX_START, PART * helix_bears(slope))


def weightless_rate(beta: float, slope: float) -> float:
    """Rate of the weightless helix: 2k²√(1 − ε²k²) = β, for small slopes k = √(β/2); the smaller root.

    Raises
    ------
    NotConvergedError
        If the helix does not bear the load: β ε² above 4/(3√3) = 0.7698.
    """
    load = 0.5 * beta * slope**2  # u √(1 − u) with u = sin²η
    if beta > helix_bears(slope):
        most = helix_bears(slope)
        raise NotConvergedError(f"no helix bears beta = {beta:.6g} at the slope {slope:.6g}: they end near {most:.6g}")
    return math.sqrt(sine_squared(load)) / slope if slope > 0.0 else math.sqrt(0.5 * beta)


def start(kind: str, beta: float, slope: float) -> Wave:
    """The state of a kind at a load, on as many harmonics as it needs.

    Raises
    ------
    NotConvergedError
        If there is no state of the kind, or none was found on the way to it.
    """
    if kind == SINUSOIDAL:
        if not beta > BUCKLING:
            raise NotConvergedError(f"at beta = {beta:.8g} the rod is straight: it buckles at beta = 2")
        first = min(beta, BUCKLING + FIRST)
        amplitude, frequency = amplitude_near_buckling(first, slope), 1.0
    else:
        first = max(beta, helix_start(slope))
        k = weightless_rate(first, slope)
        amplitude, frequency = -1.0 / (5.0 * k**4), k
    amplitudes = np.zeros(FEWEST)
    amplitudes[0] = amplitude
    found = resolved(wave(kind, first, slope, amplitudes, frequency))
    if kind == SINUSOIDAL and not found.amplitudes[0] > 0.1 * amplitude:
        raise NotConvergedError(
            f"no sinusoidal state of the endless rod was found near buckling, at beta = {first:.8g}"
        )
    return follow_to(found, beta)


def follow_to(known: Wave, beta: float, seen: Callable[[Wave], None] = lambda _wave: None) -> Wave:
    """The state at another load, reached step by step from a known one; ``seen`` is shown each on the way.

    Raises
    ------
    NotConvergedError
        If the states of this kind end on the way, with the last load at which there is one.
    """
    before: Wave | None = None
    step = math.copysign(STEP, beta - known.beta)
    while known.beta != beta:
        target = beta if abs(beta - known.beta) <= abs(step) else known.beta + step
        try:
            found = _next(before, known, target)
        except NotConvergedError:
            if abs(step) < SHORTEST:
                kept = f"{known.kind} states of the endless rod end near beta = {known.beta:.6g}"
                raise NotConvergedError(f"{kept} (slope {known.slope:.6g}): there is none at {beta:.8g}") from None
            step *= 0.25
            continue
        before, known = known, found
        seen(known)
    return known


def _next(before: Wave | None, known: Wave, beta: float) -> Wave:
    """The state at ``beta``, predicted from the last two."""
    amplitudes, frequency = known.amplitudes, known.frequency
    if before is not None and known.beta != before.beta:
        weight = (beta - known.beta) / (known.beta - before.beta)
        amplitudes = amplitudes + weight * (amplitudes - before.on(len(amplitudes)))
        frequency *= (frequency / before.frequency) ** weight
    found = resolved(wave(known.kind, beta, known.slope, amplitudes, frequency))
    if _changed(known, found):
        raise NotConvergedError("another state was found")
    return found


def _changed(known: Wave, found: Wave) -> bool:
    """Whether a step has led to another family: wave gone or reversed, frequency leapt, another kind of extremum."""
    leapt = abs(math.log(found.frequency / known.frequency)) > 0.3
    gone = found.kind == SINUSOIDAL and not found.amplitudes[0] > 0.3 * known.amplitudes[0]
    return leapt or gone or (known.stiffness > 0.0) != (found.stiffness > 0.0)


def resolved(found: Wave) -> Wave:
    """The state on enough harmonics: the last amplitudes are nothing beside the largest."""
    while np.max(np.abs(found.amplitudes[-2:])) > RESOLVED * np.max(np.abs(found.amplitudes)):
        if 2 * len(found.amplitudes) > MOST:
            raise NotConvergedError(
                f"{MOST} harmonics do not resolve the {found.kind} state at beta = {found.beta:.8g}"
            )
        found = found.finer()
    return found
