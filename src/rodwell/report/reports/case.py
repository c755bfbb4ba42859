"""The content of the report of a case: front and sections, from an answer."""

from __future__ import annotations

import datetime

from rodwell._version import __version__
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.key_number import KeyNumber
from rodwell.answers.words.advice import next_steps, statuses
from rodwell.answers.words.first_met import KEPT
from rodwell.answers.words.meaning import assumptions, sentences
from rodwell.case.case import Case
from rodwell.plots.bifurcation import ORDINATES, telling
from rodwell.quantities.text import minus
from rodwell.report.reports.content import Front, Grid, Items, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.strength import strength_sections
from rodwell.report.reports.string import string_section
from rodwell.report.reports.texts import (
    PLAIN_UNITS,
    certificate,
    conversions,
    derived,
    error_text,
    inputs,
    number,
    rows,
    sensitivities,
    short,
    special,
)

DECISIVE = (
    "first_load_met",
    "critical_load_1",
    "lift_off_load",
    "window",
    "rod_stress_lift_off",
    "safety_factor_lift_off",
    "largest_wall_force",
    "total_wall_force",
    "cylinder_stress",
    "largest_bending",
    "critical_length",
    "end_shortening",
)
"""Key numbers that decide, most important first: the front shows those that a case has, six at most."""

MOST_NUMBERS = 6


def case_report(answer: Answer) -> Report:
    """Return the content of a case's report."""
    case = answer.case
    return Report(
        title=case.title,
        subtitle=f"Buckling, lift-off and wall loads of a rod in a cylinder · rodwell {__version__} · "
        f"{datetime.date.today().isoformat()}",
        front=_front(answer),
        sections=(
            ReportSection("What the numbers mean", (Items(tuple(sentences(answer)[1:])),)),
            key_numbers(answer),
            *string_section(answer.assessment),
            *strength_sections(answer.assessment),
            _pictures(answer),
            _special_points(answer),
            _inputs_and_loads(answer),
            _inputs(case),
            *_conversions(case),
            _validity(answer),
            _trust(answer),
        ),
        footer=f"Computed by rodwell {__version__} from {case.source}. B bending stiffness, L length of the rod.",
        paper="us-letter" if case.scales is not None and case.scales.system.name == "field" else "a4",
    )


def _front(answer: Answer) -> Front:
    at = " at lift-off" if answer.at_lift_off else ""
    numbers = answer.key_numbers
    effective = "effective force, " if answer.case.with_fluids else ""
    return Front(
        verdict=sentences(answer)[0],
        statuses=statuses(answer),
        numbers=tuple(_decisive(numbers[name], answer.case) for name in DECISIVE if name in numbers)[:MOST_NUMBERS],
        picture=Picture(
            "rod-3d",
            "The rod in its cylinder, coloured by contact pressure",
            f"The rod in its cylinder{at}, first mode.",
        ),
        assumptions=f"Sign: {effective}tension positive, compression negative. End: forces are those at s = 1, the "
        f"upper end of an inclined cylinder. Assumed: {'; '.join(assumptions(answer.case))}.",
        steps=next_steps(answer),
    )


def _decisive(key: KeyNumber, case: Case) -> Number:
    if case.scales is None:
        unit = PLAIN_UNITS[key.dimension]
        return Number(key.label, f"{number(key.number)} {unit}", f"± {short(key.error)} {unit}", key.note)
    error = error_text(case.scales.text(key.error, key.dimension, 1))
    return Number(key.label, key.text(case, 5), error, key.note)


def key_numbers(answer: Answer) -> ReportSection:
    """All key numbers, with errors."""
    physical = answer.case.scales is not None
    names = ["label", *(["physical"] if physical else []), "plain", "error", "note"]
    head = ["Quantity", *(["Physical"] if physical else []), "Dimensionless (B = L = 1)", "±\u00a0error", "Remark"]
    table = Grid(
        tuple(head),
        tuple(tuple(row[name] for name in names) for row in rows(answer.key_numbers.values(), answer.case)),
        numeric=tuple(range(1, len(head) - 1)),
    )
    warning = Words(
        f"Not every number meets the tolerance {minus(f'{answer.case.rtol:g}')}. The error estimates say how well each "
        "is known.",
        "warning",
    )
    return ReportSection("Key figures", (table,) if answer.converged else (warning, table))


