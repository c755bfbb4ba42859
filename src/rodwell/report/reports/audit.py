"""The report of an audit: formulas of practice beside the exact loads of a case."""

from __future__ import annotations

import datetime
from collections import Counter
from collections.abc import Iterable

from rodwell._version import __version__
from rodwell.answers.comparison.beside import NOT_APPLICABLE, SAFE, UNSAFE, USELESS, FormulaRow, Other
from rodwell.answers.comparison.exact_loads import PLACES
from rodwell.answers.words.advice import BAD, CAUTION, GOOD, OPEN, Status
from rodwell.answers.words.steps import IF_HELD, held
from rodwell.case.about import NOBODY, About
from rodwell.formulas import LEFT_OUT
from rodwell.formulas.record import NOMENCLATURE
from rodwell.problem.problem import Problem
from rodwell.problem.words import ends_text, hole_text
from rodwell.quantities.text import minus, plain, raised
from rodwell.report.reports.content import Block, Front, Grid, Items, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.files import linked
from rodwell.report.reports.front import LOGO
from rodwell.studies.audit.audit import Audit

FILES = {
    "audit.json": "everything as data",
    "audit.csv": "every formula beside every exact load",
    "audit-chart.csv": "the exact loads behind the chart",
}


def audit_report(audit: Audit, files: Iterable[str] = (), *, about: About = NOBODY, source: str = "case") -> Report:
    """Return the content of an audit's report; ``files`` are the names of those beside it."""
    p = audit.problem
    return Report(
        title=audit.title,
        subtitle=f"Formulas of practice held against exact loads · {datetime.date.today().isoformat()} · rodwell "
        f"{__version__}",
        front=Front(
            verdict=verdict(audit),
            statuses=_statuses(audit),
            numbers=tuple(
                Number(
                    f"{load.label[:1].upper()}{load.label[1:]}, compression at the bottom",
                    _force(audit, load.at("bottom")),
                    note=f"{_force(audit, load.at('top'))} at the top" if p.axial_weight else "",
                )
                for load in audit.loads[:3]
            ),
            picture=Picture(
                "audit-chart",
                "Error of formulas as onset loads over weight and inclination",
                "Error of each formula as the load at which buckling begins, over weight and inclination; blue: below "
                "the exact load, red: above it, unsafe. The star is this case, where it lies in the chart.",
            ),
            assumptions=f"Compression positive, at the place where a formula's force is measured. {conditions(p)}",
            steps=tuple(f"Not compared: {note}" for note in audit.not_found),
            next_title="What is missing",
        ),
        sections=(_loads(audit), *_exact(audit), *_others(audit), _left_out()),
        footer=f"Computed by rodwell {__version__} from {source}.",
        paper="us-letter" if audit.scales is not None and audit.scales.system.name == "field" else "a4",
        about=about.lines,
        logo="" if about.logo is None else LOGO,
        files=linked(files, FILES),
    )


def conditions(problem: Problem) -> str:
    """The rod that exact loads belong to, its ends and its hole, in a line."""
    twist = f", T₁ = {plain(problem.twist)} B/L" if problem.twist else ""
    hole = hole_text(problem)
    by_section = ""
    if problem.sections:
        by_section = " Formulas are taken section by section, each with its own data and the force in it; told is the "
        by_section += "section whose compression comes to the formula's load first."
    if what := if_held(problem):
        by_section += f" {what}."
    return (
        f"γ = {plain(problem.weight)}, α = {plain(problem.alpha)}° from the vertical, "
        f"Δ/L = {plain(problem.clearance)}{twist}, {ends_text(problem)}. {hole[:1].upper()}{hole[1:]}, no "
        f"friction.{by_section}"
    )


def if_held(problem: Problem) -> str:
    """What the exact loads of a string assume of its steps and kinks; nothing of other rods."""
    what = " and ".join(held(problem.rod, IF_HELD)) if problem.sections else ""
    return f"The exact loads are those of a string that stays on the wall beside its steps: if {what}" if what else ""


def verdict(audit: Audit) -> str:
    """In a sentence: how many formulas apply to the rod, and which of them are safe."""
    valid = [row for row in audit.rows if row.judgement != NOT_APPLICABLE]
    beside = f" {_best_known(audit)}" if audit.problem.sections else ""
    if not valid:
        return f"None of the {len(audit.rows)} formulas of buckling loads applies to this rod.{beside}"
    parts = []
    for word in (UNSAFE, SAFE, USELESS):
        names = [row.formula.name for row in valid if row.judgement == word]
        if names:
            parts.append(f"{word}: {', '.join(names)}")
    return (
        f"{len(valid)} of {len(audit.rows)} formulas of buckling loads apply to this rod; {'; '.join(parts)}.{beside}"
    )


