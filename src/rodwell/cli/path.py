"""``rodwell path``: what happens to a rod in its hole as the load grows, and comes back."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import (
    OutPath,
    check_missed,
    json_option,
    make_problem,
    print_json,
    print_written,
    problem_options,
    progress_bar,
    rtol_option,
)
from rodwell.errors import InputError

if TYPE_CHECKING:
    from rodwell.analysis.off_wall.state import ContactState
    from rodwell.analysis.path.events import PathState
    from rodwell.analysis.path.load_path import LoadPath

UNIT = "B/L²"

WHERE = {
    "point": "at a point of contact", "end": "at the end of a stretch in contact",
    "edge": "at the edge of a narrower part of the hole",
}  # fmt: skip
"""Where a point force acts, in words."""


@click.command(short_help="The load path off the wall: lift-off, partial contact, snap, helix, and back.")
@problem_options()
@click.option(
    "--until", type=float, help="End force at s = 1 (tension positive) to load the rod to; may be left out where the "
    "clearance has steps: until it buckles.",
)  # fmt: skip
@click.option("--unload-to", type=float, help="End force to unload it to afterwards.")
@click.option("--at", help="End forces, separated by commas, at which states are shown.")
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
    "--wall-stiffness", type=float, default=math.inf,
    help="Stiffness k L⁴/B of a wall that gives way, push per length and depth.  [default: a hard wall]",
)  # fmt: skip
@click.option("--mirror", is_flag=True, help="The other arm of the buckling mode: it differs with twist.")
@click.option("--seeds", default=3, show_default=True, help="Random disturbances tried, either way, at each snap.")
@click.option("--out", type=OutPath(), help="Folder for a figure of the path, load against shortening.")
@rtol_option
@json_option
def path(
    until: float | None,
    unload_to: float | None,
    at: str | None,
    control: str,
    axial_stiffness: float | None,
    spring: float | None,
    wall_stiffness: float,
    mirror: bool,
    seeds: int,
    out: Path | None,
    rtol: float,
    as_json: bool,
    **given: Any,
) -> None:
    """What happens as the load grows quasi-statically, and comes back.

    Buckling, lift-off, gaps, points of contact, loss of stability, where the rod snaps to, the helix, and the way
    back. The rod may leave the wall; frictionless and without inertia. End force at s = 1 in B/L², tension positive;
    places in parts of the length, gaps in parts of the clearance.
    """
    from rodwell.analysis.path.load_path import load_path  # noqa: PLC0415

    problem, forces = make_problem(given), _forces(at)
    if out is not None:
        from rodwell.store.folder import check_writable  # noqa: PLC0415

        check_writable(out)
    span = abs(until or -100.0) + 1e-12

    with progress_bar(not as_json, "buckling") as tell:
        result = load_path(
            problem, until=until, unload_to=unload_to, control=control, axial_stiffness=axial_stiffness, spring=spring,
            wall_stiffness=wall_stiffness, mirror=mirror, seeds=seeds, rtol=rtol,
            progress=lambda leg, force: tell(f"{leg}, F = {force:.4g}", min(abs(force) / span, 1.0)),
        )  # fmt: skip
    if out is not None:
        from rodwell.report.folders.path import write_path  # noqa: PLC0415

        write_path(result, out, forces)
    if as_json:
        from rodwell.problem.problem import ends_text  # noqa: PLC0415

        convention = "end force F at s = 1, tension positive; places in L, gaps in clearances; "
        print_json(
            {
                **result.as_dict(forces),
                "converged": not result.missed,
                "unit": "B/L^2",
                "convention": convention + ends_text(problem),
            }
        )
    else:
        _print(result)
        for force in forces:
            _print_states(result, force)
        if out is not None:
            print_written(out)
    check_missed(result.missed, rtol)


def _forces(at: str | None) -> list[float]:
    try:
        return [float(part) for part in at.split(",")] if at else []
    except ValueError:
        raise InputError(
            "--at", at, "must be end forces in B/L² (or shortenings in L), plain numbers separated by commas"
        ) from None


def _print_states(result: LoadPath, force: float) -> None:
    """The states at an end force, or why there is none: that ends nothing."""
    from rodwell.errors import RodwellError  # noqa: PLC0415

    try:
        for state in result.at(force):
            _print_state(state)
    except RodwellError as error:
        click.echo("")
        wrapped(f"{result.control} {force:g}: not reached. {error}")


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
        at = "" if driven is None else f", {result.way.held} {driven.value:.9g} L"
        click.echo(f"  {event.force.value:+.10g}  ± {event.force.error:.0e}  {event.meaning}{where}{at}")
        if event.to is not None:
            energy = f"energy {event.to.energy.value:+.9g} B/L relative to the straight rod"
            energy += "" if driven is None else f", F = {event.to.force.value:+.10g}"
            click.echo(f"      {energy}; {event.to.agree} of {event.to.starts} disturbed starts end there")
    symbol = "F" if result.way.by_force else result.way.held
    if result.reached:
        click.echo(f"Followed to {symbol} = {result.until:g}" + (
            "." if result.unload_to is None else f" and back to {result.unload_to:g}."
        ))  # fmt: skip
    else:
        wrapped(f"Not followed to the end: {result.ended_because}.")
    if result.problem.twist != 0.0:
        arm = "without" if result.mirror else "with"
        wrapped(f"Twist makes the two arms of the buckling mode differ: the other one is followed {arm} --mirror.")


def _places(s: tuple[float, ...]) -> str:
    return "" if not s else ", s/L = " + ", ".join(f"{place:.5g}" for place in s)


def _print_state(shown: PathState) -> None:
    state = shown.state
    index = shown.stability_index
    held = "" if shown.control.by_force else f" where the {shown.control.held} is held"
    stable = f"stable{held}" if index == 0 else f"unstable{held}, index {index}"
    click.echo(f"\nF = {state.force:+.10g}, {shown.leg}: {state.kind}, {stable}")
    click.echo(
        f"  energy {state.energy.value:+.9g} ± {state.energy.error:.0e} B/L, shortening {state.shortening.value:.9g} L"
    )
    print_contacts(state)
    check = state.certificate
    passed = "passed" if check.passed else "NOT passed"
    click.echo(f"  all contact forces {state.contact_total.value:.7g} {UNIT}; certificate {passed}, {check.worst:.0e}")


def print_contacts(state: ContactState) -> None:
    """Gaps, stretches in contact and point forces of a state, a line each."""
    for gap in state.gaps:
        size = f"{gap.largest.value:.6g} Δ at s/L = {gap.at:.5g}"
        click.echo(f"  gap      {gap.start.value:.6f} to {gap.end.value:.6f}   {size}")
    for contact in state.contacts:
        force = f"{contact.force.value:.6g} {UNIT}"
        click.echo(f"  contact  {contact.start.value:.6f} to {contact.end.value:.6f}   {force} spread along it")
    for point in state.point_forces:
        what = WHERE[point.kind]
        click.echo(f"  force    {point.s.value:.6f}              {point.force.value:.6g} {UNIT} {what}")
