"""Errors of formulas over weight and inclination, from many exact critical loads: what the charts of an audit show."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rodwell.analysis.straight.critical import critical_loads
from rodwell.answers.comparison.beside import rod_of
from rodwell.answers.comparison.exact_loads import WHERE
from rodwell.errors import InputError
from rodwell.formulas import FORMULAS
from rodwell.formulas.record import Place
from rodwell.problem.checks import LARGEST_WEIGHT
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import RTOL
from rodwell.studies.maps.computing import Progress
from rodwell.studies.maps.memory import in_memory
from rodwell.studies.maps.question import asked
from rodwell.studies.maps.result import Map
from rodwell.studies.maps.workers import Workers, team

CRITICAL, OVER = "critical", ("alpha", "weight")
"""The number that formulas are held against, and what it is mapped over: dimensions of the arrays in this order."""

PANELS: tuple[tuple[str, Place], ...] = (
    ("dawson_paslay", "bottom"), ("dawson_paslay", "middle"), ("dawson_paslay", "top"),
    ("dellinger", "top"), ("paslay_bogy", "middle"), ("chen_lin_cheatham", "bottom"),
)  # fmt: skip
"""Formulas that the chart shows, and where their force is measured."""

ALPHAS = (0.0, 1.0, 2.5, 5.0, 8.0, 12.0, 17.0, 23.0, 30.0, 38.0, 46.0, 55.0, 64.0, 73.0, 80.0, 85.0, 90.0)
"""Inclinations of the chart: closer together near the vertical, where loads change fast."""

REACH = 30.0
"""The chart goes from 1/30 to 30 times the weight of the case."""

HEAVY = 1e6
"""Above this weight a critical load takes a tenth of a second and more: the chart does not go farther than the case."""


@dataclass(frozen=True)
class ErrorMap:
    """First critical loads over weight and inclination for the clearance and ends of one problem.

    Attributes
    ----------
    problem
        The case in question.
    weights, alphas
        γ (n,) and α in degrees (m,).
    force, error
        Critical end force at s = 1 in B/L², tension positive, and its error estimate, (m, n).
    """

    problem: Problem
    weights: FloatArray
    alphas: FloatArray
    force: FloatArray
    error: FloatArray

    @classmethod
    def of(cls, found: Map, problem: Problem | None = None) -> ErrorMap:
        """Hold formulas against a map of first critical loads, also one of a store: made by many workers, or resumed.

        Parameters
        ----------
        found
            What :func:`rodwell.map` made of "critical" over "weight" and "alpha" of a problem, or over one of them.
        problem
            The case in question, which is marked; that of the map, if not given.

        Raises
        ------
        InputError
            For a map of something else, or with a cell whose values make no problem.
        NotConvergedError
            If a cell has no load, with the reason.
        """
        question = found.question
        rods = question.rods
        if rods.quantity != CRITICAL or rods.folder is not None or not set(question.dims) <= set(OVER):
            raise InputError("found", repr(found), 'must be a map of "critical" of a problem over "weight" and "alpha"')
        found.refuse_gaps()
        of = Problem(**rods.given)
        numbers = {axis.name: np.array(axis.numbers) for axis in question.axes}
        alphas, weights = (numbers.get(name, np.array([getattr(of, name)])) for name in OVER)
        turned = question.dims == OVER[::-1]
        force, error = (
            (found.cells[name].T if turned else found.cells[name]).reshape(alphas.size, weights.size)
            for name in ("value", "error")
        )
        return cls(of if problem is None else problem, weights, alphas, force, error)

    def exact(self, place: Place) -> FloatArray:
        """Exact critical compression at a place in B/L², compression positive, (m, n)."""
        cosine = np.cos(np.radians(self.alphas))
        cosine[self.alphas == 90.0] = 0.0
        return -self.force + self.weights * cosine[:, None] * (1.0 - WHERE[place])

    def percent(self, key: str, place: Place) -> FloatArray:
        """100 (formula/exact − 1), (m, n); infinite where the rod buckles though a compression is not even there."""
        formula, exact = FORMULAS[key], self.exact(place)
        value = np.array([[formula.of(rod_of(self._at(w, a))) for w in self.weights] for a in self.alphas])
        out = np.full(exact.shape, math.inf)
        good = exact > self.error
        out[good] = 100.0 * (value[good] / exact[good] - 1.0)
        return out

    def _at(self, weight: float, alpha: float) -> Problem:
        return self.problem.but(weight=float(weight), alpha=float(alpha))


def chart_weights(weight: float, count: int) -> FloatArray:
    """Weights γ for the chart of a case, evenly spaced in their logarithm, the case's own in the middle if possible."""
    middle = min(max(weight, REACH), LARGEST_WEIGHT / REACH)
    top = middle * REACH if middle * REACH <= HEAVY else max(weight, HEAVY)
    return np.geomspace(middle / REACH, top, count)


