"""Beyond lift-off: the load path of a case as the load grows, and as it is taken off again, with stress on the way."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from rodwell.analysis.off_wall.curved.refused import in_such_a_hole
from rodwell.analysis.off_wall.state import ContactState, PointForce, contact_state
from rodwell.analysis.path.events import LOADING, SNAP, PathPoint
from rodwell.analysis.path.follow import Progress, load_path
from rodwell.analysis.path.load_path import LoadPath
from rodwell.answers.result.computed import PATIENCE, TOO_LONG, Computed
from rodwell.answers.result.lying import followed_from
from rodwell.case.applied import AppliedLoad
from rodwell.errors import NotConvergedError, RodwellError
from rodwell.quantities.value import Value
from rodwell.strength.off_wall import RodOffWall
from rodwell.strength.section import RodSection, RodStress, StringSections, rod_section

REACH = 1.5
"""Compression to which the rod is loaded, as a part of that at lift-off, both at mid-length."""

REACH_ARCHED = 2.2
"""The same of a rod that nothing presses to the wall, which buckles early: clamped, it has left its plane then."""

BACK = 0.6
"""Compression to which it is taken off, as a part of that at buckling, both at mid-length."""

SAME_LOAD = 1e-7
"""Part of a load by which the last state before a snap may differ from it."""


@dataclass(frozen=True, eq=False)
class StateBeyond:
    """A state on the path: at an event, or at a load that acts.

    Attributes
    ----------
    leg
        "loading" or "unloading".
    load
        End force at s = 1 in B/L², tension positive.
    state
        The rod there: gaps, contacts, point forces.
    stress
        Largest von Mises stress in the rod, None where the section is not known.
    """

    leg: str
    load: Value
    state: ContactState
    stress: RodStress | None

    @property
    def largest_point_force(self) -> PointForce | None:
        """The largest concentrated force on the wall; None without one."""
        return max(self.state.point_forces, key=lambda one: one.force.value, default=None)

    @property
    def largest_gap(self) -> Value | None:
        """The largest gap between rod and wall in Δ; None where there is none."""
        return max((gap.largest for gap in self.state.gaps), key=lambda gap: gap.value, default=None)


@dataclass(frozen=True, eq=False)
class Step:
    """An event with the state there (None for the buckling of the straight rod); ``before``: just before a snap."""

    event: PathPoint
    state: StateBeyond | None
    before: bool = False

    @property
    def meaning(self) -> str:
        """What happens, in words."""
        return "just before the rod gives way" if self.before else self.event.meaning


@dataclass(frozen=True, eq=False)
class Beyond:
    """What happens beyond lift-off.

    Attributes
    ----------
    path
        The load path; None where there is none, or it failed.
    why
        Why there is none; "" otherwise.
    events
        Each event of the path with its state; a snap twice, with the state just before it and with that after it.
    applied
        Loads that act beyond lift-off, with the state there, or why it is not known.
    """

    path: LoadPath | None
    why: str
    events: tuple[Step, ...] = ()
    applied: tuple[tuple[AppliedLoad, StateBeyond | str], ...] = ()

    @property
    def missed(self) -> tuple[str, ...]:
        """Events whose load misses the tolerance, in words."""
        return () if self.path is None else tuple(f"beyond lift-off: {what}" for what in self.path.missed)


def beyond(computed: Computed) -> Beyond:
    """Follow a case beyond lift-off and back.

    The load goes to the loads that act and that asked for, at least to ``REACH``, and comes back to ``BACK``. Nothing
    is raised: what was computed on the wall must not be lost.
    """
    begun = time.process_time()

    def progress(_leg: str, _force: float) -> str | None:
        if time.process_time() - begun <= PATIENCE:
            return None
        return TOO_LONG

    path, why = followed(computed, progress)
    if path is None:
        return Beyond(None, why)
    lift, section = off_at(computed), rod_section(computed.case)
    assert lift is not None
    events = tuple(step for one in path.events for step in _steps(path, one, section))
    applied = tuple((load, _at_load(path, load, section)) for load in computed.case.applied if load.force < lift)
    return Beyond(path, "", events, applied)


def followed(computed: Computed, progress: Progress) -> tuple[LoadPath | None, str]:
    """The load path of a case, or None and why there is none.

    ``progress`` is that of :func:`rodwell.load_path`; what it raises that is no error of the library ends it.
    """
    case = computed.case
    if not in_such_a_hole(case.problem):
        return None, (
            "states off the wall of a curved hole are computed of a uniform rod; `rodwell path` has a string of "
            "sections in a hole that stays in a vertical plane until it buckles"
        )
    left = computed.left_before
    if left is not None and left.value >= 0.0:
        return None, (
            "without an end force the curve presses the rod off the side of the hole where it was to lie, and there is "
            "nothing that a load path could begin with"
        )
    if off_at(computed) is None:
        return None, "no lift-off was found on the first branch, so there is nothing beyond it"
    until, back = reach(computed)
    try:
        path = load_path(
            case.problem, until=until, unload_to=back, wall_stiffness=case.wall_stiffness,
            mirror=computed.first.origin.mirror, rtol=case.rtol, progress=progress,
        )  # fmt: skip
    except RodwellError as error:
        return None, str(error)
    except (ArithmeticError, ValueError) as error:  # of linear algebra: a defect, and the answer on the wall stands
        return None, f"it failed ({type(error).__name__}: {error})"
    return path, ""


def off_at(computed: Computed) -> float | None:
    """End force at s = 1 in B/L² at which the rod leaves the wall: at lift-off, or of a curved hole before it buckles.

    In one that leaves the vertical plane also where it loses its stability as it lies. None where nothing of this was
    found. Of a rod that the curve presses off the wall at no load there is no path.
    """
    if computed.lift_off is not None:
        return computed.lift_off.force
    left = None if computed.left_before is None else computed.left_before.value
    if computed.lying is not None and computed.lying.end is not None:
        left = computed.lying.lowest.value
    return left if left is not None and followed_from(computed.case.problem, left) else None


def reach(computed: Computed) -> tuple[float, float]:
    """End forces at s = 1 in B/L² to which the rod is loaded, and unloaded; where it is nowhere straight, to none."""
    case, lift = computed.case, off_at(computed)
    assert lift is not None
    half = -case.problem.axial_weight * float(case.problem.rod.lever(np.array([0.5]))[0])
    asked = [load.force for load in case.applied] + ([] if case.until is None else [case.until])
    reach = REACH_ARCHED if case.problem.untouched else REACH
    until = min([half - reach * (half - lift), *asked])
    if computed.lying is not None:
        return until, 0.0
    back = half - BACK * (half - computed.buckling.value)
    return until, max(back, computed.buckling.value)


def _steps(path: LoadPath, event: PathPoint, section: RodSection | StringSections | None) -> list[Step]:
    """An event with its state; of a snap, with the state just before it, then with that to which the rod snaps."""
    states = [event.state] if event.kind != SNAP else [_before(path, event), event.state]
    found = [None if one is None else StateBeyond(event.leg, event.force, one, _stress(one, section)) for one in states]
    if event.kind == SNAP and found[0] is None:
        found = found[1:]
    return [Step(event, one, before=len(found) == 2 and i == 0) for i, one in enumerate(found)]


def _before(path: LoadPath, snap: PathPoint) -> ContactState | None:
    """The last state before a snap, at its load; None where it was not kept."""
    size = SAME_LOAD * max(abs(snap.force.value), 1.0)
    for leg in path.legs:
        for run in leg.runs if leg.name == snap.leg else []:
            if run and abs(run[-1].load - snap.force.value) <= size:
                try:
                    return contact_state(run[-1])
                except NotConvergedError:  # right at a limit point the finer elements may have no state at this load
                    return None
    return None


def _at_load(path: LoadPath, load: AppliedLoad, section: RodSection | StringSections | None) -> StateBeyond | str:
    """The state at a load that acts, as it grows; or why it is not known."""
    try:
        found = next(one for one in path.at(load.force) if one.leg == LOADING)
    except StopIteration:
        return "the path does not pass it"
    except RodwellError as error:
        return str(error)
    return StateBeyond(LOADING, Value(load.force), found.state, _stress(found.state, section))


def _stress(state: ContactState, section: RodSection | StringSections | None) -> RodStress | None:
    return None if section is None else section.largest(RodOffWall(state))
