"""``rodwell run``: from a case file to an answer, a report, figures and data."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import print_listing
from rodwell.cli.options import OutPath, check_missed, print_json, progress_bar, results_folder, units_option
from rodwell.errors import printable

if TYPE_CHECKING:
    from rodwell.answers.result.answer import Answer


@click.command(short_help="Compute a case: report, figures, data; or a parameter study.")
@click.argument("case", type=click.Path(path_type=Path))
@click.option(
    "--out",
    type=OutPath(),
    help="Folder for the results.  [default: results/NAME-OF-THE-CASE]",
)
@units_option
@click.option("--pdf", "with_pdf", is_flag=True, help="Write the report as PDF too; needs rodwell[pdf].")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON instead of the summary.")
@click.option("--quiet", is_flag=True, help="Print neither progress nor summary.")
def run(case: Path, out: Path | None, units: str | None, with_pdf: bool, as_json: bool, quiet: bool) -> None:
    """Compute CASE, a TOML file, and write report, figures and data.

    CASE may be a pipe, or "-" for standard input; its results go to results/case unless --out says where.

    If one or two of its inputs are ranges ("30..90 deg in 13"), or lists in a file that says study = true at its
    top, a parameter study is made. `rodwell keys` explains the keys of a case file, `rodwell init` writes a first one.
    """
    from rodwell.case.case import Case  # noqa: PLC0415
    from rodwell.case.file import read_case  # noqa: PLC0415
    from rodwell.store.folder import check_writable  # noqa: PLC0415
    from rodwell.studies.sweep.study import is_study  # noqa: PLC0415

    if with_pdf:
        from rodwell.report.pages.pdf import check_pdf  # noqa: PLC0415

        check_pdf()
    text = read_case(case)
    folder = results_folder(out, text.name)
    if is_study(text):
        from rodwell.cli.study import run_study  # noqa: PLC0415

        check_writable(folder)
        run_study(text, folder, units, as_json, quiet, with_pdf)
        return
    read = Case.read(text).in_units(units)
    check_writable(folder)
    from rodwell.answers.result.answer import answer  # noqa: PLC0415
    from rodwell.answers.result.missed import missed  # noqa: PLC0415
    from rodwell.report.folders.case import write_results  # noqa: PLC0415

    with progress_bar(not quiet and not as_json, "critical loads") as tell:
        result = answer(read, tell)
        tell("figures, report and data", 1.0)
        files = write_results(result, folder, with_pdf=with_pdf)
    if as_json:
        print_json(result.as_dict(), indent=2)
    elif not quiet:
        _summary(result, folder, files)
    check_missed(missed(result), read.rtol)


def _summary(answer: Answer, folder: Path, files: tuple[str, ...]) -> None:
    """What a person reads in ten seconds, then the key numbers."""
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415
    from rich.panel import Panel  # noqa: PLC0415

    from rodwell.answers.words.meaning import sentences  # noqa: PLC0415
    from rodwell.problem.problem import ends_text  # noqa: PLC0415
    from rodwell.report.folders.case import FILES  # noqa: PLC0415
    from rodwell.report.pages.pdf import PDF  # noqa: PLC0415
    from rodwell.report.reports.texts import rows  # noqa: PLC0415

    console = Console(highlight=False)
    text = sentences(answer)
    body = f"[bold]{escape(text[0])}[/bold]\n\n" + "\n".join(f"• {escape(line)}" for line in text[1:])
    console.print(Panel(body, title=escape(answer.case.title), title_align="left", border_style="blue"))
    problem = answer.case.problem
    console.print(
        f"γ = {problem.weight:.4g}   α = {problem.alpha:g}° from the vertical   Δ/L = {problem.clearance:.4g}   "
        f"{ends_text(problem)}   forces at s = 1, tension positive{', effective' if answer.case.with_fluids else ''}"
    )
    scales = answer.case.scales
    if scales is not None:
        console.print(escape("; ".join(filter(None, (fact.short(scales.system) for fact in answer.case.facts)))))
    physical = [] if scales is None else [">physical"]
    names = ["label", *(["physical"] if physical else []), "plain", "error", "note"]
    cells = [[escape(row[name]) for name in names] for row in rows(answer.key_numbers.values(), answer.case)]
    print_listing(console, ["", *physical, ">B = L = 1", ">± error", ""], cells, notes=True)
    if not answer.converged:
        console.print(f"[bold red]Not every number meets the tolerance {answer.case.rtol:g}.[/bold red]")
    named = [name for name in (*FILES, PDF) if name in files]
    where = escape(printable(str(folder)))
    console.print(f"\nWritten to [bold]{where}[/bold]: {', '.join(named)}, figures as PNG and SVG")
