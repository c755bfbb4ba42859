"""``rodwell audit``: formulas of practice beside the exact loads of a case."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.options import print_json, progress_bar, units_option

if TYPE_CHECKING:
    from rodwell.practice.audit import Audit, Comparison, Other, Row

SHORT = {
    "critical": "critical",
    "lift_off": "lift-off",
    "equal_energy": "equal energy",
    "touch_down": "coil unloaded",
}
"""Exact loads, for the table."""


@click.command()
@click.argument("case", type=click.Path(path_type=Path))
@click.option(
    "--out", type=click.Path(path_type=Path), help="Folder for the results.  [default: results/NAME-OF-THE-CASE-audit]"
)
@click.option("--friction", type=float, help="Coefficient of friction, for the formulas that take one.")
@click.option("--build", type=float, help="Degrees that the hole builds over the rod's length, for curved holes.")
@click.option("--turn", type=float, help="Degrees that the hole turns sideways over the rod's length.")
@click.option("--chart/--no-chart", default=True, show_default=True, help="Draw the error over weight and inclination.")
@units_option
@click.option("--json", "as_json", is_flag=True, help="Print JSON instead of the tables.")
def audit(
    case: Path,
    out: Path | None,
    friction: float | None,
    build: float | None,
    turn: float | None,
    chart: bool,
    units: str | None,
    as_json: bool,
) -> None:
    """Hold the formulas of practice against the exact loads of CASE, a TOML file.

    For every formula: its load, the exact load at the place where the formula's force is measured, the error in
    percent, safe or unsafe, and whether the case is inside its validity. Compression is positive here. The exact loads
    are those of a straight hole without friction.
    """
    from rodwell.practice.case import Case  # noqa: PLC0415
    from rodwell.store.folder import check_writable  # noqa: PLC0415

    read = Case.read(case).in_units(units)
    folder = Path("results") / f"{case.stem}-audit" if out is None else out
    check_writable(folder)
    angles = {"build": build, "turn": turn}
    extra = {name: math.radians(value) for name, value in angles.items() if value is not None}
    if friction is not None:
        extra["mu"] = friction

    from rodwell.practice.audit import audit as compute  # noqa: PLC0415
    from rodwell.practice.audit_map import error_map  # noqa: PLC0415
    from rodwell.report.audit import write_audit  # noqa: PLC0415

    with progress_bar(not as_json, "exact loads") as tell:
        result = compute(read, extra=extra)
        report = lambda done: tell("chart: critical loads over weight and inclination", done)  # noqa: E731
        errors = error_map(result.problem, rtol=read.rtol, progress=report) if chart else None
        tell("figure and data", 1.0)
        files = write_audit(result, errors, folder)
    if as_json:
        print_json(result.as_dict())
        return
    _print(result)
    click.echo(f"\nWritten to {folder}: " + ", ".join(files))


def _print(audit: Audit) -> None:
    """Exact loads, formulas of loads, other formulas, what is left out."""
    from rich.console import Console  # noqa: PLC0415

    from rodwell.practice.exact_loads import PLACES  # noqa: PLC0415
    from rodwell.practice.formulas import LEFT_OUT  # noqa: PLC0415
    from rodwell.problem import ends_text  # noqa: PLC0415

    console = Console(highlight=False)
    problem = audit.problem
    console.print(f"[bold]{_safe(audit.title)}[/bold]")
    console.print(
        f"γ = {problem.weight:.4g}   α = {problem.alpha:g}° from the vertical   Δ/L = {problem.clearance:.4g}   "
        f"{ends_text(problem)}\n"
        "Compression positive at top (s = 1), middle and bottom (s = 0). Straight hole, no friction."
    )
    table = _table("exact load", *(f">{place}" for place in PLACES), ">± error")
    for load in audit.loads:
        table.add_row(load.label, *(_force(audit, load.at(place)) for place in PLACES), _force(audit, load.error, 1))
    console.print(table)
    for note in audit.not_found:
        console.print(f"not compared: {_safe(note)}", style="dim")
    console.print(_loads_table(audit))
    console.print("error = formula/exact − 1; exact and verdict: at the place where the formula's force is measured.")
    _print_reasons(console, audit)
    _print_others(console, audit)
    console.print("[bold]Left out[/bold]")
    for item in LEFT_OUT:
        console.print(f"  {item.name}: {_safe(item.text)}. Reason: {_safe(item.reason)}.")


def _safe(text: str) -> str:
    from rich.markup import escape  # noqa: PLC0415

    return escape(text)


def _table(*columns: str) -> Any:
    """A table without lines; columns whose name starts with ">" are right-justified."""
    from rich.table import Table  # noqa: PLC0415

    table = Table(box=None, pad_edge=False, header_style="bold")
    for column in columns:
        name = column.removeprefix(">")
        table.add_column(name, justify="right" if column != name else "left", overflow="fold")
    return table


def _loads_table(audit: Audit) -> Any:
    """Formulas of loads: error at the place meant, and for an inclined hole at all three."""
    from rodwell.practice.exact_loads import PLACES  # noqa: PLC0415

    inclined = audit.problem.axial_weight > 0.0
    errors = [f">{place}" for place in PLACES] if inclined else [">error"]
    table = _table("formula", ">load", "at", ">exact", *errors, "verdict", "valid", "against")
    for row in audit.rows:
        main = row.main
        value = "–" if row.value is None else _force(audit, row.value)
        exact = "–" if main is None else _force(audit, main.exact)
        sides = [row.beside(row.against, place) for place in PLACES] if inclined else [main]
        cells = [_percent(side, inclined and side is main) for side in sides]
        meant, valid = SHORT[row.against], "yes" if row.valid else "no"
        name = _safe(row.formula.name)
        table.add_row(name, value, row.formula.place, exact, *cells, _verdict(row, main), valid, meant)
    return table


def _verdict(row: Row, main: Comparison | None) -> str:
    if main is None:
        return "needs " + ", ".join(row.missing) if row.missing else "–"
    if row.value == 0.0:
        return "no load"
    return "[green]safe[/green]" if main.safe else "[red]unsafe[/red]"


def _percent(side: Comparison | None, bold: bool) -> str:
    if side is None or side.percent is None:
        return "–"
    text = f"{side.percent:+.1f} %".replace("-", "−")
    return f"[bold]{text}[/bold]" if bold else text


def _force(audit: Audit, value: float, digits: int = 5) -> str:
    """A force in the case's units for a case with dimensions, else in B/L²."""
    if audit.scales is not None:
        return audit.scales.text(value, "force", digits)
    return f"{value:.{digits}g}".replace("-", "−")


