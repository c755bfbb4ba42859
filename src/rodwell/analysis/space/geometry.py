"""The rod in space: centreline, frames, curvatures, and what is needed to draw or export it.

Axes i, j, k: k along the cylinder's axis from s = 0 to s = 1, i up (the lateral part of gravity points along −i), the
straight rod at x = −Δ (at x = Δ if it lies on top). The centreline is r₁ = −Δ cos ξ₂ i + Δ sin ξ₂ j + z k, with the
braid frame {t₁, d₁, u₁} of Section 2 of the paper: d₁ points from the rod to the cylinder's axis. The cross-section of
the rod carries the material frame {t₁, d₀, v₁}; (1) with R₁₁ = R₀₁ R₁(ξ₁) makes d₁ = cos ξ₁ d₀ + sin ξ₁ v₁, so the
material frame is the braid frame turned about t₁ by −ξ₁. Its rate of turning is ω̃₁ = ω₁ − ξ₁' = −T₁/C about t₁. Of a
rod that floats the straight one is at x = Δ, and −i and −j stand in these formulas for i and j.

In a curved hole all this holds with N1, N2, T of the hole beside the rod in place of i, j, k (of a rod that floats with
−N1, −N2), and i, j, k are those in the middle of the hole, at S = ½, where the hole is as far along k as if it were
straight.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.discrete.curved import undeformed_place
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.errors import InputError, checked_number, checked_whole
from rodwell.physics.on_wall.frames import frames
from rodwell.problem.clearances import refuse_ramps
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

DISPLAY_RADIUS = 0.2
"""Radius of the rod against Δ where none is known: the dimensionless problem has no radius."""

PROPORTION = 5.0
"""Length of a readable picture against the width of its cylinder."""

STEEPEST_DRAWN = 2.0
"""Largest slope of the drawn centreline against the cylinder's axis in a readable picture."""

INNERMOST = 0.5
"""Largest part of the radius of a bend that a readable picture of its hole reaches inwards."""

LARGEST_SCALE = 1e7
FEWEST_PLACES, MOST_PLACES = 2, 100_000
USUAL_PLACES = (401, 4001)
"""Fewest and most places along the rod that are chosen when none are asked for."""

TOUCHING = 1e-6
"""Contact pressure against its largest size that counts as none."""


@dataclass(frozen=True)
class Geometry:
    """The rod in space at m places, in units L = 1 (fields in units B = L = 1).

    Made by :meth:`rodwell.Solution.geometry`. With ``radial_scale`` n ≠ 1 everything across the axis is n times
    enlarged, the rod's radius included: the centreline is that of the enlarged curve, and the frames belong to it.
    Material lines keep their twist −T₁/C about the drawn centreline, so that a rod without twist shows none.
    ``fields``, ``curvatures`` and ``material_curvatures`` are always those of the rod itself.

    Attributes
    ----------
    s
        Arclength of the rod (m,), even from 0 to 1.
    centreline
        x, y, z along i, j, k, (m, 3).
    t1, d1, u1
        Braid frame (m, 3): tangent, direction to the cylinder's axis, u₁ = t₁ × d₁.
    d0, v1
        Directors of the cross-section (m, 3), the material frame with t₁.
    curvatures, material_curvatures
        ω₁, ω₂, ω₃ along t₁, d₁, u₁ (20), and ω̃₁, ω̃₂, ω̃₃ along t₁, d₀, v₁, (m, 3), in 1/L; ω̃₁ is the twist −T₁/C.
    fields
        All fields at ``s``, see :meth:`rodwell.Solution.fields`.
    clearance
        Δ/L, not enlarged.
    rod_radius
        Radius of the rod in L, not enlarged.
    radial_scale
        How many times everything across the axis is enlarged; 1 is true scale.
    outside
        The rod lies on the outside of the cylinder.
    axis, across
        Points (m, 3) of the cylinder's axis beside the rod, and unit vectors (m, 2, 3) across it there: i, j of a
        straight cylinder, N1, N2 of a curved hole. Not enlarged.
    lift_off
        Places s at which the rod is lifting off: where the wall pushes no longer. Beyond lift-off, where it would have
        to pull most. Empty where contact is complete. Of a rod that may have left the wall: ends of stretches in
        contact, and points of contact.
    """

    s: FloatArray
    centreline: FloatArray
    t1: FloatArray
    d1: FloatArray
    u1: FloatArray
    d0: FloatArray
    v1: FloatArray
    curvatures: FloatArray
    material_curvatures: FloatArray
    fields: dict[str, FloatArray]
    clearance: float
    rod_radius: float
    radial_scale: float
    outside: bool
    axis: FloatArray
    across: FloatArray
    lift_off: tuple[float, ...]

    @property
    def drawn_radius(self) -> float:
        """Radius of the drawn rod in L."""
        return self.rod_radius * self.radial_scale

    @property
    def wall_radius(self) -> float:
        """Radius in L of the drawn surface that the rod's own surface touches.

        Inner radius Δ + rod radius of a surrounding cylinder, outer radius Δ − rod radius of one that the rod lies on.
        """
        side = -1.0 if self.outside else 1.0
        return (self.clearance + side * self.rod_radius) * self.radial_scale

    @property
    def bent(self) -> bool:
        """Whether the cylinder is a curved hole."""
        return bool(np.any(self.across != self.across[0]))

    @property
    def may_leave(self) -> bool:
        """Whether the rod may have left the wall: then ``fields`` has its gap from the wall, in Δ."""
        return "gap" in self.fields

    @property
    def pull(self) -> FloatArray:
        """Contact pressure (m,) in B/L³ with the sign that makes it negative in contact, inside and outside."""
        p = self.fields["contact_pressure"]
        return -p if self.outside else p


