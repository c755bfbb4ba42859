"""Formulas of practice beside exact loads: error, safe or unsafe, inside or outside their validity."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rodwell.answers.comparison.exact_loads import PLACES, ExactLoad
from rodwell.case.case import Case
from rodwell.errors import InputError, checked_number
from rodwell.formulas import FORMULAS, Formula, FormulaInputs
from rodwell.formulas.helix import LARGEST_HELIX, small_angle_error
from rodwell.formulas.record import Place
from rodwell.problem.problem import Problem

AGAINST = {"sinusoidal": ("critical",), "helical": ("lift_off", "critical")}
"""Exact loads that a kind of formula is held against: the first that is known."""


MEANT = {
    "chen_lin_cheatham": "equal_energy",
    "chen_lin_cheatham_finite": "equal_energy",
    "mitchell_unloading": "touch_down",
}
"""Formulas that mean another exact load, used where it is known."""


EXTRA = {
    "mu": (0.0, 10.0, "a coefficient of friction from 0 to 10"),
    "build": (-10.0, 10.0, "dα/ds in radians over the length of the rod, from -10 to 10"),
    "turn": (-10.0, 10.0, "sin α dφ/ds in radians over the length of the rod, from -10 to 10"),
    "sigma_y": (0.0, 1e30, "a yield stress, positive"),
}
"""Quantities that a problem does not hold and :func:`audit` takes: lowest, highest, what is allowed."""


SAFE, UNSAFE, LOW, NO_LOAD = "safe", "unsafe", "low", "no load"
"""Verdicts on a formula's load."""

USELESS, NOT_APPLICABLE = "safe but useless", "not applicable"
FAR_BELOW = -50.0
"""A safe load this many percent from the exact one, or more, says nothing of where the rod buckles."""


@dataclass(frozen=True)
class Comparison:
    """A formula's load beside an exact one at one place. Compression positive, in B/L².

    ``percent`` is 100 (formula/exact − 1), None where the exact compression is not positive; ``percent_error`` its
    uncertainty from that of the exact load. ``safe``: the formula's load is not above the exact one (and its error);
    whether the formula's validity covers the rod is another matter, see :attr:`FormulaRow.verdict`.
    """

    load: str
    place: Place
    exact: float
    error: float
    percent: float | None
    percent_error: float | None
    safe: bool


@dataclass(frozen=True)
class SectionLoad:
    """A formula's load in one section of a string.

    ``value`` is that load in B/L², compression positive, ``force`` the end force of the string at s = 1 in B/L²,
    tension positive, at which the compression at the formula's place in the section comes to it.
    """

    section: str
    value: float
    force: float


@dataclass(frozen=True)
class FormulaRow:
    """A formula of a load: its value in B/L², compression positive, beside the exact loads at all three places.

    ``against`` names the exact load that its kind asks for; ``reasons`` why the rod is outside the formula's validity
    (none: inside); ``missing`` the quantities that were not given, without which there is no value. Of a string
    ``section`` names the one whose compression comes to the formula's load first, to which all of that belongs, and
    ``by_section`` has its load in each.
    """

    formula: Formula
    value: float | None
    against: str
    comparisons: tuple[Comparison, ...]
    reasons: tuple[str, ...]
    missing: tuple[str, ...]
    section: str = ""
    by_section: tuple[SectionLoad, ...] = ()

    @property
    def at(self) -> str:
        """Where its force is meant, in words: "bottom"; of a string "bottom of drill pipe"."""
        return f"{self.formula.place} of {self.section}" if self.section else str(self.formula.place)

    @property
    def valid(self) -> bool:
        """Whether the rod is inside the formula's validity."""
        return not self.reasons

    @property
    def main(self) -> Comparison | None:
        """The comparison with the exact load that its kind asks for, where the formula's force is meant."""
        return self.beside(self.against, self.formula.place)

    @property
    def verdict(self) -> str:
        """How its load stands to the exact one where its force is meant: "unsafe" above it, "safe" below it.

        Below the exact load but outside the formula's validity it is "low", which is no warrant that it stays there.
        "no load" where it is 0, empty where there is nothing to hold it against.
        """
        main = self.main
        if main is None:
            return ""
        if self.value == 0.0:
            return NO_LOAD
        return UNSAFE if not main.safe else SAFE if self.valid else LOW

    @property
    def judgement(self) -> str:
        """The verdict for those who use the formula: "safe", "safe but useless", "unsafe", "not applicable"."""
        if not self.valid or self.main is None:
            return NOT_APPLICABLE
        percent = self.main.percent
        return USELESS if self.verdict == SAFE and percent is not None and percent <= FAR_BELOW else self.verdict

    def beside(self, load: str, place: Place | None) -> Comparison | None:
        """Return the comparison with an exact load at a place."""
        return next((c for c in self.comparisons if (c.load, c.place) == (load, place)), None)


@dataclass(frozen=True)
class Other:
    """A formula that gives no critical load, at the bottom's compression in the first critical load or one that acts.

    ``value`` is in units B = L = 1; ``relative_error`` what the small-angle formulas of the weightless helix lack.
    """

    formula: Formula
    value: float | None
    relative_error: float | None
    reasons: tuple[str, ...]
    missing: tuple[str, ...]


