"""Torque and drag of a whole well: every operation of its file, with bounds where several local states are stable."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.errors import InputError
from rodwell.faces import Shown, drawn, plain
from rodwell.quantities.value import Value
from rodwell.studies.drag.bending import StiffRun, stiff_run
from rodwell.studies.drag.history import History, run_with_history, states_differ
from rodwell.studies.drag.laws import STRAIGHT_LAW, Contact, contact_named, correlation
from rodwell.studies.drag.lock_up import Reach, reach, transfer
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.road_map import RoadMap, road_map
from rodwell.studies.drag.run import Run, balance, error_of, errors_along, run
from rodwell.studies.drag.strength import Strength, strength_of
from rodwell.studies.drag.well_case import DOWNWARD, Operation, Well

if TYPE_CHECKING:
    from rodwell.faces import Axes

Progress = Callable[[str, float], None]

BALANCED = 1e-8
"""Largest difference of work that passes, as a part of all work."""


@dataclass(frozen=True)
class Ends:
    """Hook load in N (tension positive, without the block) and torque at surface in N m; None where it locks up."""

    hook_load: Value | None
    torque: Value | None


@dataclass(frozen=True)
class OperationResult:
    """What was found of one operation.

    Attributes
    ----------
    operation
        What is done.
    run
        Forces along the string by the law and the rule that the well asks for.
    ends
        Hook load and torque of it.
    bounds
        The same with the helix wherever it may be ("early") and with the sinusoidal state wherever it may be ("late").
    compared
        The same by other laws: "straight" (without buckling), "correlation", "exact"; for a stiff string "soft" too.
    reach
        How deep it can go, by rule ("early" and "late"); empty for what does not go down.
    transfer
        Part of a force added at surface that arrives at the bit; None where it locks up, or for what does not go down.
    strength
        What the string bears.
    balance
        How far the work of the ends differs from that of gravity and friction, as a part of all work; None if locked.
    margin
        Push that is left in N with the bit at its depth, before that of string, block and injector ends: worse of the
        bounds; None if locked.
    force_errors
        Errors of the forces along the string in N, (m,), for the rows of ``run``.
    settled
        Whether a stiff string's axial force and bending have settled together; True for a soft one.
    """

    operation: Operation
    run: Run
    ends: Ends
    bounds: dict[str, Ends]
    compared: dict[str, Ends]
    reach: dict[str, Reach]
    transfer: float | None
    strength: Strength
    balance: Value | None
    margin: Value | None
    force_errors: np.ndarray
    settled: bool = True

    @property
    def possible(self) -> bool:
        """Whether the string gets there, past every depth looked at on the way, by the worse of the bounds."""
        return self.possible_at_depth and not self.stopped

    @property
    def possible_at_depth(self) -> bool:
        """Whether the push there is suffices with the bit at its depth, by the worse of the bounds."""
        return self.margin is not None and self.margin.value >= 0.0

    @property
    def stopped(self) -> bool:
        """Whether the string, its bit free, cannot get past a depth on the way, by the worse of the bounds."""
        return any(found.on_the_way for found in self.reach.values())

    @property
    def locked(self) -> bool:
        """Whether no push at surface suffices, by the worse of the bounds."""
        return any(ends.hook_load is None for ends in (self.ends, *self.bounds.values()))


@dataclass(frozen=True)
class Drag(Shown):
    """Torque and drag of a well: forces in N, tension positive, effective; torques in N m; depths measured, in m.

    Attributes
    ----------
    well
        What was asked for.
    operations
        What was found, in the order of the file.
    contact
        The law of contact.
    road_map
        Hook load and torque against the depth of the bit, if the well asks for it.
    """

    well: Well
    operations: tuple[OperationResult, ...]
    contact: Contact
    road_map: RoadMap | None = None

    @cached_property
    def balanced(self) -> bool:
        """Whether the work of every run balances."""
        return all(one.balance is None or one.balance.value <= BALANCED for one in self.operations)

    def as_dict(self) -> dict[str, Any]:
        """Everything as plain data, for JSON."""
        return plain(self)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the effective force of every operation with the limits of buckling, against measured depth."""
        return drawn(self, ax)


