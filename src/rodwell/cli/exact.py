"""``rodwell certify`` and ``rodwell modes``: loads with proof, and which mode comes first."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.keep import Keep, keep, keep_options, take_keep
from rodwell.cli.listing import wrapped
from rodwell.cli.options import UNIT, json_option, make_problem, print_json, problem_options
from rodwell.errors import InputError
from rodwell.quantities.text import minus, plain, separated, with_error
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.analysis.proof.certify import CertifiedLoads
    from rodwell.analysis.proof.enclosures import Enclosure
    from rodwell.analysis.straight.modes import ModePair
    from rodwell.physics.exact.horizontal import Switching
    from rodwell.report.folders.numbers import Numbers


@click.command(short_help="Critical loads with proof, to 30 digits.")
@problem_options(required=False)
@click.option("--modes", type=int, help="How many critical loads of one problem.  [default: 5]")
@click.option("--digits", default=30, show_default=True, help="Decimal digits.")
@keep_options(figure=False)
@json_option
def certify(modes: int | None, digits: int, as_json: bool, **given: Any) -> None:
    """Critical loads with proof that they are right and that none is skipped.

    Without --weight: every load that the paper gives by a closed form, beside what it prints. With --weight: the
    critical loads of one problem, for any inclination and ends. End force at s = 1 in B/L², tension positive.
    """
    where = take_keep(given)
    if given["weight"] is None:
        context = click.get_current_context()
        stray = [name for name in (*given, "modes") if name in context.params and _was_given(context, name)]
        if stray:
            raise InputError("weight", None, f"is needed with --{stray[0].replace('_', '-')}")
        _paper(digits, as_json, where)
        return
    from rodwell.analysis.proof.certify import certify as certified  # noqa: PLC0415

    problem = make_problem(given)
    loads = certified(problem, 5 if modes is None else modes, digits=digits)
    if as_json:
        print_json(loads.as_dict())
    else:
        _print_certified(loads)
    keep(where, lambda: _data_only("certify", loads.as_dict()), quiet=as_json)


def _print_certified(loads: CertifiedLoads) -> None:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    problem = loads[0].problem
    wrapped(f"Certified critical end force at s = 1 in {UNIT} (tension positive), {ends_text(problem)}:")
    for load in loads:
        value = _enclosed(load.force, loads.shown)
        closed = f"; {load.closed_form} changes sign" if load.closed_form else ""
        several = "" if load.multiplicity == 1 else f"; {load.multiplicity} loads agree to these digits"
        click.echo(f"  mode {load.number:>2}  {value}   {load.number - 1} above{several}{closed}")
    given = "Weight, angle and clearance" if problem.hole is None else "Clearance and build"
    wrapped(
        "Proved for each: that it exists, that no other load lies within its bounds, and how many lie above it. "
        f"{given} are taken as the decimals given."
    )


def _enclosed(found: Enclosure, digits: int) -> str:
    """A number with the bound of its error."""
    value, radius = found.text(digits)
    return f"{separated(minus(value))} ± {plain(float(radius), 2)}"


def _was_given(context: click.Context, name: str) -> bool:
    """Whether an option was on the command line."""
    return context.get_parameter_source(name) is not click.core.ParameterSource.DEFAULT


def _data_only(name: str, data: dict[str, Any]) -> Numbers:
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    return Numbers(name, data)


def _paper(digits: int, as_json: bool, where: Keep) -> None:
    """Print the paper's closed-form values."""
    from rodwell.analysis.proof.paper_values import paper_values  # noqa: PLC0415

    values = paper_values(digits)
    data = {"values": [value.as_dict(digits) for value in values], "clearance": 0.01}
    keep(where, lambda: _data_only("certify", data), quiet=as_json)
    if as_json:
        print_json(data)
        return
    wrapped("Closed-form values of the paper, enclosed; B = L = 1, Δ/L = 0.01, γ = mg L³/B, F at s = 1:")
    for value in values:
        verdict = "as printed" if value.agrees else "NOT as printed"
        click.echo(f"  {value.equation}: {value.quantity}")
        enclosed = _enclosed(value.value, digits)
        click.echo(f"    {enclosed}   printed {minus(str(value.printed))}: {verdict}   [{value.proof}]")
    wrong = sum(not value.agrees for value in values)
    click.echo(f"{len(values)} values, {len(values) - wrong} of them as printed.")


