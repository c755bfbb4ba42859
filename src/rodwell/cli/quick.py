"""``rodwell critical`` and ``rodwell liftoff``: quick answers to dimensionless questions."""

from __future__ import annotations

import json
from typing import Any

import click

UNIT = "B/L²"


def problem_options(function: Any) -> Any:
    """Options that describe the problem."""
    for option in (
        click.option(
            "--ends",
            default="clamped-clamped",
            show_default=True,
            help="End conditions at s = 0 and s = 1: clamped, pinned, guided (slides around the wall) or free.",
        ),
        click.option("--clearance", default=0.01, show_default=True, help="Δ/L, distance between the axes."),
        click.option("--alpha", type=float, required=True, help="Angle of the cylinder from the vertical, degrees."),
        click.option("--weight", type=float, required=True, help="γ = mg L³/B, weight of the rod."),
    ):
        function = option(function)
    return function


rtol_option = click.option("--rtol", default=1e-8, show_default=True, help="Relative tolerance of the numbers.")
json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON.")


@click.command()
@problem_options
@click.option("--modes", default=5, show_default=True, help="How many critical loads.")
@click.option("--on-top", is_flag=True, help="The rod lies on top, ξ₂ = π, where its weight helps buckling.")
@rtol_option
@json_option
def critical(
    weight: float, alpha: float, clearance: float, ends: str, modes: int, on_top: bool, rtol: float, as_json: bool
) -> None:
    """Critical loads of the straight rod.

    End force at s = 1 in B/L², tension positive, in the order in which they are met as compression grows.
    """
    from rodwell.analysis.critical import critical_loads  # noqa: PLC0415
    from rodwell.problem import Problem, checked_ends, ends_text  # noqa: PLC0415

    problem = Problem(weight=weight, alpha=alpha, clearance=clearance, on_top=on_top, ends=checked_ends(ends))
    loads = critical_loads(problem, modes, rtol=rtol)
    if as_json:
        click.echo(
            json.dumps(
                {
                    "critical_loads": [float(f) for f in loads.forces],
                    "error": [float(e) for e in loads.errors],
                    "unit": "B/L^2",
                    "convention": "end force at s = 1, tension positive; " + ends_text(problem),
                }
            )
        )
        return
    click.echo(f"Critical end force at s = 1 in {UNIT} (tension positive), {ends_text(problem)}:")
    for mode in loads:
        symmetry = {1: "even", -1: "odd", 0: "no symmetry"}[mode.parity]
        click.echo(f"  mode {mode.number:>2}  {mode.force:+.10g}  ± {mode.error:.1e}   {symmetry}")
    first = loads[0].force
    if first > 0.0:
        click.echo(f"The rod buckles under its own weight unless it is held in tension of {first:.6g} {UNIT}.")
    else:
        click.echo(f"The straight rod is stable up to a compression of {-first:.6g} {UNIT} at s = 1.")


@click.command()
@problem_options
@click.option("--mode", default=1, show_default=True, help="Buckling mode, in the order of compression.")
@click.option("--twist", default=0.0, show_default=True, help="End twisting moment T₁ in B/L.")
@rtol_option
@json_option
def liftoff(
    weight: float, alpha: float, clearance: float, ends: str, mode: int, twist: float, rtol: float, as_json: bool
) -> None:
    """Load at which the buckled rod lifts off the wall, and where.

    End force at s = 1 in B/L², tension positive; places as parts of the length from s = 0.
    """
    from rodwell.analysis.follow import follow  # noqa: PLC0415
    from rodwell.errors import NotConvergedError  # noqa: PLC0415
    from rodwell.problem import Problem, checked_ends, ends_text  # noqa: PLC0415

    problem = Problem(weight=weight, alpha=alpha, clearance=clearance, twist=twist, ends=checked_ends(ends))
    branch = follow(problem, mode, rtol=rtol)
    lift, found = branch.lift_off, branch.mode
    assert found is not None
    if lift is None:
        raise NotConvergedError(
            f"mode {mode} was followed to F = {branch.force[-1]:.6g} {UNIT} without lift-off ({branch.ended_because})"
        )
    if as_json:
        click.echo(
            json.dumps(
                {
                    "critical_load": found.force,
                    "critical_load_error": found.error,
                    "lift_off": {
                        "force": lift.force,
                        "error": lift.error,
                        "s": [] if branch.lift_off_at_buckling else list(lift.s),
                    },
                    "coincides_with_buckling": branch.lift_off_at_buckling,
                    "converged": branch.converged,
                    "unit": "B/L^2",
                    "convention": "end force at s = 1, tension positive; " + ends_text(problem),
                }
            )
        )
        return
    where = "" if branch.lift_off_at_buckling else "   at s/L = " + ", ".join(f"{s:.6g}" for s in lift.s)
    click.echo(f"End force at s = 1 in {UNIT} (tension positive), {ends_text(problem)}:")
    click.echo(f"  buckling of mode {found.number}  {found.force:+.10g}  ± {found.error:.1e}")
    click.echo(f"  lift-off            {lift.force:+.10g}  ± {lift.error:.1e}{where}")
    if branch.lift_off_at_buckling:
        click.echo("Lift-off coincides with buckling: no lateral weight presses the rod to the wall.")
    if not branch.converged:
        click.echo(f"Not every number meets the tolerance {rtol:g}.")