def geometry(
    solution: Equilibrium,
    places: int | None = None,
    *,
    rod_radius: float | None = None,
    radial_scale: float | None = 1.0,
) -> Geometry:
    """Return the rod of ``solution`` in space; arguments and errors as in :meth:`rodwell.Solution.geometry`."""
    problem = solution.problem
    refuse_ramps(problem, "pictures and shapes in space")
    count = _places(solution, places)
    s = np.linspace(0.0, 1.0, count)
    fields = solution.fields(s)
    radius = checked_radius(problem, rod_radius, np.hypot(fields["omega2"], fields["omega3"]))
    sharpest = 0.0 if problem.hole is None else problem.hole.sharpest
    scale = checked_scale(fields["eta"], problem.clearance + radius, radial_scale, sharpest)
    sin_eta, cos_eta = np.sin(fields["eta"]), np.cos(fields["eta"])
    drawn = np.arctan2(scale * sin_eta, cos_eta)
    # (32) with the drawn angle: ω₁ of the drawn frame is −ξ₂' cos η, per length of the rod
    angle = fields["xi1"] + _running((cos_eta - np.cos(drawn)) * sin_eta / problem.clearance, s)
    axes = frames(angle, drawn, fields["xi2"])
    (t1, d1, u1), (_, d0, v1) = (np.moveaxis(axes[name], 2, 0).copy() for name in ("R11", "R01"))
    axis, across = beside(problem, fields["z"])
    along = np.cross(across[:, 0], across[:, 1])
    there = np.concatenate([across, along[:, None]], axis=1)
    t1, d1, u1, d0, v1 = (np.einsum("mi,mic->mc", vectors, there) for vectors in (t1, d1, u1, d0, v1))
    centreline = axis - scale * problem.clearance * d1
    braid, material = (
        np.stack([fields[f"{name}{i}"] for i in (1, 2, 3)], axis=-1) for name in ("omega", "material_omega")
    )
    return Geometry(
        s, centreline, t1, d1, u1, d0, v1, braid, material, fields, problem.clearance, radius, scale,
        problem.outside, axis, across, _lift_off(solution, fields),
    )  # fmt: skip


