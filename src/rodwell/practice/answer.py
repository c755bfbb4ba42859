"""The answer to a case: critical loads, branches, lift-off, wall loads, and what they mean."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from rodwell._version import __version__
from rodwell.analysis import ahead
from rodwell.analysis.branches import Branch
from rodwell.analysis.certificate import Certificate
from rodwell.analysis.critical import CriticalLoads, Mode, critical_loads
from rodwell.analysis.exploring import Progress
from rodwell.analysis.follow import extended, follow
from rodwell.analysis.sensitivity import Sensitivity, of_critical_load, of_lift_off
from rodwell.analysis.solution import Solution
from rodwell.analysis.special import SpecialPoint
from rodwell.display import Shown, drawn
from rodwell.errors import NotConvergedError
from rodwell.practice.case import Case
from rodwell.practice.figures import (
    Figure,
    critical_figure,
    critical_length,
    force_scale,
    real_force,
    state_figures,
    stress_figure,
)
from rodwell.practice.uncertainty import Spread, spread_of_load
from rodwell.problem import ends_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from rodwell.analysis.measures import Measured
    from rodwell.practice.assessment import Assessment


@dataclass(frozen=True)
class Answer(Shown):
    """What was computed for a case.

    Attributes
    ----------
    case
        The case.
    critical
        Critical loads and modes of the straight rod.
    branches
        Buckled branches of the modes met before ``until``; the first is that of mode 1.
    until
        End force in B/L² to which they were followed.
    """

    case: Case
    critical: CriticalLoads
    branches: tuple[Branch, ...]
    until: float

    @property
    def first(self) -> Branch:
        """The branch of the first mode."""
        return self.branches[0]

    @property
    def lift_off(self) -> SpecialPoint | None:
        """Lift-off of the first mode."""
        return self.first.lift_off

    @cached_property
    def at_lift_off(self) -> Solution | None:
        """The state of the first mode at lift-off, None where lift-off coincides with buckling."""
        if self.lift_off is None or self.first.lift_off_at_buckling:
            return None
        return self.lift_off.solution

    @property
    def shown(self) -> Solution:
        """The state that pictures show: the first mode at lift-off, or else at the end of its branch."""
        return self.at_lift_off or self.first[-1]

    @property
    def converged(self) -> bool:
        """Whether every reported number meets the tolerance: branches, special points and key figures."""
        rtol = self.case.rtol
        return (
            all(branch.converged for branch in self.branches)
            and all(figure.error <= rtol * figure.scale for figure in self.figures.values())
            and self.assessment.converged
        )

    @cached_property
    def assessment(self) -> Assessment:
        """Stress and safety, the safe window and its limits, the loads that act, formulas beside the exact loads."""
        from rodwell.practice.assessment import Assessment  # noqa: PLC0415 - it looks at answers

        return Assessment(self)

    @cached_property
    def worst_certificate(self) -> Certificate:
        """Certificate of the state that solves the paper's equations least well, over all points of all branches."""
        states = [
            state for branch in self.branches for state in (*branch, *(p.solution for p in branch.special_points))
        ]
        certificates = [state.certificate for state in states]
        worst: Certificate = max(certificates, key=lambda certificate: certificate.worst)
        return worst

    @cached_property
    def sensitivities(self) -> tuple[Sensitivity, ...]:
        """How the first critical load and the lift-off load change with the inputs."""
        out = [of_critical_load(self.critical[0])]
        if self.at_lift_off is not None and self.lift_off is not None:
            out.append(of_lift_off(self.lift_off))
        return tuple(out)

    @cached_property
    def spreads(self) -> tuple[Spread | None, ...]:
        """Uncertainty of each of these loads from those of the inputs, None where no input was given with "±"."""
        return tuple(spread_of_load(load, self.case.scales, self.case.uncertain) for load in self.sensitivities)

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """The key figures by name."""
        out = [critical_figure(mode) for mode in self.critical]
        out += real_force(out[0], self.case) + critical_length(self.case.problem)
        lift = self.lift_off
        if lift is not None:
            note = "at s/L = " + ", ".join(f"{s:.6g}" for s in lift.s)
            if self.first.lift_off_at_buckling:
                note = "coincides with buckling: no lateral weight presses the rod to the wall"
            label = "Lift-off load, end force at s = 1"
            out.append(Figure("lift_off_load", label, lift.force, lift.error, "force", force_scale(lift.force), note))
            out += real_force(out[-1], self.case)
        if self.at_lift_off is not None:
            out += state_figures(self.at_lift_off)
        out += self.assessment.figures
        if self.at_lift_off is not None and self.case.cylinder is not None and self.case.scales is not None:
            out.append(stress_figure(self.at_lift_off, self.case.cylinder, self.case.scales))
        return {figure.name: figure for figure in out}

    def plot(self, ax: Axes | None = None, *, ordinate: Measured | None = None) -> Axes:
        """Draw the bifurcation diagram in the case's units: see :meth:`rodwell.Branch.plot`; return the axes."""
        return drawn(self, ax, ordinate=ordinate)

    @property
    def _loads(self) -> list[tuple[Sensitivity, Spread | None]]:
        return list(zip(self.sensitivities, self.spreads, strict=True))

    def as_dict(self) -> dict[str, Any]:
        """Return the answer as plain data, for JSON."""
        case, problem = self.case, self.case.problem
        lift, assessment = self.lift_off, self.assessment.as_dict()
        return {
            "title": case.title,
            "verdict": assessment.pop("verdict"),
            "rodwell_version": __version__,
            "conventions": "units B = L = 1 unless si, field or mm; end force at s = 1, tension positive"
            + (", effective" if case.with_fluids else "")
            + "; "
            + ends_text(problem),
            "problem": {
                "weight": problem.weight,
                "alpha": problem.alpha,
                "clearance": problem.clearance,
                "poisson": problem.poisson,
                "twist": problem.twist,
                "ends": list(problem.ends),
            },
            "critical_loads": [float(f) for f in self.critical.forces],
            "critical_errors": [float(e) for e in self.critical.errors],
            "lift_off": None
            if lift is None
            else {
                "force": lift.force,
                "error": lift.error,
                "s": list(lift.s),
                "coincides_with_buckling": self.first.lift_off_at_buckling,
            },
            "conversions": [fact.as_dict() for fact in case.facts],
            "yield_strength_Pa": case.yield_strength,
            "figures": {name: figure.as_dict(case) for name, figure in self.figures.items()},
            "branches": [_branch_dict(branch) for branch in self.branches],
            "assessment": assessment,
            "sensitivities": [load.as_dict() | _spread(spread) for load, spread in self._loads],
            "converged": self.converged,
            "certificate": self.worst_certificate.as_dict(),
            "rtol": case.rtol,
        }


