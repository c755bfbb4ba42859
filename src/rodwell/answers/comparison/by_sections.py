"""Formulas of practice for a string of sections: section by section, with its own data and the force that acts in it.

Formulas are those of a uniform rod. Each section is taken as one, in the hole beside it, and a formula's load is
reached where the compression at its place in a section comes to it first as the string is loaded: that section governs.
The exact loads are those of the whole string, with the compression that they make in that section.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.discrete.curved import hung, pieces_of, undeformed_place
from rodwell.answers.comparison.beside import AGAINST, FormulaRow, SectionLoad, bends_of, extra_of, value_of
from rodwell.answers.comparison.beside import row as row_of
from rodwell.answers.comparison.exact_loads import WHERE, ExactLoad
from rodwell.case.case import Case
from rodwell.case.string.sections import Member
from rodwell.formulas import FORMULAS, Formula, FormulaInputs
from rodwell.formulas.record import Place
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

ENDS_OF_ITS_OWN = "for a rod with these ends, and a section has neighbours"

LEAST_STIFFNESS = "tapers: taken with its least stiffness and its mean weight"


@dataclass(frozen=True)
class SectionRod:
    """A section as a rod of its own, in units B = L = 1 of the whole.

    ``hung`` is the axial weight above its top, its middle and its bottom, by place.
    """

    name: str
    rod: FormulaInputs
    hung: dict[Place, float]
    tapers: bool


def string_rows(
    case: Case | Problem, loads: tuple[ExactLoad, ...], extra: Mapping[str, float] | None = None
) -> tuple[FormulaRow, ...]:
    """Hold every formula of a load against exact ones of a string: the first critical load first."""
    problem = case.problem if isinstance(case, Case) else case
    sections = section_rods(case, extra or {})
    order = [f for kind in AGAINST for f in FORMULAS.values() if f.kind == kind]
    return tuple(_row(formula, sections, loads, problem.hole is not None) for formula in order)


def section_rods(case: Case | Problem, extra: Mapping[str, float]) -> tuple[SectionRod, ...]:
    """The sections of a string from s = 0, each as a rod of its own."""
    problem = case.problem if isinstance(case, Case) else case
    rod, breaks, more = problem.rod, problem.rod.breaks, extra_of(extra)
    middles = 0.5 * (breaks[1:] + breaks[:-1])
    alphas, bends = _lie(problem, middles, extra)
    above = _hung(problem, np.stack([breaks[1:], middles, breaks[:-1]]))
    members = _members(case, middles)
    tapered = rod.tapers("stiffness") | rod.tapers("weight")
    lever = rod.lever(breaks)
    lever[-1] = 0.0
    out = []
    for i, length in enumerate(np.diff(breaks)):
        member = members[i] if members else None
        known = bends[i] | _section(case, member) | more
        inputs = FormulaInputs(
            float(rod.ranges["stiffness"][0, i]),
            problem.weight * float((lever[i + 1] - lever[i]) / length),
            float(alphas[i]),
            problem.clearance,
            float(length),
            problem.ends,
            problem.pressed,
            tuple(known.items()),
        )
        name = f"section {i + 1}" if member is None else member.name
        here = dict(zip(WHERE, map(float, above[:, i]), strict=True))
        out.append(SectionRod(name, inputs, here, bool(tapered[i])))
    return tuple(out)


def above_middle(problem: Problem) -> float:
    """Axial weight in B/L² that hangs above s = ½ of a string."""
    return float(_hung(problem, np.array([0.5]))[0])


def _members(case: Case | Problem, middles: FloatArray) -> list[Member]:
    """The section of the case's string at each place; none without one."""
    if not isinstance(case, Case) or case.string is None:
        return []
    ends = np.array([end for _, end in case.string.ends])
    return [case.string.members[int(k)] for k in np.searchsorted(ends[:-1], middles, side="right")]


