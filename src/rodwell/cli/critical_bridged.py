"""What ``rodwell critical`` prints of a string that bridges steps of its clearance."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.listing import wrapped
from rodwell.cli.options import UNIT, check_missed, print_json
from rodwell.cli.path_text import print_contacts
from rodwell.quantities.text import plain, with_error
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.analysis.path.events import PathPoint
    from rodwell.analysis.path.load_path import LoadPath
    from rodwell.problem.problem import Problem
    from rodwell.report.folders.numbers import Numbers


def show_bridged(path: LoadPath, rtol: float, as_json: bool) -> None:
    """Print the load, where the string touches then, and loads with one clearance everywhere; or all of it as JSON."""
    if as_json:
        print_json(_data(path))
    else:
        _print(path)
    check_missed(path.missed, rtol)


def bridged_numbers(path: LoadPath) -> Numbers:
    """The load as files, and the string in its hole at that load drawn."""
    from rodwell.plots.paths.bridging import plot_bridging  # noqa: PLC0415
    from rodwell.quantities.table import Table  # noqa: PLC0415
    from rodwell.report.folders.numbers import Numbers  # noqa: PLC0415

    found, state = _critical(path), _critical(path).state
    assert state is not None
    columns = ("kind", "s/L", "end force at s = 1, tension positive, or contact force [B/L^2]", "error [B/L^2]")
    rows: list[tuple[str, float | None, float, float]] = [("buckling", None, found.force.value, found.force.error)]
    rows += [(point.kind, point.s.value, point.force.value, point.force.error) for point in state.point_forces]
    table = Table("critical", columns, tuple(rows))
    return Numbers("critical", _data(path), table, lambda axes: plot_bridging(state, axes))


def _critical(path: LoadPath) -> PathPoint:
    found = path.first("critical")
    assert found is not None
    return found


@cache
def _one_clearance(problem: Problem) -> tuple[tuple[float, Value], ...]:
    """The first critical load with each clearance all along, from the widest down: files and text show them."""
    from rodwell.analysis.straight.critical import critical_loads  # noqa: PLC0415
    from rodwell.problem.profile import extremes  # noqa: PLC0415

    if problem.rod.mixed:  # which leaves the wall with any clearance
        return ()
    found: list[tuple[float, Value]] = []
    for ratio in sorted({extremes(section[3])[0] for section in problem.sections}, reverse=True):
        same = [(*section[:3], 1.0, section[4]) for section in problem.sections]
        mode = critical_loads(problem.but(sections=same, clearance=ratio * problem.clearance), 1)[0]
        found.append((ratio * problem.clearance, mode.load))
    return tuple(found)


def _data(path: LoadPath) -> dict[str, Any]:
    from rodwell.problem.words import ends_text  # noqa: PLC0415

    found = _critical(path)
    assert found.state is not None
    return {
        "critical_loads": [found.force.value],
        "error": [found.force.error],
        "tensile_loads": [],
        "without_wall": None,
        "bridged": found.state.as_dict(),
        "one_clearance": [
            {"clearance": clearance, "load": load.as_dict()} for clearance, load in _one_clearance(path.problem)
        ],
        "converged": not path.missed,
        "assumptions": path.assumptions,
        "unit": "B/L^2",
        "convention": "end force at s = 1, tension positive; places in L, gaps in clearances of ratio 1; "
        + ends_text(path.problem),
    }


def _print(path: LoadPath) -> None:
    from rodwell.problem.words import ends_text, floats_in_part  # noqa: PLC0415

    found = _critical(path)
    assert found.state is not None
    click.echo(f"Critical end force at s = 1 in {UNIT} (tension positive), {ends_text(path.problem)}:")
    click.echo(f"  mode  1  {with_error(found.force)}   out of the vertical plane")
    does = "bridges the steps of its clearance"
    if floats_in_part(path.problem):
        does = "leaves the lower side of the hole where it begins to float"
    wrapped(
        f"The string {does}: it lies in the vertical plane, off the wall there, and buckles sideways at this "
        "load. At it:"
    )
    print_contacts(found.state)
    for clearance, load in _one_clearance(path.problem):
        click.echo(f"  with a clearance of {plain(clearance, 6)} L everywhere: {with_error(load)}")
    if _one_clearance(path.problem):
        wrapped("Neither of these is a bound: free stretches beside a step have no wall that holds them.")
    for line in path.events[:-1]:
        click.echo(f"  before: {with_error(line.force)}   {line.meaning}")
