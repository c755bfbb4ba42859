"""Formulas of practice beside the exact loads of one rod: error, safe or unsafe, inside or outside their validity."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from rodwell.answers.comparison.beside import AGAINST, FormulaRow, Other, _known_rod, _other, load_rows
from rodwell.answers.comparison.by_sections import above_middle, string_rows
from rodwell.answers.comparison.exact_loads import ExactLoad, exact_loads
from rodwell.case.applied import AppliedLoad
from rodwell.case.case import Case
from rodwell.case.checks.rigid_wall import warn_if_it_gives_way
from rodwell.errors import InputError
from rodwell.faces import plain
from rodwell.formulas import FORMULAS, FormulaInputs
from rodwell.problem.problem import Problem
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain as text_of
from rodwell.quantities.tolerance import RTOL


@dataclass(frozen=True)
class AtApplied:
    """The other formulas at a load that acts.

    Attributes
    ----------
    load
        The load of ``load.applied``.
    exact
        The same as end force at s = 1 in B/L², tension positive; its label says where it was given.
    straight
        Whether the exact rod is still straight at it: what formulas say of the buckled rod then says nothing.
    others
        The formulas, at the bottom's compression in this load.
    """

    load: AppliedLoad
    exact: ExactLoad
    straight: bool
    others: tuple[Other, ...]


@dataclass(frozen=True)
class Audit:
    """What :func:`audit` found.

    Attributes
    ----------
    problem, scales, title
        The rod; scales are None without dimensions.
    loads, not_found
        Exact loads, and which could not be had with the reason.
    rows
        Formulas of loads: sinusoidal, then helical; of a string section by section, each in the one that governs.
    others
        All other formulas, at the first critical load; none of a string.
    applied
        All other formulas at each of the loads that act; none where the case has none, or of a string.
    """

    problem: Problem
    scales: Scales | None
    title: str
    loads: tuple[ExactLoad, ...]
    not_found: tuple[str, ...]
    rows: tuple[FormulaRow, ...]
    others: tuple[Other, ...]
    applied: tuple[AtApplied, ...] = ()

    @property
    def critical(self) -> ExactLoad:
        """First of the exact loads: the critical one, or what takes its place out of the vertical plane."""
        return self.loads[0]

    def row(self, key: str) -> FormulaRow:
        """Return the row of a formula by its key."""
        return next(row for row in self.rows if row.formula.key == key)

    def factor(self, dimension: tuple[int, int]) -> float:
        """SI value of one unit of a quantity with these powers of force and length; 1 without dimensions."""
        if self.scales is None:
            return 1.0
        return float(self.scales.factor("force") ** dimension[0] * self.scales.length ** dimension[1])

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain data, for JSON."""
        return plain(self)


def audit(case: Case | Problem, *, extra: Mapping[str, float] | None = None, rtol: float | None = None) -> Audit:
    """Hold every formula of practice against the exact loads of a rod.

    Parameters
    ----------
    case
        The rod. Formulas are evaluated in units B = L = 1, as the paper does with Dellinger's fit, whose value
        depends on the unit of length (by 0.4 % between metres and inches).
    extra
        Quantities that some formulas take and a case does not hold, in units B = L = 1: "mu"; "build" and "turn" (angle
        over the length of the rod, of formulas beside a straight hole), "sigma_y". Exact loads are those of the case's
        hole, straight or curved, without friction.
    rtol
        Relative tolerance of the exact loads; that of the case, or 1e-8.

    Raises
    ------
    InputError
        If ``extra`` holds an unknown quantity or a value out of range, the rod is coiled, or a string has steps of its
        clearance.
    NotConvergedError
        If the first critical load cannot be computed.
    """
    if not isinstance(case, Case | Problem):
        raise InputError("case", case, "must be a rodwell.Case or a rodwell.Problem")
    problem, scales, title = case, None, "Audit"
    if isinstance(case, Case):
        warn_if_it_gives_way(case.given)
        problem, scales, title = case.problem, case.scales, case.title
        rtol = case.rtol if rtol is None else rtol
    assert isinstance(problem, Problem)
    problem.refuse_bridges("formulas of practice, and the exact loads beside them,")
    if problem.hung_weight < 0.0:
        reason = (
            "makes compression grow towards s = 1, and formulas of practice count from the end that weight loads: "
            "audit the rod seen from its other end (and upside down, if it floats)"
        )
        name = "floats" if problem.floats else "alpha"
        raise InputError(name, getattr(problem, name), reason)
    loads, notes = exact_loads(problem, RTOL if rtol is None else rtol)
    if problem.sections or problem.hole is not None:
        loads = tuple(replace(load, above_middle=above_middle(problem)) for load in loads)
    if problem.sections:
        rows = string_rows(case, loads, extra)
        return Audit(problem, scales, title, loads, (*notes, OF_A_SECTION), rows, ())
    rod = _known_rod(case, extra or {})
    rows = load_rows(case, loads, extra)
    others = _others(rod, loads[0], problem)
    applied = () if not isinstance(case, Case) else tuple(_at(case, load, rod, loads[0]) for load in case.applied)
    return Audit(problem, scales, title, loads, notes, rows, others, applied)


OF_A_SECTION = (
    "formulas of pitch, contact, stress, shortening and lock-up: those of a uniform rod; audit the section that "
    "buckles as a rod of its own"
)
"""What is not compared of a string."""


def _others(rod: FormulaInputs, load: ExactLoad, problem: Problem) -> tuple[Other, ...]:
    return tuple(_other(f, rod, load, problem) for f in FORMULAS.values() if f.kind not in AGAINST)


def _at(case: Case, load: AppliedLoad, rod: FormulaInputs, critical: ExactLoad) -> AtApplied:
    """The other formulas at a load that acts."""
    given = f"{text_of(load.given, 6)} B/L²" if case.scales is None else case.scales.system.text(load.given, "force", 6)
    number = "" if len(case.applied) == 1 else f" {1 + case.applied.index(load)}"
    label = f"applied load{number}, {given} at the {'bottom' if load.bottom else 'top'}"
    exact = ExactLoad("applied", label, load.force, 0.0, case.problem.hung_weight, critical.above_middle)
    return AtApplied(load, exact, load.force >= critical.force, _others(rod, exact, case.problem))
