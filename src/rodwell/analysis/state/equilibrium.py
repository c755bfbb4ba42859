"""One equilibrium as a record: the state on both meshes, and the numbers and fields read off it, with their errors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from warnings import warn

import numpy as np

from rodwell.analysis.discrete.measures import Measured, measured, pressure_maxima
from rodwell.analysis.state.compared import compared, compared_peaks
from rodwell.analysis.state.fields import GRID, end_force, fields_at, largest, total_wall_force
from rodwell.errors import unknown_name
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.physics.on_wall.parameters import FORCE
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.names import FIELDS
from rodwell.quantities.value import Peak, Value


@dataclass(frozen=True)
class Equilibrium:
    """An equilibrium of ``problem``; all numbers are in units B = L = 1.

    Attributes
    ----------
    problem
        The problem.
    point
        The state on both meshes, with the measured numbers and their errors.
    meshes
        Its equations on both meshes.
    """

    problem: Problem
    point: MeshedState
    meshes: TwoMeshes

    @property
    def ladder(self) -> TwoMeshes:
        """The old name of :attr:`meshes`."""
        warn("Solution.ladder is now Solution.meshes", DeprecationWarning, stacklevel=2)
        return self.meshes

    def __repr__(self) -> str:
        return f"<{type(self).__name__} at F = {self.force:.10g} B/L², stability index {self.stability_index}>"

    @property
    def force(self) -> float:
        """End force F at s = 1 in B/L², tension positive."""
        return float(self.meshes.fine.parameters(self.point.lam)[FORCE])

    @property
    def stability_index(self) -> int:
        """Number of negative eigenvalues of the energy's second variation under dead loads F and T₁."""
        return self.point.fine.index

    @property
    def stable(self) -> bool:
        """Whether the state is a minimum of the energy among states on the wall, under dead loads."""
        return self.stability_index == 0

    @property
    def accurate(self) -> bool:
        """Whether every measured number meets the tolerance asked for."""
        return self.point.accurate

    @property
    def levels(self) -> tuple[tuple[Family, State], tuple[Family, State]]:
        """Equations and state on the coarse and on the fine mesh."""
        meshes, point = self.meshes, self.point
        return (meshes.coarse, point.coarse), (meshes.fine, point.fine)

    def value_of(self, parameter: str) -> float:
        """Value of a parameter of :data:`rodwell.analysis.discrete.family.PATHS`."""
        return self.force if parameter == "force" else float(getattr(self.problem, parameter))

    def number(self, which: Measured | str) -> Value:
        """Return a measured number with its error estimate, by its name in the nomenclature ("energy", "omega2_at_1").

        Raises
        ------
        InputError
            If no measured number has that name.
        """
        which = measured(which)
        return Value(float(self.point.values[which]), float(self.point.error[which]))

    @cached_property
    def highest_pressure(self) -> tuple[float, float, tuple[float, ...]]:
        """Largest contact pressure max p (negative: in contact everywhere), its error, and where.

        More than one place if they agree to within the error (or to eight digits).
        """
        places, values, lowest = pressure_maxima(self.meshes.fine, self.point.fine)
        top, error = self.number(Measured.P_MAX)
        within = max(2.0 * error, 1e-8 * max(abs(top), abs(lowest)))
        return top, error, tuple(float(s) for s in places[values >= top - within])

    def fields(self, s: FloatArray | int = GRID) -> dict[str, FloatArray]:
        """Fields along the rod at ``s`` (m,), or at that many evenly spaced places; names as in nomenclature."""
        places = np.linspace(0.0, 1.0, s) if isinstance(s, int) else np.asarray(s, dtype=float)
        return fields_at(self.problem, self.meshes.fine, self.point.fine, places)

    def field_errors(self, s: FloatArray | int = GRID) -> dict[str, float]:
        """Error estimate of each field, the largest over ``s``: from the two nested meshes."""
        return self.fields_with_errors(s)[1]

    def fields_with_errors(self, s: FloatArray | int = GRID) -> tuple[dict[str, FloatArray], dict[str, float]]:
        """Return :meth:`fields` and :meth:`field_errors` together."""
        places = np.linspace(0.0, 1.0, s) if isinstance(s, int) else np.asarray(s, dtype=float)
        coarse, fine = (fields_at(self.problem, f, state, places) for f, state in self.levels)
        return fine, {k: float(np.max(estimated_error(fine[k], coarse[k]))) for k in fine}

    def largest(self, name: str) -> Peak:
        """Largest size of a field over s with its error estimate, and where (the first place, if there are more).

        Raises
        ------
        InputError
            If there is no field of that name.
        """
        if name not in FIELDS:
            raise unknown_name("field", name, FIELDS)
        return compared_peaks(*(largest(self.problem, f, state, name) for f, state in self.levels))

    @cached_property
    def end_reactions(self) -> dict[str, Value]:
        """What the fitting at s = 1 exerts on the rod across the axis, each with its error estimate.

        ``shear``: circumferential force in B/L², at a clamped end F₃(1) = ω₂′(1) along u₁; ``moment``: bending moment
        M₂(1) = b ω₂(1) in B/L, about d₁. What the end does not hold is zero. The axial force there is F, the twisting
        moment −T₁.
        """
        coarse, fine = (end_force(self.problem, f, state) for f, state in self.levels)
        return {
            "shear": compared(coarse.shear, fine.shear),
            "moment": compared(coarse.moment, fine.moment),
        }

    @cached_property
    def total_wall_force(self) -> Value:
        """∫|p| ds, the contact force with all directions added, with its error estimate."""
        return compared(*(total_wall_force(self.problem, f, state) for f, state in self.levels))
