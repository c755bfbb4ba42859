"""The content of the report of a case: front and sections, from an answer."""

from __future__ import annotations

import datetime
from collections.abc import Iterable

from rodwell._version import __version__
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.computed import Computed
from rodwell.answers.words.first_met import KEPT
from rodwell.answers.words.in_space import what_ends
from rodwell.answers.words.meaning import sentences
from rodwell.answers.words.wording import forces_of
from rodwell.case.case import Case
from rodwell.plots.ordinates import ORDINATES, telling
from rodwell.problem.words import counted_around
from rodwell.quantities.text import plain
from rodwell.report.reports.content import Grid, Items, Picture, Report, ReportSection, Words
from rodwell.report.reports.files import CONVENTION_OF_DATA, FILES, linked
from rodwell.report.reports.front import LOGO, front
from rodwell.report.reports.sections import string_section
from rodwell.report.reports.strength import strength_sections
from rodwell.report.reports.texts import (
    CHANGES,
    certificate,
    conversions,
    derived,
    inputs,
    plain_rows,
    rows,
    sensitivities,
    special,
)


def case_report(answer: Answer, files: Iterable[str] = (), *, path: bool = False) -> Report:
    """Return the content of a case's report; ``files`` are the names of those that stand beside it.

    ``path``: with what happens beyond lift-off, which is computed if it was not before.
    """
    case = answer.case
    today = datetime.date.today().isoformat()
    return Report(
        title=case.title,
        subtitle=f"Buckling, lift-off and wall loads of a rod in a cylinder · {today} · rodwell {__version__}",
        front=front(answer, path=path),
        sections=(
            ReportSection("What the numbers mean", (Items(tuple(sentences(answer)[1:])),)),
            _in_space(answer),
            *([_beyond(answer)] if path else []),
            *string_section(answer.assessment),
            *strength_sections(answer.assessment),
            _pictures(answer),
            key_numbers(answer),
            _special_points(answer),
            *_inputs_and_loads(answer),
            _inputs(case),
            *_conversions(case),
            _validity(answer),
            _trust(answer),
            *_for_research(answer),
        ),
        footer=f"Computed by rodwell {__version__} from {case.source}. {CONVENTION_OF_DATA}",
        paper="us-letter" if case.scales is not None and case.scales.system.name == "field" else "a4",
        about=case.about.lines,
        logo="" if case.about.logo is None else LOGO,
        files=linked(files, FILES),
    )


def _beyond(answer: Answer) -> ReportSection:
    from rodwell.report.reports.beyond import beyond_section  # noqa: PLC0415 - takes a third of a second: only where the load path is asked for

    return beyond_section(answer.case, answer.beyond)


def _in_space(answer: Answer) -> ReportSection:
    at = shown_text(answer)
    seen = "The rod in its cylinder, coloured by how hard it is pressed to the wall"
    return ReportSection("The rod in its cylinder", (Picture("rod-3d", seen, f"The rod in its cylinder{at}."),))


def shown_text(computed: Computed) -> str:
    """In which state pictures show the rod."""
    if computed.lying is None or computed.lying.buckled is not None:
        mode = "first mode" if computed.lying is None else "buckled"
        return f" at lift-off, {mode}" if computed.at_lift_off else f", {mode}"
    end = computed.lying.end
    return " at the last load followed" if end is None else f" where its way ends: {what_ends(computed.lying)}"


def key_numbers(answer: Answer) -> ReportSection:
    """All key numbers, with errors."""
    head = ("Quantity", "Value", "±\u00a0error", "Where, and what else")
    table = _grid(head, rows(answer.key_numbers.values(), answer.case))
    missed = f"Not every number meets the tolerance {plain(answer.case.rtol)}."
    warning = Words(f"{missed} The error estimates say how well each is known.", "warning")
    said = Words(f"{forces_of(answer.case).convention}. Errors are estimates of the numerical error.", "small")
    return ReportSection("Key figures", (table, said) if answer.converged else (warning, table, said))


