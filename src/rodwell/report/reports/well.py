"""The report of a screened well: what becomes of the string, station by station."""

from __future__ import annotations

import datetime
from collections.abc import Iterable

import numpy as np

from rodwell._version import __version__
from rodwell.answers.words.advice import BAD, CAUTION, GOOD, OPEN, Status
from rodwell.quantities.text import plain
from rodwell.report.reports.content import Front, Grid, Items, Number, Picture, Report, ReportSection, Words
from rodwell.report.reports.files import linked
from rodwell.report.reports.front import LOGO
from rodwell.report.reports.texts import inputs
from rodwell.studies.well.screening import BESIDE, Screening
from rodwell.studies.well.tables import assumptions, remarks_of, sentences
from rodwell.studies.well.verdict import (
    BUCKLES,
    CLOSE,
    EXPECTED,
    LEVELS,
    NO_FORCE,
    STRAIGHT,
    TENSION,
    UNJUDGED,
    amount_of,
    found,
    level_of,
    place,
    units,
    used_part,
)

FILES = {
    "stations.csv": "every station as a table",
    "stations.xlsx": "the same as a workbook",
    "screening.json": "the same as data",
}
SEVERITY = {NO_FORCE: OPEN, TENSION: GOOD, STRAIGHT: GOOD, UNJUDGED: CAUTION, CLOSE: BAD, EXPECTED: BAD, BUCKLES: BAD}

MOST_STATIONS = 60
"""Stations in the table of the report; the files have them all."""


def screening_report(screening: Screening, files: Iterable[str] = ()) -> Report:
    """Return the content of the report of a screened well; ``files`` are the names of those beside it."""
    text, case = sentences(screening), screening.case
    today = datetime.date.today().isoformat()
    return Report(
        title=case.title,
        subtitle=f"A well screened station by station · {len(screening.survey)} stations · {today} · "
        f"rodwell {__version__}",
        front=Front(
            verdict=text[0],
            statuses=_statuses(screening),
            numbers=_numbers(screening),
            picture=Picture(
                "limits",
                "Inclination, and the loads at which the string buckles and leaves the wall, against measured depth",
                "Against measured depth: inclination, and the compression at which a long straight rod of the "
                "station's inclination buckles and leaves the wall, beside formulas of practice and the string's load.",
            ),
            assumptions="Compression positive, at the station. Friction, pressure, joints and curvature of the hole "
            "are not in the exact loads; He–Kyllingstad has the curvature.",
            steps=tuple(text[1:]),
            next_title="What else was found",
        ),
        sections=(
            _stations(screening),
            ReportSection("What the loads are", (Items(tuple(assumptions(screening))),)),
            ReportSection("Inputs", (Grid(("Key of the case file", "As given"), tuple(inputs(case))),)),
        ),
        footer=f"Computed by rodwell {__version__} from {case.source}.",
        paper="us-letter" if screening.survey.depth_unit == "ft" else "a4",
        about=case.about.lines,
        logo="" if case.about.logo is None else LOGO,
        files=linked(files, FILES),
    )


def _statuses(screening: Screening) -> tuple[Status, ...]:
    level = level_of(screening)
    lost = int(np.sum(np.isnan(screening.critical.values)))
    count = len(screening.survey)
    known = Status("Stations", GOOD, "all judged", f"every one of {count} stations has its exact load")
    if lost:
        known = Status("Stations", CAUTION, "not all judged", f"{lost} of {count} stations lack an exact load")
    return (Status("Buckling", SEVERITY[level], LEVELS[level], "the worst of all stations"), known)


def _numbers(screening: Screening) -> tuple[Number, ...]:
    at, load, exact = place(screening), amount_of(screening), screening.critical
    weakest, worst = screening.weakest, screening.worst
    value, error = float(exact.values[weakest]), float(exact.errors[weakest])
    out = [Number("Least compression that buckles it", load(value, error), note=f"at {at(weakest)}")]
    if worst is not None and screening.compression is not None:
        used = f"{plain(100.0 * used_part(screening, worst).value, 3)} %"
        out.insert(0, Number("Largest part used of the critical load", used, note=f"at {at(worst)}"))
        out.append(Number("Largest compression of the string", load(float(np.nanmax(screening.compression)))))
    return tuple(out)


def _stations(screening: Screening) -> ReportSection:
    """A table of the stations, the worst among them."""
    depth, metre, force, newton = units(screening)
    head = [f"Measured depth [{depth}]", "Inclination [°]", f"Buckles [{force}]", f"Leaves the wall [{force}]"]
    head.append(f"Buckles in the hole's build [{force}]")
    exact = (screening.critical, screening.lift_off, screening.bent)
    columns = [values / newton for values in (*(loads.values for loads in exact), *screening.formulas.values())]
    head += [f"{BESIDE[key].name} [{force}]" for key in screening.formulas]
    if screening.compression is not None and screening.utilisation is not None:
        head += [f"The string [{force}]", "Used [%]"]
        columns += [screening.compression / newton, 100.0 * screening.utilisation]
    count, mark = len(screening.survey), screening.weakest if screening.worst is None else screening.worst
    shown = sorted({mark, *(int(i) for i in np.linspace(0, count - 1, min(MOST_STATIONS, count)).round())})
    judged = found(screening)
    rows = tuple(
        (
            plain(float(screening.survey.md[i]) / metre, 6),
            plain(float(screening.survey.inclination[i]), 3),
            *("–" if np.isnan(values[i]) else plain(float(values[i])) for values in columns),
            remarks_of(screening, judged, i),
        )
        for i in shown
    )
    grid = Grid((*head, "Remark"), rows, numeric=tuple(range(len(head))), marked=(shown.index(mark),))
    left_out = (
        "" if len(shown) == count else f"{len(shown)} of {count} stations; the files beside this report have all. "
    )
    note = Words(f"{left_out}Compression positive. The marked station decides.", "small")
    return ReportSection("Stations", (grid, note))
