"""What becomes of the rod at the loads that act, for one point of a study."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rodwell.answers.result.assessment import LEFT, PULLED, STRAIGHT, UNKNOWN, Assessment, AtLoad
from rodwell.answers.result.computed import Computed
from rodwell.case.applied import AppliedLoad
from rodwell.quantities.value import Value
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.section import RodStress, rod_section
from rodwell.strength.validity import Validity, validity

BUCKLES = "buckling"
"""Key of ``limits.NAMES`` for the first critical load."""


@dataclass(frozen=True)
class LoadResult:
    """The rod at one load of ``load.applied``.

    Attributes
    ----------
    load
        The load.
    what
        STRAIGHT, BUCKLED, OTHER_SHAPE, LEFT, UNKNOWN or PULLED, as in :mod:`rodwell.answers.result.assessment`.
    why
        For UNKNOWN, why; else what is amiss with the state, if anything.
    spare
        How much more compression until something gives, in B/L²; **negative**: that much beyond. By kind, the keys of
        ``limits.NAMES``; those that are not reached before the rod leaves the wall are missing.
    exceeded
        Kinds of strength that are used up at any load.
    reached
        Whether the branch of mode 1 goes so far; True where it was not asked to.
    contact
        Largest contact force per length on the wall, in B/L³; None where the state is not known.
    stress, safety
        Largest von Mises stress in the rod in **Pa**, and the safety factor against yield; None where there is none.
    """

    load: AppliedLoad
    what: str
    why: str = ""
    spare: Mapping[str, Value] = field(default_factory=dict)
    exceeded: tuple[str, ...] = ()
    contact: Value | None = None
    stress: Value | None = None
    safety: Value | None = None
    reached: bool = True


def assessed(computed: Computed) -> tuple[tuple[LoadResult, ...], Validity]:
    """Return what becomes of the rod at each load that acts, from its first critical load and its first branch.

    And how far the rod at buckling, at lift-off and at these loads is from what the theory assumes.
    """
    assessment = Assessment(computed)
    return tuple(_at(assessment, at) for at in assessment.applied), assessment.validity


def _at(a: Assessment, at: AtLoad) -> LoadResult:
    force, limits = at.load.force, a.window.limits
    lying = a.computed.lying
    spare = {BUCKLES: _to_spare(force, a.buckling)} if lying is None or lying.buckled is not None else {}
    spare |= {limit.kind: _to_spare(force, limit.load) for limit in limits if limit.load is not None}
    exceeded = tuple(limit.kind for limit in limits if limit.load is None)
    state, why = at.state, at.why
    if state is not None and state.solution is not None and not state.solution.converged:
        why = "the state does not meet the tolerance: its errors say how well it is known"
    stress = None if state is None else a.stress(state)
    return LoadResult(at.load, at.what, why, spare, exceeded, *_of_state(state, stress), reached=at.reached)


def _to_spare(force: float, limit: Value) -> Value:
    """How much more compression can be added to an end force until a limit."""
    return Value(force - limit.value, limit.error)


def _of_state(state: LoadedRod | None, stress: RodStress | None) -> tuple[Value | None, Value | None, Value | None]:
    """Contact, stress and safety factor of a state."""
    contact = None if state is None else state.contact
    return contact, stress, None if stress is None else stress.safety


def without_branch(computed: Computed, why: str) -> tuple[tuple[LoadResult, ...], Validity]:
    """The same where the buckled states could not be computed, for the reason ``why``: the straight ones are known.

    ``computed`` is without branches. A rod that leaves the wall of a curved hole by itself has left it beyond that.
    """
    case, first = computed.case, computed.buckling
    out, section = [], rod_section(case)
    straight = LoadedRod("at buckling", case.problem, first.value, first.error)
    acting = [("at the applied load", load.force) for load in case.applied]
    valid = validity(case, (straight,), acting, computed.critical[0].wavenumber)
    for load in case.applied:
        spare = {BUCKLES: _to_spare(load.force, first)}
        if computed.pulled_off(load.force):
            out.append(LoadResult(load, PULLED, why, spare))
            continue
        if load.force < first.value:
            left = computed.left_before is not None
            out.append(LoadResult(load, LEFT if left else UNKNOWN, why, spare, reached=left))
            continue
        state = LoadedRod("at the applied load", case.problem, load.force)
        stress = None if section is None else section.largest(state)
        out.append(LoadResult(load, STRAIGHT, "", spare, (), *_of_state(state, stress)))
    return tuple(out), valid
