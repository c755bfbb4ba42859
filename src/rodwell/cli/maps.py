"""``rodwell diagram`` and ``rodwell curve``: branches of a problem, and boundaries in two parameters."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rodwell.cli.maps_text import tell_curves, tell_diagram
from rodwell.cli.off_wall import off_wall_option
from rodwell.cli.options import (
    check_missed,
    json_option,
    make_problem,
    out_option,
    problem_options,
    progress_bar,
    rtol_option,
)
from rodwell.cli.told import told
from rodwell.quantities.text import plain

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rodwell.analysis.curves.curve import Curve
    from rodwell.problem.problem import Problem
    from rodwell.problem.varying import Parameter


@click.command(short_help="Bifurcation diagram: branches and their special points.")
@problem_options(coiled=True)
@click.option("--modes", default=4, show_default=True, help="How many primary branches.")
@click.option("--until", type=float, help="End force at s = 1 (tension positive) at which branches end.")
@click.option("--secondary/--no-secondary", default=True, show_default=True, help="Follow secondary branches.")
@click.option(
    "--then",
    type=click.Choice(["weight", "alpha", "clearance", "twist", "poisson"]),
    multiple=True,
    help="Continue each branch in this parameter, from its state at --until; given again: in all of them, on a line.",
)
@click.option("--to", type=float, multiple=True, help="Value to which --then goes, one for each.")
@click.option(
    "--search",
    type=click.Choice(["unfolding", "deflation"]),
    multiple=True,
    help="Look for branches that hang together with none of these; can be given twice.",
)
@off_wall_option
@click.option("--largest-step", default=0.06, show_default=True, help="Longest step of continuation.")
@rtol_option
@json_option
@out_option("diagram")
def diagram(
    modes: int,
    until: float | None,
    secondary: bool,
    then: tuple[str, ...],
    to: tuple[float, ...],
    search: tuple[str, ...],
    off_wall: bool,
    largest_step: float,
    rtol: float,
    as_json: bool,
    out: Path,
    **given: Any,
) -> None:
    """Bifurcation diagram: branches of the first modes, special points, secondary branches, stability.

    End force at s = 1 in B/L², tension positive. With --turns: the branch of the coil. Draws the figure and
    writes the branches to NetCDF.
    """
    from rodwell.store.folder import check_writable  # noqa: PLC0415

    if len(then) != len(to):
        raise click.UsageError("--then and --to belong together.")
    problem = make_problem(given)
    further = _on_a_line(then, [getattr(problem, name) for name in then], to)
    check_writable(out)
    from rodwell.analysis.branch.diagram import diagram as compute  # noqa: PLC0415
    from rodwell.analysis.branch.missed import missed  # noqa: PLC0415
    from rodwell.report.folders.beside import beside  # noqa: PLC0415
    from rodwell.report.folders.branches import drawing_diagrams, write_diagram  # noqa: PLC0415

    with told() as ready, beside(drawing_diagrams) as start, progress_bar(not as_json, "critical loads") as tell:
        result = compute(
            problem,
            modes=modes,
            until=until,
            secondary=secondary,
            then=None if further is None else (further[0], further[1][1]),
            search=search,
            off_wall=off_wall,
            rtol=rtol,
            largest_step=largest_step,
            progress=tell,
        )
        ready(lambda written: tell_diagram(result, out if written else None, as_json=as_json))
        tell("figure and data", 1.0)
        write_diagram(result, out, start)
    check_missed([what for branch in result for what in missed(branch)], rtol)


@click.command(short_help="A load against another parameter.")
@click.argument("kind", type=click.Choice(["lift-off", "critical", "secondary", "twist"]))
@problem_options(required=False)
@click.option(
    "--over",
    type=click.Choice(["weight", "alpha", "clearance", "twist", "build", "walk"]),
    required=True,
    multiple=True,
    help="Parameter over which the curve runs; its own option is then not needed. Given again: over all, on a line.",
)
@click.option("--from", "start", type=float, required=True, multiple=True, help="Start of the range, for each.")
@click.option("--to", "end", type=float, required=True, multiple=True, help="End of the range, for each.")
@click.option("--mode", default=1, show_default=True, help="Mode, at the start of the range (not for critical).")
@click.option("--modes", default=4, show_default=True, help="How many curves (critical only).")
@click.option("--mirror", is_flag=True, help="The other arm, ω₂(1) > 0 (lift-off, twist).")
@rtol_option
@json_option
@out_option("curve")
def curve(
    kind: str,
    over: tuple[str, ...],
    start: tuple[float, ...],
    end: tuple[float, ...],
    mode: int,
    modes: int,
    mirror: bool,
    rtol: float,
    as_json: bool,
    out: Path,
    **given: Any,
) -> None:
    """Trace a load against another parameter, every point converged.

    KIND is lift-off, critical, secondary (the load at which a symmetric branch loses its symmetry), or twist (at which
    a rod prepared at lift-off lifts off again). End force at s = 1 in B/L², tension positive; T₁ in B/L.
    """
    from rodwell.store.folder import check_writable  # noqa: PLC0415

    if not len(over) == len(start) == len(end):
        raise click.UsageError("--over, --from and --to belong together.")
    given |= dict(zip(over, start, strict=True))  # whatever was given: the range counts
    problem = make_problem(_with_required(given, over))
    line = _on_a_line(over, start, end)
    assert line is not None
    check_writable(out)
    from rodwell.report.folders.branches import write_curves  # noqa: PLC0415

    with told() as ready, progress_bar(not as_json, f"{kind} curve") as tell:
        report = lambda done: tell(f"{kind} curve over {' and '.join(over)}", done)  # noqa: E731
        curves = _compute(kind, problem, *line, mode, modes, mirror, rtol, report)
        ready(lambda written: tell_curves(curves, out if written else None, as_json=as_json))
        tell("figure and data", 1.0)
        write_curves(curves, out)
    points = [(item, [p for p in item.points if not p.converged]) for item in curves]
    what = [
        f"{c.name}: {len(p)} of {len(c)} points, the first at {c.over} = {plain(p[0].x, 6)}" for c, p in points if p
    ]
    check_missed(what, rtol)


def _on_a_line(
    names: Sequence[str], first: Sequence[float], last: Sequence[float]
) -> tuple[Parameter, tuple[float, float]] | None:
    """What varies, and its range: one parameter, or t from 0 to 1 on a straight line from some values to others."""
    from rodwell.problem.varying import ParameterPath  # noqa: PLC0415

    if len(set(names)) < len(names):
        raise click.UsageError(f"{max(names, key=names.count)} is given twice.")
    if len(names) < 2:
        return (names[0], (first[0], last[0])) if names else None
    ends = zip(first, last, strict=True)
    return ParameterPath(dict(zip(names, ends, strict=True))), (0.0, 1.0)


def _with_required(given: dict[str, Any], over: Sequence[str]) -> dict[str, Any]:
    for name in ("weight", "alpha"):
        if given.get(name) is None and name not in over:
            raise click.UsageError(f"Missing option '--{name}'.")
    return given


def _compute(
    kind: str,
    problem: Problem,
    over: Parameter,
    limits: tuple[float, float],
    mode: int,
    modes: int,
    mirror: bool,
    rtol: float,
    progress: Callable[[float], None],
) -> Sequence[Curve]:
    from rodwell.analysis.curves.critical import critical_curves  # noqa: PLC0415
    from rodwell.analysis.curves.states import lift_off_curve, secondary_curve, twist_curve  # noqa: PLC0415

    if kind == "critical":
        return critical_curves(problem, over, limits, modes=modes, rtol=rtol, progress=progress)
    if kind == "lift-off":
        return [lift_off_curve(problem, over, limits, mode=mode, mirror=mirror, rtol=rtol, progress=progress)]
    if kind == "secondary":
        return [secondary_curve(problem, limits, over=over, mode=mode, rtol=rtol, progress=progress)]
    return [twist_curve(problem, limits, over=over, mode=mode, mirror=mirror, rtol=rtol, progress=progress)]
