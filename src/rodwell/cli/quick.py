"""``rodwell liftoff`` and ``rodwell twist``: quick answers to dimensionless questions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.keep import keep, keep_options, take_keep
from rodwell.cli.listing import wrapped
from rodwell.cli.lying_in_space import lift_off_in_space, only_first_mode
from rodwell.cli.options import (
    UNIT,
    check_missed,
    json_option,
    make_problem,
    places_text,
    print_json,
    problem_options,
    rtol_option,
)
from rodwell.quantities.text import plain, signed, with_error
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.analysis.branch.branch import Branch
    from rodwell.analysis.branch.special import SpecialPoint
    from rodwell.analysis.loads.torsion import Torsion
    from rodwell.report.folders.numbers import Numbers


@click.command()
@problem_options()
@click.option("--mode", default=1, show_default=True, help="Buckling mode, in the order of compression.")
@click.option("--mirror", is_flag=True, help="The other arm, ω₂(1) > 0: it differs with twist.")
@keep_options("the branch with its lift-off")
@rtol_option
@json_option
def liftoff(mode: int, mirror: bool, rtol: float, as_json: bool, **given: Any) -> None:
    """Load at which the buckled rod lifts off the wall, and where.

    End force at s = 1 in B/L², tension positive; places as parts of the length from s = 0. In a hole that leaves the
    vertical plane (--walk): of the rod as it lies, or buckled where it buckles before.
    """
    from rodwell.analysis.branch.follow import follow  # noqa: PLC0415
    from rodwell.analysis.branch.missed import missed  # noqa: PLC0415
    from rodwell.analysis.branch.symmetry import arms_differ  # noqa: PLC0415
    from rodwell.analysis.state.own_places import lift_off_with_own_places  # noqa: PLC0415
    from rodwell.analysis.straight.critical import critical_loads  # noqa: PLC0415
    from rodwell.answers.words.steps import steps_data  # noqa: PLC0415
    from rodwell.errors import NotConvergedError  # noqa: PLC0415
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    where, problem = take_keep(given), make_problem(given)
    if problem.in_space:
        only_first_mode(mode, mirror)
        lift_off_in_space(problem, rtol, where, as_json)
        return
    branch = follow(problem, mode, mirror=mirror, rtol=rtol)
    differ = branch.mode is not None and arms_differ(problem, branch.mode.parity)
    other = follow(problem, mode, mirror=not mirror, rtol=rtol) if differ else None
    lift, buckling = branch.lift_off, branch.mode
    assert buckling is not None
    if lift is None:
        raise NotConvergedError(
            f"mode {mode} was followed to F = {plain(float(branch.force[-1]), 6)} {UNIT} without lift-off "
            f"({branch.ending})"
        )
    places = () if branch.lift_off_at_buckling else lift.s
    load = lift.load
    if branch.lift_off_at_buckling and mode == 1:  # nothing presses the rod to the wall: it buckles where it first can
        met = critical_loads(problem, 1, rtol=rtol).first_met
        load = Value(met.force, met.error)
    what = [line for one in (branch, other) if one is not None for line in missed(one)]
    own = None if problem.hole is None else lift_off_with_own_places(problem, lift.solution.meshes, lift.solution.point)
    data = {
        "critical_load": buckling.force,
        "critical_load_error": buckling.error,
        "lift_off": {"force": load.value, "error": load.error, "s": list(places)},
        "other_arm": _arm(other),
        "coincides_with_buckling": branch.lift_off_at_buckling,
        **({"steps": steps_data(lift.solution.step_loads)} if problem.sections else {}),
        **({} if own is None else {"lift_off_own_places": own.as_dict()}),
        **({"axial_contact_error": lift.solution.axial_contact_error} if problem.ramps else {}),
        "converged": not what,
        "unit": "B/L^2",
        "convention": "end force at s = 1, tension positive; " + ends_text(problem),
    }
    if as_json:
        print_json(data)
    else:
        _print_liftoff(branch, other, lift, (load, own), tuple(places))
        if what:
            click.echo(f"Not every number meets the tolerance {plain(rtol)}.")
    keep(where, lambda: _liftoff_numbers(data, branch, other), quiet=as_json)
    check_missed(what, rtol)


def _print_liftoff(
    branch: Branch,
    other: Branch | None,
    lift: SpecialPoint,
    loads: tuple[Value, Value | None],
    places: tuple[float, ...],
) -> None:
    """The load with the wall's help, and of a curved hole that with every cross-section at its own place."""
    from rodwell.answers.words.steps import steps_note  # noqa: PLC0415
    from rodwell.answers.words.varying import push_note  # noqa: PLC0415
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    problem, buckling, (load, own) = branch.problem, branch.mode, loads
    assert buckling is not None
    wrapped(f"End force at s = 1 in {UNIT} (tension positive), {ends_text(problem)}:")
    click.echo(f"  buckling of mode {buckling.number}  {with_error(buckling.load)}")
    click.echo(f"  lift-off            {with_error(load)}{places_text(places)}")
    if own is not None:
        click.echo(f"  with own places     {with_error(own)}")
        wrapped(
            "The branch takes the hole where the undeformed rod is; the last load has every cross-section at its own."
        )
    _print_arms(lift.load, other)
    if branch.lift_off_at_buckling:
        wrapped("Lift-off coincides with buckling: no lateral weight presses the rod to the wall.")
    for note in (steps_note(lift.solution.step_loads, bent=problem.hole is not None), push_note(lift.solution)):
        if note:
            wrapped(note)
    if load != lift.load:
        wrapped("Twist makes the rod leave the wall inwards before it buckles like a rod that is kept on it.")


