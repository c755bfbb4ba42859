"""Load a rod in a hole quasi-statically, and unload it: its load path from the straight rod on."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from rodwell.analysis.discrete import first_run
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.off_wall.happening import END
from rodwell.analysis.path.bridged import bridging, farthest
from rodwell.analysis.path.checks import (
    check_in_space,
    check_tension,
    checked_bridging,
    checked_control,
    checked_problem,
    checked_range,
    checked_wall,
)
from rodwell.analysis.path.events import CRITICAL, LOADING, UNLOADING, Leg, PathPoint
from rodwell.analysis.path.legs import walked
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.path.loading import loaded
from rodwell.analysis.path.straightening import How
from rodwell.analysis.straight.critical import critical_loads
from rodwell.errors import InputError, NotConvergedError, RodwellError, checked_whole
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import RTOL, checked_rtol

SEEDS = 3
"""Random disturbances with which a rod that gives way is sent downhill, either way along its softest direction."""

Progress = Callable[[str, float], str | None]
"""Called with the leg and the end force; a text that it returns ends the path."""


def load_path(
    problem: Problem,
    *,
    until: float | None = None,
    unload_to: float | None = None,
    control: str = "force",
    axial_stiffness: float | None = None,
    spring: float | None = None,
    wall_stiffness: float = math.inf,
    mirror: bool = False,
    seeds: int = SEEDS,
    rtol: float = RTOL,
    progress: Progress | None = None,
) -> LoadPath:
    """Load a rod in a hole quasi-statically, let it buckle, lift off, and snap where it must, and unload it.

    Parameters
    ----------
    problem
        The rod; it may leave the wall.
    until
        End force at s = 1 in B/L², tension positive, to which the compression grows. It may be left out where the
        clearance has steps: the path ends there where the string buckles.
    unload_to
        End force to which it is taken back; None: not at all.
    control
        "force": the end force is a dead load; or "shortening": the approach of the ends is prescribed, as by a stiff
        machine. Then ``until`` and ``unload_to`` are shortenings in L, the load may pass extrema, and the stability
        index is that of the rod so held.
    axial_stiffness, spring
        EA of the rod in B/L², and stiffness k in B/L³ of a spring through which it is driven, where the shortening is
        controlled; None: rigid. Then ``until`` and ``unload_to`` are those of the driven end, u − F/EA − F/k with the
        shortening u of the shape, counted from the straight rod without end force. What the strain F/EA changes in the
        shape is left out.
    wall_stiffness
        Stiffness k L⁴/B of a wall that gives way: it pushes by k times the depth, per length, where the rod's axis is
        farther from the hole's than Δ. Infinite: a hard wall.
    mirror
        The other of the two arms of the buckling mode: with twist they differ.
    seeds
        How many random disturbances, each either way along the softest direction, are tried where the rod gives way.
    rtol
        Relative tolerance of every load reported.
    progress
        Called with the leg and the end force of each new state. A text that it returns ends the path there, as the
        reason, with all that was found.

    Notes
    -----
    Where the clearance has steps (``problem.sections``) the string bridges them, off the wall. It is followed in the
    vertical plane, from where it is stretched everywhere: its ``critical`` event is the first load at which a
    disturbance out of the plane grows. States beyond are not computed, nor are twist and unloading taken. A step is
    taken at its place along the rod: that the rod is pushed along the hole by its shortening is left out.

    In a curved hole (``problem.build``) the path begins with the rod that lies along the hole, from which energy and
    shortening count. The hole beside the rod is taken where the undeformed rod is: ``ContactState.own_places`` has a
    state without that. A rod in a drop may leave the wall before it buckles: then the path goes on in the vertical
    plane, up to where a disturbance out of it grows. A string of sections is bent by the hole, the stiffer ones by a
    larger moment: it is off the wall beside its steps, and is followed as one that bridges steps of its clearance,
    which it may have too. Where the hole leaves the vertical plane (``problem.walk``, ``problem.axis``) the rod is
    nowhere straight and has no critical load: the path begins with the rod as it lies on the wall without an end force
    (:func:`rodwell.lying_rod`; where it does not, at rest). Energy and shortening still count from the undeformed rod
    along the low side, which is no equilibrium there.

    Raises
    ------
    InputError
        For a rod outside the cylinder or on top of it, for loads out of range or order. In a curved hole for a soft
        wall, for a string out of the vertical plane or that tapers, for a rod that lies in its vertical plane only in
        tension; out of that plane for ball joints and loose ends.
    NotConvergedError
        If the straight rod's critical load, or the path's first state, could not be computed.
    """
    checked_problem(problem)
    model = rod_in_hole(problem, checked_wall(problem, wall_stiffness))
    rtol, way = checked_rtol(rtol), checked_control(problem, control, axial_stiffness, spring)
    bridges = problem.leaves_wall
    if bridges:
        checked_bridging(problem, control, unload_to, mirror)
    if until is None:
        if not bridges:
            raise InputError("until", None, "is missing: give the end force to which the rod is loaded")
        until = farthest(problem)
    until, unload_to = checked_range(way, until, unload_to)
    if problem.in_space:
        check_in_space(mirror, way, unload_to)
    elif not bridges:
        check_tension(problem, way, until=until, unload_to=unload_to)
    seeds = checked_whole("seeds", seeds, 1, 100)

    def told(leg: str) -> Callable[[float], str | None] | None:
        return None if progress is None else lambda force: progress(leg, force)

    if bridges:
        walks = [bridging(model, until, rtol, told(LOADING))]
    else:
        first_run.begin(problem)
        mode = None if problem.in_space else critical_loads(problem, 1, rtol=rtol)[0]
        how = How(way, rtol, seeds, mode, told(LOADING))
        walks = [loaded(model, until, mirror, how)]
        if walks[0].ended == END and unload_to is not None:
            how = How(way, rtol, seeds, mode, told(UNLOADING))
            walks.append(walked(walks[0].last, model, until, unload_to, Leg(UNLOADING), how))
    ended = next((walk.ended for walk in walks if walk.ended != END), "")
    events = tuple(replace(event, curved=problem.hole is not None) for walk in walks for event in walk.events)
    legs = tuple(walk.leg for walk in walks)
    return LoadPath(
        problem, until, unload_to, events, legs, not ended, ended, rtol, mirror, way.name, way.compliance,
        model.stiffness,
    )  # fmt: skip


def first_buckling(problem: Problem, rtol: float = RTOL, progress: Progress | None = None) -> LoadPath:
    """The path of a string that leaves the wall by itself, until it buckles out of its plane; arguments of load_path.

    Raises
    ------
    NotConvergedError
        If it does not, as far as it was followed.
    """
    path = load_path(problem, rtol=rtol, progress=progress)
    if path.first(CRITICAL) is None:
        why = path.ended_because or f"it was followed to F = {path.until:.6g} B/L²"
        raise NotConvergedError(f"no load was found at which the string buckles out of its plane: {why}")
    return path


def not_held_at_steps(problem: Problem, rtol: float = RTOL, progress: Progress | None = None) -> PathPoint | str | None:
    """Where a string buckles sideways that a curved hole keeps off its wall beside steps of the stiffness; or why not.

    Beside it stands the critical load of one whose slope something holds there, on the wall all along. None of strings
    without such steps, of those that bridge, and out of the vertical plane.
    """
    if problem.hole is None or not problem.hole.planar or problem.bridges or not problem.rod.stepped:
        return None
    try:
        return first_buckling(problem, rtol, progress).first(CRITICAL)
    except RodwellError as error:
        return str(error)
