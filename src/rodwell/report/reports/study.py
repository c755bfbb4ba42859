"""The report of a parameter study."""

from __future__ import annotations

import datetime
from collections.abc import Iterable

from rodwell._version import __version__
from rodwell.answers.result.assessment import BUCKLED
from rodwell.answers.words.advice import BAD, CAUTION, GOOD, Status
from rodwell.case.about import NOBODY, About
from rodwell.report.reports.content import Block, Front, Grid, Items, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.files import linked
from rodwell.report.reports.front import LOGO
from rodwell.studies.sweep import load_columns
from rodwell.studies.sweep.points import StudyPoint
from rodwell.studies.sweep.study import Study
from rodwell.studies.sweep.tables import (
    LOADS,
    cells,
    head,
    load_text,
    notes,
    remarks,
    scales,
    sentences,
    worst_points,
)

FILES = {
    "points.csv": "every point with all digits and the error of each number",
    "points.xlsx": "the same as a workbook",
    "study.json": "the same as data",
    "case.toml": "the study as it was read",
}


def study_report(study: Study, files: Iterable[str] = (), *, about: About = NOBODY) -> Report:
    """Return the content of a study's report; ``files`` are the names of those beside it."""
    today = datetime.date.today().isoformat()
    return Report(
        title=study.title,
        subtitle=f"Parameter study of buckling and lift-off of a rod in a cylinder · {len(study.points)} points · "
        f"rodwell {__version__} · {today}",
        front=_front(study),
        sections=(_points(study), *_loads(study), _inputs(study)),
        footer=f"Computed by rodwell {__version__} from {study.source}. The theory is geometrically exact for a rod "
        "that stays on the wall. Not included: friction, joints, curvature of the hole, dynamics.",
        paper="us-letter" if study.physical and study.system.name == "field" else "a4",
        about=about.lines,
        logo="" if about.logo is None else LOGO,
        files=linked(files, FILES),
    )


def _front(study: Study) -> Front:
    text = sentences(study)
    numbers = []
    for name, what in LOADS.items():
        worst = study.worst(name)
        load = None if worst is None else worst.compression(name)
        if worst is None or load is None:
            continue
        label = f"Least compression at s = 1 at which it {what}"
        numbers.append(Number(label, load_text(study, load.value), note=study.rod_inputs(worst)))
    return Front(
        verdict=text[0],
        statuses=(_status(study), *_at_loads(study), *_theory(study)),
        numbers=tuple(numbers),
        picture=Picture(
            "curves",
            "Compression at buckling and lift-off, and contact force, over the varied input",
            "Above: end compression at which the straight rod buckles (solid), and at which the first mode leaves the "
            "wall (dash-dotted); upright strokes: another mode comes first"
            + _drawn_too(study)
            + f". Below: largest contact force per length at {'the load' if study.load_varies else 'lift-off'}. "
            "A curve is interrupted where a point has no result; points are joined by straight lines.",
        ),
        assumptions=" ".join(notes(study)),
        steps=tuple(text[1:]),
        next_title="What else was found",
    )


def _drawn_too(study: Study) -> str:
    """What else the upper panel shows, for the caption."""
    ringed = "" if study.load_varies else "; the worst cases are ringed"
    if not load_columns.most_loads(study):
        return ringed
    return f"{ringed}; dotted, the loads that act, as compression at s = 1, marked where the rod is buckled or worse"


def _status(study: Study) -> Status:
    """Whether every point has its loads."""
    points = len(study.points)
    without = sum(point.critical is None for point in study.points)
    partly = len(_lacking(study)) - without
    if without:
        return Status("Points", BAD, "incomplete", f"{without} of {points} points could not be computed")
    if partly:
        return Status(
            "Points", CAUTION, "complete but for lift-off", f"{partly} of {points} points have no lift-off load"
        )
    return Status("Points", GOOD, "complete", f"every one of {points} points has its loads")


def _at_loads(study: Study) -> tuple[Status, ...]:
    """How the rod stands at the loads that act, if there are any: the worst of all points."""
    loads = [state for point in study.points for state in point.loads]
    if not loads:
        return ()
    bad = sum(load_columns.fails(state) for state in loads)
    buckled = sum(state.what == BUCKLED for state in loads)
    if bad:
        why = "it leaves the wall, takes another shape, exceeds a strength, or is not known"
        return (
            Status("Loads", BAD, "not everywhere on the wall and within strength", f"in {bad} of {len(loads)}: {why}"),
        )
    if buckled:
        reason = f"in {buckled} of {len(loads)} it is buckled, on the wall and stable; else straight"
        return (Status("Loads", CAUTION, "buckled in places", reason),)
    return (Status("Loads", GOOD, "straight everywhere", f"at every one of {len(loads)} points and loads"),)


def _theory(study: Study) -> tuple[Status, ...]:
    """Whether the theory's assumptions are left anywhere; nothing where they hold."""
    left = sum(point.validity is not None and bool(point.validity.left) for point in study.points)
    if not left:
        return ()
    return (Status("Theory", BAD, "small strain is left", f"at {left} of {len(study.points)} points"),)


def _lacking(study: Study) -> list[StudyPoint]:
    """Points without all their loads."""
    return [point for point in study.incomplete if set(point.reasons or {}) - {"contact"}]


def _points(study: Study) -> ReportSection:
    columns = (*(_breakable(title) for title in head(study)), "Remark")
    blocks: list[Block] = []
    lacking = _lacking(study)
    if lacking:
        blocks.append(Words("Not every point has every result.", "warning"))
        blocks.append(Items(tuple(f"{study.inputs(point)}: {remarks(study, point)}" for point in lacking)))
    rows = tuple((*cells(study, point), remarks(study, point)) for point in study.rods)
    marked = tuple(i for i, point in enumerate(study.rods) if point.number in worst_points(study))
    blocks.append(Grid(columns, rows, numeric=tuple(range(len(columns) - 1)), marked=marked))
    blocks.append(
        Words("Numbers with all their digits and the error of each: points.csv, points.xlsx, study.json.", "small")
    )
    return ReportSection("Buckling and lift-off" if study.load_varies else "All points", tuple(blocks))


def _loads(study: Study) -> tuple[ReportSection, ...]:
    """The loads that act, if there are any."""
    if not load_columns.most_loads(study):
        return ()
    scale, force, _, _ = scales(study)
    pairs = [
        (state, row)
        for point in study.points
        for state, row in zip(point.loads, load_columns.cells(study, point, scale), strict=True)
    ]
    columns = tuple(_breakable(title) for title in load_columns.head(study, force))
    numeric = tuple(i for i, title in enumerate(columns) if title != "the rod is")
    marked = tuple(i for i, (state, _) in enumerate(pairs) if load_columns.fails(state))
    grid = Grid(columns, tuple(tuple(row) for _, row in pairs), numeric=numeric, marked=marked)
    notes = Words(" ".join((load_columns.LEGEND, *load_columns.NOTES)), "small")
    return (ReportSection("At the loads that act", (grid, notes)),)


def _breakable(title: str) -> str:
    """A title whose names of keys can be broken into lines."""
    return title.replace(".", ".\u200b").replace("_", "_\u200b")


def _inputs(study: Study) -> ReportSection:
    given = tuple(
        (f"{section}.{key}", str(value))
        for section, values in study.given.items()
        for key, value in (values.items() if hasattr(values, "items") else [])
    )
    return ReportSection("Inputs", (Grid(("Key of the case file", "As given"), given),))
