"""Loads at which something happens to the endless rod: buckling, lift-off, states that cease, equal energies."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import lru_cache

from rodwell.analysis.endless.following import BUCKLING, FIRST, follow_to, helix_bears, helix_start, start
from rodwell.analysis.endless.state import least_contact, mean_energy
from rodwell.analysis.endless.waves import HELICAL, SINUSOIDAL, Wave, wave, wave_at_frequency
from rodwell.errors import NotConvergedError
from rodwell.quantities.value import Value

HIGHEST, LOWEST = 12.0, 0.5
"""How far states are followed in β in search of a load."""

LOCATED, ROUND_OFF = 4e-15, 2e-13
"""To what part of it a root is sought; what round-off leaves of a load."""

STEP_BACK = 0.02
"""Step of log k over a fold."""

Number = Callable[[Wave], float]


@dataclass(frozen=True)
class Limits:
    """Loads of the endless rod, as compression β = P/√(Bq/D), each with its error; None where there is none.

    All are of the rod kept on the wall, frictionless, in the wavelength of least energy. A state whose least contact
    force is negative exists on paper only: the wall cannot pull.

    Attributes
    ----------
    buckling
        The straight rod buckles: β = 2, exactly and for any slope.
    sinusoidal_lift_off, sinusoidal_ceases
        Under growing load: the least contact force of the sinusoidal state is zero; on paper its states turn back.
    helix_lift_off, helix_ceases
        Under falling load: the least contact force of the helix is zero; on paper its states turn back.
    sinusoidal_helix_equal_energy, straight_helix_equal_energy
        Where the helix costs as much energy as the sinusoidal state, as the straight rod: no events.
    helix_largest
        Largest load that a helix bears, at slopes above 0.26 (sought up to β = 12): where it is so steep that more
        winding shortens it no further. None below, where it lies near 0.77/ε².
    """

    buckling: Value
    sinusoidal_lift_off: Value | None
    sinusoidal_ceases: Value | None
    helix_lift_off: Value | None
    helix_ceases: Value | None
    sinusoidal_helix_equal_energy: Value | None
    straight_helix_equal_energy: Value | None
    helix_largest: Value | None = None

    def named(self) -> dict[str, Value | None]:
        """The loads by name."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def __repr__(self) -> str:
        told = ", ".join(f"{name} {load.value:.6g}" for name, load in self.named().items() if load is not None)
        return f"<loads β of the endless rod: {told}>"


@lru_cache(maxsize=32)
def limits(slope: float) -> Limits:
    """The loads for a slope. Each is found on two sets of harmonics; they and round-off tell its error."""
    sines, ceases = _along(SINUSOIDAL, slope, BUCKLING + FIRST, HIGHEST)
    helices, gone = _along(HELICAL, slope, helix_start(slope), LOWEST)
    steeper, collapse = _along(HELICAL, slope, helix_start(slope), min(HIGHEST, 1.1 * helix_bears(slope)))
    helices = [*reversed(steeper[1:]), *helices]

    def dearer(helix: Wave) -> float:
        return mean_energy(helix) - mean_energy(_at(sines, helix.beta, len(helix.amplitudes)))

    both = [helix for helix in helices if sines and sines[0].beta < helix.beta < sines[-1].beta]
    return Limits(
        buckling=Value(BUCKLING),
        sinusoidal_lift_off=_zero(sines, least_contact),
        sinusoidal_ceases=ceases,
        helix_lift_off=_zero(helices, least_contact),
        helix_ceases=gone,
        sinusoidal_helix_equal_energy=_zero(both, dearer),
        straight_helix_equal_energy=_zero(helices, lambda helix: mean_energy(helix) + 1.0),
        helix_largest=collapse,
    )


def _along(kind: str, slope: float, first: float, last: float) -> tuple[list[Wave], Value | None]:
    """States from one load towards another, and the load at which they turn back before it."""
    found: list[Wave] = []
    try:
        found.append(start(kind, first, slope))
        follow_to(found[0], last, found.append)
    except NotConvergedError:
        return found, _both(lambda fine: _fold(found[-1].finer() if fine else found[-1])) if found else None
    return found, None


def _zero(waves: list[Wave], number: Number) -> Value | None:
    """The first load along states at which a number of theirs is zero; None if it is nowhere."""
    values = [number(wave) for wave in waves]
    for i in range(1, len(waves)):
        if values[i - 1] * values[i] <= 0.0:
            ends = sorted((waves[i - 1].beta, waves[i].beta))
            return _both(lambda fine: _root(lambda beta: number(_at(waves, beta, _count(waves[i], fine))), *ends))  # noqa: B023
    return None


def _both(load: Callable[[bool], float]) -> Value:
    """A load from few and from twice as many harmonics."""
    coarse, fine = load(False), load(True)
    return Value(fine, abs(fine - coarse) + ROUND_OFF * fine)


def _count(wave: Wave, fine: bool) -> int:
    return len(wave.amplitudes) * (2 if fine else 1)


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

    return float(brentq(function, low, high, xtol=1e-14, rtol=LOCATED))


def _at(waves: list[Wave], beta: float, count: int) -> Wave:
    """The state at a load on ``count`` harmonics, from the nearest known one."""
    near = min(waves, key=lambda known: abs(known.beta - beta))
    return wave(near.kind, beta, near.slope, near.on(count), near.frequency)


def _fold(known: Wave) -> float:
    """The load at which states turn back: as a function of the frequency it has an extremum there.

    ``known`` lies just before; the frequency goes on past the fold in steps until the load comes back.
    """

    def along(frequency: float) -> tuple[Wave, float]:
        return wave_at_frequency(known, frequency)

    def rate(frequency: float) -> float:
        return along(frequency)[1]

    first = known.frequency
    here = rate(first)
    for step in (STEP_BACK, -STEP_BACK):
        second = first * math.exp(step)
        if here * rate(second) < 0.0:
            return along(_root(rate, *sorted((first, second))))[0].beta
    raise NotConvergedError(f"the end of the {known.kind} states near beta = {known.beta:.6g} was not located")
