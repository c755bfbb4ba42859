"""The first sheet of a report, as a picture for the page on reports."""

from __future__ import annotations

from pathlib import Path

import rodwell
from rodwell.report.folders.pictures import draw_branches, draw_rod
from rodwell.report.pages.pdf import typeset
from rodwell.report.reports.case import case_report

PPI = 110


def pages(out: Path) -> dict[str, str]:
    """Draw the front of the report of the field example into ``out``."""
    answer = rodwell.answer(rodwell.Case.read(out / "examples" / "field-drill-pipe.toml"))
    pictures = {
        name: next((kind, formats[kind]) for kind in ("svg", "png") if kind in formats)
        for name, formats in {**draw_branches(answer), **draw_rod(answer)}.items()
    }
    sheets = typeset(case_report(answer), pictures, format="png", ppi=PPI)
    (out / "front.png").write_bytes(sheets[0])
    return {}
