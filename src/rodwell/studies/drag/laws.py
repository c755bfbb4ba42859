"""The laws of contact that a well may ask for, and from which β a string is helical by which rule."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import Chebyshev

from rodwell.analysis.endless.local import LIMITS, helical_contact, local_state
from rodwell.quantities.arrays import FloatArray
from rodwell.studies.drag.contact import BUCKLES, CORRELATED, EXACT, WITHOUT_BUCKLING, Law

CHEN = 2.0 * math.sqrt(2.0)
"""β from which the correlation takes the string to be helical (Chen, Lin and Cheatham 1990)."""


@dataclass(frozen=True)
class Contact:
    """A law of contact with what it knows of the local states.

    Attributes
    ----------
    name
        "exact", "correlation" or "straight".
    law
        For kernels.
    early, equal, late
        β at which the helix ceases when it is unloaded, at which its energy is that of the sinusoidal state, and up to
        which the sinusoidal state lasts when it is loaded.
    error
        Relative error of the contact forces of the law.
    """

    name: str
    law: Law
    early: float
    equal: float
    late: float
    error: float = 0.0

    def helix_from(self, rule: str) -> float:
        """β from which the string is helical by a rule; by "history" that is so where nothing is remembered."""
        return {"early": self.early, "equal-energy": self.equal, "late": self.late, "history": self.late}[rule]

    @property
    def one_state(self) -> bool:
        """Whether every load has one state, so that no rule is needed."""
        return self.early == self.late


STRAIGHT_LAW = Contact("straight", WITHOUT_BUCKLING, math.inf, math.inf, math.inf)


def correlation(helix_from: float = CHEN) -> Contact:
    """The correlation of practice, n̄ = q + r P²/4B from ``helix_from`` on."""
    return Contact("correlation", CORRELATED, helix_from, helix_from, helix_from)


POINTS, DEGREE = 801, 40
"""Points of the tables for kernels, and degree of the series from which their slopes are taken."""


@cache
def exact() -> Contact:
    """The exact states of the endless rod, small slopes: tables from :mod:`rodwell.analysis.endless.local`."""
    early, late = LIMITS.helix_lift_off.value, LIMITS.sinusoidal_lift_off.value

    def sinusoidal(beta: FloatArray) -> FloatArray:
        return np.asarray(local_state(np.clip(beta, BUCKLES, late), "sinusoidal").contact_mean)

    def helical(inverse: FloatArray) -> FloatArray:
        """G of 1/β²: with B = D = P = 1 that is q."""
        return 4.0 * np.asarray(helical_contact(1.0, np.clip(inverse, 0.0, early**-2), 1.0, 1.0))

    first, step, missed = _tabled(sinusoidal, BUCKLES, late)
    second, other, lost = _tabled(helical, 0.0, early**-2)
    law = Law(np.array([EXACT, step, other]), first, second)
    table = max(float(local_state(late, "sinusoidal").error), float(local_state(late, "helical").error))
    equal = LIMITS.sinusoidal_helix_equal_energy.value
    return Contact("exact", law, early, equal, late, max(missed, lost) + table)


def _tabled(function, low: float, high: float) -> tuple[FloatArray, float, float]:  # type: ignore[no-untyped-def]
    """Values and slopes times the step at equal steps, the step, and the largest relative error seen between them."""
    series = Chebyshev.interpolate(function, DEGREE, domain=[low, high])
    places = np.linspace(low, high, POINTS)
    step = (high - low) / (POINTS - 1)
    table = np.stack([series(places), step * series.deriv()(places)], axis=1)
    middle = 0.5 * (places[:-1] + places[1:])
    cubic = 0.5 * (table[:-1, 0] + table[1:, 0]) + 0.125 * (table[:-1, 1] - table[1:, 1])
    truth = function(middle)
    return np.ascontiguousarray(table), step, float(np.max(np.abs(cubic / truth - 1.0)))


def contact_named(name: str) -> Contact:
    """Return the law of a name: "exact", "correlation" or "straight"."""
    if name == "exact":
        return exact()
    return correlation() if name == "correlation" else STRAIGHT_LAW
