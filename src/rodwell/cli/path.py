"""``rodwell path``: what happens to a rod in its hole as the load grows, and comes back."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from rodwell.cli.listing import wrapped
from rodwell.cli.options import (
    PARAMETERS,
    OutPath,
    check_missed,
    force_at,
    json_option,
    make_problem,
    print_json,
    print_written,
    problem_options,
    progress_bar,
    rtol_option,
)
from rodwell.errors import InputError
from rodwell.quantities.text import amount, error_digit, plain, signed, with_error

if TYPE_CHECKING:
    from rodwell.analysis.off_wall.state import ContactState
    from rodwell.analysis.path.events import PathState
    from rodwell.analysis.path.load_path import LoadPath
    from rodwell.case.case import Case
    from rodwell.errors import RodwellError
    from rodwell.problem.problem import Problem
    from rodwell.quantities.value import Value

UNIT = "B/L²"

WHERE = {
    "point": "at a point of contact", "end": "at the end of a stretch in contact",
    "edge": "at the edge of a narrower part of the hole", "tip": "at the loose end",
}  # fmt: skip
"""Where a point force acts, in words."""


@click.command(short_help="The load path off the wall: lift-off, partial contact, snap, helix, and back.")
@click.argument("case", type=click.Path(path_type=Path), required=False)
@problem_options(required=False)
@click.option(
    "--until",
    help='End force at s = 1 (tension positive) to load the rod to; of a CASE with its unit, "-130 kN".  [default: of '
    "a CASE to and back from where `rodwell run` goes; where the clearance has steps, until the rod buckles]",
)
@click.option("--unload-to", help="End force to unload it to afterwards.")
@click.option("--at", help="End forces, separated by commas, at which states are shown.")
@click.option(
    "--barrier",
    help="End forces at which it is told how large a disturbance snaps the rod before it must: the energy of the "
    "saddle in between, and the turn of mid-length about the hole's axis. Takes up to a minute each.",
)
@click.option(
    "--control",
    type=click.Choice(["force", "shortening"]),
    default="force",
    show_default=True,
    help="What is controlled; with shortening, --until, --unload-to and --at are shortenings in L.",
)
@click.option("--axial-stiffness", type=float, help="EA of the rod in B/L², with --control shortening; else rigid.")
@click.option("--spring", type=float, help="Stiffness in B/L³ of a spring that drives it, with --control shortening.")
@click.option(
    "--wall-stiffness", type=float,
    help="Stiffness k L⁴/B of a wall that gives way, push per length and depth.  [default: that of CASE, or hard]",
)  # fmt: skip
@click.option("--mirror", is_flag=True, help="The other arm of the buckling mode: it differs with twist.")
@click.option("--seeds", default=3, show_default=True, help="Random disturbances tried, either way, at each snap.")
@click.option("--out", type=OutPath(), help="Folder for a figure of the path, load against shortening.")
@rtol_option
@json_option
def path(
    case: Path | None,
    until: str | None,
    unload_to: str | None,
    at: str | None,
    barrier: str | None,
    control: str,
    axial_stiffness: float | None,
    spring: float | None,
    wall_stiffness: float | None,
    mirror: bool,
    seeds: int,
    out: Path | None,
    rtol: float,
    as_json: bool,
    **given: Any,
) -> None:
    """What happens to a rod, or that of CASE, a TOML file, as the load grows quasi-statically, and comes back.

    Buckling, lift-off, gaps, points of contact, loss of stability, where the rod snaps to, the helix, and the way
    back. The rod may leave the wall; frictionless and without inertia. End force at s = 1 in B/L², tension positive;
    places in parts of the length, gaps in parts of the clearance.
    """
    from rodwell.analysis.path.follow import load_path  # noqa: PLC0415

    read = _case(case)
    problem, rtol = (make_problem(given), rtol) if read is None else (read.problem, _tolerance(read, rtol))
    begin, back = _range(problem, read, until, unload_to, control)
    forces, barriers = _numbers("--at", at, read, control), _numbers("--barrier", barrier, read, control)
    if wall_stiffness is None:
        wall_stiffness = math.inf if read is None else read.wall_stiffness
    if out is not None:
        from rodwell.store.folder import check_writable  # noqa: PLC0415

        check_writable(out)
    span = abs(-100.0 if begin is None else begin) + 1e-12

    with progress_bar(not as_json, "buckling") as tell:
        result = load_path(
            problem, until=begin, unload_to=back, control=control, axial_stiffness=axial_stiffness, spring=spring,
            wall_stiffness=wall_stiffness, mirror=mirror, seeds=seeds, rtol=rtol,
            progress=lambda leg, force: tell(f"{leg}, F = {force:.4g}", min(abs(force) / span, 1.0)),
        )  # fmt: skip
    if out is not None:
        from rodwell.report.folders.path import write_path  # noqa: PLC0415

        write_path(result, out, forces, read, barriers)
    if as_json:
        from rodwell.problem.problem import ends_text  # noqa: PLC0415

        convention = "end force F at s = 1, tension positive; places in L, gaps in clearances; "
        print_json(
            {
                **result.as_dict(forces, barriers),
                "converged": not result.missed,
                "unit": "B/L^2",
                **({} if read is None or read.scales is None else {"unit_N": read.scales.factor("force")}),
                "convention": convention + ends_text(problem),
            }
        )
    else:
        _print(result)
        if read is not None and read.scales is not None:
            click.echo(f"1 B/L² is {read.scales.text(1.0, 'force', 6)}, L {read.scales.text(1.0, 'length', 6)}.")
        for force in forces:
            _print_states(result, force)
        for force in barriers:
            _print_barrier(result, force, read)
        if out is not None:
            print_written(out)
    check_missed(result.missed, rtol)


def _case(path: Path | None) -> Case | None:
    """The case, if one is given; else weight and inclination must be, and beside one no option of a problem."""
    given = click.get_current_context().get_parameter_source
    written = [name for name in PARAMETERS if given(name) == ParameterSource.COMMANDLINE]
    if path is None:
        for name in ("weight", "alpha"):
            if name not in written:
                raise click.UsageError(f"Missing option '--{name}' (or a case file).")
        return None
    if written:
        key = f"--{written[0].replace('_', '-')}"
        raise InputError(key, None, "belongs to a problem without a case: leave it out, or the case")
    from rodwell.case.case import Case  # noqa: PLC0415

    return Case.read(path)


def _tolerance(case: Case, rtol: float) -> float:
    """The tolerance of the case, unless another is asked for."""
    source = click.get_current_context().get_parameter_source("rtol")
    return rtol if source == ParameterSource.COMMANDLINE else case.rtol


def _range(
    problem: Problem, case: Case | None, until: str | None, back: str | None, control: str
) -> tuple[float | None, float | None]:
    """Where the path goes, and comes back to: as asked, or, of a case, as its report goes; None: until it buckles."""
    if until is not None or problem.bridges:
        far = None if until is None else _number("--until", until, case, control)
        return far, None if back is None else _number("--unload-to", back, case, control)
    if case is None or control != "force":
        raise click.UsageError("Missing option '--until'.")
    from rodwell.answers.result.beyond import reach  # noqa: PLC0415
    from rodwell.answers.result.computed import compute  # noqa: PLC0415

    computed = compute(case)
    if computed.lift_off is None:
        raise InputError("--until", None, "must be given: no lift-off was found from which it could be chosen")
    far, start = reach(computed)
    return far, start if back is None else _number("--unload-to", back, case, control)


def _number(option: str, text: str, case: Case | None, control: str) -> float:
    """An end force in B/L², with its unit in a case with dimensions; or a shortening in L."""
    if case is not None and control == "force":
        return force_at(text, case, option=option)
    try:
        return float(text)
    except ValueError:
        raise InputError(option, text, "must be end forces in B/L² (or shortenings in L), plain numbers") from None


def _numbers(option: str, text: str | None, case: Case | None, control: str) -> list[float]:
    """Such numbers, separated by commas."""
    numbers = [] if text is None else [_number(option, part, case, control) for part in text.split(",")]
    if not all(map(math.isfinite, numbers)):
        raise InputError(option, text, "must be finite numbers, separated by commas")
    return numbers


def _print_states(result: LoadPath, force: float) -> None:
    """The states at an end force, or why there is none: that ends nothing."""
    from rodwell.errors import RodwellError  # noqa: PLC0415

    try:
        for state in result.at(force):
            _print_state(state)
    except RodwellError as error:
        _print_why(f"{result.control} {plain(force, 6)}: not reached", error)


def _print_why(what: str, error: RodwellError) -> None:
    """What is not there, and why."""
    click.echo("")
    wrapped(f"{what}; {error.reason if isinstance(error, InputError) else error}")


def _print_barrier(result: LoadPath, force: float, case: Case | None) -> None:
    """The barrier at an end force, or why there is none: that ends nothing."""
    from rodwell.errors import RodwellError  # noqa: PLC0415

    try:
        found = result.barrier(force)
    except RodwellError as error:
        _print_why(f"{result.control} {plain(force, 6)}: no barrier told", error)
        return
    turn, why = found.turn_or_why()
    scales = None if case is None else case.scales
    work = "" if scales is None else f" ({scales.amount(found.height, 'energy')})"
    far = "half a turn" if turn is None else f"more than {plain(turn.value, 3)} rad (± {plain(turn.error, 1)})"
    then = "comes back" if turn is None else "snaps there"
    turned = f"Turned at mid-length by {far} about the hole's axis and let go, in something viscous, the rod {then}."
    if why:
        turned = f"By how much the rod must be turned at mid-length to snap there is not told: {why}."
    click.echo("")
    wrapped(
        f"Barrier at F = {signed(found.state.force, 10)}, {found.leg}: the saddle between this state and "
        f"{found.to.meaning} lies {amount(found.height, 9)} B/L{work} higher. {turned} The saddle, unstable:"
    )
    print_contacts(found.saddle)


def _print(result: LoadPath) -> None:
    """Events as a list."""
    from rodwell.problem.problem import ends_text  # noqa: PLC0415

    click.echo(
        f"End force at s = 1 in {UNIT} (tension positive), {ends_text(result.problem)}; the {result.way.held} is"
    )
    click.echo(f"controlled. {result.assumptions[0].upper()}{result.assumptions[1:]}.")
    leg = ""
    for event in result.events:
        if event.leg != leg:
            leg = event.leg
            click.echo(f"{leg}:")
        where = _places(event.s)
        driven = result.driven(event)
        at = "" if driven is None else f", {result.way.held} {amount(driven, 9)} L"
        click.echo(f"  {with_error(event.force)}  {event.meaning}{where}{at}")
        if event.to is not None:
            energy = f"energy {_signed(event.to.energy, 9)} B/L relative to the straight rod"
            energy += "" if driven is None else f", F = {_signed(event.to.force, 10)}"
            click.echo(f"      {energy}; {event.to.agree} of {event.to.starts} disturbed starts end there")
    symbol = "F" if result.way.by_force else result.way.held
    if result.reached:
        click.echo(f"Followed to {symbol} = {plain(result.until, 6)}" + (
            "." if result.unload_to is None else f" and back to {plain(result.unload_to, 6)}."
        ))  # fmt: skip
    else:
        wrapped(f"Not followed to the end: {result.ended_because}.")
    if result.problem.twist != 0.0:
        arm = "without" if result.mirror else "with"
        wrapped(f"Twist makes the two arms of the buckling mode differ: the other one is followed {arm} --mirror.")


def _places(s: tuple[float, ...]) -> str:
    return "" if not s else ", s/L = " + ", ".join(plain(place, 5) for place in s)


def _place(s: Value) -> str:
    """A place s/L in six decimals, as in the column of a table, or as many as are known."""
    return plain(round(s.value, 6), 6).ljust(8)


def _signed(number: Value, digits: int) -> str:
    """A number with its sign, in the digits that its error allows."""
    return ("+" if number.value > 0.0 else "") + amount(number, digits)


def _print_state(shown: PathState) -> None:
    state = shown.state
    index = shown.stability_index
    held = "" if shown.control.by_force else f" where the {shown.control.held} is held"
    stable = f"stable{held}" if index == 0 else f"unstable{held}, index {index}"
    click.echo(f"\nF = {signed(state.force, 10)}, {shown.leg}: {state.kind}, {stable}")
    click.echo(f"  energy {with_error(state.energy, 9)} B/L, shortening {amount(state.shortening, 9)} L")
    print_contacts(state)
    check = state.certificate
    passed = f"{'passed' if check.passed else 'NOT passed'}, {error_digit(check.worst)}"
    click.echo(f"  all contact forces {amount(state.contact_total, 7)} {UNIT}; certificate {passed}")


def print_contacts(state: ContactState) -> None:
    """Gaps, stretches in contact and point forces of a state, a line each."""
    for gap in state.gaps:
        size = f"{amount(gap.largest, 6)} Δ at s/L = {plain(gap.at, 5)}"
        click.echo(f"  gap      {_place(gap.start)} to {_place(gap.end)}   {size}")
    for contact in state.contacts:
        force = f"{amount(contact.force, 6)} {UNIT}"
        click.echo(f"  contact  {_place(contact.start)} to {_place(contact.end)}   {force} spread along it")
    for point in state.point_forces:
        what = WHERE[point.kind]
        click.echo(f"  force    {_place(point.s)}              {amount(point.force, 6)} {UNIT} {what}")
