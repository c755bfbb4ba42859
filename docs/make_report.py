"""The first sheet of a report, as a picture for the page on reports."""

from __future__ import annotations

import tempfile
from pathlib import Path

import rodwell
from rodwell.report.folders.pictures import draw
from rodwell.report.pages.pdf import typeset
from rodwell.report.reports.case import case_report

PPI = 110


def pages(out: Path) -> dict[str, str]:
    """Draw the front of the report of the field example into ``out``."""
    answer = rodwell.answer(rodwell.Case.read(out / "examples" / "field-drill-pipe.toml"))
    with tempfile.TemporaryDirectory() as folder:
        sheets = typeset(case_report(answer), draw(answer, Path(folder)), format="png", ppi=PPI)
    (out / "front.png").write_bytes(sheets[0])
    return {}
