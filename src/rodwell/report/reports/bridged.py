"""The report on a case whose clearance has steps."""

from __future__ import annotations

import datetime

from rodwell._version import __version__
from rodwell.analysis.off_wall.state import PointForce
from rodwell.answers.result.beyond import StateBeyond
from rodwell.answers.result.bridged import Bridged
from rodwell.answers.words.bridged import bridged_sentences, bridged_statuses, limits
from rodwell.answers.words.wording import forces_of, quantity, size_text
from rodwell.case.case import Case
from rodwell.problem.words import floats_in_part
from rodwell.quantities.value import Value
from rodwell.report.reports.content import Front, Grid, Items, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.texts import conversions, derived, inputs

PICTURE = "bridging"
"""Name of the picture."""

KINDS = {"point": "point of contact", "end": "end of a stretch in contact"}


def bridged_report(found: Bridged) -> Report:
    """Return the content of the report."""
    case, text, today = found.case, bridged_sentences(found), datetime.date.today().isoformat()
    said = limits(found)
    facts = [(label, value) for label, value, _ in conversions(case)]
    return Report(
        title=case.title,
        subtitle=f"{_kind_of(case)} · rodwell {__version__} · {today}",
        front=Front(text[0], bridged_statuses(found), _numbers(found), _picture(found), " ".join(said),
                    tuple(text[1 : -len(said)]), "What else was found"),
        sections=(
            ReportSection("Where the string touches",
                          (*_contact(found), Words(f"{forces_of(case).convention}.", "small"))),
            ReportSection("What is computed, and what is not", (Items(said),)),
            ReportSection("Inputs", (Grid(("Key of the case file", "As given"), tuple(inputs(case))),
                                     Grid(("What follows", ""), tuple(facts)),
                                     Grid(("Without dimensions", ""), tuple(derived(case))))),
        ),
        footer=f"Computed by rodwell {__version__} from {case.source}.",
        paper="us-letter" if case.scales is not None and case.scales.system.name == "field" else "a4",
        about=case.about.lines,
    )  # fmt: skip


def _kind_of(case: Case) -> str:
    return "String that floats in part" if floats_in_part(case.problem) else "String over steps of its clearance"


def _numbers(found: Bridged) -> tuple[Number, ...]:
    case, out = found.case, []
    if found.buckling is not None:
        out.append(Number(f"Buckling load{forces_of(case).at_end}", forces_of(case).size(found.buckling[0].force),
                          note="sideways, out of the vertical plane"))  # fmt: skip
    largest = max(found.edges, key=lambda point: point.force.value, default=None)
    if largest is not None:
        note = "without compression" + (", levered by the end beside it" if largest in found.levered else "")
        out.append(Number("Largest force on an edge", size_text(case.scales, largest.force), note=note))
    for _, one in found.applied:
        if isinstance(one, str) or one.stress is None or case.scales is None:
            continue
        note = f"under {forces_of(case).load(one.load)}"
        out.append(Number("Largest von Mises stress", quantity(case.scales.system, one.stress, "stress", 4), note=note))
    return tuple(out[:4])


def _picture(found: Bridged) -> Picture:
    lines = "the lower side of the hole (grey) and of the string (blue)"
    if floats_in_part(found.case.problem):
        lines = "how far its axis may move (grey), the axis (blue)"
    when = "without compression" if found.buckling is None else "when it buckles"
    return Picture(
        PICTURE,
        f"The string in its hole, seen from the side, {when}",
        f"The string {when}, seen from the side: {lines}, stretches in contact (black) and point forces (red). Height "
        "is drawn much larger than length.",
    )


def _contact(found: Bridged) -> tuple[Words | Grid, ...]:
    """Contact in each known state."""
    states = [("Without compression:", found.alone)]
    states += [(f"Under {forces_of(found.case).load(one.load)}:", one)
               for _, one in found.applied if not isinstance(one, str)]  # fmt: skip
    if found.buckling is not None:
        event, there = found.buckling
        states.append((f"When it buckles, at {forces_of(found.case).load(event.force)}:", there))
    return tuple(block for when, one in states for block in (Words(when), _grid(found, one)))


def _grid(found: Bridged, one: StateBeyond) -> Grid:
    scales, clearance = found.case.scales, found.case.problem.clearance

    def place(s: Value) -> str:
        return size_text(scales, s, "length", "L")

    rows: list[tuple[Value, Value | None, str, str]] = [
        (contact.start, contact.end, "stretch in contact", size_text(scales, contact.force))
        for contact in one.state.contacts
    ]
    rows += [(point.s, None, _kind(found, point), size_text(scales, point.force)) for point in one.state.point_forces]
    rows += [(gap.start, gap.end, "gap",
              f"up to {size_text(scales, gap.largest.times(clearance), 'length', 'L')}, at {place(Value(gap.at))}")
             for gap in one.state.gaps]  # fmt: skip
    rows.sort(key=lambda row: (row[0].value, row[1] is not None))
    shown = tuple((place(start), "" if end is None else place(end), *rest) for start, end, *rest in rows)
    return Grid(("from", "to, from the end s = 0", "what", "force, or width"), shown, numeric=(0, 1, 3))


def _kind(found: Bridged, point: PointForce) -> str:
    """What a point force is, in words."""
    return KINDS.get(point.kind) or f"edge of a {found.edge_of(point.s.value)}"
