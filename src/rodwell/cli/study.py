"""A parameter study on the terminal: what ``rodwell run`` does with a case file that holds lists or ranges."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rodwell.cli.options import check_missed, note_rigid_wall, print_json, print_written, progress_bar
from rodwell.cli.told import told

if TYPE_CHECKING:
    from rich.console import Console

    from rodwell.case.file import CaseText
    from rodwell.studies.sweep.study import Study


def run_study(
    file: CaseText, folder: Path, units: str | None, as_json: bool, quiet: bool, with_pdf: bool, details: bool = False
) -> None:
    """Compute the study in ``file``, write its results to ``folder``, and print a summary or JSON."""
    from rodwell.report.folders.study import write_study  # noqa: PLC0415
    from rodwell.studies.sweep.study import study as compute  # noqa: PLC0415

    note_rigid_wall(file.data)

    def tell_all(written: bool) -> None:
        if as_json:
            print_json(result.as_dict())
        elif not quiet:
            _summary(result, details)
            if written:
                print_written(folder, "report.html", with_pdf)

    with told() as ready, progress_bar(not quiet and not as_json, "reading") as tell:
        result = compute(file, tell, units=units)
        ready(tell_all)
        tell("figure, report and data", 1.0)
        write_study(result, folder, with_pdf=with_pdf)
    rtol = next(point.case.rtol for point in result.points if point.case is not None)
    check_missed([f"point {point.number + 1}: {what}" for point in result.points for what in point.missed], rtol)


def _summary(study: Study, details: bool) -> None:
    """Worst cases and, with ``details``, the tables."""
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415
    from rich.panel import Panel  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415

    from rodwell.studies.sweep.tables import cells, head, holes, sentences, worst_points  # noqa: PLC0415

    console = Console(highlight=False)
    text = sentences(study)
    body = f"[bold]{escape(text[0])}[/bold]" + "".join(f"\n• {escape(line)}" for line in text[1:])
    console.print(Panel(body, title=escape(study.title), title_align="left", border_style="blue"))
    console.print(f"−F: compression at s = 1, positive. First mode; {holes(study)}; no friction.")
    if not details:
        return
    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in head(study, short=True):
        table.add_column(escape(title), justify="right")
    worst = worst_points(study)
    for point in study.rods:
        style = "bold red" if point.number in worst else None
        table.add_row(*(escape(cell) for cell in cells(study, point)), style=style)
    console.print(table)
    _loads(console, study)
    for point in study.incomplete:
        for name, reason in (point.reasons or {}).items():
            console.print(escape(f"{study.inputs(point)}: {name}: {reason}"), style="dim")


def _loads(console: Console, study: Study) -> None:
    """The table of the loads that act, if there are any."""
    from rich.markup import escape  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415

    from rodwell.studies.sweep.load_columns import LEGEND, STATE, cells, fails, head, most_loads  # noqa: PLC0415
    from rodwell.studies.sweep.tables import scales  # noqa: PLC0415

    if not most_loads(study):
        return
    scale, force, _, _ = scales(study)
    console.print(f"\nAt the loads that act. {LEGEND}")
    table = Table(box=None, pad_edge=False, header_style="bold", padding=(0, 1, 0, 0))
    for title in head(study, force, short=True):
        table.add_column(escape(title), justify="left" if title == STATE else "right", overflow="fold")
    for point in study.points:
        for one, row in zip(point.loads, cells(study, point, scale), strict=True):
            table.add_row(*(escape(cell) for cell in row), style="bold red" if fails(one) else None)
    console.print(table)