def beside(problem: Problem, z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Axis (m, 3) and unit vectors across it (m, 2, 3) at distances z (m,) along it from the end s = 0."""
    if problem.hole is None:
        axis = np.stack([0.0 * z, 0.0 * z, z], axis=1)
        return axis, np.tile(upwards(problem) * np.eye(3)[:2], (z.size, 1, 1))
    places = float(undeformed_place(problem, np.array([0.0]))[0]) + z
    middle = np.array([0.5])
    (_, (turn,), origin), (_, frames, points) = problem.hole.at(middle), problem.hole.at(places)
    turn = np.array([[upwards(problem)], [upwards(problem)], [1.0]]) * turn
    axis = (points - origin) @ turn.T + np.array([0.0, 0.0, 0.5])
    return axis, frames[:, :2] @ turn.T


def upwards(problem: Problem) -> float:
    """1, or −1 of a rod that floats: what it calls up, away from the side to which it is pressed, points down."""
    return -1.0 if problem.floats else 1.0


def readable_scale(eta: FloatArray, reach: float, sharpest: float = 0.0) -> float:
    """Enlargement across the axis with which a picture can be read, two digits, at least 1.

    ``eta`` is the angle between rod and axis along the rod, ``reach`` the largest distance from the axis, in L,
    ``sharpest`` the largest curvature of the axis. The picture becomes five times as long as wide, longer where the
    centreline would become steeper than 2, or where the inside of the bend would come closer than half to its centre.
    """
    by_width = 1.0 / (reach * max(2.0 * PROPORTION, sharpest / INNERMOST))
    steepest = float(np.max(np.abs(np.tan(eta))))
    scale = min(by_width, STEEPEST_DRAWN / max(steepest, 1e-300))
    if scale <= 1.0:
        return 1.0
    digit = 10.0 ** (np.floor(np.log10(scale)) - 1.0)
    return float(max(1.0, np.floor(scale / digit) * digit))


def checked_radius(problem: Problem, given: float | None, curvature: FloatArray) -> float:
    """Return the rod's radius in L, or raise: it must fit the cylinder, and bends must not close on themselves."""
    clearance = problem.clearance
    if given is None:
        return DISPLAY_RADIUS * clearance
    radius = checked_number("rod_radius", given, 0.0, 1.0, "above 0 and below 1, in L")
    if not 0.0 < radius < 1.0:
        raise InputError("rod_radius", given, "must be above 0 and below 1, in L")
    if problem.outside and radius >= clearance:
        raise InputError("rod_radius", given, f"must be below Δ = {clearance:g} L: the rod lies outside the cylinder")
    sharpest = float(np.max(curvature))
    if radius * sharpest >= 1.0:
        raise InputError("rod_radius", given, f"must be below the smallest radius of curvature, {1.0 / sharpest:g} L")
    return radius


def _places(solution: Equilibrium, places: int | None) -> int:
    if places is not None:
        return checked_places(places)
    elements = solution.meshes.fine.space.breaks.size - 1
    return min(max(USUAL_PLACES[0], 4 * elements + 1), USUAL_PLACES[1])


def checked_places(given: int) -> int:
    """Return how many places along the rod, or raise."""
    return checked_whole("places", given, FEWEST_PLACES, MOST_PLACES)


def checked_scale(eta: FloatArray, reach: float, given: float | None, sharpest: float = 0.0) -> float:
    """Return the enlargement across the axis, or raise; arguments as for :func:`readable_scale`."""
    if given is None:
        return readable_scale(eta, reach, sharpest)
    most = min(LARGEST_SCALE, max(1.0, 1.0 / (reach * sharpest))) if sharpest > 0.0 else LARGEST_SCALE
    allowed = f"from 1 (true scale) to {most:.4g}"
    if most < LARGEST_SCALE:
        allowed += ", at which the wall reaches the centre of the hole's bend"
    return checked_number("radial_scale", given, 1.0, most, allowed)


def _running(rate: FloatArray, s: FloatArray) -> FloatArray:
    """Integral from 0 to each place, trapezoidal rule."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(s))])


def _lift_off(solution: Equilibrium, fields: dict[str, FloatArray]) -> tuple[float, ...]:
    top, error, places = solution.highest_pressure
    size = float(np.max(np.abs(fields["contact_pressure"])))
    straight = not np.any(fields["y"])  # nothing lifts off by itself where nothing presses either
    return () if straight or top < -max(2.0 * error, TOUCHING * size) else places