def load_rows(
    case: Case | Problem, loads: tuple[ExactLoad, ...], extra: Mapping[str, float] | None = None
) -> tuple[FormulaRow, ...]:
    """Hold every formula of a load against exact ones that are known: the first critical load first."""
    rod = _known_rod(case, extra or {})
    order = [f for kind in AGAINST for f in FORMULAS.values() if f.kind == kind]
    problem = case.problem if isinstance(case, Case) else case
    return tuple(row(formula, rod, loads, problem.hole is not None) for formula in order)


def _known_rod(case: Case | Problem, extra: Mapping[str, float]) -> FormulaInputs:
    """The rod with all that the case and ``extra`` tell of it."""
    problem = case.problem if isinstance(case, Case) else case
    known = bends_of(problem, extra) | _section(case) | extra_of(extra)
    return rod_of(problem, tuple(known.items()))


def bends_of(problem: Problem, extra: Mapping[str, float]) -> dict[str, float]:
    """Build and turn in 1/L of the hole at mid-length, 0 of a straight one."""
    if problem.hole is None:
        return {"build": 0.0, "turn": 0.0}
    for name in ("build", "turn"):
        if name in extra:
            raise InputError(name, extra[name], "is given twice: the hole of the problem is curved; leave it out")
    k1, k2 = problem.hole.curvatures(np.array([0.5]))[0]
    return {"build": float(k1), "turn": -float(k2)}


def rod_of(problem: Problem, more: tuple[tuple[str, float], ...] = ()) -> FormulaInputs:
    """Return the rod of a problem in units B = L = 1, as formulas take it."""
    alpha = 180.0 - problem.alpha if problem.floats else problem.alpha  # a rod that floats is one upside down
    return FormulaInputs(1.0, problem.weight, alpha, problem.clearance, 1.0, problem.ends, problem.pressed, more)


def extra_of(extra: Mapping[str, float]) -> dict[str, float]:
    """What was given besides, checked."""
    for name in extra:
        if name not in EXTRA:
            raise InputError("extra", name, f"is not a quantity that can be given; these can: {', '.join(EXTRA)}")
    return {name: checked_number(name, value, *EXTRA[name]) for name, value in extra.items()}


def _section(case: Case | Problem) -> dict[str, float]:
    """Outer diameter, area, second moment of area and yield stress in units B = L = 1: what the case gives."""
    if not isinstance(case, Case) or case.scales is None or case.rod is None:
        return {}
    rod, length, out = case.rod, case.scales.length, {}
    if rod.outer_diameter is not None and not rod.bore_known:
        out = {"D": rod.outer_diameter / length}
    elif rod.outer_diameter is not None:
        out = {"D": rod.outer_diameter / length, "A": rod.area / length**2, "I": rod.inertia / length**4}
    if rod.yield_strength is not None:
        out["sigma_y"] = rod.yield_strength / case.scales.factor("stress")
    return out


def value_of(formula: Formula, rod: FormulaInputs, missing: tuple[str, ...]) -> float | None:
    """Value, or None where the formula has none."""
    if missing:
        return None
    try:
        value = formula.of(rod)
    except (ZeroDivisionError, InputError):
        return None
    return value if math.isfinite(value) else None


def row(formula: Formula, rod: FormulaInputs, loads: tuple[ExactLoad, ...], curved: bool) -> FormulaRow:
    """A formula of a load for a rod beside exact loads at its three places."""
    missing, reasons = formula.missing(rod), list(formula.violations(rod))
    value = value_of(formula, rod, missing)
    takes = bool({"build", "turn"} & set(formula.takes))
    bent = not curved and takes and any(dict(rod.more).get(name) for name in ("build", "turn"))
    if bent:
        reasons.append("the exact loads are those of a straight hole: not compared")
    if curved and not takes:
        reasons.append("for straight holes, and this one is curved")
    names = [load.name for load in loads]
    wanted = (MEANT.get(formula.key, ""), *AGAINST[formula.kind])
    against = next(name for name in wanted if name in names)
    pairs = [] if value is None or bent else [compare(value, load, place) for load in loads for place in PLACES]
    return FormulaRow(formula, value, against, tuple(pairs), tuple(reasons), missing)


def compare(value: float, load: ExactLoad, place: Place) -> Comparison:
    """Hold the compression ``value`` in B/L² against an exact load at a place."""
    exact = load.at(place)
    percent = error = None
    if exact > load.error:
        percent = 100.0 * (value / exact - 1.0)
        error = 100.0 * abs(value) / exact * load.error / exact
    return Comparison(load.name, place, exact, load.error, percent, error, value <= exact + load.error)


def _other(formula: Formula, rod: FormulaInputs, load: ExactLoad, problem: Problem) -> Other:
    """A formula of another kind, at the bottom's compression in a load: the first critical one, or one that acts."""
    force = load.at("bottom")
    more: dict[str, float] = {"F": force} if force > 0.0 else {}
    if rod.lateral > 0.0:
        more["F_p"] = FORMULAS["dawson_paslay"].of(rod)
    if problem.twist != 0.0:
        more["T"] = problem.twist
    if force > 0.0:
        more["p"] = math.pi * math.sqrt(8.0 / force)
    full = FormulaInputs(rod.B, rod.w, rod.alpha, rod.r, rod.L, rod.ends, rod.pressed, (*rod.more, *more.items()))
    missing = formula.missing(full)
    error = None
    if not missing and formula.kind == "helix" and 0.0 < force * rod.r**2 < LARGEST_HELIX:
        error = small_angle_error(formula.key, 1.0, rod.r, force)
    return Other(formula, value_of(formula, full, missing), error, tuple(formula.violations(full)), missing)
