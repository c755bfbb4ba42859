"""``rodwell screen``: a whole well, station by station."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.options import OutPath, check_missed, print_json, print_written, progress_bar
from rodwell.cli.told import told
from rodwell.errors import InputError
from rodwell.quantities.text import plain

if TYPE_CHECKING:
    from rodwell.studies.well.screening import Screening
    from rodwell.survey.survey import Survey

SHOWN = 12
"""Stations in the table on the terminal."""


@click.command(short_help="Screen a whole well, station by station, from its survey.")
@click.argument("survey", type=click.Path(path_type=Path))
@click.option("--case", required=True, type=click.Path(path_type=Path), help="Case file of string and hole.")
@click.option("--out", type=OutPath(), help="Folder for the results.  [default: results/NAME-screen]")
@click.option("--bit-force", help='Effective force at the last station: "-100 kN" is weight on bit.')
@click.option("--hook-force", help='Effective force at the first station: "500 kN" is hook load.')
@click.option("--depth-unit", help="Unit of measured depth, m or ft, if the header does not say.")
@click.option("--angle-unit", help="Unit of inclination and azimuth, deg or rad.  [default: the header's, or deg]")
@click.option("--force-unit", help="Unit of the force column, if the header does not say.")
@click.option(
    "--column", "columns", multiple=True, metavar="KIND=NAME",
    help='Which column is md, inclination, azimuth, force or well, by its header or number: inclination="Dip (deg)", '
    "azimuth=none leaves one out. Can be given several times.",
)  # fmt: skip
@click.option("--decimal", help="Decimal mark, point or comma, where numbers such as 1,234 do not tell.")
@click.option("--well", help="Which well, if the file holds several.")
@click.option("--all-wells", is_flag=True, help="Every well of the file, each into a folder of its own.")
@click.option("--units", type=click.Choice(["si", "field"]), help="Units of the results.  [default: by the survey]")
@click.option("--details", is_flag=True, help="Print stations and assumptions too, not the verdict only.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON instead of the summary.")
def screen(
    survey: Path,
    case: Path,
    out: Path | None,
    bit_force: str | None,
    hook_force: str | None,
    depth_unit: str | None,
    angle_unit: str | None,
    force_unit: str | None,
    columns: tuple[str, ...],
    decimal: str | None,
    well: str | None,
    all_wells: bool,
    units: str | None,
    details: bool,
    as_json: bool,
) -> None:
    """Screen the well of SURVEY, a file of measured depth and inclination, station by station.

    The file is CSV or other text, XLSX, LAS, or a Petrel deviation file; azimuths and forces are taken if it has them.

    At every station: the exact load at which a long straight rod of the station's inclination buckles and leaves the
    wall, beside the formulas of practice; with a force at bit or hook, or a column of forces, how much of it is used.
    Forces given are tension positive: a bit that pulls or a hook that pushes is refused unless the word says so,
    "20 klbf tension". Results are compression positive, at the station. Length, inclination and loads of the case
    are not used. `rodwell keys` explains the keys of a case file.
    """
    from rodwell.case.case import Case  # noqa: PLC0415
    from rodwell.store.folder import check_writable  # noqa: PLC0415
    from rodwell.studies.well.plain import screening_dict  # noqa: PLC0415
    from rodwell.studies.well.screening import CRITICAL_PRECISION, LIFT_OFF_PRECISION  # noqa: PLC0415

    read = Case.read(case)
    how = {
        "depth_unit": depth_unit, "angle_unit": angle_unit, "force_unit": force_unit, "columns": _columns(columns),
        "decimal": decimal,
    }  # fmt: skip
    wells = _wells(survey, how, well, all_wells)
    if force_unit is not None and all(each.force is None for each in wells.values()):
        what = f"has no meaning: {survey.name} has no column of forces; leave the option out, or name the column Force"
        raise InputError("--force-unit", force_unit, what)
    folder = Path("results") / f"{survey.stem}-screen" if out is None else out
    folders = {name: folder / _folder_name(name, i) if all_wells else folder for i, name in enumerate(wells)}
    for each in folders.values():
        check_writable(each)
    forces = {"bit_force": _force("--bit-force", bit_force), "hook_force": _force("--hook-force", hook_force)}
    if units is not None:
        wells = {name: replace(each, depth_unit={"si": "m", "field": "ft"}[units]) for name, each in wells.items()}
    from rodwell.report.folders.well import write_screening  # noqa: PLC0415
    from rodwell.studies.well.screening import screen as compute  # noqa: PLC0415

    done: dict[str, Screening] = {}

    def tell_all(_: bool) -> None:
        if as_json and done:
            data = {name: screening_dict(each) for name, each in done.items()}
            print_json({"wells": data} if all_wells else next(iter(data.values())))

    with told() as ready:
        ready(tell_all)
        for name, of_well in wells.items():
            with told() as well_ready, progress_bar(not as_json, "critical loads") as tell:
                done[name] = compute(read, of_well, **forces, signs_meant=True, progress=tell)
                well_ready(partial(_tell_well, done[name], folders[name], as_json=as_json, details=details))
                tell("figure and data", 1.0)
                write_screening(done[name], folders[name])
    for kind, precision in (("critical load", CRITICAL_PRECISION), ("lift-off load", LIFT_OFF_PRECISION)):
        missed = [f"{name}: {what}" if name else what for name, each in done.items() for what in each.missed[kind]]
        check_missed(missed, precision.tolerance)


def _columns(given: tuple[str, ...]) -> dict[str, str | int]:
    """Columns by meaning from "inclination=Dip (deg)"."""
    from rodwell.errors import InputError  # noqa: PLC0415

    columns: dict[str, str | int] = {}
    for text in given:
        kind, equals, name = text.partition("=")
        if not equals:
            raise InputError("--column", text, 'must be KIND=NAME, for example inclination="Dip (deg)"')
        columns[kind.strip().lower()] = name
    return columns


def _wells(survey: Path, how: dict[str, Any], well: str | None, all_wells: bool) -> dict[str, Survey]:
    """The wells that were asked for, by name."""
    from rodwell.errors import InputError  # noqa: PLC0415
    from rodwell.survey.survey import Survey, read_surveys  # noqa: PLC0415

    if not all_wells:
        return {"": Survey.read(survey, well=well, **how)}
    if well is not None:
        raise InputError("--well", well, "cannot be given together with --all-wells")
    return read_surveys(survey, **how)


def _folder_name(well: str, number: int) -> str:
    """A name for the folder of a well: letters and digits of its name, and its number, so that no two are one."""
    plain = "".join(c if c.isalnum() or c in "-_" else "-" for c in well).strip("-")[:60]
    return f"{number + 1}-{plain}" if plain else str(number + 1)


def _tell_well(result: Screening, folder: Path, written: bool, *, as_json: bool, details: bool) -> None:
    """Print what was found in a well unless it is wanted as JSON, and where its files are, if they are."""
    if as_json:
        return
    _print(result, details)
    if written:
        print_written(folder, "report.html")


def _force(option: str, text: str | None) -> float | None:
    """A force of the command line in N; a sign that contradicts the option's name needs a word."""
    from rodwell.case.checks.signs import pulls, pushes  # noqa: PLC0415
    from rodwell.errors import InputError  # noqa: PLC0415
    from rodwell.quantities.units import to_si  # noqa: PLC0415
    from rodwell.quantities.written import direction  # noqa: PLC0415

    if text is None:
        return None
    try:
        value = to_si(text, "force")
    except ValueError as error:
        raise InputError(option, text, str(error)) from None
    said = direction(text)[1] != 0
    if option == "--bit-force" and value > 0.0 and not said:
        raise pulls(option, text, " at the bit, which would hang on the string")
    if option == "--hook-force" and value < 0.0 and not said:
        raise pushes(option, text, " at the hook, which would push the string")
    return value


