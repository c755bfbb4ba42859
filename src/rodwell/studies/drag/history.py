"""What a string remembers: where it is helical since it has been loaded beyond what the sinusoidal state bears.

Loaded, the straight string becomes sinusoidal and stays so until that state leaves the wall; unloaded, the helix stays
until it ceases. In between both are there, and what was before decides. So the string is run in to the depth in stages
with its bit free, then the force at the bit is built up; at each stage it keeps what it was where it may.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rodwell.studies.drag.contact import HELICAL
from rodwell.studies.drag.laws import Contact
from rodwell.studies.drag.pieces import Cutter, Interval
from rodwell.studies.drag.run import Run, run
from rodwell.studies.drag.well_case import Operation

RUNNING_IN, BUILDING_UP = 24, 8
"""Stages in which the string is run in, and in which the force at the bit is built up."""


class History:
    """The history of a string in a well under one law of contact; running in is computed once for each depth."""

    def __init__(self, cutter: Cutter, contact: Contact) -> None:
        self.cutter, self.contact = cutter, contact
        self._run_in: dict[float, tuple[Interval, ...]] = {}

    def before(self, operation: Operation, depth: float | None = None) -> tuple[Interval, ...]:
        """Where the string is helical before an operation: distances above the bit in m."""
        place = operation.bit_depth if depth is None else depth
        if self.contact.one_state:
            return ()
        memory = self._after_running_in(place)
        if operation.bit_force < 0.0:
            for force in operation.bit_force * np.arange(1, BUILDING_UP) / BUILDING_UP:
                memory = self._after(operation, place, float(force), memory)
        return memory

    def _after_running_in(self, depth: float) -> tuple[Interval, ...]:
        if depth not in self._run_in:
            going_in = Operation("run-in", "run-in", depth)
            memory: tuple[Interval, ...] = ()
            for place in depth * np.arange(1, RUNNING_IN + 1) / RUNNING_IN:
                memory = self._after(going_in, float(place), 0.0, memory)
            self._run_in[depth] = memory
        return self._run_in[depth]

    def _after(
        self, operation: Operation, depth: float, force: float, memory: Sequence[Interval]
    ) -> tuple[Interval, ...]:
        one = run(self.cutter, operation, self.contact, "history", depth=depth, bit_force=force, remembered=memory,
                  coarse=True)  # fmt: skip
        return tuple(one.intervals(HELICAL))


def run_with_history(
    history: History, operation: Operation, rule: str, *, depth: float | None = None, coarse: bool = False
) -> Run:
    """One operation by a rule, with what was before where the rule is "history"."""
    remembered = history.before(operation, depth) if rule == "history" else ()
    return run(history.cutter, operation, history.contact, rule, depth=depth, remembered=remembered, coarse=coarse)


def states_differ(history: History, operation: Operation, depth: float | None = None) -> bool:
    """Whether rules can differ: somewhere both states are there under the loads of the operation."""
    if history.contact.one_state:
        return False
    first, last = (
        run(history.cutter, operation, history.contact, rule, depth=depth, coarse=True) for rule in ("early", "late")
    )
    return not (first.arrived and last.arrived and first.intervals(HELICAL) == last.intervals(HELICAL))


__all__ = ["History", "run_with_history", "states_differ"]
