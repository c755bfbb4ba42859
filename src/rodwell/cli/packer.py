"""``rodwell packer``: tubing in a packer, its changes of length, the movement of its seals, the packer's force."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import print_listing, wrapped
from rodwell.cli.options import (
    OutPath,
    check_missed,
    json_option,
    note_rigid_wall,
    print_json,
    print_written,
    results_folder,
    units_option,
)
from rodwell.cli.told import told

if TYPE_CHECKING:
    from rodwell.studies.packer.packer import PackerAnswer


@click.command(short_help="Tubing in a packer: changes of length, movement, the packer's force.")
@click.argument("case", type=click.Path(path_type=Path))
@click.option("--out", type=OutPath(), help="Folder for the results.  [default: results/NAME-OF-THE-CASE-packer]")
@click.option("--pdf", "with_pdf", is_flag=True, help="Write the report as PDF too.")
@units_option
@json_option
def packer(case: Path, out: Path | None, with_pdf: bool, units: str | None, as_json: bool) -> None:
    """Length changes of the tubing of CASE, a TOML file with [packer], and what its packer must hold.

    The tubing is [rod], the casing [hole]; it was landed with the fluids of [mud] and the pressures of [pressure], and
    goes over to those of [packer]. Piston forces, buckling, ballooning, temperature and slack-off; a packer that allows
    none, some or all of the motion. Lengths positive downwards, forces tension positive. `rodwell keys packer` explains
    the keys.
    """
    from rodwell.case.case import Case  # noqa: PLC0415
    from rodwell.case.file import read_case  # noqa: PLC0415
    from rodwell.store.folder import check_writable  # noqa: PLC0415

    if with_pdf:
        from rodwell.report.pages.pdf import check_pdf  # noqa: PLC0415

        check_pdf()
    text = read_case(case)
    read = Case.read(text).in_units(units)
    note_rigid_wall(read.given)
    folder = results_folder(out, text.name, "-packer")
    check_writable(folder)
    from rodwell.report.folders.packer import write_packer  # noqa: PLC0415
    from rodwell.studies.packer.packer import packer as compute  # noqa: PLC0415

    result = compute(read)

    def tell_all(written: bool) -> None:
        if as_json:
            print_json(result.as_dict())
            return
        _print(result)
        if written:
            print_written(folder, "report.html", with_pdf)

    with told() as ready:
        ready(tell_all)
        write_packer(result, folder, with_pdf=with_pdf)
    check_missed([] if result.converged else ["a change of length, or the packer's force"], 1e-4)


def _print(answer: PackerAnswer) -> None:
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415

    from rodwell.studies.packer.tables import SIGNS, rows, shown  # noqa: PLC0415
    from rodwell.studies.packer.words import sentences  # noqa: PLC0415

    console = Console(highlight=False)
    console.print(f"[bold]{escape(answer.case.title)}[/bold]")
    for sentence in sentences(answer):
        wrapped(sentence)
    assert answer.case.scales is not None
    system = answer.case.scales.system
    cells = [
        (
            escape(row.label),
            *shown(row, system),
            escape(row.note),
        )
        for row in rows(answer)
    ]
    click.echo()
    print_listing(console, ("", ">value", ">± error", ""), cells, notes=True)
    click.echo()
    for sign in SIGNS:
        wrapped(sign)
