"""One equilibrium: every field of rod and cylinder, with error estimates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rodwell.analysis.balance import Reaction, energies, reactions
from rodwell.analysis.certificate import Certificate, certify
from rodwell.analysis.fields import GRID, end_force, fields_at, largest, total_wall_force
from rodwell.analysis.measures import Measured, pressure_maxima
from rodwell.analysis.wall import WallLoads, wall_loads
from rodwell.display import Shown, drawn, drawn_in_space
from rodwell.numerics.families import Family, State
from rodwell.numerics.ladder import Ladder, Point, estimated_error
from rodwell.numerics.spaces import FloatArray
from rodwell.physics.parameters import FORCE
from rodwell.problem import Problem

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from rodwell.analysis.geometry import Geometry
    from rodwell.practice.scales import Scales


@dataclass(frozen=True)
class Solution(Shown):
    """An equilibrium of ``problem`` at one end force.

    Created by :func:`rodwell.follow` and :func:`rodwell.equilibrium`; all numbers are in units B = L = 1.
    """

    problem: Problem
    point: Point
    ladder: Ladder

    def __repr__(self) -> str:
        return f"<Solution at F = {self.force:.10g} B/L², stability index {self.stability_index}>"

    @property
    def force(self) -> float:
        """End force F at s = 1 in B/L², tension positive."""
        return float(self.ladder.fine.parameters(self.point.lam)[FORCE])

    @property
    def stability_index(self) -> int:
        """Number of negative eigenvalues of the energy's second variation under dead loads F and T₁."""
        return self.point.fine.index

    @property
    def stable(self) -> bool:
        """Whether the state is a minimum of the energy among states on the wall, under dead loads."""
        return self.stability_index == 0

    @property
    def converged(self) -> bool:
        """Whether every measured number meets the tolerance asked for, and the certificate its limit."""
        return self.accurate and self.certificate.passed

    def number(self, which: Measured) -> tuple[float, float]:
        """Return a measured number and its error estimate."""
        return float(self.point.values[which]), float(self.point.error[which])

    @cached_property
    def highest_pressure(self) -> tuple[float, float, tuple[float, ...]]:
        """Largest contact pressure max p (negative: in contact everywhere), its error, and where.

        More than one place if they agree to within the error (or to eight digits).
        """
        places, values, lowest = pressure_maxima(self.ladder.fine, self.point.fine)
        top, error = self.number(Measured.P_MAX)
        within = max(2.0 * error, 1e-8 * max(abs(top), abs(lowest)))
        return top, error, tuple(float(s) for s in places[values >= top - within])

    def fields(self, s: FloatArray | int = GRID) -> dict[str, FloatArray]:
        """Fields along the rod at ``s`` (m,), or at that many evenly spaced places; names as in nomenclature."""
        places = np.linspace(0.0, 1.0, s) if isinstance(s, int) else np.asarray(s, dtype=float)
        return fields_at(self.problem, self.ladder.fine, self.point.fine, places)

    def field_errors(self, s: FloatArray | int = GRID) -> dict[str, float]:
        """Error estimate of each field, the largest over ``s``: from the two nested meshes."""
        return self.fields_with_errors(s)[1]

    def fields_with_errors(self, s: FloatArray | int = GRID) -> tuple[dict[str, FloatArray], dict[str, float]]:
        """Return :meth:`fields` and :meth:`field_errors` together."""
        places = np.linspace(0.0, 1.0, s) if isinstance(s, int) else np.asarray(s, dtype=float)
        coarse, fine = (fields_at(self.problem, f, state, places) for f, state in self.levels)
        return fine, {k: float(np.max(estimated_error(fine[k], coarse[k]))) for k in fine}

    def geometry(
        self, places: int | None = None, *, rod_radius: float | None = None, radial_scale: float | None = 1.0
    ) -> Geometry:
        """The rod in space: centreline, braid and material frames, curvatures at evenly spaced places.

        Parameters
        ----------
        places
            How many; None: 401 or more, by the mesh of the solution.
        rod_radius
            Radius of the rod in L. The dimensionless problem has none: None stands for 0.2 Δ, a radius to be looked at.
        radial_scale
            How many times everything across the axis is enlarged; 1 is true scale, None a scale that can be read.

        Raises
        ------
        InputError
            For a radius that does not fit (outside a cylinder it must be below Δ; anywhere below the smallest radius
            of curvature), a scale below 1, fewer than two places.
        """
        from rodwell.analysis.geometry import geometry  # noqa: PLC0415 - most who solve do not draw

        return geometry(self, places, rod_radius=rod_radius, radial_scale=radial_scale)

    def largest(self, name: str) -> tuple[float, float, float]:
        """Largest size of a field over s, its error estimate, and where (the first place, if there are more)."""
        values, places = zip(*(largest(self.problem, f, state, name) for f, state in self.levels), strict=True)
        return values[1], float(estimated_error(values[1], values[0])), places[1]

    @cached_property
    def end_reactions(self) -> dict[str, tuple[float, float]]:
        """What the fitting at s = 1 exerts on the rod across the axis, each with its error estimate.

        ``shear``: circumferential force in B/L², at a clamped end F₃(1) = ω₂′(1) along u₁; ``moment``: bending moment
        M₂(1) = ω₂(1) in B/L, about d₁. What the end does not hold is zero. The axial force there is F, the twisting
        moment −T₁.
        """
        coarse, fine = (end_force(f, state) for f, state in self.levels)
        return {
            "shear": (fine.shear, float(estimated_error(fine.shear, coarse.shear))),
            "moment": (fine.omega2, float(estimated_error(fine.omega2, coarse.omega2))),
        }

    @cached_property
    def total_wall_force(self) -> tuple[float, float]:
        """∫|p| ds, the contact force with all directions added, and its error estimate."""
        totals = [total_wall_force(f, state) for f, state in self.levels]
        return totals[1], float(estimated_error(totals[1], totals[0]))

    @property
    def levels(self) -> tuple[tuple[Family, State], tuple[Family, State]]:
        """Equations and state on the coarse and on the fine mesh."""
        ladder, point = self.ladder, self.point
        return (ladder.coarse, point.coarse), (ladder.fine, point.fine)

    @cached_property
    def energies(self) -> dict[str, tuple[float, float]]:
        """Strain energies, heights and work of the end loads: see :func:`rodwell.analysis.balance.energies`."""
        return energies(self)

    @cached_property
    def wall(self) -> WallLoads:
        """What the wall and the supports of the cylinder must bear: see :class:`rodwell.analysis.wall.WallLoads`."""
        return wall_loads(self)

    @cached_property
    def reactions(self) -> tuple[Reaction, ...]:
        """What the supports exert on rod and cylinder: see :func:`rodwell.analysis.balance.reactions`."""
        return reactions(self)

    def dataset(self, places: int = GRID, *, length: float | None = None, stiffness: float | None = None) -> xr.Dataset:
        """Everything as an xarray Dataset: see :func:`rodwell.analysis.dataset.solution_dataset`."""
        from rodwell.analysis.dataset import solution_dataset  # noqa: PLC0415

        return solution_dataset(self, places, length, stiffness)

    def plot(self, ax: Axes | None = None, *, field: str = "contact_pressure", scales: Scales | None = None) -> Axes:
        """Draw a field along the rod; several states can share axes.

        Parameters
        ----------
        ax
            Matplotlib axes to draw on; None: new ones of pyplot, which notebooks show by themselves.
        field
            Its name in the nomenclature.
        scales
            Units of the axes: ``scales`` of a case; None: B = L = 1.

        Returns
        -------
        Axes
            Those drawn on.

        Raises
        ------
        InputError
            If there is no field of that name.
        """
        return drawn(self, ax, field=field, scales=scales)

    def plot_rod(
        self,
        ax: Axes | None = None,
        *,
        scales: Scales | None = None,
        rod_radius: float | None = None,
        radial_scale: float | None = None,
    ) -> Axes:
        """Draw the rod in its cylinder in three dimensions: see :func:`rodwell.plots.rod3d.plot_rod`.

        ``ax`` must be axes in three dimensions; None: new ones of pyplot.
        """
        return drawn_in_space(self, ax, scales=scales, rod_radius=rod_radius, radial_scale=radial_scale)

    @property
    def accurate(self) -> bool:
        """Whether every measured number meets the tolerance asked for."""
        return self.point.accurate

    @cached_property
    def certificate(self) -> Certificate:
        """The paper's own equations, relations and end conditions evaluated on this state: what is left of each."""
        return certify(self)


def _levels(solution: Solution) -> tuple[tuple[Family, State], tuple[Family, State]]:
    ladder, point = solution.ladder, solution.point
    return (ladder.coarse, point.coarse), (ladder.fine, point.fine)
