"""``rodwell liftoff``, ``rodwell sensitivity`` and ``rodwell twist``: quick answers to dimensionless questions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import (
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

UNIT = "B/L²"


@click.command()
@problem_options()
@click.option("--mode", default=1, show_default=True, help="Buckling mode, in the order of compression.")
@click.option("--mirror", is_flag=True, help="The other arm, ω₂(1) > 0: it differs with twist.")
@rtol_option
@json_option
def liftoff(mode: int, mirror: bool, rtol: float, as_json: bool, **given: Any) -> None:
    """Load at which the buckled rod lifts off the wall, and where.

    End force at s = 1 in B/L², tension positive; places as parts of the length from s = 0.
    """
    from rodwell.analysis.branch.follow import follow  # noqa: PLC0415
    from rodwell.analysis.branch.missed import missed  # noqa: PLC0415
    from rodwell.analysis.branch.symmetry import arms_differ  # noqa: PLC0415
    from rodwell.analysis.straight.critical import critical_loads  # noqa: PLC0415
    from rodwell.answers.words.steps import steps_data, steps_note  # noqa: PLC0415
    from rodwell.errors import NotConvergedError  # noqa: PLC0415
    from rodwell.problem.problem import ends_text  # noqa: PLC0415

    problem = make_problem(given)
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
    if as_json:
        print_json(
            {
                "critical_load": buckling.force,
                "critical_load_error": buckling.error,
                "lift_off": {"force": load.value, "error": load.error, "s": list(places)},
                "other_arm": _arm(other),
                "coincides_with_buckling": branch.lift_off_at_buckling,
                **({"steps": steps_data(lift.solution.step_loads)} if problem.sections else {}),
                "converged": not what,
                "unit": "B/L^2",
                "convention": "end force at s = 1, tension positive; " + ends_text(problem),
            }
        )
        check_missed(what, rtol)
        return
    click.echo(f"End force at s = 1 in {UNIT} (tension positive), {ends_text(problem)}:")
    click.echo(f"  buckling of mode {buckling.number}  {with_error(buckling.load)}")
    click.echo(f"  lift-off            {with_error(load)}{places_text(places)}")
    _print_arms(lift.load, other)
    if branch.lift_off_at_buckling:
        click.echo("Lift-off coincides with buckling: no lateral weight presses the rod to the wall.")
    note = steps_note(lift.solution.step_loads)
    if note:
        wrapped(note)
    if load != lift.load:
        wrapped("Twist makes the rod leave the wall inwards before it buckles like a rod that is kept on it.")
    if what:
        click.echo(f"Not every number meets the tolerance {plain(rtol)}.")
    check_missed(what, rtol)


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


@click.command(short_help="How loads change with weight, inclination, clearance, twist.")
@problem_options()
@click.option("--mode", default=1, show_default=True, help="Buckling mode, in the order of compression.")
@rtol_option
@json_option
def sensitivity(mode: int, rtol: float, as_json: bool, **given: Any) -> None:
    """How critical and lift-off load change with weight, inclination, clearance, stiffness and length.

    Exact derivatives, and elasticities: the change of the end force at s = 1 in percent for one percent more of an
    input, the others constant.
    """
    from rodwell.analysis.loads.sensitivity import sensitivities  # noqa: PLC0415
    from rodwell.problem.problem import ends_text  # noqa: PLC0415

    problem = make_problem(given)
    loads = sensitivities(problem, mode, rtol=rtol)
    missed = [load.name for load in loads if not load.converged]
    if as_json:
        convention = "end force F at s = 1 in B/L^2, tension positive; alpha in degrees; " + ends_text(problem)
        print_json({"loads": [load.as_dict() for load in loads], "convention": convention})
        check_missed(missed, rtol)
        return
    for load in loads:
        click.echo(
            f"{load.name}: F = {signed(load.force, 10)} {UNIT} at s = 1 (tension positive), {ends_text(problem)}"
        )
        for name, slope in load.derivatives.items():
            click.echo(f"  dF per {_PER[name]:<13} {with_error(slope)}")
        if load.force != 0.0:
            for name, change in load.elasticities().items():
                click.echo(f"  {_MORE[name]:<26} {signed(change.value, 6)} %")
        for number, section in enumerate(load.sections, 1):
            for name, slope in section.items():
                click.echo(f"  dF per {_OF_SECTION[name].format(number):<38} {with_error(slope)}")
        if load.note:
            click.echo(f"  {load.note}")
    check_missed(missed, rtol)


_PER = {"weight": "unit of γ", "alpha": "degree of α", "clearance": "unit of Δ/L", "twist": "B/L of T₁"}
_OF_SECTION = {
    "stiffness": "unit of the stiffness ratio, section {}",
    "weight": "unit of the weight ratio, section {}",
    "upper_end": "L that section {} is longer, the next shorter",
}
_MORE = {
    "weight_per_length": "1 % more weight per length",
    "clearance": "1 % more clearance Δ",
    "stiffness": "1 % more stiffness B",
    "length": "1 % more length L",
    "alpha": "1° more from the vertical",
}


@click.command(short_help="Which twist presses a rod at its lift-off load to the wall.")
@problem_options()
@click.option("--mode", default=1, show_default=True, help="Buckling mode, in the order of compression.")
@click.option("--mirror", is_flag=True, help="The other arm, ω₂(1) > 0.")
@click.option("--until", default=200.0, show_default=True, help="Largest |T₁| looked at, in B/L.")
@rtol_option
@json_option
def twist(mode: int, mirror: bool, until: float, rtol: float, as_json: bool, **given: Any) -> None:
    """Twist a rod held at its lift-off load: which sense presses it to the wall, and up to where.

    The rod is prepared without twist (leave --twist at 0), then T₁ grows either way at constant end force.
    """
    from rodwell.analysis.loads.torsion import torsion  # noqa: PLC0415
    from rodwell.problem.problem import ends_text  # noqa: PLC0415

    result = torsion(make_problem(given), mode, mirror=mirror, until=until, rtol=rtol)
    what = [] if result.prepared.solution.converged else ["the state at lift-off"]
    if result.branch is not None and result.again is not None and not result.branch.meets_tolerance(result.again):
        what.append("the twist at which it lifts off again")
    if as_json:
        print_json(result.as_dict())
        check_missed(what, rtol)
        return
    lift = result.prepared
    click.echo(f"End force at s = 1 in {UNIT} (tension positive), T₁ at s = 1 in B/L, {ends_text(result.problem)}:")
    click.echo(f"  prepared at lift-off of mode {mode}  F = {with_error(lift.load)}")
    for s, rate, error in zip(lift.s, result.rates, result.rate_errors, strict=True):
        click.echo(f"  at s/L = {plain(s, 6)}  dp/dT₁ = {with_error(Value(rate, error), 6)} 1/L²")
    click.echo(result.meaning)
    check_missed(what, rtol)
