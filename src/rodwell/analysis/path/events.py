"""What a load path consists of: events, legs, and states at loads."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from rodwell.analysis.beyond.between import around, nearest_first
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.control import FORCE, Control
from rodwell.analysis.off_wall.state import BRIDGED, ON_WALL, OTHER_SIDE, STRAIGHT, ContactState
from rodwell.errors import NotConvergedError
from rodwell.faces import drawn_in_space
from rodwell.problem.words import floats_in_part
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.analysis.space.geometry import Geometry
    from rodwell.faces import Axes
    from rodwell.quantities.scales import Scales

LOADING, UNLOADING = "loading", "unloading"

CRITICAL, LIFT_OFF, SNAP, FOLD, BRANCH_POINT = "critical", "lift_off", "snap", "fold", "branch_point"
LOAD_PEAK = "load_peak"
ENTERS, LEAVES = "enters", "leaves"
TOUCHES, TOUCH_DOWN = "touches", "touch_down"

MEANING = {
    CRITICAL: "the straight rod buckles",
    LIFT_OFF: "the rod lifts off the wall",
    "gap_opens": "a gap opens",
    "gap_closes": "a gap closes",
    "contact_point": "a stretch in contact has shrunk to a point",
    "contact_line": "a point of contact grows to a stretch",
    "contact_splits": "a point of contact becomes two",
    "contacts_merge": "two points of contact become one",
    "contact_lost": "a contact is lost",
    TOUCHES: "the rod touches the wall anew",
    TOUCH_DOWN: "contact is complete again",
    FOLD: "limit point: no equilibrium nearby beyond it",
    LOAD_PEAK: "the load passes an extremum",
    BRANCH_POINT: "the state gives way to one of another shape",
    SNAP: "the rod snaps",
}
"""Kinds of events, in words."""


ALONG_THE_HOLE = {CRITICAL: "the rod that lies along the hole buckles"}
THROUGH_THE_PLANE = {
    ENTERS: "the rod comes to lie in the vertical plane, without a jump",
    LEAVES: "the rod leaves the vertical plane, without a jump",
}
"""Events in a curved hole, in words that tell more."""


def unbuckled(curved: bool) -> str:
    """The shape of a rod that has not buckled, in words."""
    return "where it lies along the hole" if curved else "the straight shape"


_ARTICLE = {"sinusoidal": "a ", "helix": "a ", OTHER_SIDE: "the shape ", ON_WALL: "a shape "}


@dataclass(frozen=True)
class Destination:
    """Where a snap leads: the kind of state, its turns around the hole, its energy relative to the straight rod.

    ``force`` is the end force there: where it is controlled that of the snap.
    ``starts`` is how many disturbed starts were tried, ``agree`` how many ended in this state or its mirror image,
    or came upon the way of one that did.
    """

    kind: str
    turns: int
    energy: Value
    force: Value
    starts: int
    agree: int

    @property
    def meaning(self) -> str:
        """The state, in words."""
        if self.kind == STRAIGHT:
            return "the straight shape"
        turns = f" of {abs(self.turns)} turn{'s' if abs(self.turns) != 1 else ''}" if self.turns else ""
        return f"{_ARTICLE.get(self.kind, 'another state of ')}{self.kind}{turns}"

    def as_dict(self) -> dict[str, Any]:
        """Plain data, for JSON."""
        return {
            "state": self.kind, "turns": self.turns, "energy": self.energy.as_dict(), "force": self.force.as_dict(),
            "starts": self.starts, "agree": self.agree,
        }  # fmt: skip


@dataclass(frozen=True, eq=False)
class PathPoint:
    """An event of a load path.

    Attributes
    ----------
    kind
        One of :data:`MEANING`.
    force
        End force at s = 1 in B/L², tension positive, with the estimate of its error.
    s
        Where along the rod, in L; empty where it concerns the whole of it.
    leg
        "loading" or "unloading".
    to
        Where a snap leads; None for other events.
    state
        The state there; None for the straight rod's buckling. After a snap, the state the rod has snapped to.
    met
        Whether the load meets the tolerance.
    plane
        "enters" or "leaves" at a branch point where states go over into the vertical plane, or out of it; else empty.
    curved
        Whether the hole is curved: where it has not buckled the rod is not straight there, but lies along the hole.
    """

    kind: str
    force: Value
    s: tuple[float, ...]
    leg: str
    to: Destination | None = None
    state: ContactState | None = None
    met: bool = True
    plane: str = ""
    curved: bool = False

    @property
    def meaning(self) -> str:
        """What happens, in words."""
        if self.kind == CRITICAL and self.state is not None and self.state.kind == BRIDGED:
            if floats_in_part(self.state.problem):
                return "the string of sections that sink and float buckles sideways"
            over = "that bridges steps of the clearance" if self.state.problem.bridges else "in the curved hole"
            return f"the string {over} buckles sideways"
        if self.kind == CRITICAL and self.leg == UNLOADING:
            return "the rod lies along the hole again" if self.curved else "the rod is straight again"
        if self.to is None:
            in_hole = ALONG_THE_HOLE | THROUGH_THE_PLANE if self.curved else {}
            return in_hole.get(self.plane or self.kind, MEANING[self.kind])
        if self.to.kind == STRAIGHT:
            return f"the rod falls back to {unbuckled(self.curved)}"
        return f"the rod snaps to {self.to.meaning}"

    def as_dict(self) -> dict[str, Any]:
        """Plain data, for JSON."""
        return {
            "kind": self.kind, "force": self.force.as_dict(), "s": list(self.s), "leg": self.leg,
            "to": None if self.to is None else self.to.as_dict(),
        }  # fmt: skip


@dataclass(eq=False)
class Leg:
    """One way of a load path: its name, and unbroken runs of states in order; a snap begins a new run.

    ``straight`` are ranges of the end force, (from, to), in which the rod is straight.
    """

    name: str
    runs: list[list[PatternedState]] = field(default_factory=list)
    straight: list[tuple[float, float]] = field(default_factory=list)

    def near(self, value: float, control: Control) -> list[PatternedState]:
        """Known states on either side of a value of the controlled quantity, the nearer first."""
        run = self.passing(value, control)
        return [] if run is None else nearest_first(around(self.runs[run], value, control)[0], value, control)

    def passing(self, value: float, control: Control) -> int | None:
        """Which run passes a value of the controlled quantity: the last one that does; None if none does."""
        runs = range(len(self.runs) - 1, -1, -1)
        return next((i for i in runs if around(self.runs[i], value, control)), None)


@dataclass(frozen=True, eq=False)
class PathState:
    """A state at a load asked for, and on which leg."""

    leg: str
    state: ContactState
    control: Control = FORCE

    @property
    def stability_index(self) -> int:
        """The stability index where the end force, or the shortening, is controlled."""
        return self.control.index_at(self.state.fine.solved)

    def geometry(
        self, places: int | None = None, *, rod_radius: float | None = None, radial_scale: float | None = 1.0
    ) -> Geometry:
        """The rod in space; arguments and errors as in :meth:`rodwell.Solution.geometry`, ``places`` 401 if not given.

        Its frame {t₁, d₁, u₁} does not turn about the tangent: see :mod:`rodwell.analysis.space.in_hole`. ``fields``
        has, of the fields there, z, η, ξ₂ and Δ ξ₂ as ``y`` (the angle around the hole, from the bottom), the
        contact pressure; and the ``gap`` between rod and wall in Δ, the ``curvature``.
        """
        from rodwell.analysis.space.in_hole import geometry_in_hole  # noqa: PLC0415 - most who solve do not draw

        return geometry_in_hole(self.state.fine, places, rod_radius=rod_radius, radial_scale=radial_scale)

    def plot_rod(
        self,
        ax: Axes | None = None,
        *,
        scales: Scales | None = None,
        rod_radius: float | None = None,
        radial_scale: float | None = None,
    ) -> Axes:
        """Draw the rod in its cylinder in three dimensions: see :func:`rodwell.plots.rod3d.plot_rod`."""
        return drawn_in_space(self.state, ax, scales=scales, rod_radius=rod_radius, radial_scale=radial_scale)

    def as_dict(self) -> dict[str, Any]:
        """Plain data, for JSON."""
        more: dict[str, Any] = {}
        if not self.control.by_force:
            more["driven"] = self.control.value(self.state.fine.solved)
        if self.state.problem.hole is not None:
            more["place_errors"] = self._place_errors()
        return {"leg": self.leg, **self.state.as_dict(), **more, "stability_index": self.stability_index}

    def _place_errors(self) -> dict[str, float] | None:
        """:attr:`ContactState.place_errors`; None where no state with its own places was found."""
        try:
            return self.state.place_errors
        except NotConvergedError:
            return None
