"""``rodwell drag``: torque and drag of a whole well."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

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
from rodwell.errors import InputError
from rodwell.quantities.text import plain

FAR = 10.0
"""Multiples of the yield strength that are told as beyond it."""

if TYPE_CHECKING:
    from rodwell.studies.drag.calibration import Calibration
    from rodwell.studies.drag.drag import Drag


@click.command(short_help="Torque and drag of a whole well: hook load, torque, buckling, lock-up.")
@click.argument("well", type=click.Path(path_type=Path))
@click.option("--out", type=OutPath(), help="Folder for the results.  [default: results/NAME-drag]")
@units_option
@click.option(
    "--calibrate", type=click.Path(path_type=Path), metavar="CSV",
    help="Measured hook loads and torques: friction factors are fitted to them, and all is computed with these.",
)  # fmt: skip
@click.option("--pdf", "with_pdf", is_flag=True, help="Write the report as PDF too; needs rodwell[pdf].")
@click.option("--json", "as_json", is_flag=True, help="Print JSON instead of the summary.")
@click.option("--quiet", is_flag=True, help="Print neither progress nor summary.")
def drag(
    well: Path,
    out: Path | None,
    units: str | None,
    calibrate: Path | None,
    with_pdf: bool,
    as_json: bool,
    quiet: bool,
) -> None:
    """Compute the operations of WELL, a TOML file of string, hole with survey, fluids and operations.

    For each operation: hook load and torque at surface, where the string is buckled and how, contact force, stress,
    stretch, and for what goes down how deep it can go: where it locks up, and where the push at surface ends. Forces
    are effective, tension positive. Where two local states are stable, both bounds are printed and the verdict takes
    the worse.

    If one or two of its inputs are ranges (friction = "0.1..0.4 in 7"), or lists in a file that says study = true at
    its top, a parameter study is made.
    """
    from rodwell.case.file import read_case  # noqa: PLC0415
    from rodwell.report.folders.drag import write_drag  # noqa: PLC0415
    from rodwell.store.folder import check_writable  # noqa: PLC0415
    from rodwell.studies.drag.drag import drag as compute  # noqa: PLC0415
    from rodwell.studies.drag.plain import drag_dict  # noqa: PLC0415
    from rodwell.studies.drag.sweep.study import is_well_study  # noqa: PLC0415
    from rodwell.studies.drag.well_case import Well  # noqa: PLC0415

    if with_pdf:
        from rodwell.report.pages.pdf import check_pdf  # noqa: PLC0415

        check_pdf()
    text = read_case(well)
    folder = results_folder(out, text.name, "-drag")
    if is_well_study(text):
        from rodwell.cli.drag_study import run_drag_study  # noqa: PLC0415

        if calibrate is not None:
            what = "takes a file of single values: a study has no measurements of its own; give one value to each key"
            raise InputError("--calibrate", calibrate, what)
        check_writable(folder)
        run_drag_study(text, folder, units, as_json, quiet, with_pdf)
        return
    read = Well.read(text).in_units(units)
    check_writable(folder)
    fitted = None

    def tell_all(written: bool) -> None:
        if as_json:
            print_json(drag_dict(found, fitted))
        elif not quiet:
            _print(found)
            if fitted is not None:
                _print_friction(fitted)
            if written:
                print_written(folder, "report.html", with_pdf)

    with told() as ready, progress_bar(not quiet and not as_json, "operations") as tell:
        if calibrate is not None:
            from rodwell.studies.drag.calibration import calibrate as fit  # noqa: PLC0415
            from rodwell.studies.drag.measured import read_measured  # noqa: PLC0415

            fitted = fit(read, read_measured(calibrate, read), tell)
            read = fitted.well
        found = compute(read, tell)
        ready(tell_all)
        tell("figures, report and data", 1.0)
        write_drag(found, folder, calibration=fitted, with_pdf=with_pdf)
    from rodwell.studies.drag.drag import BALANCED  # noqa: PLC0415
    from rodwell.studies.drag.words import unbalanced  # noqa: PLC0415

    check_missed(unbalanced(found), BALANCED)


def _print_friction(found: Calibration) -> None:
    """Friction factors that were found, how well they meet the measurements, and what makes them doubtful."""
    from rodwell.studies.drag.words import scatter  # noqa: PLC0415

    for name, value in zip(found.names, found.friction, strict=True):
        known = value.error == value.error and value.error < float("inf")
        error = f" ± {plain(value.error, 2)} (standard error)" if known else ": nothing is measured that depends on it"
        click.echo(f"friction factor of {name}: {plain(value.value)}{error}")
    click.echo(f"{scatter(found.well, found)} about those computed ({len(found.measured)} measurements).")
    for note in found.notes:
        click.echo(note)


def _print(found: Drag) -> None:
    """Verdict and sentences, a table of the operations, assumptions."""
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415
    from rich.panel import Panel  # noqa: PLC0415

    from rodwell.studies.drag.words import assumptions, sentences  # noqa: PLC0415

    console = Console(highlight=False)
    text = sentences(found)
    body = f"[bold]{escape(text[0])}[/bold]" + "".join(f"\n• {escape(line)}" for line in text[1:])
    console.print(Panel(body, title=escape(found.well.title), title_align="left", border_style="blue"))
    console.print(_table(found))
    for line in assumptions(found):
        console.print(escape(line), style="dim")


def _table(found: Drag) -> object:
    """Ends of every operation by the three laws of contact; what fails stands out."""
    from rich.markup import escape  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415

    from rodwell.quantities.value import Value  # noqa: PLC0415
    from rodwell.studies.drag.words import FAILS, level_of_one, units  # noqa: PLC0415

    by = units(found.well)
    (n, force), (nm, torque) = by["force"], by["torque"]
    table = Table(box=None, pad_edge=False, header_style="bold")
    heads = ["operation", f"hook load [{force}]", "straight", "correlation", f"torque [{torque}]", "buckled", "yield"]
    for i, head in enumerate(heads):
        table.add_column(escape(head), justify="left" if i == 0 else "right")

    def cell(value: Value | None, unit: float) -> str:
        return "locks up" if value is None else plain(value.value / unit, 5)

    for one in found.operations:
        used = [v for v in one.strength.used if v == v]  # noqa: PLR0124
        buckled = sum(low - high for low, high, _ in one.run.buckled) / by["depth"][0]
        table.add_row(
            escape(one.operation.name), cell(one.ends.hook_load, n),
            *(cell(one.compared[name].hook_load, n) if name in one.compared else "" for name in
              ("straight", "correlation")),
            cell(one.ends.torque, nm), f"{plain(buckled)} {by['depth'][1]}" if buckled else "no",
            ("–" if not used else "beyond" if max(used) >= FAR else f"{plain(100.0 * max(used), 3)} %")
            + (" of some" if used and one.strength.not_judged else ""),
            style="bold red" if level_of_one(one) == FAILS else None,
        )  # fmt: skip
    return table