def _liftoff_numbers(data: dict[str, Any], branch: Branch, other: Branch | None) -> Numbers:
    """Buckling and lift-off as files, and the branches drawn."""
    from rodwell.analysis.straight.critical import CriticalLoads  # noqa: PLC0415
    from rodwell.plots.bifurcation import plot_bifurcation  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    lift = data["lift_off"]
    columns = ("event", "end force at s = 1, tension positive [B/L^2]", "error [B/L^2]", "places s/L")
    rows: list[tuple[str, float, float, str]] = [
        ("buckling", data["critical_load"], data["critical_load_error"], ""),
        ("lift-off", lift["force"], lift["error"], " ".join(repr(s) for s in lift["s"])),
    ]
    if other is not None and other.lift_off is not None:
        second = other.lift_off
        rows.append(("lift-off of the other arm", second.force, second.error, " ".join(repr(s) for s in second.s)))
    shown = [branch] if other is None else [branch, other]
    return Numbers(
        "liftoff",
        data,
        Table("liftoff", columns, tuple(rows)),
        lambda axes: plot_bifurcation(shown, CriticalLoads(), None, axes),
    )


def _arm(other: Branch | None) -> dict[str, Any] | None:
    """Lift-off of the other arm as plain data; None where it is the image of the first."""
    if other is None:
        return None
    lift, ended = other.lift_off, {"mirror": other.origin.mirror, "ended_because": other.ended_because}
    return ended if lift is None else {**ended, "force": lift.force, "error": lift.error, "s": list(lift.s)}


def _print_arms(lift: Value, other: Branch | None) -> None:
    """Lift-off of the other arm, and which of the two comes first."""
    if other is None:
        return
    if other.lift_off is None:
        wrapped(f"Twist makes the two arms of the mode differ; the other one has no lift-off ({other.ended_because}).")
        return
    second = other.lift_off
    click.echo(f"  on the other arm    {with_error(second.load)}{places_text(second.s)}")
    first = max(lift.value, second.force)
    wrapped(
        "Twist makes the two arms of the mode differ, and the rod may take either: the one that lifts off first, at "
        f"{signed(first, 10)}, counts."
    )


@click.command(short_help="Which twist presses a rod at its lift-off load to the wall.")
@problem_options()
@click.option("--mode", default=1, show_default=True, help="Buckling mode, in the order of compression.")
@click.option("--mirror", is_flag=True, help="The other arm, ω₂(1) > 0.")
@click.option("--until", default=200.0, show_default=True, help="Largest |T₁| looked at, in B/L.")
@keep_options("the contact pressure along the rod, twisted and not,")
@rtol_option
@json_option
def twist(mode: int, mirror: bool, until: float, rtol: float, as_json: bool, **given: Any) -> None:
    """Twist a rod held at its lift-off load: which sense presses it to the wall, and up to where.

    The rod is prepared without twist (leave --twist at 0), then T₁ grows either way at constant end force.
    """
    from rodwell.analysis.loads.torsion import torsion  # noqa: PLC0415

    where = take_keep(given)
    result = torsion(make_problem(given), mode, mirror=mirror, until=until, rtol=rtol)
    what = [] if result.prepared.solution.converged else ["the state at lift-off"]
    if result.branch is not None and result.again is not None and not result.branch.meets_tolerance(result.again):
        what.append("the twist at which it lifts off again")
    if as_json:
        print_json(result.as_dict())
    else:
        _print_twist(result, mode)
    keep(where, lambda: _twist_numbers(result), quiet=as_json)
    check_missed(what, rtol)


def _print_twist(result: Torsion, mode: int) -> None:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    lift = result.prepared
    wrapped(f"End force at s = 1 in {UNIT} (tension positive), T₁ at s = 1 in B/L, {ends_text(result.problem)}:")
    click.echo(f"  prepared at lift-off of mode {mode}  F = {with_error(lift.load)}")
    for s, rate, error in zip(lift.s, result.rates, result.rate_errors, strict=True):
        click.echo(f"  at s/L = {plain(s, 6)}  dp/dT₁ = {with_error(Value(rate, error), 6)} 1/L²")
    wrapped(result.meaning)


def _twist_numbers(result: Torsion) -> Numbers:
    """Rates of the contact pressure as files, the pressure drawn."""
    from rodwell.plots.loads.twisting import plot_torsion  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    columns = ("place s/L", "dp/dT1 [1/L^2]", "error [1/L^2]")
    rows = tuple(zip(result.prepared.s, result.rates, result.rate_errors, strict=True))
    return Numbers("twist", result.as_dict(), Table("twist", columns, rows), lambda axes: plot_torsion(result, axes))