def _print(screening: Screening, details: bool) -> None:
    """Verdict; with ``details`` a few stations from top to bottom with the worst among them, assumptions."""
    from rich.console import Console  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415
    from rich.panel import Panel  # noqa: PLC0415

    from rodwell.studies.well.tables import assumptions, sentences  # noqa: PLC0415

    console = Console(highlight=False)
    text = sentences(screening)
    body = f"[bold]{escape(text[0])}[/bold]" + "".join(f"\n• {escape(line)}" for line in text[1:])
    console.print(Panel(body, title=escape(screening.case.title), title_align="left", border_style="blue"))
    if not details:
        for note in screening.survey.notes:  # how the file was read is never left out
            console.print(escape(note), style="dim")
        return
    console.print(_stations(screening))
    for line in assumptions(screening):
        console.print(escape(line), style="dim")


def _stations(screening: Screening) -> object:
    import numpy as np  # noqa: PLC0415
    from rich.markup import escape  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415

    from rodwell.studies.well.screening import BESIDE  # noqa: PLC0415
    from rodwell.studies.well.verdict import units  # noqa: PLC0415

    depth, metre, force, newton = units(screening)
    table = Table(box=None, pad_edge=False, header_style="bold")
    heads = [f"MD [{depth}]", "incl.", f"buckles [{force}]", "lifts off", "in the build"]
    heads += [BESIDE[key].head for key in screening.formulas]
    used = screening.utilisation
    heads += [] if used is None else ["the string", "used"]
    for head in heads:
        table.add_column(escape(head), justify="right")
    mark = screening.weakest if screening.worst is None else screening.worst
    count = len(screening.survey)
    shown = sorted({mark, *(int(i) for i in np.linspace(0, count - 1, min(SHOWN, count)).round())})
    exact = (screening.critical, screening.lift_off, screening.bent)
    columns = [*(loads.values for loads in exact), *screening.formulas.values()]
    columns += [] if screening.compression is None else [screening.compression]
    for i in shown:
        cells = [plain(screening.survey.md[i] / metre, 6), f"{plain(screening.survey.inclination[i], 3)}°"]
        cells += ["–" if np.isnan(c[i]) else plain(c[i] / newton) for c in columns]
        cells += [] if used is None else ["–" if np.isnan(used[i]) else f"{plain(100 * used[i], 3)} %"]
        table.add_row(*cells, style="bold red" if i == mark else None)
    return table
