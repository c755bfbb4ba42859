"""Branches that leave the wall: the option that asks for it; how a branch goes on and ends, on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from rodwell.cli.options import places_text
from rodwell.quantities.text import minus, plain, signed, with_error

if TYPE_CHECKING:
    from rodwell.analysis.beyond.off_wall_branch import OffWallBranch
    from rodwell.analysis.branch.branch import Branch

off_wall_option = click.option(
    "--off-wall/--on-wall", default=False, show_default=True,
    help="Where a branch lifts off it leaves the wall and goes on off it; else the rod is kept on the wall.",
)  # fmt: skip


def why_not_passed(beyond: OffWallBranch) -> str:
    """How far a branch goes off the wall, and why it ends: for a load that it does not pass."""
    low, high = (f"{signed(float(force), 6)} B/L²" for force in (beyond.force.min(), beyond.force.max()))
    return f"off the wall the branch covers {low} to {high} at s = 1 (it ended: {minus(beyond.ended_because)})"


def print_ending(branch: Branch) -> None:
    """Print how a branch goes on off the wall, if it does, and why it ended."""
    from rodwell.analysis.branch.special import END  # noqa: PLC0415

    if branch.beyond is not None:
        _print_off_wall(branch.beyond)
    if branch.closed:
        click.echo("  closed: the end is where it began")
    elif branch.ended_because != END and (not branch.reached_end or branch.origin.parent):
        click.echo(minus(f"  ended: {branch.ended_because}"))


def _print_off_wall(beyond: OffWallBranch) -> None:
    """Print the special points of states off the wall, and how large the gap grows."""
    from rodwell.analysis.beyond.off_wall_branch import END  # noqa: PLC0415
    from rodwell.analysis.path.events import MEANING  # noqa: PLC0415
    from rodwell.report.reports.texts import KINDS  # noqa: PLC0415

    click.echo(f"  off the wall: {len(beyond)} states, gaps up to {plain(float(beyond.largest_gap.max()), 4)} Δ")
    happens = {**MEANING, **KINDS}
    widest = max(len(happens[point.kind]) for point in beyond.special_points)
    for point in beyond.special_points:
        index = f"index {point.index_before} → {point.index_after}"
        known = with_error(point.reached) if point.kind != END else plain(point.force, 8)
        remark = "" if point.met else "   misses the tolerance"
        click.echo(f"    {happens[point.kind]:<{widest}}  F = {known}   {index}{places_text(point.s)}{remark}")
