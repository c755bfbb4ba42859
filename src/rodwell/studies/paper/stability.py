"""Stability diagrams: Fig. 5, 6, 12(b) and 13, loads against weight."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.curves.critical import critical_curves
from rodwell.analysis.curves.curve import Curve
from rodwell.analysis.curves.states import lift_off_curve
from rodwell.errors import NotConvergedError
from rodwell.formulas import FORMULAS
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.studies.maps.memory import in_memory
from rodwell.studies.maps.question import asked
from rodwell.studies.maps.workers import team
from rodwell.studies.paper.work import CLEARANCE, Work, rod

FIG5_WEIGHTS = (5.0, 40.0, 140.0, 280.0)
"""γ of the panels of Fig. 5, marked by diamonds."""

STEPS = (0.15, 0.5, 1.0, 1.35)
"""Compressions of these panels, as parts of the way from buckling to lift-off."""

INCLINED = ((60.0, 300.0), (30.0, 300.0), (10.0, 300.0), (5.0, 200.0), (2.0, 150.0), (0.0, 350.0))
"""Fig. 6(a) to (f): α in degrees, and the γ up to which the panel goes."""

FIG13_ALPHAS = (90.0, 60.0)
"""α in degrees of Fig. 13(a) and (b)."""

GRID = 601
"""Weights at which curves are drawn."""


@dataclass(frozen=True)
class Stability:
    """A stability diagram.

    Attributes
    ----------
    label
        What tells the panel from the others.
    problem
        The rod.
    until
        γ up to which it goes.
    critical
        Curves of critical loads, in the order of compression at the start.
    lift_off
        Pieces of the lift-off curve of the first mode: γ and F, (n,) each; empty where lift-off coincides with
        buckling.
    """

    label: str
    problem: Problem
    until: float
    critical: tuple[Curve, ...]
    lift_off: tuple[tuple[FloatArray, FloatArray], ...]

    @property
    def weights(self) -> FloatArray:
        """γ at which the curves are drawn, double points among them."""
        marks = [mark.x for curve in self.critical for mark in curve.marks]
        return np.unique(np.concatenate([np.linspace(0.0, self.until, GRID), marks]))

    def load(self, number: int) -> FloatArray:
        """F of one curve at :attr:`weights`, by a cubic spline through its points."""
        from scipy.interpolate import CubicSpline  # noqa: PLC0415 - slow to import

        curve = self.critical[number]
        return np.asarray(CubicSpline(curve.x, curve.values)(self.weights))

    @property
    def first(self) -> FloatArray:
        """F of the first critical load at :attr:`weights`."""
        return np.asarray(np.max([self.load(i) for i in range(len(self.critical))], axis=0))


@dataclass(frozen=True)
class StabilityRow:
    """States of one weight under growing compression, Fig. 5: the one at lift-off and its place among them."""

    weight: float
    states: tuple[Solution, ...]
    lift: SpecialPoint
    at_lift: int


@dataclass(frozen=True)
class Fig5:
    """Fig. 5: the diagram, and the panels below it."""

    diagram: Stability
    rows: tuple[StabilityRow, ...]


def fig5(work: Work) -> Fig5:
    """Stability diagram of the horizontal rod, and states at γ = 5, 40, 140, 280."""
    problem, until = rod(0.0), 300.0
    critical = critical_curves(problem, "weight", (0.0, until), modes=4, rtol=work.rtol)
    lifts = sound(lift_off_curve(problem, "weight", (0.0, until), mode=mode, rtol=work.rtol) for mode in (1, 2))
    switches = sorted(mark.x for mark in critical[0].marks if mark.note == "modes 1 and 2 switch")
    edges = [0.0, *switches, until]
    pieces = [_piece(lifts[i % 2], low, high) for i, (low, high) in enumerate(pairwise(edges))]
    diagram = Stability("", problem, until, critical, tuple(pieces))
    return Fig5(diagram, tuple(_row(work, weight) for weight in FIG5_WEIGHTS))


def sound(curves: Iterable[Curve]) -> tuple[Curve, ...]:
    """Return the curves, or raise if a point misses the tolerance, or if one does not reach the end of its range."""
    traced = tuple(curves)
    for curve in traced:
        if not curve.converged or curve.ended_because != "end":
            raise NotConvergedError(f"{curve!r} at α = {curve.problem.alpha:g}: {curve.ended_because}")
    return traced


def _piece(curve: Curve, low: float, high: float) -> tuple[FloatArray, FloatArray]:
    """A lift-off curve between two weights."""
    if np.any(np.diff(curve.x) <= 0.0):
        raise NotConvergedError("the lift-off curve of the horizontal rod turns back: it has no value at each weight")
    inside = (curve.x > low) & (curve.x < high)
    x = np.concatenate([[low], curve.x[inside], [high]])
    return x, np.interp(x, curve.x, curve.values)


def _row(work: Work, weight: float) -> StabilityRow:
    problem = rod(weight)
    lift = work.branch(problem).lift_off
    if lift is None:
        raise NotConvergedError(f"γ = {weight:g}: no lift-off")
    start = work.critical(problem, 1)[0].force
    forces = [start + part * (lift.force - start) for part in STEPS]
    branch = work.branch(problem, 1, forces[-1])
    at_lift = STEPS.index(1.0)
    states = tuple(lift.solution if i == at_lift else branch.at(force) for i, force in enumerate(forces))
    return StabilityRow(weight, states, lift, at_lift)


def fig6(work: Work) -> tuple[Stability, ...]:
    """Stability diagrams of inclined rods, Fig. 6(a) to (f)."""
    return tuple(
        inclined(work, f"({letter})", alpha, until) for letter, (alpha, until) in zip("abcdef", INCLINED, strict=True)
    )


def inclined(work: Work, label: str, alpha: float, until: float) -> Stability:
    """Stability diagram of a rod at α degrees up to a weight; of a vertical one without lift-off, where it buckles."""
    problem = rod(0.0, alpha)
    critical = critical_curves(problem, "weight", (0.0, until), modes=3, rtol=work.rtol)
    if alpha == 0.0:
        return Stability(label, problem, until, critical, ())
    (curve,) = sound((lift_off_curve(problem, "weight", (0.0, until), rtol=work.rtol),))
    return Stability(label, problem, until, critical, ((curve.x, curve.values),))


def fig12b(work: Work) -> Stability:
    """Critical loads of the rod on top, Fig. 12(b)."""
    problem, until = rod(0.0, on_top=True), 160.0
    return Stability("(b)", problem, until, critical_curves(problem, "weight", (0.0, until), rtol=work.rtol), ())


@dataclass(frozen=True)
class Fit:
    """First critical load and Dellinger's fit (89); Fig. 13.

    Attributes
    ----------
    label, alpha
        The panel, and α in degrees.
    weights, exact, fit
        γ, critical end force F (tension positive) and compression −F by the fit, (n,) each.
    """

    label: str
    alpha: float
    weights: FloatArray
    exact: FloatArray
    fit: FloatArray


def fig13(work: Work) -> tuple[Fit, ...]:
    """Fig. 13(a) and (b): α = π/2 and π/3; a map of first critical loads."""
    formula, switches = FORMULAS["dellinger"].function, [n * n * (n + 2) ** 2 * np.pi**4 * CLEARANCE for n in (1, 2, 3)]
    weights = np.unique([*np.linspace(0.0, 300.0, 101), *switches])
    question = asked(rod(0.0), "critical", {"alpha": list(FIG13_ALPHAS), "weight": weights}, rtol=work.rtol)
    with team(1) as alone:
        exact = in_memory(question, alone)
    exact.refuse_gaps()
    fits = [[formula(1.0, weight, alpha, CLEARANCE) for weight in weights] for alpha in FIG13_ALPHAS]
    panels = zip(("(a)", "(b)"), FIG13_ALPHAS, exact.values, fits, strict=True)
    return tuple(Fit(label, alpha, weights, loads, np.array(fit)) for label, alpha, loads, fit in panels)
