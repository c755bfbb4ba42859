"""``rodwell run``: from a case file to an answer, a report, figures and data."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import print_listing
from rodwell.cli.options import (
    OutPath,
    check_missed,
    print_json,
    print_written,
    progress_bar,
    results_folder,
    units_option,
)
from rodwell.cli.told import told

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
@click.option("--details", is_flag=True, help="Print the key figures with their errors too, not the verdict only.")
@click.option(
    "--path/--no-path",
    default=None,
    help="Follow the rod beyond lift-off and back, or leave that out."
    "  [default: analysis.off_wall of the case, or yes]",
)
@click.option("--quiet", is_flag=True, help="Print neither progress nor summary.")
def run(
    case: Path,
    out: Path | None,
    units: str | None,
    with_pdf: bool,
    as_json: bool,
    details: bool,
    path: bool | None,
    quiet: bool,
) -> None:
    """Compute CASE, a TOML file, and write report, figures and data.

    CASE may be a pipe, or "-" for standard input; its results go to results/case unless --out says where.

    If one or two of its inputs are ranges ("30..90 deg in 13"), or lists in a file that says study = true at its
    top, a parameter study is made. `rodwell keys` explains the keys of a case file, `rodwell init` writes a first one.
    """
    from rodwell.case.case import Case  # noqa: PLC0415
    from rodwell.case.file import read_case  # noqa: PLC0415
    from rodwell.store.folder import check_writable  # noqa: PLC0415
    from rodwell.studies.sweep.varied import is_study  # noqa: PLC0415

    if with_pdf:
        from rodwell.report.pages.pdf import check_pdf  # noqa: PLC0415

        check_pdf()
    text = read_case(case)
    folder = results_folder(out, text.name)
    if is_study(text):
        from rodwell.cli.study import run_study  # noqa: PLC0415

        check_writable(folder)
        run_study(text, folder, units, as_json, quiet, with_pdf, details)
        return
    read = Case.read(text).in_units(units)
    check_writable(folder)
    if read.problem.bridges:
        from rodwell.cli.run_bridged import run_bridged  # noqa: PLC0415

        run_bridged(read, folder, as_json=as_json, quiet=quiet, with_pdf=with_pdf)
        return
    if read.problem.ramps:
        from rodwell.cli.run_varying import run_varying  # noqa: PLC0415

        run_varying(read, folder, as_json=as_json, quiet=quiet, with_pdf=with_pdf)
        return
    from rodwell.answers.result.answer import answer  # noqa: PLC0415
    from rodwell.report.folders.beside import drawing_beside  # noqa: PLC0415

    follows = read.off_wall if path is None else path
    with told() as ready, drawing_beside() as drawing:
        shown = not quiet and not as_json
        with progress_bar(shown, "critical loads") as tell:
            result = answer(read, tell)
        if shown:
            _verdict(result)
        drawing.case(result)
        if shown and not result.converged:
            _not_converged(read.rtol)
        from rodwell.answers.result.missed import missed  # noqa: PLC0415
        from rodwell.report.folders.case import write_results  # noqa: PLC0415

        def tell_all(written: bool) -> None:
            if not quiet or as_json:
                _tell(result, follows, as_json=as_json, details=details)
            if shown and written:
                print_written(folder, "report.html", with_pdf)

        ready(tell_all)
        with progress_bar(shown, "report, figures and data"):
            write_results(result, folder, with_pdf=with_pdf, path=follows, drawing=drawing)
    check_missed([*missed(result), *(result.beyond.missed if follows else ())], read.rtol)


def _tell(answer: Answer, follows: bool, *, as_json: bool, details: bool) -> None:
    """Print the answer as JSON; or what is to be said after the verdict."""
    if as_json:
        from rodwell.answers.data.plain import answer_dict  # noqa: PLC0415

        print_json(answer_dict(answer, path=follows), indent=2)
        return
    if follows:
        _beyond(answer)
    if details:
        _details(answer)


def _verdict(answer: Answer) -> None:
    """What a person reads in ten seconds, as soon as it is known."""
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415
    from rich.panel import Panel  # noqa: PLC0415

    from rodwell.answers.words.meaning import sentences  # noqa: PLC0415

    console = Console(highlight=False)
    with progress_bar(True, "stress, contact and what they mean"):
        text = sentences(answer)
    body = f"[bold]{escape(text[0])}[/bold]\n\n" + "\n".join(f"• {escape(line)}" for line in text[1:])
    console.print(Panel(body, title=escape(answer.case.title), title_align="left", border_style="blue"))


def _not_converged(rtol: float) -> None:
    from rich.console import Console  # noqa: PLC0415

    from rodwell.quantities.text import plain  # noqa: PLC0415

    text = f"[bold red]Not every number meets the tolerance {plain(rtol)}.[/bold red]"
    Console(highlight=False).print(text)


def _beyond(answer: Answer) -> None:
    """What happens beyond lift-off: told after the verdict, for it takes longer."""
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415
    from rich.panel import Panel  # noqa: PLC0415

    from rodwell.answers.words.beyond import beyond_sentences  # noqa: PLC0415

    text = beyond_sentences(answer.case, answer.beyond)
    body = "\n".join(f"• {escape(line)}" for line in text)
    Console(highlight=False).print(Panel(body, title="Beyond lift-off", title_align="left", border_style="blue"))


def _details(answer: Answer) -> None:
    """The problem, how it was made, and the key numbers with their errors."""
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415

    from rodwell.answers.words.wording import forces_of  # noqa: PLC0415
    from rodwell.problem.words import ends_text  # noqa: PLC0415
    from rodwell.quantities.text import plain  # noqa: PLC0415
    from rodwell.report.reports.texts import rows  # noqa: PLC0415

    console = Console(highlight=False)
    problem, scales = answer.case.problem, answer.case.scales
    console.print(
        f"γ = {plain(problem.weight)}   α = {plain(problem.alpha)}° from the vertical   "
        f"Δ/L = {plain(problem.clearance)}   "
        f"{ends_text(problem)}   {forces_of(answer.case).convention}{', effective' if answer.case.with_fluids else ''}"
    )
    if scales is not None:
        console.print(escape("; ".join(filter(None, (fact.short(scales.system) for fact in answer.case.facts)))))
    names = ("label", "value", "error", "note")
    cells = [[escape(row[name]) for name in names] for row in rows(answer.key_numbers.values(), answer.case)]
    print_listing(console, ["", ">value", ">± error", ""], cells, notes=True)
