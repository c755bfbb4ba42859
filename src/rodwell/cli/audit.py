"""``rodwell audit``: formulas of practice beside the exact loads of a case."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.listing import print_listing
from rodwell.cli.mapping import StorePath, named_as_options, telling
from rodwell.cli.options import (
    OutPath,
    Progress,
    check_missed,
    print_json,
    print_written,
    progress_bar,
    results_folder,
    units_option,
)
from rodwell.cli.told import told
from rodwell.errors import InputError
from rodwell.quantities.text import error_digit, minus, plain, signed

if TYPE_CHECKING:
    from rodwell.answers.comparison.beside import Comparison, FormulaRow, Other
    from rodwell.problem.problem import Problem
    from rodwell.studies.audit.audit import AtApplied, Audit
    from rodwell.studies.audit.error_map import ErrorMap

NAMES = {
    "critical": "the first critical load",
    "lift_off": "lift-off",
    "equal_energy": "the coil with the energy of the straight rod",
    "touch_down": "the coil that leaves the wall on unloading",
}
"""Exact loads, where a case has none to be named."""


def _renamed(context: click.Context, option: click.Parameter, given: float | None) -> None:
    """Refuse what was once the angle in degrees: elsewhere the same word is a curvature in 1/L."""
    if given is not None:
        key = "build" if option.name == "build" else "walk"
        raise InputError(
            f"--{option.name}",
            given,
            f"is now --{option.name}-angle, degrees over the length of the rod: write --{option.name}-angle {given:g}; "
            f"for exact loads of the curved hole give its curvature in the case, hole.{key}",
        )


@click.command(short_help="Hold the formulas of practice against a case's exact loads.")
@click.argument("case", type=click.Path(path_type=Path))
@click.option("--out", type=OutPath(), help="Folder for the results.  [default: results/NAME-OF-THE-CASE-audit]")
@click.option("--friction", type=float, help="Coefficient of friction, for the formulas that take one.")
@click.option(
    "--build-angle",
    type=float,
    help="Degrees that the hole builds over the rod's length, for formulas beside a case in a straight hole.",
)
@click.option("--turn-angle", type=float, help="Degrees that the hole turns sideways over the rod's length.")
@click.option("--build", type=float, hidden=True, callback=_renamed, expose_value=False)
@click.option("--turn", type=float, hidden=True, callback=_renamed, expose_value=False)
@click.option("--chart/--no-chart", default=True, show_default=True, help="Draw the error over weight and inclination.")
@click.option("--workers", default=1, show_default=True, help="Processes on this machine that compute the chart.")
@click.option("--scheduler", metavar="URL", help="Address of a Dask scheduler, in place of --workers.")
@click.option(
    "--store", type=StorePath(), metavar="NAME.zarr",
    help="Keep the loads of the chart, chunk by chunk, to go on after a break; needs rodwell[map].",
)  # fmt: skip
@units_option
@click.option("--details", is_flag=True, help="Print every formula, not the verdict only.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON instead.")
def audit(
    case: Path,
    out: Path | None,
    friction: float | None,
    build_angle: float | None,
    turn_angle: float | None,
    chart: bool,
    workers: int,
    scheduler: str | None,
    store: str | None,
    units: str | None,
    details: bool,
    as_json: bool,
) -> None:
    """Hold the formulas of practice against the exact loads of CASE, a TOML file.

    For every formula: its load, the exact load at the place where the formula's force is measured, the error in
    percent, safe (where the formula is valid for the rod) or unsafe. Formulas of pitch, contact, stress, shortening and
    lock-up are shown at the first critical load and at each load.applied. Compression is positive here. The exact loads
    are those of the case's hole, straight or curved (hole.build, hole.survey), without friction. `rodwell keys`
    explains the keys of a case file.
    """
    from rodwell.case.case import Case  # noqa: PLC0415
    from rodwell.case.file import read_case  # noqa: PLC0415
    from rodwell.store.folder import check_writable  # noqa: PLC0415

    text = read_case(case)
    read = Case.read(text).in_units(units)
    folder = results_folder(out, text.name, "-audit")
    check_writable(folder)
    angles = {"build": build_angle, "turn": turn_angle}
    extra = {name: math.radians(value) for name, value in angles.items() if value is not None}
    if friction is not None:
        extra["mu"] = friction

    from rodwell.report.folders.audit import write_audit  # noqa: PLC0415
    from rodwell.studies.audit.audit import audit as compute  # noqa: PLC0415

    drawn = chart and not (read.problem.hole or read.problem.sections)  # maps turn the hole of a uniform rod
    if store is not None and not drawn:
        raise InputError("--store", store, "keeps the loads of a chart, and none is drawn here: leave it out")

    def tell_all(written: bool) -> None:
        if as_json:
            print_json(result.as_dict())
            return
        _decided(result)
        if details:
            _print(result)
        if written:
            print_written(folder, "report.html")

    with told() as ready, progress_bar(not as_json, "exact loads") as tell:
        result = compute(read, extra=extra)
        ready(tell_all)
        options = {"workers": workers, "scheduler": scheduler, "started": telling(as_json), "rtol": read.rtol}
        errors = _chart(result.problem, store, tell, options) if drawn else None
        tell("figure and data", 1.0)
        write_audit(result, errors, folder, read.about, read.source)
    missed = [f"{load.label} ± {error_digit(load.error)}" for load in result.loads if not load.meets(read.rtol)]
    check_missed(missed, read.rtol)


def _chart(problem: Problem, store: str | None, tell: Progress, options: dict[str, Any]) -> ErrorMap:
    """Errors of formulas over weight and inclination, of a map of critical loads."""
    from rodwell.store.mapping import map as mapped  # noqa: PLC0415
    from rodwell.studies.audit.error_map import CRITICAL, ErrorMap, chart_over  # noqa: PLC0415

    report: Progress = lambda _what, done: tell("chart: critical loads over weight and inclination", done)  # noqa: E731
    with named_as_options(store, "--store"):
        found = mapped(problem, CRITICAL, over=chart_over(problem), out=store, halvings=0, progress=report, **options)
    return ErrorMap.of(found, problem)


def _decided(audit: Audit) -> None:
    """What is decided, in a few lines."""
    from rich.console import Console  # noqa: PLC0415
    from rich.panel import Panel  # noqa: PLC0415

    from rodwell.report.reports.audit import if_held, verdict  # noqa: PLC0415

    lines = [f"[bold]{_safe(verdict(audit))}[/bold]"]
    for load in audit.loads:
        lines.append(f"• {_safe(load.label)}: {_force(audit, load.at('bottom'), 4)} of compression at the bottom")
    lines += [f"• {_safe(what)}" for what in [if_held(audit.problem)] if what]
    lines += [f"• not compared: {_safe(note)}" for note in audit.not_found]
    panel = Panel("\n".join(lines), title=_safe(audit.title), title_align="left", border_style="blue")
    Console(highlight=False).print(panel)


def _print(audit: Audit) -> None:
    """Exact loads, formulas of loads, other formulas, what is left out."""
    from rich.console import Console  # noqa: PLC0415

    from rodwell.answers.comparison.exact_loads import PLACES  # noqa: PLC0415
    from rodwell.formulas import LEFT_OUT  # noqa: PLC0415
    from rodwell.report.reports.audit import conditions  # noqa: PLC0415

    console = Console(highlight=False)
    console.print(f"[bold]{_safe(audit.title)}[/bold]")
    console.print(f"Compression positive at top (s = 1), middle and bottom (s = 0). {conditions(audit.problem)}")
    rows = [
        (_safe(load.label), *(_force(audit, load.at(place)) for place in PLACES), _force(audit, load.error, 1))
        for load in audit.loads
    ]
    print_listing(console, ["exact load", *(f">{place}" for place in PLACES), ">± error"], rows)
    for note in audit.not_found:
        console.print(f"not compared: {_safe(note)}", style="dim")
    console.print()
    _print_loads(console, audit)
    _print_reasons(console, audit)
    _print_others(console, audit)
    console.print("\n[bold]Left out[/bold]")
    for item in LEFT_OUT:
        _item(console, f"[italic]{_safe(item.name)}[/italic]:", f"{_safe(item.text)}. Reason: {_safe(item.reason)}.")


def _safe(text: str) -> str:
    from rich.markup import escape  # noqa: PLC0415

    return escape(text)


def _print_loads(console: Any, audit: Audit) -> None:
    """Formulas of loads under the exact load that each is held against: for an inclined hole errors at all places."""
    from rodwell.answers.comparison.exact_loads import PLACES  # noqa: PLC0415

    inclined = audit.problem.axial_weight > 0.0
    titles = {load.name: load.label for load in audit.loads}
    groups: dict[str, list[Sequence[str] | str]] = {}
    for row in audit.rows:
        sides = [row.beside(row.against, place) for place in PLACES] if inclined else [row.main]
        cells = [_percent(side, inclined and side is row.main) for side in sides]
        value = "–" if row.value is None else _force(audit, row.value)
        title = f"[bold]against {_safe(titles.get(row.against, NAMES[row.against]))}[/bold]"
        groups.setdefault(row.against, [title]).append(
            (f"  {_safe(row.formula.name)}", value, _safe(row.at), *cells, _verdict(row, row.main),
             "yes" if row.valid else "no")
        )  # fmt: skip
    errors = [f">{place}" for place in PLACES] if inclined else [">error"]
    rows = [row for group in groups.values() for row in group]
    print_listing(console, ["formula", ">load", "at", *errors, "verdict", "valid"], rows)
    where = " at top, middle, bottom" if inclined else ""
    at_place = f"at the place where the formula's force is measured{', in bold' if inclined else ''}"
    console.print(f"Error{where} = formula/exact − 1, as compressions; verdict: {at_place}.", style="dim")
    console.print(
        "Safe: below the exact load, and the formula is valid for the rod; low: below it, but the formula is not meant "
        "for such a rod.", style="dim",
    )  # fmt: skip


def _verdict(row: FormulaRow, main: Comparison | None) -> str:
    if main is None:
        return "needs " + ", ".join(row.missing) if row.missing else "–"
    return {"safe": "[green]safe[/green]", "unsafe": "[red]unsafe[/red]"}.get(row.verdict, row.verdict)


def _percent(side: Comparison | None, bold: bool) -> str:
    if side is None or side.percent is None:
        return "–"
    text = minus(f"{side.percent:+.1f} %")
    return f"[bold]{text}[/bold]" if bold else text


def _force(audit: Audit, value: float, digits: int = 5) -> str:
    """A force in the case's units for a case with dimensions, else in B/L²."""
    return plain(value, digits) if audit.scales is None else audit.scales.text(value, "force", digits)