@click.command(short_help="Which mode of a horizontal rod is first; where modes switch.")
@click.option("--weight", type=float, help="γ = mg L³/B, weight of the rod.")
@click.option("--clearance", default=0.01, show_default=True, help="Δ/L, distance between the axes.")
@click.option("--pairs", default=1, show_default=True, help="How many pairs of modes.")
@click.option("--table", type=int, metavar="M", help="Table 1 of the paper, up to this m.")
@keep_options("the loads over the weight")
@json_option
def modes(weight: float | None, clearance: float, pairs: int, table: int | None, as_json: bool, **given: Any) -> None:
    """Which buckling mode of a horizontal rod comes first, and at which weights modes switch.

    Both ends clamped, rod at the bottom. Closed forms: no mesh.
    """
    from rodwell.analysis.straight.modes import mode_pairs, switching_table  # noqa: PLC0415

    if weight is None and table is None:
        raise InputError("weight", None, "is needed, or --table")
    where = take_keep(given)
    if weight is None and where.figure is not None:
        raise InputError("--figure", str(where.figure), "draws the loads over the weight: give --weight, too")
    found = [] if weight is None else mode_pairs(weight, clearance, pairs=pairs)
    rows = [] if table is None else switching_table(table, clearance)
    data: dict[str, Any] = {"unit": "B/L^2", "clearance": clearance}
    data["convention"] = "end force at s = 1, tension positive; both ends clamped"
    if weight is not None:
        data |= {"weight": weight, "pairs": [pair.as_dict() for pair in found]}
    if table is not None:
        data["table"] = [row._asdict() for row in rows]
    if as_json:
        print_json(data)
    else:
        _print_modes(weight, clearance, found, rows)
    keep(where, lambda: _numbers(data, found, rows, weight), quiet=as_json)


def _print_modes(weight: float | None, clearance: float, found: list[ModePair], rows: list[Switching]) -> None:
    if found:
        wrapped(
            f"Horizontal rod, γ = {plain(weight or 0.0, 10)}, Δ/L = {plain(clearance, 10)}, both ends clamped; "
            f"F at s = 1 in {UNIT}:"
        )
    for pair in found:
        _print_pair(pair)
    if rows:
        table = rows[-1].m
        wrapped(f"Weights at which modes switch, m ≤ {table}, Δ/L = {plain(clearance, 10)}; both loads are F_c:")
        click.echo("    n    m          γ_c          F_c   modes")
        for row in rows:
            both = f"{2 * row.pair - 1}, {2 * row.pair}"
            click.echo(f"  {row.n:>3}  {row.m:>3}  {row.weight:>11.4f}  {minus(f'{row.force:+.4f}'):>11}   {both}")


def _numbers(data: dict[str, Any], found: list[ModePair], rows: list[Switching], weight: float | None) -> Numbers:
    """Pairs and switchings as files; the loads drawn over the weight, where one was given."""
    from rodwell.plots.loads.switching import plot_pairs  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    columns = ("what", "modes", "symmetry", "weight", "end force at s = 1, tension positive [B/L^2]")
    lines: list[tuple[str, str, str, float | None, float]] = [
        ("critical load", f"{2 * pair.pair - 1 + i}", "even" if parity == 1 else "odd", weight, force)
        for pair in found
        for i, (parity, force) in enumerate(zip(pair.parities, pair.forces, strict=True))
    ]
    lines += [("switching", f"{2 * row.pair - 1}, {2 * row.pair}", "", row.weight, row.force) for row in rows]
    draw = None if weight is None else (lambda axes: plot_pairs(found, weight, data["clearance"], axes))
    return Numbers("modes", data, Table("modes", columns, tuple(lines)), draw)


def _print_pair(pair: ModePair) -> None:
    """One pair of modes, with the weights at which it switches."""
    for number, parity, force in zip((2 * pair.pair - 1, 2 * pair.pair), pair.parities, pair.forces, strict=True):
        click.echo(
            f"  mode {number:>2}  {with_error(Value(force, pair.error), 12)}   {'even' if parity == 1 else 'odd'}"
        )
    times = {0: "has not switched", 1: "switched once", 2: "switched twice"}
    text = f"{times.get(pair.switched, f'switched {pair.switched} times')} below this weight"
    for name, place in (("last", pair.before), ("next", pair.after)):
        if place is not None:
            text += f"; {name} at γ = {plain(place.weight, 10)} (n = {place.n}, m = {place.m})"
    wrapped(text, "    ")
