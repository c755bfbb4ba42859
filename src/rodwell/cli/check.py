"""``rodwell verify``: a case once more, by another method and another program."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.keep import keep, keep_options, take_keep
from rodwell.cli.listing import wrapped
from rodwell.cli.off_wall import off_wall_option, why_not_passed
from rodwell.cli.options import force_at, json_option, note_rigid_wall, print_json, progress_bar
from rodwell.quantities.text import plain, signed

if TYPE_CHECKING:
    from rodwell.analysis.branch.verifying.verify import Verification
    from rodwell.report.folders.numbers import Numbers


@click.command(short_help="Solve a case once more with SciPy's solve_bvp, and compare.")
@click.argument("case", type=click.Path(path_type=Path))
@click.option("--mode", default=1, show_default=True, help="Buckling mode whose branch is verified.")
@click.option(
    "--at",
    "at",
    multiple=True,
    help='End force at s = 1, tension positive, at which to compare, with its unit ("-130 kN"; a plain number in B/L² '
    "without dimensions); may be given several times.  "
    "[default: half way from buckling to lift-off, and 1.3 times that way]",
)
@off_wall_option
@click.option(
    "--rtol", default=1e-8, show_default=True, help="Relative tolerance of the other program and of agreement."
)
@keep_options("the differences of all fields")
@json_option
def verify(
    case: Path, mode: int, at: tuple[str, ...], off_wall: bool, rtol: float, as_json: bool, **given: Any
) -> None:
    """Solve CASE, a TOML file, once more as the paper's fifteen equations with SciPy's solve_bvp, and compare.

    Every field and the lift-off load are compared with the engine's; with --off-wall states beyond lift-off are those
    of a rod that has left the wall, held against balance in space. Takes some seconds for each state. The exit code
    is 1 if the two do not agree. `rodwell keys` explains the keys of a case file.
    """
    from rodwell.analysis.branch.verifying.verify import verify as solve_again  # noqa: PLC0415
    from rodwell.answers.result.check import branch_to_verify  # noqa: PLC0415
    from rodwell.answers.result.reach import passes, why_out_of_reach  # noqa: PLC0415
    from rodwell.case.case import Case  # noqa: PLC0415
    from rodwell.errors import InputError, NotConvergedError  # noqa: PLC0415

    where, read = take_keep(given), Case.read(case)
    note_rigid_wall(read.given)
    forces = [force_at(text, read) for text in at]
    with progress_bar(not as_json, "the engine's branch") as tell:
        try:
            branch = branch_to_verify(read, mode, forces, off_wall=off_wall)
        except InputError as error:
            name = "--at" if error.field == "until" else error.field
            raise InputError(name, ", ".join(at) if name == "--at" else error.value, error.reason) from None
        off = branch.beyond
        why = why_out_of_reach(branch, read.scales) if off is None else why_not_passed(off)
        missed = [force for force in forces if not (passes(branch, force) or (off is not None and off.passes(force)))]
        forces = [force for force in forces if force not in missed]
        if missed and not forces:
            raise NotConvergedError(f"--at = {', '.join(at)} cannot be reached: {why}")
        count = [0]

        def report(force: float) -> None:
            tell(f"solve_bvp at F = {plain(force, 6)} B/L²", min(count[0] / 3.0, 0.9))
            count[0] += 1

        result = solve_again(branch, forces or None, rtol=rtol, progress=report)
    not_reached = [{"force": force, "reached": False, "why": why} for force in missed]
    data = {"case": read.title, "mode": mode, **result.as_dict(), "not_reached": not_reached}
    if as_json:
        print_json(data)
    else:
        _print(result, read.title, mode)
        for force in missed:
            wrapped(f"  F = {signed(force, 8)}: not reached: {why}")
    keep(where, lambda: _numbers(data, result), quiet=as_json)
    if not result.agrees:
        raise click.exceptions.Exit(1)


def _numbers(data: dict[str, Any], result: Verification) -> Numbers:
    """The comparison as files, the differences drawn."""
    from rodwell.plots.loads.verified import plot_verified  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    columns = ("end force at s = 1, tension positive [B/L^2]", "field", "largest relative difference", "tolerance")
    rows = [(s.force, name, size, s.tolerance) for s in result.states for name, size in s.differences.items()]
    return Numbers("verify", data, Table("verify", columns, tuple(rows)), lambda axes: plot_verified(result, axes))


def _print(result: Verification, title: str, mode: int) -> None:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    click.echo(f"{title}: mode {mode}, {ends_text(result.branch.problem)}")
    wrapped("Engine (one function y(s), splines) against SciPy's solve_bvp (the paper's 15 equations and (B1)–(B15)).")
    wrapped("End force F at s = 1 in B/L², tension positive; differences relative to each field's largest value.")
    if any(state.off_wall for state in result.states):
        wrapped("Off the wall: balance of forces and moments in space, stretch by stretch, their ends unknown.")
    for state in result.states:
        verdict = "agree" if state.agrees else "DO NOT AGREE"
        worst = state.worst
        click.echo(
            f"  F = {signed(state.force, 8)}{', off the wall' * state.off_wall}: {verdict}; largest difference "
            f"{plain(state.differences[worst], 2)}, in {worst}"
        )
        wrapped(f"solve_bvp: {state.nodes} mesh points, residual {plain(state.residual, 2)}. {state.message}", "      ")
    if result.lift_off is not None:
        ours, other = result.lift_off
        click.echo(
            f"  lift-off: engine {signed(ours, 12)}, solve_bvp {signed(other, 12)}, "
            f"difference {plain(result.lift_off_difference or 0.0, 2)}"
        )
    click.echo("All agree." if result.agrees else f"They do not all agree to {plain(result.rtol)}.")
