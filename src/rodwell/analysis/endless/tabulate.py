"""The table of states of the endless rod, computed anew: Chebyshev series in the load, and their errors.

    python -m rodwell.analysis.endless.tabulate

writes ``table.json``, which :mod:`rodwell.analysis.endless.local` reads; a test computes the table again and compares.
Every number of a state is a power of the load times a series that is analytic in

* u = √(β − 2) for sinusoidal states, from buckling to a little past their lift-off,
* v = 1/β² for helices, from infinite load to a little past theirs,

in pieces where the place of the least contact force leaves the symmetric one. A second series is the derivative by ε²β:
what a small slope adds in first order.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

from rodwell.analysis.endless.following import BUCKLING, follow_to, start
from rodwell.analysis.endless.limits import limits
from rodwell.analysis.endless.state import PeriodicState, contact
from rodwell.analysis.endless.waves import HELICAL, KINDS, SINUSOIDAL, Wave, basis, wave
from rodwell.quantities.arrays import FloatArray

FILE = Path(__file__).with_name("table.json")

NUMBERS = (
    "frequency", "amplitude", "energy", "contact_mean", "contact_largest", "contact_least", "rate_largest",
    "curvature_largest", "shortening",
)  # fmt: skip
"""What is tabulated, in this order."""

POWERS = {
    SINUSOIDAL: (0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0),
    HELICAL: (0.5, -2.0, 2.0, 2.0, 2.0, 2.0, 0.5, 1.0, 1.0),
}
"""Powers of u (sinusoidal) and of β (helical) by which the numbers are divided before they are expanded."""

HIGHEST_SINUSOIDAL, LOWEST_HELICAL = 3.6, 2.65
"""Ends of the table: a little past the lift-offs, at β = 3.5417 and 2.7447, which a slope moves."""

DEGREE, CHECKED = 23, 21
"""Degree of the series, and at how many places of a piece they are compared with states."""

SLOPES = 1e-3 * np.arange(4.0)
"""Values of ε²β from which the derivative by it is taken."""

TESTED_SLOPE = 0.01
"""Value of ε²β at which the first order is compared with states."""


def variable(kind: str, beta: FloatArray) -> FloatArray:
    """The variable of the series, for loads of any shape."""
    return np.asarray(np.sqrt(beta - BUCKLING) if kind == SINUSOIDAL else 1.0 / beta**2)


def load(kind: str, x: float) -> float:
    """The load of a variable."""
    return BUCKLING + x * x if kind == SINUSOIDAL else 1.0 / math.sqrt(x)


def table() -> dict[str, Any]:
    """The whole table as plain data."""
    named = limits(0.0).named()
    loads = {name: [load.value, load.error] for name, load in named.items() if load is not None}
    return {
        "numbers": list(NUMBERS),
        "loads": loads,
        "states": {
            kind: {"powers": list(POWERS[kind]), "pieces": [_piece(kind, *ends) for ends in _ends(kind)]}
            for kind in KINDS
        },
    }


def _ends(kind: str) -> list[tuple[float, float]]:
    """Ends of the pieces, in the variable of the series."""
    if kind == HELICAL:
        return [(0.0, LOWEST_HELICAL**-2)]
    leaves = math.sqrt(_least_contact_leaves() - BUCKLING)
    return [(0.0, leaves), (leaves, math.sqrt(HIGHEST_SINUSOIDAL - BUCKLING))]


def _least_contact_leaves() -> float:
    """Load from which the contact force of the sinusoidal state is no longer least where the rod is lowest."""
    below, above = 2.3, 2.7
    known = start(SINUSOIDAL, below, 0.0)

    def curved(beta: float) -> float:
        return _bend_of_contact(follow_to(known, beta))

    return float(brentq(curved, below, above, xtol=1e-12))


def _bend_of_contact(state: Wave) -> float:
    """Second derivative of the contact force by φ at φ = 0."""
    phase = basis(state.kind, len(state.amplitudes)).phase
    series = np.fft.rfft(contact(state, phase)).real
    return float(-np.sum(np.arange(len(series)) ** 2 * series) / len(phase))


def _piece(kind: str, first: float, last: float) -> dict[str, Any]:
    """Series of a piece, and how far they are from states between their nodes."""
    nodes = np.cos(np.pi * (np.arange(DEGREE + 1.0) + 0.5) / (DEGREE + 1.0))
    places = first + 0.5 * (last - first) * (nodes + 1.0)
    known = _scaled(kind, places, SLOPES)
    series = [np.polynomial.chebyshev.chebfit(nodes, rows, DEGREE).T for rows in _orders(known)]
    values, slanted = series
    check = np.linspace(-1.0, 1.0, CHECKED + 2)[1:-1]
    exact = _scaled(kind, first + 0.5 * (last - first) * (check + 1.0), np.array([0.0, TESTED_SLOPE]))
    told = np.polynomial.chebyshev.chebval(check, values.T).T
    told_slope = told + TESTED_SLOPE * np.polynomial.chebyshev.chebval(check, slanted.T).T
    size = _sizes(exact[:, 0])
    return {
        "from": first,
        "to": last,
        "series": values.tolist(),
        "slope_series": slanted.tolist(),
        "error": (np.max(np.abs(told - exact[:, 0]) / size)).tolist(),
        "slope_error": (np.max(np.abs(told_slope - exact[:, 1]) / size) / TESTED_SLOPE**2).tolist(),
    }


def _sizes(exact: FloatArray) -> FloatArray:
    """What errors are relative to: each number itself, of the contact force its mean."""
    size = np.abs(exact)
    size[:, NUMBERS.index("contact_least")] = size[:, NUMBERS.index("contact_mean")]
    return size


def _scaled(kind: str, places: FloatArray, slopes: FloatArray) -> FloatArray:
    """Numbers of the states at places (p,) of the variable for several ε²β, over their powers: (p, slopes, numbers)."""
    loads = np.array([load(kind, x) for x in places])
    base = np.sqrt(loads - BUCKLING) if kind == SINUSOIDAL else loads
    found = np.empty((len(places), len(slopes), len(NUMBERS)))
    for i, beta in enumerate(loads):
        known = start(kind, float(beta), 0.0).finer()
        for j, slope in enumerate(np.sqrt(slopes / beta)):
            known = wave(kind, float(beta), float(slope), known.amplitudes, known.frequency)
            state = PeriodicState(known, known)
            found[i, j] = [getattr(state, name).value for name in NUMBERS]
    return np.asarray(found / base[:, None, None] ** np.array(POWERS[kind]))


def _orders(known: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Value and derivative by ε²β at zero, (p, numbers), from the cubic through four values."""
    zero, one, two, three = np.moveaxis(known, 1, 0)
    return zero, np.asarray((-11.0 * zero + 18.0 * one - 9.0 * two + 2.0 * three) / (6.0 * SLOPES[1]))


def main() -> None:
    """Write the table beside this file."""
    FILE.write_text(json.dumps(table(), indent=0, allow_nan=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
