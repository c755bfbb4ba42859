"""Which numbers maps are made of: a registry, to which a new one adds one line."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.special import BRANCH_POINT, SpecialPoint
from rodwell.analysis.discrete.measures import Measured
from rodwell.answers.result.assessment import BUCKLED, LEFT, OTHER_SHAPE, STRAIGHT
from rodwell.answers.result.reach import no_lift_off, out_of_reach
from rodwell.errors import NotConvergedError
from rodwell.quantities.value import Peak, Value
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.section import rod_section
from rodwell.studies.maps.cells import (
    ANOTHER_SHAPE,
    CONVERGED,
    MISSES_TOLERANCE,
    NOT_DEFINED,
    NOT_REACHED,
    OFF_THE_WALL,
    Found,
    MappedRod,
    NoSuchNumber,
)

SECONDARY_REACH = 8.0
"""How far a branch is searched for its secondary bifurcation, in scales of load of its mode, as for curves."""


@dataclass(frozen=True)
class MapNumber:
    """A number of which a map can be made.

    Attributes
    ----------
    name
        As it is asked for.
    label, symbol
        For people and figures.
    dimension
        As in :mod:`rodwell.quantities.names`; of "stress" values are in Pa, others are dimensionless.
    of
        Computes it for a rod, or raises :class:`NoSuchNumber`.
    at_load
        Whether it belongs to a load that acts.
    """

    name: str
    label: str
    symbol: str
    dimension: str
    of: Callable[[MappedRod], Found]
    at_load: bool = False


def _critical(rod: MappedRod) -> Found:
    return Found(CONVERGED, rod.buckling, wavenumber=rod.wavenumber)


def _lift_off(rod: MappedRod) -> Found:
    branch = rod.branch
    lift = branch.lift_off
    if lift is None:
        raise NoSuchNumber(NOT_REACHED, no_lift_off(rod.case.scales, branch), rod.wavenumber)
    if branch.lift_off_at_buckling:
        return Found(CONVERGED, rod.buckling, wavenumber=rod.wavenumber, reason="lift-off coincides with buckling")
    return _point(rod, lift)


def _limit(rod: MappedRod) -> Found:
    end = rod.branch.end_of_the_way
    if end is None:
        raise NoSuchNumber(NOT_REACHED, no_lift_off(rod.case.scales, rod.branch), rod.wavenumber)
    return _lift_off(rod) if rod.branch.lift_off_at_buckling else _point(rod, end)


def _secondary(rod: MappedRod) -> Found:
    problem, mode = rod.case.problem, rod.critical[0]
    if not problem.symmetric or mode.parity == 0:
        why = "no branch has a symmetry to lose: alpha must be 90 and the ends equal"
        raise NoSuchNumber(NOT_DEFINED, why, rod.wavenumber)
    until = mode.force - SECONDARY_REACH * mode.wavenumber**2
    branch = follow(problem, mode, until=until, rtol=rod.case.rtol, largest_step=rod.largest_step)
    point = next((point for point in branch.special_points if point.kind == BRANCH_POINT), None)
    if point is None:
        why = f"no secondary bifurcation down to F = {branch.force.min():.6g} B/L²"
        raise NoSuchNumber(NOT_REACHED, why, rod.wavenumber)
    return _judged(rod, point.load, branch.meets_tolerance(point))


def _point(rod: MappedRod, point: SpecialPoint) -> Found:
    return _judged(rod, point.load, rod.branch.meets_tolerance(point), point.s[0] if point.s else math.nan)


def _judged(rod: MappedRod, value: Value, good: bool, place: float = math.nan) -> Found:
    reason = "" if good else "misses the tolerance: the error says how well it is known"
    return Found(CONVERGED if good else MISSES_TOLERANCE, value, place, rod.wavenumber, reason)


def _at_load(number: Callable[[MappedRod, LoadedRod], Value]) -> Callable[[MappedRod], Found]:
    """A number of the state at the load that acts: straight, or buckled on the wall and stable."""

    def of(rod: MappedRod) -> Found:
        at = rod.at_load
        if at.state is None or at.what not in (STRAIGHT, BUCKLED):
            outcome = {LEFT: OFF_THE_WALL, OTHER_SHAPE: ANOTHER_SHAPE}.get(at.what, NOT_REACHED)
            if outcome == NOT_REACHED and not out_of_reach(rod.branch, at.load.force):
                raise NotConvergedError(at.why)
            raise NoSuchNumber(outcome, at.why, rod.wavenumber)
        value = number(rod, at.state)
        solution = at.state.solution
        found = _judged(
            rod, value, solution is None or solution.converged, value.s if isinstance(value, Peak) else math.nan
        )
        return Found(found.outcome, found.value, found.place, 0.0 if solution is None else rod.wavenumber, found.reason)

    return of


def _stress(rod: MappedRod, state: LoadedRod) -> Value:
    section = rod_section(rod.case)
    if section is None:
        raise NoSuchNumber(NOT_DEFINED, "needs a case with dimensions and the rod's outer diameter")
    found = section.largest(state)
    return Peak(found.value, found.error, found.s)


def _shortening(_rod: MappedRod, state: LoadedRod) -> Value:
    return Value(0.0) if state.solution is None else state.solution.number(Measured.SHORTENING)


_FORCE = "end force at s = 1, tension positive"

NUMBERS: dict[str, MapNumber] = {
    one.name: one
    for one in (
        MapNumber("critical", f"first critical load, {_FORCE}", "F_cr", "force", _critical),
        MapNumber("lift-off", f"lift-off load of mode 1, {_FORCE}", "F_lift", "force", _lift_off),
        MapNumber("limit", f"load at which mode 1 leaves the wall or loses its stability, {_FORCE}", "F_lim",
                  "force", _limit),
        MapNumber("secondary", f"load at which mode 1 loses its symmetry, {_FORCE}", "F_sec", "force", _secondary),
        MapNumber("contact", "largest contact force per length on the wall", "max |p|", "force_per_length",
                  _at_load(lambda _, state: state.contact), at_load=True),
        MapNumber("contact-total", "contact force on the wall in all", "∫|p|", "force",
                  _at_load(lambda _, state: state.total_contact), at_load=True),
        MapNumber("shortening", "approach of the ends by buckling, 1 − z(1)", "1 − z(1)", "length",
                  _at_load(_shortening), at_load=True),
        MapNumber("stress", "largest von Mises stress in the rod", "σ", "stress", _at_load(_stress), at_load=True),
    )
}  # fmt: skip
"""Numbers by name. A new one is a line here, with a function from a rod to what is found."""
