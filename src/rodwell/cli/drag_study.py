"""A parameter study of torque and drag: what ``rodwell drag`` does with a file that holds lists or ranges."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rodwell.cli.options import check_missed, print_json, print_written, progress_bar
from rodwell.cli.told import told

if TYPE_CHECKING:
    from rodwell.case.file import CaseText
    from rodwell.studies.drag.sweep.study import DragStudy


def run_drag_study(file: CaseText, folder: Path, units: str | None, as_json: bool, quiet: bool, with_pdf: bool) -> None:
    """Compute the study in ``file``, write its results to ``folder``, and print a summary or JSON."""
    from rodwell.report.folders.drag_study import write_drag_study  # noqa: PLC0415
    from rodwell.studies.drag.drag import BALANCED  # noqa: PLC0415
    from rodwell.studies.drag.sweep.study import drag_study  # noqa: PLC0415

    def tell_all(written: bool) -> None:
        if as_json:
            print_json(found.as_dict())
        elif not quiet:
            _print(found)
            if written:
                print_written(folder, "report.html", with_pdf)

    with told() as ready, progress_bar(not quiet and not as_json, "reading") as tell:
        found = drag_study(file, tell, units=units)
        ready(tell_all)
        tell("figure, report and data", 1.0)
        write_drag_study(found, folder, with_pdf=with_pdf)
    check_missed([f"point {point.number + 1}: {what}" for point in found.points for what in point.missed], BALANCED)


def _print(found: DragStudy) -> None:
    """Verdict and sentences, and what could not be computed; the table stands in the report."""
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415
    from rich.panel import Panel  # noqa: PLC0415

    from rodwell.studies.drag.sweep.tables import NOTES  # noqa: PLC0415
    from rodwell.studies.drag.sweep.words import sentences  # noqa: PLC0415

    console = Console(highlight=False)
    text = sentences(found)
    body = f"[bold]{escape(text[0])}[/bold]" + "".join(f"\n• {escape(line)}" for line in text[1:])
    console.print(Panel(body, title=escape(found.well.title), title_align="left", border_style="blue"))
    for point in found.points:
        if point.reason:
            console.print(escape(f"{found.inputs(point)}: {point.reason}"), style="dim")
    console.print(escape(NOTES[0]), style="dim")
