"""``rodwell critical`` and ``liftoff`` in a hole that leaves the vertical plane: how far the rod lies on the wall."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.keep import Keep, keep
from rodwell.cli.listing import wrapped
from rodwell.cli.options import UNIT, check_missed, places_text, print_json, progress_bar
from rodwell.errors import InputError, NotConvergedError
from rodwell.quantities.text import plain, with_error

if TYPE_CHECKING:
    from rodwell.analysis.branch.branch import Branch
    from rodwell.analysis.branch.special import SpecialPoint
    from rodwell.analysis.loads.lying_rod import LyingRod
    from rodwell.problem.problem import Problem
    from rodwell.quantities.value import Value
    from rodwell.report.folders.numbers import Numbers


def critical_in_space(problem: Problem, rtol: float, where: Keep, as_json: bool) -> None:
    """Print the loads at which the rod, as it lies, loses its stability, and between which forces it lies."""
    lying = _followed(problem, rtol, as_json)
    lost = {"lost": lying.end, "lost_in_tension": lying.end_in_tension}
    loads = {name: [end.load] if end is not None and end.index_after > 0 else [] for name, end in lost.items()}
    data = {
        "critical_loads": [load.value for load in loads["lost"]],
        "error": [load.error for load in loads["lost"]],
        "tensile_loads": [load.as_dict() for load in loads["lost_in_tension"]],
        "without_wall": None,
        **_said(lying),
    }
    if as_json:
        print_json(data)
    else:
        _print(lying)
    keep(where, lambda: _numbers("critical", data, lying), quiet=as_json)
    _check(lying, rtol)


def lift_off_in_space(problem: Problem, rtol: float, where: Keep, as_json: bool) -> None:
    """Print the load at which the rod leaves the wall: as it lies, or buckled where it buckles before.

    Raises
    ------
    NotConvergedError
        If it was not found to leave the wall.
    """
    from rodwell.analysis.state.own_places import lift_off_with_own_places  # noqa: PLC0415

    lying = _followed(problem, rtol, as_json)
    lift = _lift_off(lying)
    own = lift_off_with_own_places(problem, lift.solution.meshes, lift.solution.point)
    buckling = None if lying.buckled is None else lying.lowest
    data = {
        "critical_load": None if buckling is None else buckling.value,
        "critical_load_error": None if buckling is None else buckling.error,
        "lift_off": {"force": lift.force, "error": lift.error, "s": list(lift.s)},
        "other_arm": None,
        "coincides_with_buckling": False,
        "lift_off_own_places": own.as_dict(),
        **_said(lying),
    }
    if as_json:
        print_json(data)
    else:
        _print(lying)
        click.echo(f"  lift-off            {with_error(lift.load)}{places_text(lift.s)}")
        click.echo(f"  with own places     {with_error(own)}")
        wrapped("States take the hole where the undeformed rod is; the last load has every cross-section at its own.")
    keep(where, lambda: _numbers("liftoff", data, lying), quiet=as_json)
    _check(lying, rtol)


def only_first_mode(mode: int, mirror: bool) -> None:
    """Raise if another mode or arm is asked for: a rod that lies along such a hole has none."""
    why = "a rod in a hole that leaves the vertical plane moves with the load, and has no modes"
    if mode != 1:
        raise InputError("--mode", mode, f"must be left out: {why}")
    if mirror:
        raise InputError("--mirror", "", f"must be left out: {why}")


def _followed(problem: Problem, rtol: float, quiet: bool) -> LyingRod:
    from rodwell.analysis.loads.lying_rod import lying_rod  # noqa: PLC0415

    with progress_bar(not quiet, "how the rod lies") as tell:
        return lying_rod(
            problem, rtol=rtol, progress=lambda force: tell(f"how the rod lies at F = {force:.4g} {UNIT}", 0.5)
        )


def _lift_off(lying: LyingRod) -> SpecialPoint:
    from rodwell.analysis.branch.special import LIFT_OFF  # noqa: PLC0415

    end = lying.end
    lift = end if end is not None and end.kind == LIFT_OFF else None
    if lift is None and lying.buckled is not None:
        lift = lying.buckled.lift_off
    if lift is None:
        why = _what_ends(end, lying.pressed, lying) if lying.buckled is None else lying.buckled.ending
        raise NotConvergedError(
            f"the rod was followed to F = {plain(lying.until, 6)} {UNIT} and did not leave the wall there: {why}; "
            "rodwell critical tells how far it lies"
        )
    return lift


def _what_ends(end: SpecialPoint | None, branch: Branch, lying: LyingRod) -> str:
    """What ends the way of the rod as it lies, in a clause."""
    from rodwell.analysis.branch.special import LIFT_OFF  # noqa: PLC0415

    if end is None:
        return f"it was followed no farther ({branch.ending})"
    if end.kind == LIFT_OFF:
        return "it leaves the wall"
    buckles = lying.buckled is not None and branch is lying.pressed
    return "it buckles" if buckles else "it loses its stability and takes another shape"


def _said(lying: LyingRod) -> dict[str, Any]:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    return {
        "lying": lying.as_dict(),
        "converged": all(branch.converged for branch in lying.branches),
        "unit": "B/L^2",
        "convention": "end force at s = 1, tension positive; " + ends_text(lying.problem),
    }


def _ways(lying: LyingRod) -> tuple[tuple[str, Value, SpecialPoint | None, Branch], ...]:
    """The lowest and the highest end force at which it lies, with what ends it there."""
    return (
        ("lowest", lying.lowest, lying.end, lying.pressed),
        ("highest", lying.highest, lying.end_in_tension, lying.pulled),
    )


def _print(lying: LyingRod) -> None:
    from rodwell.answers.words.steps import steps_note  # noqa: PLC0415
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    p = lying.problem
    given = "the axis given" if p.axis else f"build {plain(p.build, 6)}/L, walk {plain(p.walk, 6)}/L"
    wrapped(
        f"The hole leaves the vertical plane ({given}, α = {plain(p.alpha, 6)}° at mid-length): the rod lies on no "
        "straight line along it and moves with every change of the end force."
    )
    click.echo(f"It lies on the wall, stable, at end forces at s = 1 in {UNIT} (tension positive),")
    click.echo(f"{ends_text(p)}:")
    for name, load, end, branch in _ways(lying):
        places = "" if end is None else places_text(end.s)
        beyond = "below" if name == "lowest" else "above"
        click.echo(f"  {name:<8}  {with_error(load)}{places}   {beyond} {_what_ends(end, branch, lying)}")
    note = steps_note(lying.rest.step_loads, bent=True)
    if note:
        wrapped(note)


def _numbers(name: str, data: dict[str, Any], lying: LyingRod) -> Numbers:
    """The loads as files, and the states drawn."""
    from rodwell.analysis.straight.critical import CriticalLoads  # noqa: PLC0415
    from rodwell.plots.bifurcation import plot_bifurcation  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    columns = ("event", "end force at s = 1, tension positive [B/L^2]", "error [B/L^2]", "places s/L")
    rows: list[tuple[str, float, float, str]] = [
        (f"{which} end force: {_what_ends(end, branch, lying)}", load.value, load.error,
         "" if end is None else " ".join(repr(s) for s in end.s))
        for which, load, end, branch in _ways(lying)
    ]  # fmt: skip
    if "lift_off" in data:
        lift = data["lift_off"]
        rows.append(("lift-off", lift["force"], lift["error"], " ".join(repr(s) for s in lift["s"])))
    return Numbers(
        name, data, Table(name, columns, tuple(rows)),
        lambda axes: plot_bifurcation(lying.branches, CriticalLoads(), None, axes),
    )  # fmt: skip


def _check(lying: LyingRod, rtol: float) -> None:
    from rodwell.analysis.branch.missed import missed  # noqa: PLC0415

    check_missed([line for branch in lying.branches for line in missed(branch)], rtol)
