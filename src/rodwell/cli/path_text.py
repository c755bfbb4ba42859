"""What ``rodwell path`` says: events, states, and barriers in words."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import UNIT
from rodwell.errors import InputError
from rodwell.problem.words import floats_in_part
from rodwell.quantities.text import amount, error_digit, plain, signed, with_error

if TYPE_CHECKING:
    from rodwell.analysis.off_wall.state import ContactState
    from rodwell.analysis.path.events import PathState
    from rodwell.analysis.path.load_path import LoadPath
    from rodwell.case.case import Case
    from rodwell.errors import RodwellError
    from rodwell.quantities.value import Value


WHERE = {
    "point": "at a point of contact", "end": "at the end of a stretch in contact",
    "edge": "at the edge of a narrower part of the hole", "tip": "at the loose end",
    "kink": "at a kink of the stiffness",
}  # fmt: skip
"""Where a point force acts, in words."""


def print_states(result: LoadPath, force: float) -> None:
    """Print the states at an end force, or why there is none: that ends nothing."""
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


def print_barrier(result: LoadPath, force: float, case: Case | None) -> None:
    """Print the barrier at an end force, or why there is none: that ends nothing."""
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


def print_path(result: LoadPath, case: Case | None) -> None:
    """Print events as a list, of a case with their loads in its words, too, and why the path ended."""
    from rodwell.answers.words.wording import forces_in  # noqa: PLC0415
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    click.echo(
        f"End force at s = 1 in {UNIT} (tension positive), {ends_text(result.problem)}; the {result.way.held} is"
    )
    wrapped(f"controlled. {result.assumptions[0].upper()}{result.assumptions[1:]}.")
    leg, scales, said = "", None if case is None else case.scales, forces_in(result, case)
    for event in result.events:
        if event.leg != leg:
            leg = event.leg
            click.echo(f"{leg}:")
        where = _places(event.s)
        driven = result.driven(event)
        at = "" if driven is None else f", {result.way.held} {amount(driven, 9)} L"
        there = "" if scales is None else f" ({said.load(event.force)})"
        click.echo(f"  {with_error(event.force)}{there}  {event.meaning}{where}{at}")
        if event.to is not None:
            energy = f"energy {_signed(event.to.energy, 9)} B/L relative to {_rest(result)}"
            energy += "" if driven is None else f", F = {_signed(event.to.force, 10)}"
            click.echo(f"      {energy}; {event.to.agree} of {event.to.starts} disturbed starts end there")
    symbol = "F" if result.way.by_force else result.way.held
    if result.reached and not any(leg.runs for leg in result.legs):
        stays = "stays straight" if result.problem.hole is None else "lies along the hole"
        click.echo(f"The rod {stays}: the first load at which it buckles is not reached.")
    if result.reached:
        click.echo(f"Followed to {symbol} = {plain(result.until, 6)}" + (
            "." if result.unload_to is None else f" and back to {plain(result.unload_to, 6)}."
        ))  # fmt: skip
    else:
        wrapped(f"Not followed to the end: {said.retold(result.ended_because)}.")
    if result.problem.twist != 0.0:
        arm = "without" if result.mirror else "with"
        wrapped(f"Twist makes the two arms of the buckling mode differ: the other one is followed {arm} --mirror.")


def _rest(result: LoadPath) -> str:
    """The rod that has not buckled, from which energies count."""
    if result.problem.in_space:
        return "the undeformed rod along the bottom"
    return "the straight rod" if result.problem.hole is None else "the rod that lies along the hole"


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
    if state.problem.hole is not None:
        _print_own_places(state)


def _print_own_places(state: ContactState) -> None:
    """The numbers of a state in a curved hole with every cross-section at its own place."""
    from rodwell.errors import NotConvergedError  # noqa: PLC0415

    try:
        own = state.own_places
    except NotConvergedError as error:
        wrapped(f"  {error}")
        return
    click.echo("  the hole is taken where the undeformed rod is; with every cross-section at its own place:")
    click.echo(f"    energy {amount(own.energy, 9)} B/L, all contact forces {amount(own.contact_total, 7)} {UNIT}")


def print_contacts(state: ContactState) -> None:
    """Print gaps, stretches in contact and point forces of a state, a line each."""
    for gap in state.gaps:
        size = f"{amount(gap.largest, 6)} Δ at s/L = {plain(gap.at, 5)}"
        click.echo(f"  gap      {_place(gap.start)} to {_place(gap.end)}   {size}")
    for contact in state.contacts:
        force = f"{amount(contact.force, 6)} {UNIT}"
        click.echo(f"  contact  {_place(contact.start)} to {_place(contact.end)}   {force} spread along it")
    for point in state.point_forces:
        what = WHERE[point.kind]
        if floats_in_part(state.problem):
            high = (abs(point.angle) > 0.5 * math.pi) != state.problem.floats
            what += f", on the {'upper' if high else 'lower'} wall"
        click.echo(f"  force    {_place(point.s)}              {amount(point.force, 6)} {UNIT} {what}")
