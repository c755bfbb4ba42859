"""Branches of equilibria as users hold them: a record, and its faces."""

from __future__ import annotations

from collections import Counter
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rodwell.analysis.branch.control import Controlled
from rodwell.analysis.branch.functionals import Number, number_of, value_of
from rodwell.analysis.branch.record import BranchRecord
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import END, LIFT_OFF, Origin, SpecialPoint
from rodwell.analysis.branch.symmetry import Reflection, images
from rodwell.analysis.discrete.measures import measured
from rodwell.analysis.straight.scale import load_scale
from rodwell.errors import unknown_name
from rodwell.faces import Shown, drawn, face
from rodwell.numerics.continuation.closing import CLOSED
from rodwell.numerics.continuation.events import INDEX
from rodwell.quantities.arrays import FloatArray

if TYPE_CHECKING:
    import xarray as xr

    from rodwell.faces import Axes
    from rodwell.quantities.scales import Scales


class Branch(BranchRecord, Shown):
    """A branch of equilibria in one parameter, points in order of travel.

    Attributes
    ----------
    problem
        The problem; where the branch is followed in one of its values, that of the first point.
    parameter
        What varies along it: "force", "weight", "alpha", "clearance" or "twist".
    origin
        Its name and where it comes from.
    special_points
        In order of travel.
    trace
        Points and meshes_along as continuation left them: for what goes on from here.
    reached_end
        Whether it was followed to where it was asked to end.
    ended_because
        Why it ended.
    beyond
        Its states off the wall, from lift-off on, where it was asked to leave the wall (``off_wall``), or None. Points,
        numbers and special points of the branch itself are those on the wall.
    """

    @property
    def closed(self) -> bool:
        """Whether it is a closed loop, followed once round."""
        return self.ended_because == CLOSED

    @property
    def images(self) -> tuple[Reflection, ...]:
        """Reflections of the problem that make other branches out of this one, the identity first."""
        middle = self[len(self) // 2]
        return images(middle.problem, middle.point.fine.symmetry)

    @property
    def ending(self) -> str:
        """Why the branch ended, in words."""
        words = {
            END: "the end of the search was reached", LIFT_OFF: "the rod lifts off", INDEX: "its stability changes",
        }  # fmt: skip
        return words.get(self.ended_because, self.ended_because)

    def numbers(self, which: Number) -> FloatArray:
        """A number of all points, (n,): measured, by its name in the nomenclature, or a function of a solution.

        Raises
        ------
        InputError
            If no measured number has that name, or the function does not return a number.
        """
        if callable(which):
            return np.array([value_of(solution, which) for solution in self])
        place = measured(which)
        return np.array([p.values[place] for p in self.trace.points])

    def errors(self, which: Number) -> FloatArray:
        """Error estimates of :meth:`numbers`, (n,)."""
        if callable(which):
            return np.array([number_of(solution, which).error for solution in self])
        place = measured(which)
        return np.array([p.error[place] for p in self.trace.points])

    @cached_property
    def labels(self) -> dict[str, SpecialPoint]:
        """The special points by label, in order of travel: kind and number, "fold 1", "fold 2", "lift_off 1"."""
        seen: Counter[str] = Counter()
        out = {}
        for point in self.special_points:
            seen[point.kind] += 1
            out[f"{point.kind} {seen[point.kind]}"] = point
        return out

    def labelled(self, label: str) -> SpecialPoint:
        """Return the special point with a label: its ``solution`` is a state to start from.

        Raises
        ------
        InputError
            If there is none.
        """
        if label not in self.labels:
            raise unknown_name("label", label, self.labels)
        return self.labels[label]

    def under(self, control: str) -> Controlled:
        """Return the branch as it is under another control: "shortening" of a branch in the force, "rotation" in twist.

        Its states are the same; stability index and folds are those where the approach of the ends or the rotation of
        the end s = 1 is held in place of the load: see :class:`rodwell.analysis.branch.control.Controlled`.
        """
        return Controlled(self, control)

    @cached_property
    def certificates(self) -> FloatArray:
        """What is left of the paper's equations at each point, (n,): see :attr:`Solution.certificate`."""
        return np.array([solution.certificate.worst for solution in self])

    @cached_property
    def converged(self) -> bool:
        """Whether every measured number of every point meets the tolerance, special points and their place included.

        Each state must also solve the paper's own equations (:attr:`Solution.certificate`).
        """
        off_wall = self.beyond is None or self.beyond.converged
        return (
            off_wall
            and all(solution.converged for solution in self)
            and all(map(self.meets_tolerance, self.special_points))
        )

    def meets_tolerance(self, point: SpecialPoint) -> bool:
        """Whether a special point of this branch is known to the tolerance: its place, and its state."""
        size = load_scale(self.problem) if self.parameter == "force" else float(np.ptp(self.values))
        return point.solution.converged and point.reached.within(self.trace.meshes[0].rtol, max(abs(point.value), size))

    @property
    def lift_off(self) -> SpecialPoint | None:
        """The first point where the rod leaves the wall, or None if it was not reached.

        Without lateral weight nothing but the buckled rod itself presses it to the wall: lift-off then
        coincides with buckling, and this is the critical point.
        """
        if self.lift_off_at_buckling:
            return self.special_points[0]
        return next((p for p in self.special_points if p.kind == LIFT_OFF), None)

    @property
    def lift_off_at_buckling(self) -> bool:
        """Whether lift-off coincides with buckling: no lateral weight (weightless rod or vertical cylinder)."""
        return self.problem.untouched and self.mode is not None

    @property
    def end_of_the_way(self) -> SpecialPoint | None:
        """Lift-off, or where the shape loses its stability before; None where it ends on the wall and stable."""
        if self.lift_off_at_buckling:
            return self.lift_off
        return next((p for p in self.special_points if p.kind == LIFT_OFF or p.index_after > 0), None)

    @cached_property
    def dataset(self) -> xr.Dataset:
        """All points as an xarray Dataset: see :func:`rodwell.store.dataset.branch_dataset`."""
        data: xr.Dataset = face("dataset")(self)
        return data

    def plot(self, ax: Axes | None = None, *, ordinate: Number | None = None, scales: Scales | None = None) -> Axes:
        """Draw the bifurcation diagram of this branch and its images: end curvature against end compression.

        A branch in another parameter is drawn against that, and so is any function of a solution.

        Parameters
        ----------
        ax
            Axes to draw on, which are returned; None: new ones of pyplot, which notebooks show by themselves.
        ordinate
            What is drawn: a measured number, by its name in the nomenclature, or a function of a solution; None: an end
            curvature that does not vanish.
        scales
            Units of the axes: ``scales`` of a case; None: B = L = 1.

        Raises
        ------
        InputError
            If the branch is one in another parameter than the force.
        """
        return drawn(self, ax, ordinate=ordinate, scales=scales)

    def renamed(self, origin: Origin) -> Branch:
        """Return the same branch under another name."""
        ending = self.reached_end, self.ended_because
        return Branch(self.problem, origin, self.trace, self.special_points, *ending, self.parameter, self.beyond)


def states_to_lift_off(branch: Branch, count: int = 5) -> list[Solution]:
    """States of a branch from buckling to lift-off, evenly spread in load; to its end if it has no lift-off."""
    lift = branch.lift_off
    if lift is None or branch.lift_off_at_buckling:
        picks = np.linspace(1, len(branch) - 1, min(count, len(branch) - 1)).round().astype(int)
        return [branch[int(i)] for i in dict.fromkeys(picks)]
    start = branch.force[0]
    forces = start + (lift.force - start) * np.linspace(0.0, 1.0, count)
    inner = [branch.at(float(f)) for f in forces[1:-1]]
    return [branch[0], *inner, lift.solution]