def _print_reasons(console: Any, audit: Audit) -> None:
    """Why formulas do not apply, or have no value: each reason once."""
    groups: dict[str, list[str]] = {}
    for row in audit.rows:
        lacking = [f"not given: {', '.join(row.missing)}"] if row.missing else []
        for reason in (*row.reasons, *lacking):
            groups.setdefault(reason, []).append(row.formula.name)
    console.print("[bold]Outside validity[/bold]")
    for reason, names in groups.items():
        console.print(f"  [italic]{_safe(reason)}[/italic]: {_safe('; '.join(names))}")


def _print_others(console: Any, audit: Audit) -> None:
    """Formulas of other kinds that have a value; those that need more, by name."""
    console.print("[bold]Other formulas[/bold], at the bottom's compression in the first critical load")
    table = _table("formula", ">value", "unit", ">small-angle error", "valid")
    for other in audit.others:
        if other.value is None:
            continue
        error = "" if other.relative_error is None else f"{100 * other.relative_error:+.2g} %".replace("-", "−")
        value, unit = _other_value(audit, other)
        table.add_row(_safe(other.formula.name), value, unit, error, "no" if other.reasons else "yes")
    console.print(table)
    needy = [f"{o.formula.name} (needs {', '.join(o.missing)})" for o in audit.others if o.missing]
    console.print("Without a value: " + _safe("; ".join(needy)), style="dim")


def _other_value(audit: Audit, other: Other) -> tuple[str, str]:
    from rodwell.practice.formulas.record import NOMENCLATURE  # noqa: PLC0415

    assert other.value is not None
    dimension = other.formula.dimension
    if audit.scales is not None:
        size, unit = audit.scales.system.unit(NOMENCLATURE[dimension])
        value = other.value * audit.factor(dimension) / size
        return f"{value:.5g}".replace("-", "−"), "" if unit == "1" else unit
    powers = {"B": dimension[0], "L": dimension[1] - 2 * dimension[0]}
    unit = " ".join(f"{name}{_power(power)}" for name, power in powers.items() if power)
    return f"{other.value:.5g}".replace("-", "−"), unit


def _power(power: int) -> str:
    return "" if power == 1 else str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
