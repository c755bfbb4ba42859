"""The rod under one end force: straight, or buckled and lying on the wall. All that is asked of it, on both meshes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.state.compared import compared, compared_peaks
from rodwell.analysis.state.fields import ZOOMS, fields_at, largest_of
from rodwell.analysis.straight.fields import straight_fields
from rodwell.analysis.straight.lying import lying_contact_in_all
from rodwell.analysis.straight.ramps import axial_contact, contact_in_all_on_ramps
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Peak, Value

Fields = dict[str, FloatArray]


@dataclass(frozen=True)
class OnMesh:
    """Fields of one state on one mesh as a function of places s (m,); no mesh for the straight rod."""

    fields: Callable[[FloatArray], Fields]
    space: SplineSpace | None = None

    def __call__(self, s: FloatArray) -> Fields:
        """Fields at places s (m,), in units B = L = 1, and the places themselves, "s"."""
        return self.fields(s) | {"s": s}

    def largest(self, size: Callable[[Fields], FloatArray], zooms: int = ZOOMS) -> tuple[float, float]:
        """Largest value along the rod of something made from the fields, and its (first) place."""
        return largest_of(lambda s: size(self(s)), self.space, zooms)


@dataclass(frozen=True)
class LoadedRod:
    """The rod in one state.

    Attributes
    ----------
    name
        What the state is: "at buckling", "at lift-off", "at the applied load".
    problem
        The problem.
    force, error
        End force F at s = 1 in B/L², tension positive, and how well it is known (0: it was given).
    solution
        The buckled state; None for the straight rod, in a hole curved in the vertical plane the one that lies along it.
    lies
        The state is that of a rod that lies along a hole out of the vertical plane, and has not buckled.
    """

    name: str
    problem: Problem
    force: float
    error: float = 0.0
    solution: Solution | None = field(default=None, repr=False)
    lies: bool = False

    @property
    def load(self) -> Value:
        """The end force with its error."""
        return Value(self.force, self.error)

    @property
    def straight(self) -> bool:
        """Whether the rod has not buckled: it is straight, or as the hole bends it."""
        return self.solution is None or self.lies

    @property
    def at_bottom(self) -> float:
        """Effective axial force at the lower end s = 0 in B/L², N(0) = F − γ cos α, or less γ times the rod's rise.

        Where the clearance varies, with what the wall pushes along the hole.
        """
        pushed = axial_contact(self.problem, self.force) if self.problem.ramps else 0.0
        return self.force - self.problem.hung_weight + pushed

    @property
    def along(self) -> tuple[OnMesh, ...]:
        """The state on the coarse and the fine mesh; one entry for the straight rod, which is known exactly."""
        if self.solution is None:
            return (OnMesh(lambda s: straight_fields(self.problem, self.force, s)),)
        return tuple(on_mesh(self.solution.problem, *level) for level in self.solution.levels)

    def fields(self, s: FloatArray) -> Fields:
        """Fields at places s (m,), in units B = L = 1; for the straight rod those that are asked for here."""
        return self.along[-1](s)

    def largest(self, size: Callable[[Fields], FloatArray]) -> Peak:
        """Largest value along the rod of something made from its fields, with its error."""
        peaks = [mesh.largest(size) for mesh in self.along]
        return compared_peaks(peaks[0], peaks[-1])

    @property
    def contact(self) -> Peak:
        """Largest contact force per length on the wall, |p|, in B/L³."""
        if self.solution is None:
            return self.largest(lambda f: np.abs(f["contact_pressure"]))
        return self.solution.wall.contact

    @property
    def total_contact(self) -> Value:
        """Contact force on the wall in all, all directions added, in B/L²."""
        if self.solution is not None:
            return self.solution.total_wall_force
        if self.problem.hole is not None:
            return lying_contact_in_all(self.problem, self.force)
        if self.problem.ramps:
            return contact_in_all_on_ramps(self.problem, self.force)
        whole = self.problem.lateral_weight * self.problem.rod.whole_weight
        return compared(whole, whole)

    @property
    def shortening(self) -> Value:
        """Approach of the ends by buckling, 1 − z(1), in L."""
        return Value(0.0) if self.solution is None else self.solution.number(Measured.SHORTENING)


def on_mesh(problem: Problem, family: Family, state: State) -> OnMesh:
    """Fields of one state on one mesh, as a function of places s (m,); in a curved hole not the tangential balance."""
    return OnMesh(lambda s: fields_at(problem, family, state, s, balance=False), state.space)
