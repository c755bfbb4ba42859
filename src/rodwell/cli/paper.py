"""``rodwell paper``: every number and figure of the paper recomputed, compared and drawn."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import print_listing
from rodwell.cli.options import json_option, out_option, print_json, print_written, progress_bar, rtol_option

if TYPE_CHECKING:
    from rodwell.studies.paper.agreement import Agreement
    from rodwell.studies.paper.claims import Finding

UNEXPLAINED_EXIT = 1
COLOURS = {"agrees": "green", "differs, documented": "yellow", "differs": "bold red"}


@click.command(short_help="Recompute the paper: numbers, tables, figures.")
@click.option("--only", help="Items, separated by commas: for example table1,fig5.  [default: all; --list names them]")
@click.option("--figures/--no-figures", default=True, show_default=True, help="Draw the figures (PDF and PNG).")
@click.option("--list", "as_list", is_flag=True, help="List the items and stop.")
@click.option("--jobs", type=int, help="Processes that draw figures.  [default: 2 for more than two figures]")
@rtol_option
@json_option
@out_option("paper")
def paper(
    only: str | None, figures: bool, as_list: bool, jobs: int | None, rtol: float, as_json: bool, out: Path
) -> None:
    """Recompute the paper that rodwell is built on: numbers, tables, figures.

    Each printed number stands beside the computed one with its error, and whether all printed digits agree.
    Differences that are understood are explained. The exit code is 0 only if there are no others.
    """
    from rodwell.studies.paper.items import ITEMS, chosen  # noqa: PLC0415

    if as_list:
        for item in ITEMS.values():
            click.echo(f"{item.name:8}{item.title}")
        return
    names = None if only is None else [name.strip() for name in only.split(",") if name.strip()]
    chosen(names)
    from rodwell.store.folder import check_writable  # noqa: PLC0415

    check_writable(out)
    from rodwell.report.folders.paper import write_paper  # noqa: PLC0415

    with progress_bar(not as_json, "numbers") as tell:
        table, files = write_paper(out, names, figures=figures, rtol=rtol, jobs=jobs, progress=tell)
    if as_json:
        print_json(table.as_dict() | {"files": list(files)})
    else:
        _print(table)
        print_written(out)
    if not table.passed:
        sys.exit(UNEXPLAINED_EXIT)


def _print(table: Agreement) -> None:
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415

    from rodwell.report.folders.paper import HEAD, remarks  # noqa: PLC0415
    from rodwell.studies.paper.agreement import CONVENTION  # noqa: PLC0415

    console = Console(highlight=False)
    if len(table):
        head = [f">{name}" if 0 < i < 4 else name for i, name in enumerate(HEAD[1:])]
        print_listing(console, head, _rows(list(table)))
    for title, findings in remarks(table):
        console.print(f"[bold]{title}[/bold]")
        for finding in findings:
            console.print(f"[italic]{escape(finding.claim.place)}[/italic]: {escape(finding.claim.quantity)}")
            console.print(f"  {escape(finding.remark)}")
    console.print(f"[bold]{escape(table.summary)}[/bold]\n{CONVENTION}")


def _rows(findings: list[Finding]) -> Iterator[Sequence[str] | str]:
    """Rows under the places of the paper that they belong to."""
    from rich.markup import escape  # noqa: PLC0415

    from rodwell.report.folders.paper import cells  # noqa: PLC0415

    place = ""
    for finding in findings:
        where, quantity, *numbers, verdict = (escape(cell) for cell in cells(finding))
        if where != place:
            yield f"[bold]{where}[/bold]"
        place, colour = where, COLOURS[finding.verdict]
        yield (f"  {quantity}", *numbers, f"[{colour}]{verdict}[/{colour}]")