def _pictures(computed: Computed) -> ReportSection:
    at = " at lift-off" if computed.at_lift_off else ""
    kept = f" {KEPT}" if computed.untouched else ""
    wall = computed.shown.wall.meaning
    ordinate = ORDINATES[telling(computed.branches)][1]
    return ReportSection(
        "From buckling to lift-off",
        (
            Picture(
                "bifurcation",
                "Bifurcation diagram",
                f"Bifurcation diagram: {ordinate} against the compression at s = 1. Thick: stable under dead loads "
                f"for a rod kept on the wall. Pale: beyond lift-off, where the wall would have to pull.{kept}",
            ),
            Picture(
                "wall-loads",
                "Contact pressure, and twisting moment in the cylinder, along the rod",
                "First mode at several end forces. Above: contact pressure p; the wall pushes with −p per length, "
                "and the rod lifts off where p reaches 0. Below: twisting moment T₂ that the rod's weight sets up "
                "in the cylinder; its value at s = 0 is the torque that the cylinder's support must provide.",
            ),
            Picture(
                "cylinder",
                "Moments in the cylinder along its length",
                f"What the cylinder carries{at}, first mode: twisting moment T₂ and bending moments μ and λ cos η "
                "(59), for a cylinder whose bedding takes up the rod's weight place by place. "
                f"{wall[:1].upper()}{wall[1:]}.",
            ),
            Picture(
                "modes",
                "Buckling modes",
                "Buckling modes of the straight rod, each scaled to a largest deflection of 1.",
            ),
        ),
    )


def _special_points(computed: Computed) -> ReportSection:
    branches, scales = computed.branches, computed.case.scales
    kept = [Words(KEPT, "warning")] if computed.untouched else []
    physical = scales is not None
    names = ["mode", "kind", *(["physical"] if physical else []), "plain", "error", "index", "place"]
    head = ["Mode", "What", *(["End force at s = 1"] if physical else []), "F in B/L²", "±\u00a0error"]
    note = (
        "Stability index: number of independent ways in which the state is unstable under dead loads, for a rod "
        "kept on the wall; 0 is stable. With end shortening or end rotation controlled instead of the loads, the "
        "index is lower by at most one for each."
    )
    lines = special(branches, scales)
    missed = any(row["remark"] for row in lines)
    table = Grid(
        (*head, "Stability index", "Place s/L", *(["Remark"] if missed else [])),
        tuple(tuple(str(row[name]) for name in [*names, *(["remark"] if missed else [])]) for row in lines),
        numeric=(2, 3, 4) if physical else (2, 3),
    )
    return ReportSection("Special points of every branch", (table, Words(note, "small"), *kept))


def _inputs_and_loads(computed: Computed) -> ReportSection:
    uncertain = computed.case.uncertain
    head = ["Load", "clearance Δ", "weight per length", "stiffness B", "length L", "angle α, per degree"]
    head += ["± from the inputs"] if uncertain else []
    lines = [(row["name"], *row["cells"], *([row["spread"]] if uncertain else [])) for row in sensitivities(computed)]
    note = (
        "Change of the load in percent for one percent more of an input, the others constant (elasticity), from "
        "exact derivatives."
    )
    if uncertain:
        written = ", ".join(f"{u.key} = {u.written}" for u in uncertain)
        note += f" The last column carries the uncertainties of the inputs ({written}) through to first order, as "
        note += "independent of each other."
    table = Grid(tuple(head), tuple(lines), numeric=tuple(range(1, len(head))))
    return ReportSection("What the inputs do to the loads", (table, Words(note, "small")))


def _inputs(case: Case) -> ReportSection:
    return ReportSection(
        "Inputs",
        (Grid(("As given", ""), tuple(inputs(case))), Grid(("What follows", ""), tuple(derived(case)))),
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
    table = Grid(("What", "Largest", "Covered", "Where", ""), rows, numeric=(1, 2))
    words = Words(found.sentence, "warning" if found.left else "plain")
    return ReportSection("What the theory assumes, and how far it holds here", (words, table))


def _trust(answer: Answer) -> ReportSection:
    left = certificate(answer.worst_certificate)
    tolerance = minus(f"{answer.case.rtol:g}")
    passed = "passed" if left["passed"] else "not passed"
    met = "is met by every number" if answer.converged else "is not met by every number"
    return ReportSection(
        "How far the numbers can be trusted",
        (
            Words(
                "Every state was computed on two nested meshes. The errors given are estimates from their "
                f"difference; the tolerance asked for was {tolerance} and {met}."
            ),
            Words(
                "Every state was put into the paper's own system, which the solver does not use: fifteen "
                "differential equations, fifteen end conditions, and the relations between rod, cylinder and "
                "contact. What is left of each, divided by its largest term along the rod, is at most "
                f"{left['worst']} (in {left['where']}); the limit is {left['limit']}: {passed}. For the state that "
                "fits least well:"
            ),
            Grid(("Equations of the paper", "What is left"), tuple(left["groups"]), numeric=(1,)),
            Words(
                "The theory is geometrically exact for a rod that stays on the wall: no small-angle or "
                "small-deflection assumption is made. Pressures and mud act through effective force and buoyed "
                "weight. Not included: friction, joints, curvature of the hole, dynamics."
            ),
        ),
    )