def _best_known(audit: Audit) -> str:
    """Of a string, what the best known formula comes to section by section, and how far it is off."""
    row = audit.row("dawson_paslay" if audit.problem.hole is None else "he_kyllingstad")
    main = row.main
    if row.value is None or main is None or main.percent is None:
        return ""
    error = minus(f"{main.percent:+.1f} %")
    return (
        f"{row.formula.name}, section by section: {row.section} governs, at {_force(audit, row.value)} of compression "
        f"at its {row.formula.place}; that is {error} from the exact load, which has {_force(audit, main.exact)} there."
    )


def _statuses(audit: Audit) -> tuple[Status, ...]:
    counts = Counter(row.judgement for row in audit.rows)
    levels = {UNSAFE: BAD, SAFE: GOOD, USELESS: CAUTION, NOT_APPLICABLE: OPEN}
    reasons = {
        UNSAFE: "above the exact load where their force is meant",
        SAFE: "below it, by less than half",
        USELESS: "below it by half or more",
        NOT_APPLICABLE: "the rod is outside of what they are for",
    }
    return tuple(
        Status(word[:1].upper() + word[1:], levels[word] if counts[word] else OPEN,
               f"{counts[word]} formula{'s' if counts[word] != 1 else ''}", reasons[word])
        for word in (UNSAFE, SAFE, USELESS, NOT_APPLICABLE)
    )  # fmt: skip


def _force(audit: Audit, value: float, digits: int = 4) -> str:
    if audit.scales is not None:
        return audit.scales.text(value, "force", digits)
    return f"{plain(value, digits)} B/L²"


def _loads(audit: Audit) -> ReportSection:
    """Formulas of loads that apply, then those that do not, and why."""
    head = ("Formula", "Gives", "at", "Exact there", "Difference", "It is")
    string = bool(audit.problem.sections)  # its sections are mostly shorter than formulas ask for: all are shown
    shown = [row for row in audit.rows if row.judgement != NOT_APPLICABLE or (string and row.value and row.main)]
    rows = tuple(_row(audit, row) for row in shown)
    blocks: list[Block] = [Grid(head, rows, numeric=(1, 3, 4))] if rows else []
    out = [row for row in audit.rows if row.judgement == NOT_APPLICABLE]
    if out:
        blocks.append(Words("Not applicable to this rod:", "small"))
        blocks.append(Items(tuple(f"{row.formula.name}: {_why(row)}." for row in out)))
    return ReportSection("Buckling loads by formula", tuple(blocks))


def _why(row: FormulaRow) -> str:
    missing = [f"not given: {', '.join(row.missing)}"] if row.missing else []
    return "; ".join([*row.reasons, *missing]) or "it has no load at this rod"


def _row(audit: Audit, row: FormulaRow) -> tuple[str, ...]:
    main = row.main
    assert main is not None
    assert row.value is not None
    percent = "–" if main.percent is None else minus(f"{main.percent:+.1f} %")
    return (row.formula.name, _force(audit, row.value), row.at, _force(audit, main.exact), percent,
            row.judgement)  # fmt: skip


def _exact(audit: Audit) -> tuple[ReportSection, ...]:
    rows = tuple(
        (load.label, *(_force(audit, load.at(place), 6) for place in PLACES), _force(audit, load.error, 1))
        for load in audit.loads
    )
    head = ("Exact load", *PLACES, "±\u00a0error")
    return (ReportSection("Exact loads, as compression", (Grid(head, rows, numeric=tuple(range(1, len(head)))),)),)


def _others(audit: Audit) -> tuple[ReportSection, ...]:
    groups = [(f"the {audit.critical.label}", audit.others)]
    groups += [
        (one.exact.label, tuple(o for o in one.others if {"F", "p"} & set(o.formula.takes))) for one in audit.applied
    ]
    out = []
    for where, others in groups:
        rows = tuple(
            (o.formula.name, other_value(audit, o), "no" if o.reasons else "yes") for o in others if o.value is not None
        )
        if rows:
            grid = Grid(("Formula", "Value", "Applies"), rows, numeric=(1,))
            out.append(ReportSection(f"Other formulas, at {where}", (grid,)))
    return tuple(out)


def other_value(audit: Audit, other: Other) -> str:
    """The value of a formula in the case's units, or with its powers of B and L."""
    assert other.value is not None
    dimension = other.formula.dimension
    if audit.scales is not None:
        return audit.scales.system.text(other.value * audit.factor(dimension), NOMENCLATURE[dimension], 5)
    powers = {"B": dimension[0], "L": dimension[1] - 2 * dimension[0]}
    unit = " ".join(f"{name}{'' if power == 1 else raised(power)}" for name, power in powers.items() if power)
    return f"{plain(other.value, 5)} {unit}".rstrip()


def _left_out() -> ReportSection:
    lines = tuple(f"{item.name}: {item.text}. Reason: {item.reason}." for item in LEFT_OUT)
    return ReportSection("Formulas left out", (Items(lines),))
