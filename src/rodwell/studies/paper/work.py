"""Computations that several claims or figures share: each is made once."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, TypeVar

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.special import BRANCH_POINT, SpecialPoint
from rodwell.analysis.loads.torsion import Torsion, torsion
from rodwell.analysis.straight.critical import CriticalLoads, critical_loads
from rodwell.errors import NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import RTOL, checked_rtol
from rodwell.quantities.value import Value

T = TypeVar("T")

CLEARANCE, POISSON = 0.01, 0.3
"""Δ/L and ν of all calculations in the paper (section 4)."""

WEIGHTS = (1.0, 400.0)
"""Weights γ between which the paper's weights of buckling without end force lie."""

TWISTED_TO = 40.0
"""Twist T₁ in B/L to which a prepared rod is twisted."""


def rod(weight: float, alpha: float = 90.0, **more: Any) -> Problem:
    """Return a rod of the paper: clamped, Δ/L = 0.01, ν = 0.3."""
    return Problem(weight, alpha, CLEARANCE, POISSON, **more)


class Work:
    """What is computed on the way, kept.

    Parameters
    ----------
    rtol
        Relative tolerance of every computed number.
    """

    WARM = rod(15.0)
    """A rod whose branch takes every compiled kernel."""

    def __init__(self, rtol: float = RTOL) -> None:
        self.rtol = checked_rtol(rtol)
        self._kept: dict[Any, Any] = {}

    def critical(self, problem: Problem, count: int = 4) -> CriticalLoads:
        """Critical loads of the straight rod."""
        return self.once(("critical", problem, count), lambda: critical_loads(problem, count, rtol=self.rtol))

    def branch(self, problem: Problem, mode: int = 1, until: float | None = None) -> Branch:
        """Branch of a mode, ω₂(1) < 0, to an end force or to lift-off."""
        branch = self.once(("branch", problem, mode, until), lambda: follow(problem, mode, until=until, rtol=self.rtol))
        if not branch.reached_end:
            raise NotConvergedError(
                f"γ = {problem.weight:g}, α = {problem.alpha:g}, mode {mode}: {branch.ended_because}"
            )
        return branch

    def twisted(self, problem: Problem, mode: int = 1, *, mirror: bool = False) -> Torsion:
        """What twist does to the rod at its lift-off load."""
        return self.once(
            ("twisted", problem, mode, mirror),
            lambda: torsion(problem, mode, mirror=mirror, until=TWISTED_TO, rtol=self.rtol),
        )

    def branch_point(self, problem: Problem, mode: int, until: float) -> SpecialPoint:
        """The first secondary bifurcation of a mode's branch."""
        points = [p for p in self.branch(problem, mode, until).special_points if p.kind == BRANCH_POINT]
        if not points:
            raise NotConvergedError(f"γ = {problem.weight:g}: no secondary bifurcation on mode {mode} to F = {until:g}")
        return points[0]

    def buckling_weight(self, problem: Problem, mode: int = 1) -> Value:
        """Weight γ at which a mode's critical end force is zero.

        Between ``WEIGHTS``; the error is that of the load over its slope against the weight.
        """
        return self.once(("weight", problem, mode), lambda: self._zero(problem, mode))

    def _zero(self, problem: Problem, mode: int) -> Value:
        from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

        def load(weight: float) -> Value:
            return critical_loads(problem.but(weight=weight), mode, rtol=self.rtol)[-1].load

        root = float(brentq(lambda w: load(w).value, *WEIGHTS, xtol=1e-12, rtol=1e-14))
        force, error = load(root)
        step = 1e-4 * root
        slope = (load(root + step).value - load(root - step).value) / (2.0 * step)
        return Value(root, float((abs(force) + error) / abs(slope) + 4e-14 * root))

    def once(self, key: Hashable, compute: Callable[[], T]) -> T:
        """Return what is kept under ``key``, computed when it is first asked for."""
        if key not in self._kept:
            self._kept[key] = compute()
        kept: T = self._kept[key]
        return kept
