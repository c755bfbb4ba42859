"""What ``rodwell diagram`` and ``rodwell curve`` say: branches with their special points, and points of curves."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.off_wall import print_ending
from rodwell.cli.options import places_text, print_json, print_written
from rodwell.quantities.text import plain, with_error

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rodwell.analysis.branch.diagram import Diagram
    from rodwell.analysis.curves.curve import Curve
    from rodwell.problem.varying import Parameter


def tell_diagram(result: Diagram, out: Path | None, *, as_json: bool) -> None:
    """Print branches and their special points, or JSON; and that files of them are in ``out``, if they are."""
    bent = result.problem.hole is not None
    places = {branch.name: branch[-1].place_errors for branch in result} if bent else {}
    pushes = {branch.name: branch[-1].axial_contact_error for branch in result} if result.problem.ramps else {}
    if as_json:
        more = {"place_errors_at_the_ends": places, "axial_contact_errors_at_the_ends": pushes}
        print_json({**result.as_dict(), **{name: errors for name, errors in more.items() if errors}})
        return
    _print_diagram(result)
    for name, errors in places.items():
        pressure, energy = (plain(errors[which], 2) for which in ("largest_pressure", "energy"))
        wrapped(
            "The hole is taken where the undeformed rod is. With every cross-section at its own place the last "
            f"state of {name} has a largest contact pressure that differs by {pressure} B/L³, and an energy that "
            f"differs by {energy} B/L."
        )
    if out is not None:
        print_written(out)


def tell_curves(curves: Sequence[Curve], out: Path | None, *, as_json: bool) -> None:
    """Print points of curves, or JSON; and that files of them are in ``out``, if they are."""
    if as_json:
        print_json({"curves": [c.as_dict() for c in curves]})
        return
    _print_curves(curves)
    if out is not None:
        print_written(out)


def _print_diagram(result: Diagram) -> None:
    from rodwell.answers.words.first_met import KEPT  # noqa: PLC0415
    from rodwell.answers.words.steps import steps_note  # noqa: PLC0415
    from rodwell.answers.words.varying import push_note  # noqa: PLC0415
    from rodwell.problem.words import ends_text  # noqa: PLC0415
    from rodwell.quantities.value import Value  # noqa: PLC0415
    from rodwell.report.reports.texts import KINDS  # noqa: PLC0415

    widest = max((len(KINDS[p.kind]) for branch in result for p in branch.special_points), default=0)
    wrapped(f"End force at s = 1 in B/L² (tension positive), {ends_text(result.problem)}; index under dead loads.")
    if result.problem.twist != 0.0 and result.problem.untouched:
        wrapped(KEPT)
    first = next((p for branch in result for p in branch.special_points if p.kind in ("lift_off", "end")), None)
    note = "" if first is None else steps_note(first.solution.step_loads, bent=result.problem.hole is not None)
    if note:
        wrapped(note)
    if first is not None and result.problem.ramps:
        wrapped(push_note(first.solution))
    for branch in result:
        verb = "leaves" if branch.parameter == "force" else "continues"
        parent = f", {verb} {branch.origin.parent}" if branch.origin.parent else ""
        others = [image.name for image in result.images(branch)[1:]]
        mirrored = f"   images: {', '.join(others)}" if others else ""
        click.echo(f"\n{branch.name}{parent}: {len(branch)} points{mirrored}")
        for p in branch.special_points:
            index = f"index {p.index_before} → {p.index_after}"
            name = "F" if p.parameter == "force" else str(p.parameter)
            known = Value(p.force if p.parameter == "force" else p.value, 0.0 if p.kind == "end" else p.error)
            remark = "" if branch.meets_tolerance(p) else "   misses the tolerance"
            click.echo(f"  {KINDS[p.kind]:<{widest}}  {name} = {with_error(known)}   {index}{places_text(p.s)}{remark}")
        print_ending(branch)
    for line in result.unexplored:
        click.echo(f"not explored: {line}")
    click.echo()
    wrapped(f"Searched: {'; '.join(result.searched)}. There may be other branches.")
    if not result.converged:
        click.echo("Not every number meets the tolerance.")


SHOWN = 12
"""Points of a curve that the terminal shows."""


def _print_curves(curves: Sequence[Curve]) -> None:
    from rodwell.analysis.curves.curve import convention  # noqa: PLC0415
    from rodwell.plots.curves import MARKERS  # noqa: PLC0415
    from rodwell.problem.varying import words_for  # noqa: PLC0415
    from rodwell.quantities.value import Value  # noqa: PLC0415

    first = curves[0]
    wrapped(f"{first.kind} over {words_for(first.over)}: {convention(first.problem, first.quantity)}")
    for item in curves:
        click.echo(f"\n{item.name}: {len(item)} points")
        step = max(1, (len(item) - 1) // (SHOWN - 1))
        shown = [*item.points[:-1:step], item.points[-1]]
        for p in shown:
            known = with_error(Value(p.value, p.error))
            click.echo(f"  {item.over} = {plain(p.x, 8):<12} {known}{places_text(p.s)}{_numbers(item.over, p.x)}")
        for m in item.marks:
            place, known = with_error(Value(m.x, m.x_error)).lstrip("+"), with_error(Value(m.value, m.error))
            there = _numbers(item.over, m.x)
            click.echo(f"  {MARKERS[m.kind][1]}: {item.over} = {place}{there}, {known}; {m.note}")

        if item.ended_because != "end":
            click.echo(f"  ended early: {item.ended_because}")
        if not item.converged:
            click.echo("  Not every point meets the tolerance.")


def _numbers(over: Parameter, x: float) -> str:
    """The numbers at a place of a path, for the terminal; nothing for one parameter."""
    if isinstance(over, str):
        return ""
    return "  (" + ", ".join(f"{name} {plain(value, 6)}" for name, value in over.at(x).items()) + ")"
