"""Exact loads that formulas of practice are held against, as compression at three places of the rod."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.coiled import coil
from rodwell.analysis.branch.special import LIFT_OFF, SpecialPoint
from rodwell.analysis.branch.symmetry import arms_differ
from rodwell.analysis.loads.arms import to_lift_off
from rodwell.analysis.loads.lying_rod import lying_rod
from rodwell.analysis.straight.critical import critical_loads
from rodwell.analysis.straight.scale import EULER
from rodwell.errors import InputError, NotConvergedError
from rodwell.formulas.record import Place
from rodwell.problem.ends import HOLD_ANGLE
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import RTOL

PLACES: tuple[Place, ...] = ("top", "middle", "bottom")
"""s = 1, 1/2 and 0: compression grows downwards by the axial weight."""

WHERE: dict[Place, float] = {"top": 1.0, "middle": 0.5, "bottom": 0.0}

MOST_TURNS = 6
"""Coils of more turns are not looked for."""

STARTS = (0.75, 0.85, 0.95)
"""Where coils are looked for, as parts of the load of Chen, Lin and Cheatham."""


@dataclass(frozen=True)
class ExactLoad:
    """An exact load of a problem.

    Attributes
    ----------
    name
        "critical", "lift_off", "equal_energy" or "touch_down".
    label
        What it is.
    force, error
        End force F at s = 1 in B/L², **tension positive**, and its error estimate.
    axial_weight
        γ cos α, by which the two ends differ.
    above_middle
        How much of it is above the middle; None: half of it.
    """

    name: str
    label: str
    force: float
    error: float
    axial_weight: float
    above_middle: float | None = None

    def meets(self, rtol: float) -> bool:
        """Whether the load is known to a tolerance, judged like that of a branch."""
        return self.error <= rtol * max(abs(self.force), EULER + max(self.axial_weight, 0.0))

    def at(self, place: Place) -> float:
        """Compression −N(s) at a place in B/L², **compression positive**; N(s) = F + γ cos α (s − 1)."""
        if place == "middle" and self.above_middle is not None:
            return -self.force + self.above_middle
        return -self.force + self.axial_weight * (1.0 - WHERE[place])


def critical(problem: Problem, rtol: float = RTOL) -> ExactLoad:
    """First critical load of the straight rod."""
    mode = critical_loads(problem, 1, rtol=rtol).first_met
    return ExactLoad("critical", "first critical load", mode.force, mode.error, problem.hung_weight)


AS_IT_LIES = (
    "critical load: a rod in a hole that leaves the vertical plane has none, since it moves with every change of the "
    "load; in its place stands the load up to which it lies on the wall, stable",
    "loads with every cross-section at its own place in the hole: these take it where the rod would be on the low "
    "side, undeformed; `rodwell liftoff` has both",
)
"""What must be known of the loads of a rod in such a hole."""


def _as_it_lies(problem: Problem, rtol: float) -> list[ExactLoad]:
    """The load at which a rod in a hole that leaves the vertical plane ceases to lie on the wall, stable.

    Where that is a bifurcation, also lift-off of the branch that leaves there, if it is met.

    Raises
    ------
    NotConvergedError
        If that does not happen as far as the rod is followed.
    """
    rod = lying_rod(problem, rtol=rtol)
    end, weight = rod.end, problem.hung_weight
    if end is None:
        raise NotConvergedError(
            f"the rod lies on the wall of this hole, stable, down to F = {rod.lowest.value:.6g} B/L², as far as it was "
            "followed: there is no load that formulas could be held against"
        )
    happens = "buckles" if rod.buckled is not None else HAPPENS.get(end.kind, "loses its stability")
    loads = [ExactLoad("critical", f"load at which the rod, as it lies, {happens}", end.force, end.error, weight)]
    lift = None if rod.buckled is None else rod.buckled.lift_off
    if lift is not None:
        loads.append(ExactLoad("lift_off", "lift-off of the branch that leaves there", lift.force, lift.error, weight))
    return loads


HAPPENS = {LIFT_OFF: "leaves the wall"}
"""How it ceases, by kind of the special point."""


def exact_loads(problem: Problem, rtol: float = RTOL) -> tuple[tuple[ExactLoad, ...], tuple[str, ...]]:
    """Return the exact loads of a problem, and what could not be had with the reason.

    The first critical load, which the end twist does not change; lift-off of mode 1 under the end twist, of its two
    arms the one that leaves the wall at less compression: the rod may take either. For a horizontal rod whose ends hold
    the angle, the least load at which a coil of whole turns has the energy of the straight rod, and that at which this
    coil leaves the wall when it is unloaded; both without the end twist, as their labels say. In a hole that leaves the
    vertical plane, where there is no critical load, that up to which the rod lies on the wall, stable, in its place.

    Raises
    ------
    NotConvergedError
        If the first of these loads cannot be computed.
    """
    if problem.in_space:
        return tuple(_as_it_lies(problem, rtol)), AS_IT_LIES
    loads, notes = [critical(problem, rtol)], []
    if problem.hole is None and (problem.alpha == 0.0 or problem.weight == 0.0 or not problem.pressed):
        notes.append("lift-off: no lateral weight presses the rod to the wall")
    else:
        _add(loads, notes, "lift-off", lambda: [_lift_off(problem, rtol)])
    holds = problem.ends[0] in HOLD_ANGLE and problem.ends[1] in HOLD_ANGLE
    if problem.hole is not None:
        notes.append("load of equal energy: coils are computed in straight holes only")
    elif problem.sections:
        notes.append("load of equal energy: of a uniform rod only")
    elif problem.alpha != 90.0 or not holds or not problem.pressed:
        notes.append("load of equal energy: only for a horizontal rod pressed to the wall whose ends hold the angle")
    else:
        _add(loads, notes, "load of equal energy", lambda: _coil(problem, partial(coil, rtol=rtol)))
    return tuple(loads), tuple(notes)


def _add(loads: list[ExactLoad], notes: list[str], what: str, compute: Callable[[], list[ExactLoad]]) -> None:
    """Add loads, or the reason why they are not known."""
    try:
        loads += compute()
    except (InputError, NotConvergedError) as error:
        notes.append(f"{what}: {error}")


def _lift_off(problem: Problem, rtol: float) -> ExactLoad:
    """Lift-off of mode 1 at the least compression: with twist, of both arms, or none if one of them is not known."""
    mode = critical_loads(problem, 1, rtol=rtol)[0]
    first, second = to_lift_off(problem, mode, rtol)
    if second is None and arms_differ(problem, mode.parity):
        raise NotConvergedError("only one of the two arms, which differ under the end twist, could be followed")
    loads = []
    for branch in (first,) if second is None else (first, second):
        if branch.lift_off is None or not branch.converged:
            raise NotConvergedError(f"not found to the tolerance ({branch.ending})")
        loads.append(branch.lift_off.load)
    least = max(loads, key=lambda load: load.value)
    label = "lift-off of mode 1" + (", under the end twist" if problem.twist else "")
    return ExactLoad("lift_off", label, least.value, least.error, problem.hung_weight)


def _coil(problem: Problem, wind: Callable[..., Branch]) -> list[ExactLoad]:
    """Least compression at which a coil of whole turns, in contact throughout, has the energy of the straight rod.

    And that at which this coil leaves the wall as it is unloaded, if it was met. Few turns need the least: the rod
    winds where it likes and lies at the bottom elsewhere. So turns are counted up until one more needs more.
    """
    best: tuple[SpecialPoint, int, Branch] | None = None
    for turns in range(1, MOST_TURNS + 1):
        branch = _wound(problem.but(turns=turns, twist=0.0), wind)
        point = None if branch is None else _first(branch, "equal_energy")
        if branch is None or point is None or point.solution.highest_pressure[0] >= 0.0:
            continue
        if best is not None and point.force <= best[0].force:
            break
        best = point, turns, branch
    if best is None:
        raise NotConvergedError("no coil in contact throughout was found that has the energy of the straight rod")
    point, turns, branch = best
    name, axial = f"coil of {turns} turn{'s' * (turns > 1)}", problem.hung_weight
    twist = ", without the end twist" if problem.twist else ""
    label = f"{name} with the energy of the straight rod{twist}"
    loads = [ExactLoad("equal_energy", label, point.force, point.error, axial)]
    touch = _first(branch, "touch_down")
    if touch is not None:
        loads.append(
            ExactLoad("touch_down", f"{name} leaves the wall, unloaded{twist}", touch.force, touch.error, axial)
        )
    return loads


def _wound(problem: Problem, wind: Callable[..., Branch]) -> Branch | None:
    """Branch of a coil from below to above the load of Chen, Lin and Cheatham; None if no coil was found.

    Odd about mid-length if there is one: an unsymmetric coil, which is found where the odd one is no minimum, needs
    more compression.
    """
    lopsided = None
    scale = (2.0 * math.pi * problem.turns) ** 2
    chen = 2.0 * math.sqrt(2.0 * problem.lateral_weight / problem.clearance)
    for start in STARTS:
        try:
            branch = wind(problem, start=-start * chen, until=-max(1.35 * chen, 4.0 * scale))
        except (InputError, NotConvergedError):
            continue
        if branch[0].point.fine.symmetry != 0:
            return branch
        lopsided = lopsided or branch
    return lopsided


def _first(branch: Branch, kind: str) -> SpecialPoint | None:
    return next((point for point in branch.special_points if point.kind == kind), None)
