"""``rodwell endless``: the rod far from its ends, one load and one slope."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.endless_joints import show_joints
from rodwell.cli.keep import keep, keep_options, take_keep
from rodwell.cli.listing import print_listing, wrapped
from rodwell.cli.options import check_missed, json_option, print_json
from rodwell.quantities.text import amount, error_digit, number_text, plain

if TYPE_CHECKING:
    from rich.console import Console

    from rodwell.analysis.endless.endless import Endless
    from rodwell.analysis.endless.hysteresis import Stage
    from rodwell.quantities.value import Value
    from rodwell.report.folders.numbers import Numbers

UNITS = {
    "frequency": "1/ℓ",
    "amplitude": "rad",
    "energy": "qD",
    "contact_mean": "q",
    "contact_largest": "q",
    "contact_least": "q",
    "rate_largest": "rad/ℓ",
    "curvature_largest": "√(qD/B)",
    "stress_factor": "DP/(2B)",
    "shortening": "√(qD³/B)",
}
LOADS = {
    "buckling": "the straight rod buckles",
    "sinusoidal_lift_off": "the sinusoidal state lifts off, loading",
    "sinusoidal_ceases": "on paper its states end, loading",
    "helix_lift_off": "the helix lifts off, unloading",
    "helix_ceases": "on paper helices end, unloading",
    "sinusoidal_helix_equal_energy": "helix and sinusoidal state cost the same",
    "straight_helix_equal_energy": "helix and straight rod cost the same",
    "helix_largest": "largest load of a helix of this slope",
}
HEAD = "Endless rod kept on the wall; β = P/√(Bq/D), compression P positive; lengths in ℓ = ∜(BD/q)"


@click.command(short_help="The rod far from its ends: sinusoidal and helical states, one curve for all.")
@click.option(
    "--beta", type=float, help="Load β = P/√(Bq/D), compression positive.  [default: the loads of all states]"
)
@click.option("--slope", type=float, default=0.0, show_default=True, help="ε = ∜(qD³/B); 0 for small slopes.")
@click.option(
    "--joint",
    type=click.Path(exists=True, dir_okay=False),
    metavar="CASE.toml",
    help="A case of a string on equal tool joints: the critical load of an endless string of its joints.",
)
@keep_options("contact forces over β")
@json_option
def endless(beta: float | None, slope: float, joint: str | None, as_json: bool, **given: Any) -> None:
    """States of a rod far from its ends on the wall of a hole.

    P is compression, B the bending stiffness, D the distance of the axes, and q the normal load per length: lateral
    weight and the curvature of the hole together. With --beta the sinusoidal and the helical state at that load;
    without, the loads at which states begin, lift off and end. With --joint the critical load of an endless string of
    equal joints that lies on its tool joints.
    """
    from rodwell.analysis.endless.endless import endless as solve  # noqa: PLC0415
    from rodwell.errors import InputError  # noqa: PLC0415

    where = take_keep(given)
    if joint is not None:
        others = {"--beta": beta, "--slope": slope or None, "--figure": where.figure, "--out": where.out}
        for name, value in others.items():
            if value is not None:
                what = "does not go with --joint, which takes a case alone; --json writes its numbers"
                raise InputError(name, value, what)
        show_joints(joint, as_json)
        return
    try:
        result = solve(beta, slope)
    except InputError as error:
        raise InputError(f"--{error.field}", error.value, error.reason) from None
    if as_json:
        print_json(result.as_dict())
    else:
        _print(result)
    keep(where, lambda: _numbers(result), quiet=as_json)
    check_missed([] if result.converged else ["a number of the endless rod"], 1e-8)


def _numbers(result: Endless) -> Numbers:
    """States, or the loads of all states, as files; contact forces drawn."""
    from rodwell.plots.endless import plot_endless  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    rows: list[tuple[str, str, float, float, str]] = []
    for name, load in result.loads.named().items():
        if load is not None:
            rows.append(("load", LOADS[name], load.value, load.error, "√(Bq/D)"))
    for kind, state in result.states.items():
        for name, unit in UNITS.items():
            number: Value = getattr(state, name)
            rows.append((kind, name.replace("_", " "), number.value, number.error, unit))
    table = Table("endless", ("of", "number", "value", "error", "unit"), tuple(rows))
    return Numbers("endless", result.as_dict(), table, lambda axes: plot_endless(result, axes))


def _print(result: Endless) -> None:
    from rich.console import Console  # noqa: PLC0415

    console = Console(highlight=False)
    slope = "small slopes" if result.slope == 0.0 else f"slope ε = {plain(result.slope)}"
    wrapped(f"{HEAD}; {slope}.")
    click.echo()
    if result.beta is None:
        _print_loads(result, console)
        _print_history(result.history)
    else:
        _print_states(result, console)


def _print_loads(result: Endless, console: Console) -> None:
    rows = [
        (LOADS[name], *_cells(load)) if load is not None else (LOADS[name], "none", "")
        for name, load in result.loads.named().items()
        if load is not None or name != "helix_largest"
    ]
    print_listing(console, ("load", ">β", ">± error"), rows)


def _print_history(history: tuple[Stage, ...]) -> None:
    click.echo()
    for leg in ("loading", "unloading"):
        click.echo(f"{leg.capitalize()}:")
        for stage in history:
            if stage.leg == leg:
                wrapped(_stage_text(stage), "  ")
    wrapped(
        "Lift-off ends full contact. What a rod that has left the wall does next is not computed here; the jumps are "
        "those to the other state in full contact."
    )


def _stage_text(stage: Stage) -> str:
    first = "" if stage.first is None else f" from {amount(stage.first, 7)}"
    last = "" if stage.last is None else f" to {amount(stage.last, 7)}"
    ends = {"lift_off": ", where it lifts off", "ceases": ", where such states end"}.get(stage.ends_with, "")
    text = f"{stage.state}{first}{last}{ends}"
    if stage.jump is not None:
        n1, n2 = stage.jump.contact_mean
        text += (
            f" → {stage.jump.to}: mean contact force {amount(n1, 5)} q → {amount(n2, 5)} q, "
            f"{amount(stage.jump.energy_lost, 5)} qD per length less energy"
        )
    return text


def _print_states(result: Endless, console: Console) -> None:
    for kind in ("sinusoidal", "helical"):
        state = result.states.get(kind)
        if state is None:
            wrapped(f"No {kind} state: {result.reasons[kind]}.")
            click.echo()
            continue
        click.echo(f"{kind} state at β = {plain(state.beta, 10)}")
        rows = [(f"  {name.replace('_', ' ')}", *_cells(getattr(state, name)), unit) for name, unit in UNITS.items()]
        print_listing(console, ("  number", ">value", ">± error", "unit"), rows)
        told = state.stability
        stable = "stable" if told.stable else "unstable"
        wrapped(f"{stable} under dead load, kept on the wall: 48 wavelengths from two periods to a hundred.", "  ")
        if not state.in_contact:
            wrapped("On paper only: the wall would have to pull; a real rod has left it.", "  ")
        click.echo()


def _cells(number: Value) -> tuple[str, str]:
    return number_text(number), "exact" if number.error == 0.0 else error_digit(number.error)
