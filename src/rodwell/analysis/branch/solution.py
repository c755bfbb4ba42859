"""One equilibrium as users hold it: a record, and its faces."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from rodwell.analysis.discrete.measures import MEASURES
from rodwell.analysis.state.balance import Reaction, end_rotation, energies, reactions
from rodwell.analysis.state.certificate import Certificate, certificate_of
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.analysis.state.fields import GRID
from rodwell.analysis.state.on_ramps import OnRamps
from rodwell.analysis.state.own_places import with_own_places
from rodwell.analysis.state.wall import StepLoad, WallLoads, step_loads, wall_loads
from rodwell.faces import Shown, drawn, drawn_in_space, face
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter, varied
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    import xarray as xr

    from rodwell.analysis.space.geometry import Geometry
    from rodwell.faces import Axes
    from rodwell.quantities.scales import Scales


class Solution(Equilibrium, Shown):
    """An equilibrium of ``problem`` at one end force: a record with faces, see :class:`Equilibrium` for its fields.

    Created by :func:`rodwell.follow` and :func:`rodwell.equilibrium`; all numbers are in units B = L = 1.
    """

    @property
    def converged(self) -> bool:
        """Whether every measured number meets the tolerance asked for, and the certificate its limit."""
        return self.accurate and self.certificate.passed

    @cached_property
    def certificate(self) -> Certificate:
        """The paper's own equations, relations and end conditions evaluated on this state: what is left of each."""
        return certificate_of(self)

    @cached_property
    def own_places(self) -> Solution:
        """The state in a curved hole with every cross-section at its own place along it.

        Branches take the hole where the undeformed rod is, which is off by the end shortening at most: see
        :mod:`rodwell.analysis.state.own_places`.

        Raises
        ------
        InputError
            If the hole is straight.
        NotConvergedError
            If it could not be solved.
        """
        meshes, point = with_own_places(self.problem, self.meshes, self.point)
        return Solution(self.problem, point, meshes)

    @property
    def place_errors(self) -> dict[str, float]:
        """By how much each measured number is off, with the hole where the undeformed rod is; none if straight."""
        if self.problem.hole is None:
            return {}
        own = self.own_places
        return {name: abs(own.number(which).value - self.number(which).value) for which, name in MEASURES.items()}

    @property
    def axial_contact_error(self) -> float:
        """By how much the axial force is off at most, in B/L², where the clearance varies along the rod; 0 elsewhere.

        Branches take what the wall pushes along the hole as on the rod that lies straight, so that they leave it at its
        own critical load. This is how much more or less the contact of the buckled rod pushes above any place.
        """
        return OnRamps(self.problem, *self.levels[1]).axial_contact_error() if self.problem.ramps else 0.0

    @cached_property
    def energies(self) -> dict[str, Value]:
        """Strain energies, heights and work of the end loads: see :func:`rodwell.analysis.state.balance.energies`."""
        return energies(self)

    @cached_property
    def wall(self) -> WallLoads:
        """What wall and supports must bear: see :class:`rodwell.analysis.state.wall.WallLoads`."""
        return wall_loads(self)

    @cached_property
    def step_loads(self) -> tuple[StepLoad, ...]:
        """What the wall exerts at steps of the bending stiffness: see :class:`rodwell.analysis.state.wall.StepLoad`."""
        return step_loads(self)

    @cached_property
    def reactions(self) -> tuple[Reaction, ...]:
        """What the supports exert on rod and cylinder: see :func:`rodwell.analysis.state.balance.reactions`."""
        return reactions(self)

    @cached_property
    def end_rotation(self) -> Value:
        """How far the end s = 1 is turned about its axis: see :func:`rodwell.analysis.state.balance.end_rotation`."""
        return end_rotation(self)

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
        from rodwell.analysis.space.geometry import geometry  # noqa: PLC0415 - most who solve do not draw

        return geometry(self, places, rod_radius=rod_radius, radial_scale=radial_scale)

    def dataset(self, places: int = GRID, *, length: float | None = None, stiffness: float | None = None) -> xr.Dataset:
        """Everything as an xarray Dataset: see :func:`rodwell.store.dataset.solution_dataset`."""
        data: xr.Dataset = face("dataset")(self, places, length=length, stiffness=stiffness)
        return data

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


def solution_of(problem: Problem, parameter: Parameter, point: MeshedState, meshes: TwoMeshes) -> Solution:
    """Return the solution of a state of a branch of ``problem`` in a parameter, whose value the state knows."""
    return Solution(varied(problem, parameter, point.lam), point, meshes)