def _spread(spread: Spread | None) -> dict[str, Any]:
    """Uncertainty from the inputs, for JSON: in B/L², or in N for a case with dimensions."""
    if spread is None:
        return {"from_inputs": None}
    return {"from_inputs": {"total": spread.total, "parts": spread.parts}}


def _branch_dict(branch: Branch) -> dict[str, Any]:
    return {
        "mode": branch.mode.number if branch.mode else None,
        "points": len(branch),
        "reached_end": branch.reached_end,
        "ended_because": branch.ended_because,
        "special_points": [point.as_dict() for point in branch.special_points],
    }


def answer(case: Case, progress: Progress | None = None) -> Answer:
    """Compute a case: critical loads, the branch of each mode, lift-off of the first.

    Parameters
    ----------
    case
        The case.
    progress
        Called with what is being done and how much is done.

    Raises
    ------
    NotConvergedError
        If the critical loads or the first branch cannot be computed, or the first branch cannot be followed
        to ``load.until``; the message says why and how far it got.
    """
    tell = progress or (lambda _what, _done: None)
    problem = case.problem
    ahead.begin()
    tell("critical loads", 0.0)
    critical = critical_loads(problem, case.modes, rtol=case.rtol)
    tell("lift-off", 0.1)
    first, until = _first_branch(case, critical)
    branches = [first]
    followed = [mode for mode in critical if mode.force > until]
    for number, mode in enumerate(followed[1:], start=1):
        share = (0.9 / len(followed), 0.1 + 0.9 * number / len(followed))

        def report(force: float, mode: Mode = mode, share: tuple[float, float] = share) -> None:
            part = (mode.force - force) / (mode.force - until)
            tell(f"mode {mode.number} at F = {force:.4g} B/L²", share[1] + share[0] * min(max(part, 0.0), 1.0))

        branches.append(follow(problem, mode, until=until, rtol=case.rtol, progress=report))
    tell("done", 1.0)
    return Answer(case, critical, tuple(branches), until)


def _first_branch(case: Case, critical: CriticalLoads) -> tuple[Branch, float]:
    """Branch of the first mode, and the end force to follow branches to.

    That is the one asked for, if it buckles the rod; otherwise one past lift-off and all modes.
    """
    first = critical[0]
    if case.until is not None and case.until < first.force:
        branch = follow(case.problem, first, until=case.until, rtol=case.rtol)
        _check_reached(case, branch, case.until)
        return branch, case.until
    to_lift_off = follow(case.problem, first, rtol=case.rtol)
    until = _reach(critical, to_lift_off)
    return (extended(to_lift_off, until) if to_lift_off.reached_end else to_lift_off), until


def _reach(critical: CriticalLoads, to_lift_off: Branch) -> float:
    """End force past lift-off and all modes."""
    first, lift = critical[0].force, to_lift_off.lift_off
    beyond = [1.2 * (first - critical[-1].force), 0.3 * critical[0].wavenumber ** 2]
    if lift is not None:
        beyond.append(1.3 * (first - lift.force))
    return float(first - max(beyond))


def _check_reached(case: Case, branch: Branch, until: float) -> None:
    if branch.reached_end:
        return
    unit, factor = "B/L²", 1.0
    if case.scales is not None:
        size, unit = case.scales.system.unit("force")
        factor = case.scales.factor("force") / size
    raise NotConvergedError(
        f"load.until = {until * factor:.6g} {unit} cannot be reached: the branch of mode 1 goes no lower than "
        f"{branch.reach[0] * factor:.6g} {unit} and ends there or on its way back ({branch.ended_because}); "
        "give a load.until above that"
    )