def chart_over(
    problem: Problem,
    weights: Sequence[float] | FloatArray | None = None,
    alphas: Sequence[float] | FloatArray | None = None,
) -> dict[str, list[float] | float]:
    """What :func:`rodwell.map` is to go over for a chart: γ and α in degrees, chosen around the problem if not given.

    Raises
    ------
    InputError
        For an empty range.
    """
    heavy = problem.weight * REACH > HEAVY
    gammas = chart_weights(problem.weight, 13 if heavy else 23) if weights is None else np.asarray(weights, dtype=float)
    angles = np.array(ALPHAS[:: 1 + heavy] if alphas is None else alphas, dtype=float)
    if gammas.ndim != 1 or angles.ndim != 1 or min(gammas.size, angles.size) == 0 or gammas.size * angles.size == 1:
        raise InputError("weights, alphas", None, "must each be a list of at least one number, and one of two")
    grid = zip(OVER, (angles.tolist(), gammas.tolist()), strict=True)
    return {name: values if len(values) > 1 else values[0] for name, values in grid}


def error_map(
    problem: Problem,
    weights: Sequence[float] | FloatArray | None = None,
    alphas: Sequence[float] | FloatArray | None = None,
    *,
    rtol: float = RTOL,
    workers: int | Workers = 1,
    progress: Progress | None = None,
) -> ErrorMap:
    """Compute the first critical load over weight and inclination, as a map in memory.

    To keep it, to go on with it or to put it on a cluster, call :func:`rodwell.map` with :func:`chart_over`, and
    :meth:`ErrorMap.of` with what it returns.

    Parameters
    ----------
    problem
        Clearance, ends and the side of the wall; its weight sets the range.
    weights, alphas
        γ and α in degrees; chosen around the problem's weight, and 0 to 90, if not given.
    rtol
        Tolerance of each load.
    workers, progress
        As for :func:`rodwell.map`.

    Raises
    ------
    InputError
        For an empty range or values out of range.
    NotConvergedError
        If a critical load cannot be computed.
    """
    question = asked(problem, CRITICAL, chart_over(problem, weights, alphas), rtol=rtol)
    with team(workers) as found:
        return ErrorMap.of(in_memory(question, found, progress), problem)


def hanging_coefficients(
    sizes: Sequence[float], ends: tuple[str, str] = ("pinned", "pinned"), count: int = 2
) -> tuple[FloatArray, FloatArray]:
    """Compression at the bottom of a vertical string over (B w²)^⅓, for lengths L = X (B/w)^⅓.

    Parameters
    ----------
    sizes
        X (n,).
    ends
        At s = 0, the bottom, and s = 1.
    count
        How many loads.

    Returns
    -------
    tuple
        Coefficients and their errors, each (n, count). With no end force at all the coefficient would be X.
    """
    out = np.empty((2, len(sizes), count))
    for i, size in enumerate(sizes):
        loads = critical_loads(Problem(size**3, alpha=0.0, ends=ends), count)
        out[0, i] = (size**3 - loads.forces) / size**2
        out[1, i] = loads.errors / size**2
    return out[0], out[1]
