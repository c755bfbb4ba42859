"""Critical loads of the straight rod without the wall's help: both lateral displacements, twist and axial weight.

Lateral weight and wall are left out: these are the loads at which the rod, held by nothing but its ends, would buckle.
Where lateral weight presses the rod to the wall, the wall's help is what makes the loads of
:func:`rodwell.critical_loads` larger. Where nothing presses it, the rod is free to move inwards; see
:mod:`rodwell.analysis.straight.touching`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from rodwell.analysis.discrete.choices import MOST_ELEMENTS
from rodwell.analysis.discrete.family import pair_ends
from rodwell.analysis.discrete.meshes import free_space
from rodwell.analysis.straight.pencil import Pencil
from rodwell.analysis.straight.scale import load_noise, twisted_load_scale
from rodwell.analysis.straight.slopes import lever_at, weight_rates
from rodwell.analysis.straight.touching import first_inwards
from rodwell.errors import InputError, NotConvergedError, checked_whole
from rodwell.numerics.splines import pair
from rodwell.numerics.splines.spaces import Prolongation, SplineSpace
from rodwell.physics.off_wall.linear import torque_density
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import ComplexArray, FloatArray
from rodwell.quantities.tolerance import RTOL, checked_rtol

MOST_LOADS = 100

SINGLE, DOUBLE = 1, 2

RIGID = 1e-3
"""Wavenumber in rad/L below which a mode does not bend but by round-off."""

MOST_TWIST = 200.0
"""Largest |T₁| in B/L with which contact of a rod that nothing presses to the wall is sought."""

OVER = ("weight", "alpha", "clearance", "twist")
"""By what loads can be derived: γ, α in degrees, Δ/L, T₁."""


@dataclass(frozen=True)
class SpatialMode:
    """A mode of the straight rod in both lateral displacements, u = x + iy: x inwards from the wall, y around it.

    Attributes
    ----------
    problem
        The problem that it belongs to.
    force
        Critical end force F at s = 1 in B/L², tension positive.
    error
        Estimate of its error, in B/L²: from two nested meshes, and round-off.
    multiplicity
        2 if every exp(iφ)u is a mode as well, as where all ends hold x and y alike; otherwise 1.
    space, coefficients
        The mode as a spline with complex coefficients (n,).
    """

    problem: Problem
    force: float
    error: float
    multiplicity: int
    space: SplineSpace
    coefficients: ComplexArray

    def __repr__(self) -> str:
        times = f", {self.multiplicity} modes" if self.multiplicity > 1 else ""
        return f"<SpatialMode at F = {self.force:.10g} B/L²{times}>"

    @property
    def rigid(self) -> bool:
        """Whether the mode is a motion of the whole rod without bending: then its load is 0 exactly."""
        return self.problem.weight == self.force == 0.0

    def shape(self, s: FloatArray) -> ComplexArray:
        """Mode u(s) = x + iy at ``s`` (m,), scaled to a largest displacement of 1."""
        u = pair.evaluate(self.space, self.coefficients, np.asarray(s, dtype=float), 1)[0]
        fine = pair.evaluate(self.space, self.coefficients, np.linspace(0.0, 1.0, 2001), 1)[0]
        return np.asarray(u / np.max(np.abs(fine)))

    def derivative(self, over: str) -> float:
        """Derivative of the force by "weight", "alpha" in degrees, "clearance" (0), or "twist", the others constant.

        From the Rayleigh quotient, of which the force is a stationary value:
        dF/dq = −∂Q/∂q / ∫|u′|² ds with Q of :mod:`rodwell.physics.off_wall.linear`.
        """
        if over not in OVER:
            raise InputError("over", over, f"must be one of {', '.join(OVER)}")
        _, slope, bend = pair.derivatives(self.space, self.coefficients)
        w = self.space.weights
        if over == "twist":
            rate = w @ torque_density(slope, bend)
        else:
            lever = lever_at(self.problem, self.space.points)
            rate = weight_rates(self.problem, over)[0] * (w @ (lever * np.abs(slope) ** 2))
        return float(-rate / (w @ np.abs(slope) ** 2)) + 0.0


@dataclass(frozen=True)
class WallTouch(SpatialMode):
    """The first mode of a rod that lies at the wall without being pressed to it: it can move inwards, x ≥ 0 only.

    Attributes
    ----------
    moves_inward
        Whether a mode of the rod without a wall moves inwards only: then the wall does not help.
    contacts
        Where the mode needs the wall: from, to (equal: at a point), in L.
    """

    moves_inward: bool
    contacts: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class LoadsWithoutWall:
    """Loads at which the straight rod would buckle if its ends alone held it, and what becomes of them at the wall.

    Attributes
    ----------
    problem
        The problem; its lateral weight and clearance do not enter.
    modes
        In the order in which they are met as compression grows.
    rtol
        Tolerance that they were asked for with.
    """

    problem: Problem
    modes: tuple[SpatialMode, ...]
    rtol: float

    def __repr__(self) -> str:
        return f"<LoadsWithoutWall F = {', '.join(f'{force:.10g}' for force in self.forces)} B/L²>"

    @property
    def forces(self) -> FloatArray:
        """Critical end forces, (n,), falling (tension positive), in B/L²."""
        return np.array([mode.force for mode in self.modes])

    @property
    def errors(self) -> FloatArray:
        """Error estimates, (n,), in B/L²."""
        return np.array([mode.error for mode in self.modes])

    @property
    def scale(self) -> float:
        """What errors are judged against beside the size of a load: γ cos α + 4π² + T₁²/4."""
        return twisted_load_scale(self.problem)

    @cached_property
    def at_wall(self) -> WallTouch | None:
        """The first mode with the wall's help, where no lateral weight acts; None where it does.

        There the load is that of :func:`rodwell.critical_loads`, if weight presses the rod to the wall. The true load
        with the wall's help is not above the load without it. It is not below this one, up to its error; that no mode
        elsewhere on the cone comes earlier was looked for from many starts and is not proved.

        Raises
        ------
        NotConvergedError
            If abs(T₁) > 200.
        """
        if self.problem.lateral_weight > 0.0:
            return None
        first = self.modes[0]
        if abs(self.problem.twist) > MOST_TWIST:
            raise NotConvergedError(
                f"the load with the wall's help is not computed for |T₁| above {MOST_TWIST:g}, where the mode touches "
                f"the wall in too many places; it is not above {first.force:.6g} B/L² (tension positive)"
            )
        size = abs(first.force) + twisted_load_scale(self.problem)
        found = first_inwards(_pencil(self.problem), first.space, first.multiplicity == DOUBLE, self.rtol * size)
        error = found.error + (first.error if found.moves_inward else load_noise(self.problem) * size)
        force = first.force if found.moves_inward else -found.value
        mode = self.problem, force, error, SINGLE, found.space, found.coefficients
        return WallTouch(*mode, found.moves_inward, found.contacts)


def loads_without_wall(problem: Problem, count: int = 1, *, rtol: float = RTOL) -> LoadsWithoutWall:
    """Critical end forces of the straight rod without the wall's help, with twist and axial weight.

    The second variation in both lateral displacements: see :mod:`rodwell.physics.off_wall.linear`. Ends of a rod on the
    wall are radially held; "ball" and "loose" ends are not. T₁ is semi-tangential where an end can turn.

    Parameters
    ----------
    problem
        The rod. Its lateral weight, wall and clearance are left out.
    count
        How many, 1 to 100. Loads of two modes that are turned against each other count once.
    rtol
        Relative tolerance; the error is judged against abs(F) + γ cos α + 4π² + T₁²/4.

    Raises
    ------
    InputError
        If ``count`` or ``rtol`` is out of range, or ``problem.turns`` is not 0.
    NotConvergedError
        If the tolerance cannot be met.
    """
    problem.refuse_curved("loads without the wall are computed")
    problem.refuse_bridges("loads of the straight rod")
    rtol, count = checked_rtol(rtol), checked_whole("count", count, 1, MOST_LOADS)
    if problem.turns != 0:
        raise InputError("turns", problem.turns, "critical loads are those of the straight rod: turns must be 0")
    return _loads(problem, count, rtol)


@lru_cache(maxsize=64)
def _loads(problem: Problem, count: int, rtol: float) -> LoadsWithoutWall:
    pencil = _pencil(problem)
    alike = _alike(problem)
    wanted = count * alike
    space = free_space(problem, count)
    while space.size < 2 * wanted + 8:
        space = space.refined()
    values, vectors = pencil.lowest(space, wanted, None)
    while True:
        finer = space.refined()
        up = Prolongation(space, finer)
        start = np.array([pair.as_real(up(v.real.copy()) + 1j * up(v.imag.copy())) for v in vectors])
        better, shapes = pencil.lowest(finer, wanted, (values, start))
        forces = -better[:wanted]
        size = np.abs(forces) + twisted_load_scale(problem)
        error = np.abs(better[:wanted] - values[:wanted]) + load_noise(problem) * size
        if np.all(error <= rtol * size):
            break
        if 2 * finer.elements > MOST_ELEMENTS:
            reached = np.max(error / size)
            raise NotConvergedError(f"loads without the wall are known to {reached:.1e} only, rtol is {rtol:g}")
        space, values, vectors = finer, better, shapes
    forces[[_rigid(problem, finer, mode) for mode in shapes[:wanted]]] = 0.0
    modes = [
        SpatialMode(problem, float(forces[i]), float(error[i]), alike, finer, shapes[i])
        for i in range(0, wanted, alike)
    ]
    return LoadsWithoutWall(problem, tuple(modes), rtol)


def _rigid(problem: Problem, space: SplineSpace, mode: ComplexArray) -> bool:
    """Whether a mode does not bend and nothing acts on it but the end force."""
    _, slope, bend = pair.derivatives(space, mode)
    squares = (space.weights @ np.abs(u) ** 2 for u in (bend, RIGID * slope))
    return problem.weight == problem.twist == 0.0 and bool(next(squares) < next(squares))


def _alike(problem: Problem) -> int:
    """How many modes each load has: two where every end holds x and y alike."""
    return DOUBLE if problem.isotropic_ends else SINGLE


def _pencil(problem: Problem) -> Pencil:
    return Pencil(problem.axial_weight, problem.twist, *pair_ends(problem), problem.rod if problem.sections else None)
