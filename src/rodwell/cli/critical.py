"""``rodwell critical``: critical loads of the straight rod, with the wall's help and without."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.critical_bridged import bridged_numbers, show_bridged
from rodwell.cli.critical_in_hole import lying_numbers, show_lying, unheld_load
from rodwell.cli.critical_varying import show_varying, varying_numbers
from rodwell.cli.keep import keep, keep_options, take_keep
from rodwell.cli.listing import wrapped
from rodwell.cli.lying_in_space import critical_in_space
from rodwell.cli.options import UNIT, check_missed, json_option, make_problem, print_json, problem_options, rtol_option
from rodwell.quantities.text import error_digit, plain, with_error
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.analysis.straight.critical import CriticalLoads
    from rodwell.analysis.straight.without_wall import LoadsWithoutWall, SpatialMode
    from rodwell.problem.problem import Problem
    from rodwell.report.folders.numbers import Numbers


@click.command()
@problem_options()
@click.option("--modes", default=5, show_default=True, help="How many critical loads.")
@keep_options("the modes")
@rtol_option
@json_option
def critical(modes: int, rtol: float, as_json: bool, **given: Any) -> None:
    """Critical loads of the straight rod.

    End force at s = 1 in B/L², tension positive, in the order in which they are met as compression grows: with the
    wall's help, and without. Twist does not enter as long as lateral weight presses the rod to the wall; where nothing
    does, and without the wall's help, it makes the rod buckle earlier. In a curved hole (--build): loads of both signs,
    and where the wall would have to pull the rod that lies along it. In one that leaves the vertical plane (--walk) the
    rod moves with the load: between which forces it lies on the wall, stable, and what ends that. Where --sections have
    several clearances: the first load at which the string that bridges their steps buckles sideways; where the
    clearance goes over smoothly (a~b): loads of the rod that lies on the wall, as long as that presses it everywhere.
    """
    from rodwell.analysis.straight.critical import critical_loads, tensile_loads  # noqa: PLC0415
    from rodwell.analysis.straight.without_wall import loads_without_wall  # noqa: PLC0415

    where, problem = take_keep(given), make_problem(given)
    if problem.bridges:
        from rodwell.analysis.path.follow import first_buckling  # noqa: PLC0415

        path = first_buckling(problem, rtol)
        keep(where, lambda: bridged_numbers(path), quiet=as_json)
        show_bridged(path, rtol, as_json)
        return
    if problem.ramps:
        varying = critical_loads(problem, modes, rtol=rtol)
        keep(where, lambda: varying_numbers(varying), quiet=as_json)
        show_varying(varying, modes, as_json)
        return
    if problem.in_space:
        critical_in_space(problem, rtol, where, as_json)
        return
    loads = critical_loads(problem, modes, rtol=rtol)
    if problem.hole is not None:
        tensile = tensile_loads(problem, modes, rtol=rtol)
        unheld = unheld_load(problem, rtol)
        show_lying(loads, tensile, unheld, as_json)
        keep(where, lambda: lying_numbers(loads, tensile, unheld), quiet=as_json)
        return
    free = loads_without_wall(problem, rtol=rtol)
    if as_json:
        print_json(_data(loads, free))
    elif _untouched(problem):
        _print_untouched(loads, free)
    else:
        _print_pressed(loads, free)
    keep(where, lambda: _numbers(loads, free), quiet=as_json)
    if _untouched(problem):
        touch = free.at_wall
        known = touch is None or touch.error <= rtol * (abs(touch.force) + free.scale)
        check_missed(
            [] if known or touch is None else [f"load with the wall's help ± {error_digit(touch.error)}"], rtol
        )


def _numbers(loads: CriticalLoads, free: LoadsWithoutWall) -> Numbers:
    """Loads as files: the same data as on the terminal, a row for each load, and the modes drawn."""
    from rodwell.plots.profiles import plot_modes  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    columns = ("kind", "mode", "end force at s = 1, tension positive [B/L^2]", "error [B/L^2]")
    rows = [("kept on the wall", mode.number, mode.force, mode.error) for mode in loads]
    rows += [("without the wall's help", n, mode.force, mode.error) for n, mode in enumerate(free.modes, 1)]
    if free.at_wall is not None:
        rows.append(("with the wall's help", 1, free.at_wall.force, free.at_wall.error))
    table = Table("critical", columns, tuple(rows))
    return Numbers("critical", _data(loads, free), table, lambda axes: plot_modes(loads, ax=axes))


def _untouched(problem: Problem) -> bool:
    """Whether twist counts, since nothing presses the rod to the wall."""
    return problem.twist != 0.0 and problem.untouched


def _data(loads: CriticalLoads, free: LoadsWithoutWall) -> dict[str, Any]:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    problem, kept = free.problem, (loads.forces, loads.errors)
    data: dict[str, Any] = {}
    if _untouched(problem):
        touch = free.at_wall
        assert touch is not None
        data = {
            "critical_loads": [touch.force],
            "error": [touch.error],
            "moves_inward": touch.moves_inward,
            "contacts": [list(contact) for contact in touch.contacts],
            "kept_on_wall": {"loads": [float(f) for f in kept[0]], "error": [float(e) for e in kept[1]]},
        }
    else:
        data = {"critical_loads": [float(f) for f in kept[0]], "error": [float(e) for e in kept[1]]}
    return {
        **data,
        "tensile_loads": [],
        "without_wall": {"loads": [float(f) for f in free.forces], "error": [float(e) for e in free.errors]},
        "unit": "B/L^2",
        "convention": "end force at s = 1, tension positive; " + ends_text(problem),
    }


def _print_pressed(loads: CriticalLoads, free: LoadsWithoutWall) -> None:
    """Loads of a rod that weight presses to the wall, that weight would pull off it, or that no twist moves off it."""
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    problem, alone = free.problem, free.modes[0]
    if problem.twist != 0.0:
        wrapped(
            f"Twist does not enter while weight keeps the rod on the wall. Without the wall's help it does: the rod "
            f"would buckle at {plain(alone.force, 6)} {UNIT}."
        )
    if problem.lateral_weight > 0.0 and not problem.pressed:
        wrapped("Weight pulls this rod off the wall: the loads below are those of a rod that is kept on it.")
    wrapped(f"Critical end force at s = 1 in {UNIT} (tension positive), {ends_text(problem)}:")
    for mode in loads:
        symmetry = {1: "even", -1: "odd", 0: "no symmetry"}[mode.parity]
        number = "0   the rod turns as a rigid body" if mode.rigid else f"{with_error(mode.load)}"
        click.echo(f"  mode {mode.number:>2}  {number}   {symmetry}")
    click.echo(_line("without the wall's help", alone))
    first = loads[0]
    if first.rigid:
        click.echo("Any compression turns the straight rod as a rigid body.")
    elif first.force > 0.0:
        click.echo(
            f"The rod buckles under its own weight unless it is held in tension of {plain(first.force, 6)} {UNIT}."
        )
    else:
        wrapped(f"The straight rod is stable up to a compression of {plain(-first.force, 6)} {UNIT} at s = 1.")


def _print_untouched(loads: CriticalLoads, free: LoadsWithoutWall) -> None:
    """Loads of a twisted rod that lies at the wall without being pressed to it."""
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    problem, touch = free.problem, free.at_wall
    assert touch is not None
    at = "without any end force" if abs(touch.force) <= touch.error else f"at {plain(touch.force, 6)} {UNIT}"
    wrapped(
        f"Nothing presses this rod to the wall, so twist counts: the rod buckles {at}, not at "
        f"{plain(loads[0].force, 6)} like a rod that is kept on the wall."
    )
    wrapped(f"Critical end force at s = 1 in {UNIT} (tension positive), {ends_text(problem)}:")
    click.echo(_line("with the wall's help", touch))
    click.echo(_line("without the wall's help", free.modes[0]))
    for mode in loads:
        click.echo(f"  kept on the wall, mode {mode.number:>2}  {with_error(mode.load)}")
    if touch.moves_inward:
        click.echo("The mode moves inwards only: the wall does not help.")
    else:
        places = ", ".join(plain(a, 3) if a == b else f"{plain(a, 3)} to {plain(b, 3)}" for a, b in touch.contacts)
        wrapped(f"The mode needs the wall, at s/L = {places}.")
    if abs(touch.force) <= touch.error:
        click.echo("The straight rod bears no compression.")
    elif touch.force > 0.0:
        wrapped(f"The rod buckles unless it is held in tension of {plain(touch.force, 6)} {UNIT}.")
    else:
        wrapped(f"The straight rod is stable up to a compression of {plain(-touch.force, 6)} {UNIT} at s = 1.")


def _line(name: str, mode: SpatialMode) -> str:
    if mode.rigid:
        return f"  {name}  0   the rod moves as a rigid body"
    return f"  {name:<24}  {with_error(Value(mode.force, mode.error))}"
