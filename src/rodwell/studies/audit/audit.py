"""Formulas of practice beside the exact loads of one rod: error, safe or unsafe, inside or outside their validity."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rodwell.answers.comparison.beside import AGAINST, FormulaRow, Other, _known_rod, _other, load_rows
from rodwell.answers.comparison.exact_loads import ExactLoad, exact_loads
from rodwell.case.case import Case
from rodwell.errors import InputError
from rodwell.faces import plain
from rodwell.formulas import FORMULAS
from rodwell.problem.problem import Problem
from rodwell.quantities.scales import Scales
from rodwell.quantities.tolerance import RTOL


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
        Formulas of loads: sinusoidal, then helical.
    others
        All other formulas.
    """

    problem: Problem
    scales: Scales | None
    title: str
    loads: tuple[ExactLoad, ...]
    not_found: tuple[str, ...]
    rows: tuple[FormulaRow, ...]
    others: tuple[Other, ...]

    @property
    def critical(self) -> ExactLoad:
        """First critical load."""
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
        over the length of the rod), "sigma_y". Exact loads are those of a straight hole without friction.
    rtol
        Relative tolerance of the exact loads; that of the case, or 1e-8.

    Raises
    ------
    InputError
        If ``extra`` holds an unknown quantity or a value out of range, or the rod is coiled.
    NotConvergedError
        If the first critical load cannot be computed.
    """
    if not isinstance(case, Case | Problem):
        raise InputError("case", case, "must be a rodwell.Case or a rodwell.Problem")
    problem, scales, title = case, None, "Audit"
    if isinstance(case, Case):
        problem, scales, title = case.problem, case.scales, case.title
        rtol = case.rtol if rtol is None else rtol
    assert isinstance(problem, Problem)
    loads, notes = exact_loads(problem, RTOL if rtol is None else rtol)
    rod = _known_rod(case, extra or {})
    rows = load_rows(case, loads, extra)
    others = tuple(_other(f, rod, loads[0], problem) for f in FORMULAS.values() if f.kind not in AGAINST)
    return Audit(problem, scales, title, loads, notes, rows, others)