def _lie(problem: Problem, places: FloatArray, extra: Mapping[str, float]) -> tuple[FloatArray, list[dict[str, float]]]:
    """Inclination in degrees (n,), build and turn in 1/L, of the hole beside places (n,) of the rod."""
    if problem.hole is None:
        return np.full(places.size, problem.alpha), [bends_of(problem, extra)] * places.size
    bends_of(problem, extra)  # refuses what is given twice
    curvatures, frames, _ = problem.hole.at(undeformed_place(problem, places))
    tangent = frames[:, 2]
    bent = np.einsum("nk,nkx->nx", curvatures, frames[:, :2])
    high = np.array([0.0, 0.0, 1.0]) - tangent[:, 2:] * tangent
    size = np.linalg.norm(high, axis=1, keepdims=True)
    high = np.where(size > 0.0, high / np.where(size > 0.0, size, 1.0), frames[:, 0])
    left = np.cross(tangent, high)
    build, turn = np.sum(bent * high, axis=1), -np.sum(bent * left, axis=1)
    alphas = np.degrees(np.arccos(np.clip(tangent[:, 2], -1.0, 1.0)))
    return alphas, [{"build": float(b), "turn": float(t)} for b, t in zip(build, turn, strict=True)]


def _hung(problem: Problem, places: FloatArray) -> FloatArray:
    """Axial weight in B/L² that hangs above places of any shape: F − N(s)."""
    if problem.hole is None:
        lever = problem.rod.lever(places.ravel()).reshape(places.shape)
        return np.asarray(-problem.axial_weight * np.where(places == 1.0, 0.0, lever))
    above = hung(problem, problem.rod, pieces_of(problem))
    return np.asarray(problem.weight * above(places.ravel()).reshape(places.shape))


def _section(case: Case | Problem, member: Member | None) -> dict[str, float]:
    """Outer diameter, area, second moment of area and yield stress of a section in units B = L = 1."""
    if not isinstance(case, Case) or case.scales is None or member is None:
        return {}
    rod, length, out = member.rod, case.scales.length, {}
    if rod.outer_diameter is not None:
        out["D"] = rod.outer_diameter / length
        if rod.bore_known:
            out |= {"A": rod.area / length**2, "I": rod.inertia / length**4}
    if rod.yield_strength is not None:
        out["sigma_y"] = rod.yield_strength / case.scales.factor("stress")
    return out


def _row(formula: Formula, sections: tuple[SectionRod, ...], loads: tuple[ExactLoad, ...], curved: bool) -> FormulaRow:
    """A formula in the section whose compression comes to its load first; in the first, where it has none in any."""
    found = []
    for section in sections:
        missing = formula.missing(section.rod)
        value = value_of(formula, section.rod, missing)
        if value is not None:
            above = section.hung[formula.place or "bottom"]
            found.append((above - value, section, value))
    first = max(found, key=lambda one: one[0])[1] if found else sections[0]
    here = tuple(_within(load, first) for load in loads)
    row = row_of(formula, first.rod, here, curved)
    reasons = [*row.reasons, *([LEAST_STIFFNESS] if first.tapers else [])]
    if _depends_on_ends(formula, first.rod):
        reasons.append(ENDS_OF_ITS_OWN)
    by_section = tuple(SectionLoad(section.name, value, force) for force, section, value in found)
    return replace(row, section=first.name, by_section=by_section, reasons=tuple(reasons))


def _depends_on_ends(formula: Formula, rod: FormulaInputs) -> bool:
    """Whether a formula is for a rod of certain ends."""
    pairs = (("clamped", "clamped"), ("pinned", "pinned"), ("free", "free"))
    return len({tuple(formula.violations(replace(rod, ends=pair))) for pair in pairs}) > 1


def _within(load: ExactLoad, section: SectionRod) -> ExactLoad:
    """An exact load of the string as the force at the top of a section, and what hangs within it."""
    top, middle, bottom = (section.hung[place] for place in WHERE)
    return replace(load, force=load.force - top, axial_weight=bottom - top, above_middle=middle - top)