def drag(well: Well, progress: Progress | None = None) -> Drag:
    """Compute every operation of a well.

    Raises
    ------
    InputError
        If the well has no operation, or asks for a road map of a stiff string.
    """
    if not isinstance(well, Well):
        raise InputError("well", well, 'must be a rodwell Well: Well.read("well.toml") or Well.from_dict')
    if not well.operations:
        raise InputError("well.operation", None, "is missing: give [[well.operation]] with a kind, for example run-in")
    if well.settings.string == "stiff" and well.settings.road_map is not None:
        what = "is computed for the soft string only: leave it out, or [well] string"
        raise InputError("well.road_map", None, what)
    tell = progress or (lambda _what, _done: None)
    cutter = Cutter(well)
    contact = contact_named(well.settings.contact)
    history = History(cutter, contact)
    results = []
    for i, operation in enumerate(well.operations):
        tell(operation.name, 0.7 * i / len(well.operations))
        computed = _stiff if well.settings.string == "stiff" else _computed
        results.append(computed(well, cutter, history, operation))
    return Drag(well, tuple(results), contact, road_map(well, lambda what, done: tell(what, 0.7 + 0.3 * done)))


def _computed(well: Well, cutter: Cutter, history: History, operation: Operation) -> OperationResult:
    contact, rule = history.contact, well.settings.state_rule
    one = run_with_history(history, operation, rule)
    rough = run_with_history(history, operation, rule, coarse=True)
    ends = _ends(one, rough)
    several = states_differ(history, operation)
    bounds = {name: _by_rule(cutter, operation, contact, name) if several else ends for name in ("early", "late")}
    others = [law for law in (STRAIGHT_LAW, correlation(), contact) if law.name != contact.name]
    compared = {law.name: _by_rule(cutter, operation, law, "equal-energy") for law in others}
    compared[contact.name] = ends
    margin = _margin(well, ends, bounds)
    down = operation.kind in DOWNWARD
    reaches = {}
    if down:
        deepest = min(well.end, float(cutter.string_ends[-1]))
        first = reach(cutter, operation, contact, "early", deepest)
        # the helix presses more than the sinusoidal state: what passes with it everywhere passes with the other
        passes = first.push_ends is None and margin is not None and margin.value >= 0.0
        same = contact.one_state or passes
        reaches = {"early": first, "late": first if same else reach(cutter, operation, contact, "late", deepest)}
    return OperationResult(
        operation, one, ends, bounds, compared, reaches,
        transfer(cutter, operation, contact, rule) if down else None,
        strength_of(well, one), balance(one, well.survey) if one.arrived else None, margin,
        errors_along(one, rough),
    )  # fmt: skip


def _stiff(well: Well, cutter: Cutter, history: History, operation: Operation) -> OperationResult:
    """The same for a stiff string; how deep it can go is not searched."""
    contact, rule = history.contact, well.settings.state_rule
    several = states_differ(history, operation)
    remembered = history.before(operation) if rule == "history" else ()
    mine = stiff_run(cutter, operation, contact, rule, remembered)
    ends = _stiff_ends(mine)
    bounds = {
        name: _stiff_ends(stiff_run(cutter, operation, contact, name)) if several else ends
        for name in ("early", "late")
    }
    laws = {"straight": STRAIGHT_LAW, "correlation": correlation(), "soft": contact}
    compared = {name: _by_rule(cutter, operation, law, "equal-energy") for name, law in laws.items()}
    one = mine.run
    return OperationResult(
        operation, one, ends, bounds, compared | {contact.name: ends}, {}, None, strength_of(well, one, mine.curvature),
        balance(one, well.survey) if one.arrived else None, _margin(well, ends, bounds),
        np.full(len(one.rows), mine.hook_load.error), mine.settled,
    )  # fmt: skip


def _stiff_ends(found: StiffRun) -> Ends:
    return Ends(found.hook_load, found.torque) if found.run.arrived else Ends(None, None)


def _margin(well: Well, ends: Ends, bounds: dict[str, Ends]) -> Value | None:
    """Push that is left, by the worse of the bounds; None if any of them locks up."""
    known = [b.hook_load for b in (ends, *bounds.values())]
    loads = [load for load in known if load is not None]
    if len(loads) < len(known):
        return None
    worst = min(loads, key=lambda load: load.value)
    return Value(worst.value + well.push, worst.error)


def _by_rule(cutter: Cutter, operation: Operation, contact: Contact, rule: str) -> Ends:
    fine = run(cutter, operation, contact, rule)
    return _ends(fine, run(cutter, operation, contact, rule, coarse=True))


def _ends(fine: Run, coarse: Run) -> Ends:
    if not fine.arrived or not math.isfinite(fine.force):
        return Ends(None, None)
    force, torque = error_of(fine, coarse)
    return Ends(Value(fine.force, force), Value(fine.torque, torque))
