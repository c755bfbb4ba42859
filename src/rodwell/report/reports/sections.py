"""The section of a report on a string: its sections, with the stress in each against its own strength."""

from __future__ import annotations

from collections.abc import Callable

from rodwell.answers.result.assessment import Assessment
from rodwell.case.pipe import PhysicalRod
from rodwell.case.string.sections import Member
from rodwell.quantities.text import amount
from rodwell.quantities.units import System
from rodwell.report.reports.content import Block, Grid, Picture, ReportSection, Words
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.section import RodStress, StringSections


def string_section(a: Assessment) -> tuple[ReportSection, ...]:
    """What the string is made of, drawn and as a table; nothing for a uniform rod."""
    string, scales = a.case.string, a.case.scales
    if string is None or scales is None:
        return ()
    system = scales.system
    state = _state(a)
    stressed = isinstance(a.section, StringSections) and state is not None
    stresses: list[RodStress | None] = [None] * len(string.members)
    cored = any(one.rod.core_diameter for one in string.members)
    head = ["Section", "From", "to", "Outer diameter", "Bore", "Stiffness EI", "Weight in the fluids", "Yield strength"]
    head[4:4] = ["Core"] * cored
    if stressed:
        assert isinstance(a.section, StringSections)
        assert state is not None
        stresses = list(a.section.largest_each(state))
        head += [f"Largest von Mises {state.name}", "Safety factor"]
    rows = [
        _row(one, span, string.length, stress, system, stressed, cored)
        for one, span, stress in zip(string.members, string.ends, stresses, strict=True)
    ]
    words = (
        "From the bottom up; places are distances along the rod from s = 0. In the drawing lengths and diameters have "
        "scales of their own. B in B/L² is the stiffness of the longest section."
    )
    if any(one.taper is not None for one in string.members):
        words += (
            " A section that tapers has its values at the lower and at the upper end; diameters go in a straight line "
            "between them, the stiffness with them, and stresses are those of the diameter where they are."
        )
    caption = "The string as it lies in the hole, its lower end at the left."
    picture = Picture("string", "The sections of the string in their hole", caption)
    table = Grid(tuple(head), tuple(rows), tuple(range(1, len(head))))
    blocks: tuple[Block, ...] = (picture, table, Words(words, "small"))
    return (ReportSection("The string", blocks),)


def _state(a: Assessment) -> LoadedRod | None:
    """The state whose stresses are told: at the most compressive load that acts, or at lift-off, or at buckling."""
    applied = [at.state for at in a.applied if at.state is not None]
    if applied:
        return min(applied, key=lambda state: state.force)
    return a.at_lift_off or a.at_buckling


def _from_to(one: Member, of: Callable[[PhysicalRod], float], kind: str, system: System) -> str:
    """What a section has, where it tapers at its lower and its upper end."""
    return " to ".join(dict.fromkeys(system.text(of(one.rods[end]), kind, 4) for end in (0, -1)))


def _row(
    one: Member,
    span: tuple[float, float],
    length: float,
    stress: RodStress | None,
    system: System,
    stressed: bool,
    cored: bool,
) -> tuple[str, ...]:
    rod = one.rod
    row = [
        one.name,
        *(system.text(part * length, "length", 4) if part > 0.0 else "0" for part in span),
        "–" if rod.outer_diameter is None else _from_to(one, lambda rod: rod.outer_diameter or 0.0, "length", system),
        _from_to(one, lambda rod: rod.inner_diameter, "length", system)
        if rod.inner_diameter > 0.0
        else "none"
        if rod.bore_known
        else "–",
        _from_to(one, lambda rod: rod.stiffness, "stiffness", system),
        " to ".join(dict.fromkeys(system.text(one.weights[end], "force_per_length", 4) for end in (0, -1))),
        "–" if rod.yield_strength is None else system.text(rod.yield_strength, "stress", 4),
    ]
    if cored:
        core = _from_to(one, lambda rod: rod.core_diameter or 0.0, "length", system) if rod.core_diameter else "none"
        row.insert(4, core)
    if stressed:
        assert stress is not None
        row += [system.beside_error(stress, "stress"), "–" if stress.safety is None else amount(stress.safety)]
    return tuple(row)
