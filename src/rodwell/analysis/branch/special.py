"""Special points of branches, and where branches come from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.straight.critical import Mode
from rodwell.numerics.continuation.events import INDEX, TURN
from rodwell.numerics.continuation.walk import Trace
from rodwell.physics.on_wall.model import RodOnCylinder
from rodwell.problem.varying import Parameter
from rodwell.quantities.value import Value

LIFT_OFF, TOUCH_DOWN, END = "lift_off", "touch_down", "end"
EQUAL_ENERGY = "equal_energy"
CRITICAL, FOLD, BRANCH_POINT, UNCERTAIN = "critical", "fold", "branch_point", "uncertain"

KINDS = (LIFT_OFF, EQUAL_ENERGY, END, INDEX, TURN)
"""What continuation finds that makes a special point; what else ends a branch is told in words."""

OUT_OF_RANGE = RodOnCylinder.out_of_range()
"""Why a branch ends where the rod turns across the cylinder."""

STRAIGHT = "it meets the straight rod"
REJOINS = "it meets a symmetric branch, where it turns into its own mirror image"
"""Why a branch ends at another."""

LOCATED_NOISE = 3e-13
"""Relative error that round-off in some hundred operations, and in the numbers given, may leave in a located load."""


@dataclass(frozen=True)
class SpecialPoint:
    """A point of a branch where something changes.

    Attributes
    ----------
    kind
        "critical" (the branch leaves the straight rod), "lift_off" (contact is lost first, in the direction of
        travel), "touch_down" (contact is complete again), "branch_point" (other branches meet this one), "fold" (the
        parameter turns back), "equal_energy" (a coil has the energy of the straight rod), "end", or "uncertain": a
        change of the stability index that only one of the two meshes shows, since an eigenvalue vanishes to round-off.
    force
        End force at s = 1 in B/L², tension positive.
    reached
        The branch's parameter there with the estimate of its error, also as ``value`` and ``error``: the end force,
        unless the branch is followed in another parameter.
    s
        Where along the rod: the places that lift off; empty for other kinds.
    index_before, index_after
        Stability index on either side, in the direction of travel.
    solution
        The state itself.
    after
        Number of the point of the branch that it follows.
    parameter
        What varies along the branch.
    """

    kind: str
    force: float
    reached: Value
    s: tuple[float, ...]
    index_before: int
    index_after: int
    solution: Solution
    after: int
    parameter: Parameter = "force"

    def __repr__(self) -> str:
        where = f", s = {', '.join(f'{s:.4g}' for s in self.s)}" if self.s else ""
        index = f"index {self.index_before} → {self.index_after}"
        return f"<SpecialPoint {self.kind} at {self.parameter} = {self.value:.10g}{where}, {index}>"

    @property
    def value(self) -> float:
        """The branch's parameter."""
        return self.reached.value

    @property
    def error(self) -> float:
        """Estimate of its error."""
        return self.reached.error

    @property
    def load(self) -> Value:
        """The end force with the error of the parameter, which it is on a branch followed in the end force."""
        return Value(self.force, self.error)

    def as_dict(self) -> dict[str, Any]:
        """Return the point without its state as plain data, for JSON."""
        return {
            "kind": self.kind,
            "force": self.force,
            "error": self.error,
            "index_before": self.index_before,
            "index_after": self.index_after,
            "s": list(self.s),
        }


@dataclass(frozen=True)
class Origin:
    """Where a branch comes from.

    Attributes
    ----------
    name
        Name of the branch, as diagrams list it.
    mode
        The buckling mode by which it leaves the straight rod; None if it starts elsewhere.
    switched
        Whether its first point is a branch point, which it shares with another branch.
    parent
        Name of the branch that it leaves there.
    mirror
        Whether it is the other of the two arms of its mode, ω₂(1) > 0.
    error
        Estimate of the error of the parameter at its start, where it leaves another.
    """

    name: str
    mode: Mode | None = None
    switched: bool = False
    parent: str | None = None
    mirror: bool = False
    error: float = 0.0


def index_at_start(trace: Trace) -> int:
    """Return the index just after the start of a branch whose first point is a state of the branch that it leaves."""
    changes = [event for event in trace.found if event.name == INDEX]
    after_first = trace.points[min(1, len(trace.points) - 1)].fine.index
    return changes[0].index_before if changes else int(after_first)