def _print_reasons(console: Any, audit: Audit) -> None:
    """Why formulas do not apply, or have no value: each reason once."""
    groups: dict[str, list[str]] = {}
    for row in audit.rows:
        lacking = [f"not given: {', '.join(row.missing)}"] if row.missing else []
        for reason in (*row.reasons, *lacking):
            groups.setdefault(reason, []).append(row.formula.name)
    if groups:
        console.print("\n[bold]Outside validity[/bold]")
    for reason, names in groups.items():
        _item(console, f"[italic]{_safe(reason)}[/italic]:", _safe("; ".join(names)))


def _item(console: Any, head: str, text: str) -> None:
    """A line, and what belongs to it, indented."""
    from rich.padding import Padding  # noqa: PLC0415

    console.print(Padding(head, (0, 0, 0, 2)))
    console.print(Padding(text, (0, 0, 0, 4)))


def _print_others(console: Any, audit: Audit) -> None:
    """Formulas of other kinds that have a value, at the first of the exact loads and at those that act."""
    bottom = _force(audit, audit.critical.at("bottom"))
    console.print(
        f"\n[bold]Other formulas[/bold], at the {audit.critical.label} ({bottom} of compression at the bottom)"
    )
    _print_values(console, audit, audit.others)
    for one in audit.applied:
        console.print(f"\n[bold]Other formulas[/bold], at the {_safe(one.exact.label)} ({_at_bottom(audit, one)})")
        _print_values(console, audit, [other for other in one.others if {"F", "p"} & set(other.formula.takes)])
    console.print("Small angle: error that a formula makes by taking the angle of the helix as small.", style="dim")
    needy = [other for other in audit.others if other.missing]
    if needy:
        console.print("\n[bold]Without a value[/bold]")
    for other in needy:
        console.print(f"  {_safe(other.formula.name)}: needs {', '.join(other.missing)}")


def _at_bottom(audit: Audit, one: AtApplied) -> str:
    """The compression at the bottom in a load that acts, and whether formulas of a buckled rod say anything of it."""
    force = one.exact.at("bottom")
    text = f"{_force(audit, abs(force))} of {'compression' if force > 0.0 else 'tension'} at the bottom"
    still = "is still straight" if audit.problem.hole is None else "still lies along the hole"
    return f"{text}; the exact rod {still} there" if one.straight else text


def _print_values(console: Any, audit: Audit, others: Sequence[Other]) -> None:
    from rodwell.report.reports.audit import other_value  # noqa: PLC0415

    rows = []
    for other in (one for one in others if one.value is not None):
        error = "" if other.relative_error is None else f"{signed(100 * other.relative_error, 2)} %"
        rows.append((_safe(other.formula.name), other_value(audit, other), error, "no" if other.reasons else "yes"))
    print_listing(console, ["formula", ">value", ">small angle", "valid"], rows)
