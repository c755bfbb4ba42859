"""The report of a parameter study of torque and drag."""

from __future__ import annotations

import datetime
from collections.abc import Iterable, Mapping
from typing import Any

from rodwell._version import __version__
from rodwell.answers.words.advice import BAD, CAUTION, GOOD, Status
from rodwell.quantities.text import minus
from rodwell.report.reports.content import Block, Front, Grid, Items, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.files import linked
from rodwell.report.reports.front import LOGO
from rodwell.studies.drag.sweep.study import DragStudy
from rodwell.studies.drag.sweep.tables import NOTES, short_head, short_rows
from rodwell.studies.drag.sweep.words import failing, sentences
from rodwell.studies.drag.words import BUCKLES, force

FILES = {
    "points.csv": "every point and operation with all digits and the error of each number",
    "points.xlsx": "the same as a workbook",
    "study.json": "the same as data",
    "well.toml": "the study as it was read",
}


def drag_study_report(study: DragStudy, files: Iterable[str] = ()) -> Report:
    """Return the content of the report; ``files`` are the names of those beside it."""
    today, well = datetime.date.today().isoformat(), study.well
    return Report(
        title=well.title,
        subtitle=f"Parameter study of torque and drag · {len(study.points)} points · {len(study.names)} operations · "
        f"rodwell {__version__} · {today}",
        front=_front(study),
        sections=(_points(study), _inputs(study)),
        footer=f"Computed by rodwell {__version__} from {well.source} and {well.survey.source}. "
        "Not included: tool joints, temperature, friction of sheaves, forces of flow.",
        paper="us-letter" if well.system.name == "field" else "a4",
        about=well.about.lines,
        logo="" if well.about.logo is None else LOGO,
        files=linked(files, FILES),
    )


def _front(study: DragStudy) -> Front:
    text = sentences(study)
    numbers = []
    for i, name in enumerate(study.names[:6]):
        loads = [(one.hook_load, point) for point, one in study.results(i) if one.hook_load is not None]
        if loads:
            load, point = min(loads, key=lambda pair: pair[0].value)
            label = f"Least hook load, {name}"
            numbers.append(Number(label, force(study.well, load), "", study.inputs(point)))
    return Front(
        verdict=text[0],
        statuses=(_computed(study), _possible(study)),
        numbers=tuple(numbers),
        picture=Picture(
            "curves",
            "Hook load, push left at surface and depth of lock-up of every operation over the varied input",
            "Hook load without the block, tension positive; below, where there is any, push left at surface and depth "
            "of lock-up, by the worse of two local states where both are stable. Crosses: the operation is not "
            "possible or beyond the yield strength; at the foot, it locks up. Points are joined by straight lines.",
        ),
        assumptions=" ".join(NOTES),
        steps=tuple(text[1:]),
        next_title="What else was found",
    )


def _computed(study: DragStudy) -> Status:
    without = sum(not point.operations for point in study.points)
    if without:
        return Status("Points", BAD, "incomplete", f"{without} of {len(study.points)} points could not be computed")
    missed = sum(bool(point.missed) for point in study.points)
    if missed:
        return Status("Points", BAD, "not balanced", f"at {missed} of {len(study.points)} points")
    return Status("Points", GOOD, "complete", f"every one of {len(study.points)} points, work balanced to 10⁻⁸")


def _possible(study: DragStudy) -> Status:
    bad, computed = len(failing(study)), sum(bool(point.operations) for point in study.points)
    if bad:
        return Status("Operations", BAD, "not everywhere possible", f"something fails at {bad} of {computed} points")
    buckled = sum(any(one.level == BUCKLES for one in point.operations) for point in study.points)
    if buckled:
        return Status("Operations", CAUTION, "buckled in places", f"at {buckled} of {computed} points")
    return Status("Operations", GOOD, "possible and straight", f"at every one of {computed} points")


def _points(study: DragStudy) -> ReportSection:
    blocks: list[Block] = []
    lacking = [point for point in study.points if point.reason]
    if lacking:
        blocks.append(Words("Not every point could be computed.", "warning"))
        blocks.append(Items(tuple(f"{study.inputs(point)}: {point.reason}" for point in lacking)))
    rows, inputs = short_rows(study), len(study.varied)
    head = tuple(short_head(study))
    numeric = (*range(inputs), *range(inputs + 1, len(head) - 1))
    marked = tuple(i for i, (_, fails) in enumerate(rows) if fails)
    grid = Grid(head, tuple(tuple(minus(cell) for cell in cells) for cells, _ in rows), numeric=numeric, marked=marked)
    note = Words("Numbers with all their digits and the error of each: points.csv, points.xlsx, study.json.", "small")
    return ReportSection("All points", (*blocks, grid, note))


def _inputs(study: DragStudy) -> ReportSection:
    rows = tuple(_given("", study.given))
    return ReportSection("Inputs", (Grid(("Key of the file", "As given"), rows),))


def _given(name: str, value: Any) -> Iterable[tuple[str, str]]:
    """Keys as they are named, and what was written."""
    if isinstance(value, Mapping):
        for key, one in value.items():
            yield from _given(f"{name}.{key}" if name else key, one)
    elif isinstance(value, list) and value and all(isinstance(one, Mapping) for one in value):
        for i, one in enumerate(value):
            yield from _given(f"{name} {i + 1}", one)
    else:
        yield name, str(value)
