"""The section of a case's report on what happens beyond lift-off."""

from __future__ import annotations

from rodwell.answers.result.beyond import Beyond, Step
from rodwell.answers.words.beyond import assumed_beyond, beyond_sentences
from rodwell.answers.words.wording import forces_of, quantity, size_text
from rodwell.case.case import Case
from rodwell.problem.words import ends_text
from rodwell.quantities.text import amount
from rodwell.quantities.value import Value
from rodwell.report.reports.content import Block, Grid, Items, Picture, ReportSection, Words

PICTURE = "load-path"
"""Name of the picture."""


def beyond_section(case: Case, found: Beyond) -> ReportSection:
    """The whole story in words, picture and tables; or why there is none."""
    text = beyond_sentences(case, found)
    if found.path is None:
        return ReportSection("Beyond lift-off", (Words(text[0], "warning"),))
    assumed = assumed_beyond(case)
    assumed = f"{assumed[:1].upper()}{assumed[1:]}; {ends_text(case.problem)}. {forces_of(case).convention}."
    blocks: list[Block] = [
        Items(tuple(text)),
        Picture(
            PICTURE,
            "Load against shortening as the load grows and is taken off again, with states of the rod",
            "Compression against shortening of the rod's span, as the load grows (solid) and is taken off again "
            "(dashed). Arrows: the rod snaps at a load that stays. Below, the states that letters name: the rod seen "
            "along the hole (circle: as far as the wall lets its axis go), and the gap between rod and wall along it.",
        ),
        _events(case, found),
        Words(f"{assumed} A safety factor is that of an elastic rod.", "small"),
    ]
    if found.missed:
        blocks.append(Words(f"Not every load meets the tolerance: {'; '.join(found.missed)}.", "warning"))
    gaps = _gaps(case, found)
    return ReportSection("Beyond lift-off", (*blocks, *gaps))


def _events(case: Case, found: Beyond) -> Grid:
    """What happens in order, with forces on the wall and stress."""
    stress = any(one.state is not None and one.state.stress is not None for one in found.events)
    head = ["As the load", f"Compression{forces_of(case).at_end}", "What happens", "All forces on the wall",
            "Largest concentrated force", "at s/L"]  # fmt: skip
    head += ["Largest von Mises stress", "Safety factor"] if stress else []
    rows = tuple(_row(case, one, stress) for one in found.events)
    return Grid(tuple(head), rows, numeric=(1, *range(3, len(head))))


def _row(case: Case, one: Step, stress: bool) -> tuple[str, ...]:
    leg = "grows" if one.event.leg == "loading" else "is taken off"
    out = [leg, _load(case, one.event.force), one.meaning]
    state = one.state
    if state is None:
        return (*out, *["–"] * (5 if stress else 3))
    point = state.largest_point_force
    out.append(size_text(case.scales, state.state.contact_total))
    out += ["–", "–"] if point is None else [size_text(case.scales, point.force), amount(point.s, 4)]
    if stress:
        known, safety = state.stress, None if state.stress is None else state.stress.safety
        out.append("–" if known is None or case.scales is None else quantity(case.scales.system, known, "stress", 4))
        out.append("–" if safety is None else amount(safety, 3))
    return tuple(out)


def _load(case: Case, force: Value) -> str:
    """Compression at the end at which the case says forces; negative: tension."""
    said = forces_of(case)
    sign = "−" if said.compression(force).value < 0.0 else ""
    return f"{sign}{said.size(force).lstrip('−-')}"


def _gaps(case: Case, found: Beyond) -> list[Block]:
    """Gaps along the rod and concentrated forces, state by state."""
    rows = []
    for one in found.events:
        for gap in one.state.state.gaps if one.state is not None else ():
            size = size_text(case.scales, gap.largest.times(case.problem.clearance), "length", "L")
            rows.append((_load(case, one.event.force), one.meaning, amount(gap.start, 5), amount(gap.end, 5), size,
                         f"{gap.at:.4g}"))  # fmt: skip
    if not rows:
        return []
    head = (f"Compression{forces_of(case).at_end}", "When", "Gap from s/L", "to s/L", "Largest gap", "at s/L")
    return [Grid(head, tuple(rows), numeric=(0, 2, 3, 4, 5))]