def _for_research(answer: Answer) -> tuple[ReportSection, ...]:
    """The same in units B = L = 1, of a case with dimensions."""
    if answer.case.scales is None:
        return ()
    head = ("Quantity", "Value, B = L = 1", "±\u00a0error", "Remark")
    table = _grid(head, plain_rows(answer.key_numbers.values()))
    said = (
        "The key figures as the theory has them: forces are those at the end s = 1, tension positive; B is the bending "
        "stiffness, L the length of the rod."
    )
    return (ReportSection("For research: the same without dimensions", (Words(said, "small"), table)),)


def _grid(head: tuple[str, ...], lines: list[dict[str, str]]) -> Grid:
    cells = tuple(tuple(row[name] for name in ("label", "value", "error", "note")) for row in lines)
    return Grid(head, cells, numeric=(1, 2))


def _pictures(computed: Computed) -> ReportSection:
    at, lies = shown_text(computed), computed.lying is not None and computed.lying.buckled is None
    kept = f" {KEPT}" if computed.untouched else ""
    wall, straight = computed.shown.wall.meaning, computed.case.problem.hole is None
    ordinate = ORDINATES[telling(computed.branches, computed.case.scales)][1]
    dimensions = computed.case.scales is not None
    first = "First mode" if computed.lying is None else "The rod as it lies" if lies else "The buckled rod"
    title = "How the rod lies" if lies else "Bifurcation diagram"
    enlarged = " Beside it the part from buckling to lift-off, enlarged." if computed.lying is None else ""
    pushed = "push on the wall per length" if dimensions else "contact pressure p; the wall pushes with −p per length"
    return ReportSection(
        "From buckling to lift-off" if not lies else "How the rod lies as the load grows",
        (
            Picture(
                "bifurcation",
                "Bifurcation diagram",
                f"{title}: {ordinate} against the compression{forces_of(computed.case).at_end}. Thick: "
                "stable under dead loads for a rod kept on the wall. Dashed: unstable. Pale: beyond lift-off, where "
                f"the wall would have to pull.{enlarged}{kept}",
            ),
            Picture(
                "wall-loads",
                f"Push on the wall, and {'twisting moment in the cylinder' if straight else 'angle around the hole'}, "
                "along the rod",
                f"{first} at several loads. Above: {pushed}; the rod lifts off where it reaches 0. Below: "
                + (BELOW if straight else BELOW_IN_CURVED_HOLE.format(*counted_around(computed.case.problem))),
            ),
            *(
                [
                    Picture(
                        "cylinder",
                        "Moments in the cylinder along its length",
                        f"What the cylinder carries{at}: twisting moment T₂ and bending moments μ and "
                        "λ cos η (59), for a cylinder whose bedding takes up the rod's weight place by place. "
                        f"{wall[:1].upper()}{wall[1:]}.",
                    )
                ]
                if straight
                else []
            ),
            *(
                [
                    Picture(
                        "modes",
                        "Buckling modes",
                        f"Buckling modes of the {'straight rod' if straight else 'rod as it lies'}, each scaled to a "
                        "largest deflection of 1.",
                    )
                ]
                if computed.critical
                else []
            ),
        ),
    )


BELOW = (
    "twisting moment T₂ that the rod's weight sets up in the cylinder; its value at s = 0 is the torque that the "
    "cylinder's support must provide."
)

BELOW_IN_CURVED_HOLE = (
    "which part of the wall bears it, as the angle around the hole from the {} side, positive to the {} looking "
    "towards s = 0."
)


def _special_points(computed: Computed) -> ReportSection:
    kept = [Words(KEPT, "warning")] if computed.untouched else []
    names = ["mode", "kind", "load", "error", "index", "place"]
    said = forces_of(computed.case)
    head = (
        "Mode" if computed.lying is None else "Branch",
        "What",
        "F at s = 1, B/L²" if said.scales is None else f"Compression{said.at_end}",
        "±\u00a0error",
    )
    note = (
        "Stability index: number of independent ways in which the state is unstable under dead loads, for a rod "
        "kept on the wall; 0 is stable. With end shortening or end rotation controlled instead of the loads, the "
        "index is lower by at most one for each."
    )
    lines = special(computed.branches, computed.case)
    missed = any(row["remark"] for row in lines)
    table = Grid(
        (*head, "Stability index", "Place", *(["Remark"] if missed else [])),
        tuple(tuple(str(row[name]) for name in [*names, *(["remark"] if missed else [])]) for row in lines),
        numeric=(2, 3),
    )
    return ReportSection("Special points of every branch", (table, Words(note, "small"), *kept))


