"""What is computed for a set of inputs: critical loads, branches and what leaves them; as plain data for the page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.exploring import Exploration, Progress
from rodwell.analysis.branch.follow import LARGEST_STEP, Following
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.path.events import Leg, PathPoint
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.straight.lying import refuse_spatial
from rodwell.answers.result.computed import Computed, compute
from rodwell.answers.words.wording import forces_of
from rodwell.case.case import Case
from rodwell.plots.ordinates import ORDINATES, telling
from rodwell.plots.units import axis
from rodwell.quantities.forces import Forces
from rodwell.quantities.text import amount
from rodwell.quantities.value import Value
from rodwell.report.reports.texts import KINDS
from rodwell.web import off_wall

STRAIGHT = "straight"
"""Name of the straight rod among the branches."""

NO_PULL = 1e-9
"""A pull below this part of what presses the rod to the wall is round-off."""

Reached = Callable[["Explored", bool], None]
"""Called with what is there so far, and whether that is all."""


@dataclass(frozen=True)
class Explored:
    """Branches of one case.

    Attributes
    ----------
    data
        Content of the case file.
    computed
        Critical loads and primary branches.
    branches
        These and what leaves them, as far as it has been followed.
    unexplored
        Why branch points were left without their secondary branch.
    unit
        Factor from newtons (of a dimensionless case: from B/L²) to the unit of loads on the page, and that unit: that
        of the case to begin with, so that it stays while inputs move. None: the one that suits these branches.
    path, no_path
        The load path beyond lift-off where it was asked for; or why there is none.
    """

    data: Mapping[str, Any]
    computed: Computed
    branches: tuple[Branch, ...]
    unexplored: tuple[str, ...] = ()
    unit: tuple[float, str] | None = None
    path: LoadPath | None = None
    no_path: str = ""

    @property
    def case(self) -> Case:
        """The case."""
        return self.computed.case

    @property
    def forces(self) -> Forces:
        """How its end forces are shown."""
        return forces_of(self.case)

    @cached_property
    def load_unit(self) -> tuple[float, str]:
        """Factor from B/L² to the unit of loads on the page, and that unit."""
        if self.unit is None:
            return axis("force", self.case.scales, max(float(np.max(np.abs(b.force))) for b in self.branches))
        return self.unit[0] * newtons(self.case), self.unit[1]

    @property
    def kept_unit(self) -> tuple[float, str]:
        """The unit of loads, for other inputs: B/L² moves with them, newtons do not."""
        return self.load_unit[0] / newtons(self.case), self.load_unit[1]

    def shown(self, force: float) -> float:
        """The compression at the end shown, in the unit of loads, of an end force F in B/L²."""
        return float(self.forces.drawn(force)) * self.load_unit[0]

    def force(self, shown: float) -> float:
        """The end force F at s = 1 in B/L², tension positive, of a compression as it is shown."""
        return (self.forces.weight if self.forces.bottom else 0.0) - shown / self.load_unit[0]

    @cached_property
    def factors(self) -> dict[Measured, tuple[float, str]]:
        """Factor and unit of each ordinate: they suit the largest of all branches."""
        out = {}
        for which, (name, _) in ORDINATES.items():
            top = max(float(np.max(np.abs(branch.numbers(which)))) for branch in self.branches)
            out[which] = axis(name, self.case.scales, top)
        return out

    def ordinates(self, at: Mapping[Measured, float]) -> dict[str, float]:
        """Measured numbers as the ordinates show them, by name."""
        return {
            name: float(at[which]) * self.factors[which][0] for which, (name, _) in ORDINATES.items() if which in at
        }

    def __getitem__(self, name: str) -> Branch:
        return next(branch for branch in self.branches if branch.name == name)

    @cached_property
    def range(self) -> tuple[float, float]:
        """Least and largest load as shown: from the unloaded rod, or some tension, to the end of the first branch."""
        buckles, last = self.shown(self.computed.buckling.value), self.shown(float(self.computed.first.force.min()))
        low = min(0.0, buckles - 0.4 * (last - buckles))
        return low, last if self.path is None else max(last, self.shown(off_wall.farthest(self.path)))

    @property
    def suggested(self) -> float:
        """The load to begin with: the one that acts, or one between buckling and lift-off."""
        if self.case.applied:
            return float(f"{self.shown(min(load.force for load in self.case.applied)):.12g}")  # as it was given
        buckles, lift = self.computed.buckling.value, self.computed.lift_off
        end = self.computed.first.force.min() if lift is None or lift.force == buckles else lift.force
        return float(f"{self.shown(buckles + 0.6 * (float(end) - buckles)):.4g}")

    def plain(self) -> dict[str, Any]:
        """Return the diagram as plain data: loads as shown, ordinates in units that suit them."""
        factors = self.factors
        named = [{"name": name, "label": label, "unit": factors[w][1]} for w, (name, label) in ORDINATES.items()]
        chosen = telling(self.branches, self.case.scales)
        lift, low_high = self.computed.lift_off_load, self.range
        return {
            "title": self.case.title,
            "axis": {"label": self.forces.axis, "unit": self.load_unit[1], "end": self.forces.at_end},
            "convention": self.forces.convention,
            "ordinates": named,
            "ordinate": ORDINATES[chosen][0],
            "range": low_high,
            "suggested": self.suggested,
            "buckles": self.load_data(self.computed.buckling),
            "lifts_off": None if lift is None else self.load_data(lift),
            "straight": self._straight(),
            "branches": [
                *(self._branch(branch) for branch in self.branches),
                *([] if self.path is None else [self._leg(self.path, leg) for leg in self.path.legs if any(leg.runs)]),
            ],
            "snaps_at": self._snap(),
            "unexplored": list(self.unexplored),
            "rtol": self.case.rtol,
        }

    def _snap(self) -> dict[str, Any]:
        """Where the rod snaps first as the load grows, or what is known instead, in words."""
        if self.path is None:
            return {"text": self.no_path, "load": None}
        snap = off_wall.snaps_at(self.path)
        if snap is not None:
            return self.load_data(snap.force) | {"to": snap.meaning}
        return {"text": f"not up to {self.load_data(Value(off_wall.farthest(self.path)))['text']}", "load": None}

    def load_data(self, load: Value) -> dict[str, Any]:
        """A load as shown, in B/L², and in words: compression or tension by that word, or with its sign."""
        compression = self.forces.compression(load)
        text = f"{amount(compression, 6)} B/L²{self.forces.at_end}"
        return {
            "load": self.shown(load.value),
            "error": load.error * self.load_unit[0],
            "force": load.value,
            "text": text if self.case.scales is None else self.forces.load(load),
        }

    def _straight(self) -> dict[str, Any]:
        """The straight rod: where it meets its modes."""
        met = [self.load_data(mode.load) | {"mode": mode.number} for mode in self.computed.critical]
        return {"name": STRAIGHT, "critical": met, "buckles": self.shown(self.computed.buckling.value)}

    def _branch(self, branch: Branch) -> dict[str, Any]:
        """A branch as a line of vertices: its points, with the special points between them."""
        states: list[tuple[float, Mapping[Measured, float], int, SpecialPoint | None]] = []
        numbers = {which: branch.numbers(which) for which in Measured}
        for i, force in enumerate(branch.force):
            at = {which: float(numbers[which][i]) for which in Measured}
            states.append((float(force), at, int(branch.stability_index[i]), None))
            for point in (p for p in branch.special_points if p.after == i and p.kind not in ("critical", "end")):
                here = {which: float(point.solution.number(which).value) for which in Measured}
                states.append((point.force, here, point.index_after, point))
        lines = _columns([self.ordinates(at) for _, at, _, _ in states])
        columns = {which: np.array([at[which] for _, at, _, _ in states]) for which in Measured}
        images = []
        for image in branch.images[1:]:
            turned = image.numbers(columns)
            images.append(_columns([self.ordinates({w: turned[w][i] for w in Measured}) for i in range(len(states))]))
        return {
            "name": branch.name,
            "mode": branch.mode.number if branch.mode else None,
            "parent": branch.origin.parent,
            "load": [self.shown(force) for force, *_ in states],
            "y": lines,
            "images": images,
            "index": [index for _, _, index, _ in states],
            "off": beyond_lift_off(branch, states),
            "special": [self._special(branch, point) for point in branch.special_points],
            "ended": branch.ending,
            "reached": branch.reached_end,
            "converged": all(s.accurate for s in branch),
        }

    def _leg(self, path: LoadPath, leg: Leg) -> dict[str, Any]:
        """A leg of the load path as a branch; ``breaks`` are vertices to which a snap leads."""
        runs, name = [run for run in leg.runs if run], off_wall.LEGS[leg.name]
        states = [state for run in runs for state in run]
        return {
            "name": name,
            "mode": None,
            "parent": "",
            "load": [self.shown(state.load) for state in states],
            "y": _columns([self.ordinates(off_wall.ordinates(state)) for state in states]),
            "images": [],
            "index": [state.solved.index for state in states],
            "off": [False] * len(states),
            "breaks": np.cumsum([len(run) for run in runs])[:-1].tolist(),
            "special": [self._event(event) for event in off_wall.events_of(path, name)],
            "ended": path.ended_because,
            "reached": path.reached,
            "converged": not path.missed,
        }

    def _event(self, event: PathPoint) -> dict[str, Any]:
        assert event.state is not None
        return self.load_data(event.force if event.to is None else event.to.force) | {
            "kind": event.kind,
            "label": event.meaning,
            "y": self.ordinates(off_wall.ordinates(event.state.fine)),
            "index_before": None,
            "index_after": event.state.stability_index,
            "s": list(event.s),
            "converged": event.met,
        }

    def _special(self, branch: Branch, point: SpecialPoint) -> dict[str, Any]:
        return self.load_data(point.load) | {
            "kind": point.kind,
            "label": KINDS[point.kind],
            "y": self.ordinates({which: point.solution.number(which).value for which in Measured}),
            "index_before": point.index_before,
            "index_after": point.index_after,
            "s": list(point.s),
            "converged": branch.meets_tolerance(point),
        }


def newtons(case: Case) -> float:
    """B/L² in newtons; 1 for a dimensionless case."""
    return 1.0 if case.scales is None else case.scales.factor("force")


def _columns(rows: list[dict[str, float]]) -> dict[str, list[float]]:
    return {name: [row[name] for row in rows] for name in rows[0]}


def beyond_lift_off(branch: Branch, states: list[Any]) -> list[bool]:
    """Whether the wall would have to pull beyond each vertex, in the order of travel."""
    first = states[0][1]
    off = branch.lift_off_at_buckling or first[Measured.P_MAX] > NO_PULL * branch.problem.lateral_weight
    out = []
    for *_, point in states:
        if point is not None and point.kind in ("lift_off", "touch_down"):
            off = point.kind == "lift_off"
        out.append(off)
    return out


def explore(
    data: Mapping[str, Any], case: Case, tell: Progress, reached: Reached, unit: tuple[float, str] | None = None
) -> Explored:
    """Compute the branches of a case, telling what is there in between.

    Parameters
    ----------
    data, case
        Content of the case file, and the same as a case.
    tell
        Called with what is being done; what it raises ends the computation.
    reached
        Called as soon as the primary branches are there, and when all is done.
    unit
        As in :class:`Explored`.

    Raises
    ------
    InputError
        For a hole that leaves the vertical plane, where the rod has no critical loads.
    NotConvergedError
        If the critical loads cannot be computed, or the first branch cannot be started.
    """
    refuse_spatial(case.problem)
    computed = compute(case, tell)
    branches = list(computed.branches)
    if computed.other_arm is not None:
        branches.append(computed.other_arm)
    first = Explored(data, computed, tuple(branches), unit=unit)
    reached(first, False)
    how = Following(case.rtol, LARGEST_STEP)
    work = Exploration(case.problem, computed.critical, computed.until, how)
    work.branches += branches
    work.follow_secondary(tell)
    whole = Explored(data, computed, tuple(work.branches), tuple(work.unexplored), unit)
    reached(whole, True)
    return whole
