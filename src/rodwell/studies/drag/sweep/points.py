"""What a parameter study of torque and drag keeps of an operation: its numbers, without what is along the string."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.quantities.value import Value
from rodwell.studies.drag.contact import NAMES
from rodwell.studies.drag.drag import OperationResult
from rodwell.studies.drag.plain import largest
from rodwell.studies.drag.tables import worst_depth
from rodwell.studies.drag.well_case import Operation, Well
from rodwell.studies.drag.words import FAILS, failure, level_of_one


@dataclass(frozen=True)
class OperationAt:
    """One operation at one point: forces in N, tension positive, effective; torques in N m; measured depths in m.

    Attributes
    ----------
    operation
        What is done.
    hook_load, torque
        At surface; None where the string locks up.
    early, late
        Hook load with the helix wherever it may be, and with the sinusoidal state wherever it may be.
    margin
        Push that is left, by the worse of these; None where it locks up.
    lock_up, push_ends
        Depth of the bit from which no push moves the string, and from which the push there is does not suffice; None
        where neither happens, or for what does not go down.
    buckled
        Length in m by the name of the local state.
    contact, von_mises, used
        Largest contact force in N/m and stress in Pa along the string, and the part of the yield strength; None where
        unknown.
    not_judged
        Sections of the string whose yield strength is not given.
    level, why
        Verdict, and why the operation fails; "" if it does not.
    """

    operation: Operation
    hook_load: Value | None
    torque: Value | None
    early: Value | None
    late: Value | None
    margin: Value | None
    lock_up: Value | None
    push_ends: Value | None
    buckled: dict[str, float]
    contact: Value | None
    von_mises: Value | None
    used: Value | None
    not_judged: tuple[str, ...]
    level: str
    why: str


@dataclass(frozen=True)
class WellPoint:
    """One point of a study.

    Attributes
    ----------
    number, at
        From 0; which of its values each varied input has.
    operations
        In the order of the file; none where the point could not be computed.
    push
        Largest push at surface in N: block and what pushes beside it.
    missed
        What does not balance or has not settled.
    reason
        Why the point could not be computed.
    """

    number: int
    at: tuple[int, ...]
    operations: tuple[OperationAt, ...] = ()
    push: float = 0.0
    missed: tuple[str, ...] = ()
    reason: str = ""


def operation_at(well: Well, one: OperationResult) -> OperationAt:
    """What is kept of an operation."""
    arrived, level = one.run.arrived, level_of_one(one)
    buckled: dict[str, float] = {}
    for low, high, state in one.run.buckled:
        buckled[NAMES[state]] = buckled.get(NAMES[state], 0.0) + low - high
    contact, von_mises, used = (
        largest(along) if arrived else None for along in (one.run.contacts, one.strength.von_mises, one.strength.used)
    )
    return OperationAt(
        one.operation, one.ends.hook_load, one.ends.torque, one.bounds["early"].hook_load,
        one.bounds["late"].hook_load, one.margin, worst_depth(one, "lock_up"), worst_depth(one, "push_ends"), buckled,
        contact, von_mises, used, one.strength.not_judged, level, failure(well, one) if level == FAILS else "",
    )  # fmt: skip
