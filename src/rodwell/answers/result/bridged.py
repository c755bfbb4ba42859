"""What is computed for a case whose clearance has steps: the string that bridges them, until it buckles sideways."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from rodwell.analysis.off_wall.state import ContactState, PointForce, contact_state
from rodwell.analysis.path.bridged import farthest
from rodwell.analysis.path.events import CRITICAL, LOADING, PathPoint
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.load_path import LoadPath
from rodwell.answers.result.beyond import StateBeyond
from rodwell.answers.result.computed import PATIENCE, TOO_LONG
from rodwell.case.applied import AppliedLoad
from rodwell.case.case import Case
from rodwell.errors import NotConvergedError, RodwellError
from rodwell.problem.ends import OFF_WALL_ENDS
from rodwell.problem.profile import extremes
from rodwell.problem.words import where_it_bridges
from rodwell.quantities.value import Value
from rodwell.strength.off_wall import RodOffWall
from rodwell.strength.section import RodSection, StringSections, rod_section

PART_OF_HOLE, TOOL_JOINT, THICKER = "narrower part of the hole", "tool joint", "thicker section of the string"
"""What may have the edge that a string touches at a step of its clearance."""

SAME = 1e-9
"""Relative distance from the buckling load within which a load counts as at it, not below."""


@dataclass(frozen=True, eq=False)
class Bridged:
    """A case whose clearance has steps.

    Attributes
    ----------
    case
        The case.
    path
        The string as the compression grows, in the vertical plane.
    buckling
        The load at which it buckles sideways, with the state there; None where none was found.
    alone
        The string without end compression, or stretched so that nothing is compressed.
    applied
        Loads that act, with the state there, or why it is not known.
    """

    case: Case
    path: LoadPath
    buckling: tuple[PathPoint, StateBeyond] | None
    alone: StateBeyond
    applied: tuple[tuple[AppliedLoad, StateBeyond | str], ...]

    @property
    def missed(self) -> tuple[str, ...]:
        """Loads that miss the tolerance, and the state without compression if it misses its balance, in words."""
        certificate = self.alone.state.certificate
        if certificate.passed:
            return self.path.missed
        return (*self.path.missed, f"how it lies without compression, balance missed by {certificate.worst:.1e}")

    @property
    def converged(self) -> bool:
        """Whether every load meets the tolerance."""
        return not self.missed

    def edge_of(self, place: float) -> str:
        """What has the edge that the string touches at a place, s/L, of a step."""
        pairs = self.case.pairs
        below, above = min(pairwise(pairs), key=lambda two: abs(two[1].start - place))
        narrow = below if extremes(below.clearance) < extremes(above.clearance) else above
        if below.member is above.member or narrow.member is None:
            return PART_OF_HOLE
        if narrow.member.tool_joint:
            return TOOL_JOINT
        return THICKER if below.part is above.part else PART_OF_HOLE

    @property
    def edges(self) -> tuple[PointForce, ...]:
        """Edges that it touches without compression, from s = 0."""
        return tuple(point for point in self.alone.state.point_forces if point.kind == "edge")

    @property
    def levered(self) -> tuple[PointForce, ...]:
        """Of these the ones that are the first contact beside an end that holds the slope: the end levers there."""
        state = self.alone.state
        places = [point.s.value for point in state.point_forces]
        places += [place.value for contact in state.contacts for place in (contact.start, contact.end)]
        held = [end not in OFF_WALL_ENDS for end in self.case.problem.ends]
        first = {place for place, holds in zip((min(places, default=0.0), max(places, default=1.0)), held, strict=True)
                 if holds}  # fmt: skip
        return tuple(point for point in self.edges if point.s.value in first)

    def share(self, load: AppliedLoad) -> float | None:
        """Compression at s = 1 over that at which the string buckles, from where it is stretched everywhere."""
        if self.buckling is None:
            return None
        top = self.alone.load.value
        return (top - load.force) / (top - self.buckling[0].force.value)


def bridged_answer(case: Case, tell: Callable[[str, float], None] = lambda _what, _done: None) -> Bridged:
    """Follow the string of a case until it buckles sideways, and find it under the loads that act.

    ``tell`` is called with what is being done, and how much of the range of loads has been passed.

    Raises
    ------
    InputError
        For what is not computed where the clearance has steps, with the reason.
    NotConvergedError
        If it was not found how the string lies under its weight.
    """
    begun, section, far = time.process_time(), rod_section(case), abs(farthest(case.problem))

    def progress(leg: str, force: float) -> str | None:
        tell(f"{leg}, F = {force:.4g} B/L²", min(abs(force) / far, 1.0))
        if time.process_time() - begun <= PATIENCE:
            return None
        return TOO_LONG

    path = load_path(case.problem, rtol=case.rtol, progress=progress)
    found, buckling = path.first(CRITICAL), None
    if found is not None and found.state is not None:
        buckling = found, _there(found.state, found.force, section)
    top = path.legs[0].runs[0][0].load
    alone = _there(_lying(path, top), Value(top), section)
    applied = tuple((load, _at_load(path, load, top, found, section)) for load in case.applied)
    return Bridged(case, path, buckling, alone, applied)


def _lying(path: LoadPath, top: float) -> ContactState:
    """The first state of a path; one that misses its balance too, as beside stations of a survey that are far apart."""
    try:
        return path.at(top)[0].state
    except NotConvergedError:
        return contact_state(path.legs[0].runs[0][0])


def _at_load(
    path: LoadPath, load: AppliedLoad, top: float, found: PathPoint | None, section: RodSection | StringSections | None
) -> StateBeyond | str:
    """The string under a load that acts, or why it is not known."""
    if found is not None and load.force <= found.force.value * (1.0 - SAME):
        where = where_it_bridges(path.problem)
        return f"the string has buckled sideways: states beyond are not computed {where}"
    try:
        if load.force > top:  # stretched more than where the path begins
            path = load_path(path.problem, until=load.force, rtol=path.rtol)
        return _there(path.at(load.force)[0].state, Value(load.force), section)
    except RodwellError as error:
        return str(error)


def _there(state: ContactState, load: Value, section: RodSection | StringSections | None) -> StateBeyond:
    return StateBeyond(LOADING, load, state, None if section is None else section.largest(RodOffWall(state)))