def _inputs_and_loads(computed: Computed) -> tuple[ReportSection, ...]:
    if not computed.sensitivities:
        return ()
    uncertain = computed.case.uncertain
    changed, rows = sensitivities(computed)
    head = ["Load", *(CHANGES[name] for name in changed), *(["± from the inputs"] if uncertain else [])]
    lines = [(row["name"], *row["cells"], *([row["spread"]] if uncertain else [])) for row in rows]
    note = (
        f"Change of the load{forces_of(computed.case).at_end} in percent for one percent more of an input, the others "
        "constant (elasticity), from exact derivatives."
    )
    if uncertain:
        written = ", ".join(f"{u.key} = {u.written}" for u in uncertain)
        note += f" The last column carries the uncertainties of the inputs ({written}) through to first order, as "
        note += "independent of each other."
    table = Grid(tuple(head), tuple(lines), numeric=tuple(range(1, len(head))))
    return (ReportSection("What the inputs do to the loads", (table, Words(note, "small"))),)


def _inputs(case: Case) -> ReportSection:
    return ReportSection(
        "Inputs",
        (
            Grid(("Key of the case file", "As given"), tuple(inputs(case))),
            Grid(("What follows", "Value"), tuple(derived(case))),
        ),
    )


def _conversions(case: Case) -> tuple[ReportSection, ...]:
    facts = tuple(conversions(case))
    if not facts:
        return ()
    return (ReportSection("From the inputs to the problem", (Grid(("What", "Value", "From"), facts),)),)


def _validity(answer: Answer) -> ReportSection:
    """How far the loads shown are from what the theory assumes."""
    found = answer.assessment.validity
    rows = tuple((m.label, m.text, m.limit_text, m.where, m.status) for m in found.measures)
    table = Grid(("What", "Largest", "Covered", "Where", "Kept"), rows, numeric=(1, 2))
    words = Words(found.sentence, "warning" if found.left else "plain")
    return ReportSection("What the theory assumes, and how far it holds here", (words, table))


SYSTEM = (
    "Every state was put into the paper's own system, which the solver does not use: fifteen differential equations, "
    "fifteen end conditions, and the relations between rod, cylinder and contact."
)

SYSTEM_IN_CURVED_HOLE = (
    "Every state was put into space, on the wall of the curved hole, and its force and moment were held against weight "
    "and contact as vectors, and against what its ends hold; none of these equations is the solver's."
)


def _trust(answer: Answer) -> ReportSection:
    left = certificate(answer.worst_certificate)
    tolerance = plain(answer.case.rtol)
    passed = "passed" if left["passed"] else "not passed"
    met = "is met by every number" if answer.converged else "is not met by every number"
    straight = answer.case.problem.hole is None
    return ReportSection(
        "How far the numbers can be trusted",
        (
            Words(
                "Every state was computed on two nested meshes. The errors given are estimates from their "
                f"difference; the tolerance asked for was {tolerance} and {met}."
            ),
            Words(
                f"{SYSTEM if straight else SYSTEM_IN_CURVED_HOLE} "
                "What is left of each, divided by its largest term along the rod, is at most "
                f"{left['worst']} (in {left['where']}); the limit is {left['limit']}: {passed}. For the state that "
                "fits least well:"
            ),
            Grid(
                ("Equations of the paper" if straight else "Balance", "What is left"),
                tuple(left["groups"]),
                numeric=(1,),
            ),
            Words(
                "The theory is geometrically exact for a rod that stays on the wall: no small-angle or "
                "small-deflection assumption is made. Pressures and mud act through effective force and buoyed "
                f"weight. Not included: friction, joints, {'curvature of the hole, ' if straight else ''}dynamics."
            ),
        ),
    )
