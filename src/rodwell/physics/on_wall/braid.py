"""From y(s) back to the braid: all fields of rod and cylinder, with their equation numbers.

Vectors are given in the braid frame {t₁, d₁, u₁} of the rod unless said otherwise. The angle ``y/Δ`` is ξ₂ for a
rod at the bottom and ξ₂ − π for a rod on top; lateral weight carries the sign that goes with it. Units B = L = 1.

Conditions (B9)–(B14): the end loads at s = 1 act on the rod alone, the cylinder is free of load there. What the
supports of the cylinder must bear is therefore found at s = 0. For other ends than clamped ones the constants of
integration follow from the same rule. An end that holds y bears the circumferential force F₃(1), one that holds
y′ the moment M₂(1); what an end does not hold vanishes (natural conditions). At an end that can turn (pinned,
free) the rod keeps the curvature ω₃ = sin²η/Δ, though no fitting bends it: the moment ω₃ u₁ there comes from the
rim of contact, as a pair of opposite radial forces close together, which does no work and acts on the cylinder
in return. A step [b] of the stiffness does the same inside: the moment b ω₃ jumps there, and the wall's pair of forces
bears it (:mod:`rodwell.physics.on_wall.sections`). Where y is free, it is F₁ sin η + F₃ cos η of the rod together with
ω₃ sin η/Δ from that pair that vanishes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rodwell.physics.on_wall.end_loads import EndForce
from rodwell.physics.on_wall.frames import material_curvatures
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, LATERAL_WEIGHT, TWIST
from rodwell.physics.on_wall.strand import axial_resultant, contact_pressure, curvatures, strand_force
from rodwell.physics.on_wall.tapered import more_force, more_pressure

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class Taper(NamedTuple):
    """Where sections taper: b′ and b″, and the derivative by s of the lateral weight per length, (m,) each."""

    rate: FloatArray
    bend: FloatArray
    lateral: FloatArray


def wall_pressure(
    s: FloatArray,
    u: FloatArray,
    parameters: Sequence[Any] | FloatArray,
    stiffness: float | FloatArray,
    taper: Taper | None,
) -> FloatArray:
    """Contact pressure p (m,) at ``s`` (m,) from y and three derivatives (4, m), (55)."""
    pressure = contact_pressure(s, u[0], u[1], u[2], u[3], parameters, stiffness)
    if taper is not None:
        pressure = pressure + more_pressure(u[1], u[2], u[3], parameters[CLEARANCE], taper.rate, taper.bend)
    return np.asarray(pressure)


def rates(
    s: FloatArray,
    u: FloatArray,
    parameters: Sequence[Any] | FloatArray,
    torsional_stiffness: float | FloatArray,
    end: EndForce,
    stiffness: float | FloatArray = 1.0,
    taper: Taper | None = None,
) -> FloatArray:
    """Derivatives along s of what has to be integrated, (8, m); where sections taper (9, m).

    Of a string, ``parameters``, ``torsional_stiffness`` and ``stiffness`` are those of the section of each place.

    z' (44), ξ₁' (32), T₂' (33), M' = −t₁ × F (25)–(27) of the braid moment along i, j, k, with the braid
    force F = N(s) k + F₃(1) u₂(1), and (48) along i and j: lateral weight and contact pressure on the rod. Ninth, what
    changes F₁⁽¹⁾ + ½b(ω₂² + ω₃²) + Δ wₗ cos ξ₂ along a taper.
    """
    clearance = parameters[CLEARANCE]
    pressure = wall_pressure(s, u, parameters, stiffness, taper)
    angle, sin_eta = u[0] / clearance, u[1]
    cos_eta, omega1, omega2, omega3, _ = curvatures(u[1], u[2], u[3], clearance)
    axial, (along_i, along_j) = axial_resultant(s, parameters), end.across
    more = []
    if taper is not None:
        lost = 0.5 * taper.rate * (omega2**2 + omega3**2)
        more = [parameters[AXIAL_WEIGHT] * cos_eta + clearance * taper.lateral * np.cos(angle) - lost]
    return np.array(
        [
            cos_eta,
            parameters[TWIST] / torsional_stiffness + omega1,
            clearance * parameters[LATERAL_WEIGHT] * np.sin(angle),
            cos_eta * along_j - sin_eta * np.cos(angle) * axial,
            sin_eta * np.sin(angle) * axial - cos_eta * along_i,
            sin_eta * (np.cos(angle) * along_i - np.sin(angle) * along_j),
            parameters[LATERAL_WEIGHT] + pressure * np.cos(angle),
            -pressure * np.sin(angle),
            *more,
        ]
    )


def reconstruct(
    s: FloatArray,
    u: FloatArray,
    from_left: FloatArray,
    from_right: FloatArray,
    parameters: Sequence[Any] | FloatArray,
    torsional_stiffness: float | FloatArray,
    end: EndForce,
    stiffness: float | FloatArray = 1.0,
    piece: IntArray | None = None,
    taper: Taper | None = None,
) -> dict[str, FloatArray]:
    """All fields at ``s`` (m,).

    Parameters
    ----------
    s, u
        Places (m,) and y, y', y'', y''' there (4, m).
    from_left, from_right
        Integrals of :func:`rates` (8 or 9, m): from 0 to s, and from s to 1.
    parameters
        Physical parameters (6,); of a string those of the section of each place, (m,) where they differ.
    torsional_stiffness
        C, in units of B, one or (m,).
    end
        Loads at s = 1.
    stiffness
        b = B(s)/B, one or (m,).
    piece
        Number of the section of each place (m,), None of a uniform rod: ``from_right`` then has the step loads in it.
    taper
        Where sections taper, what of that is needed at each place.

    Returns
    -------
    dict
        Field name to values (m,); names, symbols, units and equations are in ``rodwell.quantities.names``.
    """
    out = _rod(s, u, from_left, parameters, torsional_stiffness, stiffness)
    if taper is not None:
        for i, more in enumerate(more_force(u[1], u[2], u[3], parameters[CLEARANCE], taper.rate), 1):
            out[f"rod_F{i}"] = out[f"rod_F{i}"] + more
        bent = more_pressure(u[1], u[2], u[3], parameters[CLEARANCE], taper.rate, taper.bend)
        out["contact_pressure"] = out["contact_pressure"] + bent
    frame = _Frame.along(u[0] / parameters[CLEARANCE], u[1])
    out |= _braid(s, frame, from_right[3:6], parameters, end)
    out |= _cylinder(frame, out, from_right[:8], parameters, end)
    below = parameters[AXIAL_WEIGHT] * from_right[0] if taper is None else -from_left[8]
    out["tangential_balance"] = _tangential_balance(out, below, parameters, stiffness, piece)
    return out


@dataclass(frozen=True)
class _Frame:
    """Sines and cosines of ξ₂ and η, (m,): the braid frame {t₁, d₁, u₁}."""

    sin_a: FloatArray
    cos_a: FloatArray
    sin: FloatArray
    cos: FloatArray

    @classmethod
    def along(cls, angle: FloatArray, sin_eta: FloatArray) -> _Frame:
        return cls(np.sin(angle), np.cos(angle), sin_eta, np.sqrt(1.0 - sin_eta**2))

    def components(self, vector: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Components along t₁, d₁, u₁ of a vector (3, m) given along i, j, k."""
        inward = vector[0] * self.cos_a - vector[1] * self.sin_a
        around = vector[0] * self.sin_a + vector[1] * self.cos_a
        return self.sin * around + self.cos * vector[2], inward, self.cos * around - self.sin * vector[2]


def _rod(
    s: FloatArray,
    u: FloatArray,
    from_left: FloatArray,
    parameters: Sequence[Any] | FloatArray,
    torsional_stiffness: float | FloatArray,
    stiffness: float | FloatArray,
) -> dict[str, FloatArray]:
    """Shape, curvatures, forces and moments of the rod, and the contact pressure on it."""
    clearance, twist = parameters[CLEARANCE], parameters[TWIST]
    _, omega1, omega2, omega3, _ = curvatures(u[1], u[2], u[3], clearance)
    f1, f2, f3 = strand_force(s, u[1], u[2], u[3], parameters, stiffness)
    xi1 = from_left[1]
    material = material_curvatures(xi1, omega2, omega3, twist, torsional_stiffness)
    return {
        "y": u[0],
        "xi2": u[0] / clearance,
        "eta": np.arcsin(u[1]),
        "omega1": omega1,
        "omega2": omega2,
        "omega3": omega3,
        "material_omega1": material[0],
        "material_omega2": material[1],
        "material_omega3": material[2],
        "z": from_left[0],
        "xi1": xi1,
        "contact_pressure": contact_pressure(s, u[0], u[1], u[2], u[3], parameters, stiffness),
        "rod_F1": f1,
        "rod_F2": f2,
        "rod_F3": f3,
        "rod_M1": np.full_like(s, -twist),
        "rod_M2": stiffness * omega2,
        "rod_M3": stiffness * omega3,
    }


def _braid(
    s: FloatArray, frame: _Frame, moment_from_right: FloatArray, parameters: Sequence[Any] | FloatArray, end: EndForce
) -> dict[str, FloatArray]:
    """Force and moment of rod and cylinder together, components along t₁, d₁, u₁."""
    along_i, along_j = end.across
    force = np.array([np.full_like(s, along_i), np.full_like(s, along_j), axial_resultant(s, parameters)])
    moment = _end_moment(end, float(parameters[TWIST]))[:, None] - moment_from_right
    names = ("braid_F1", "braid_F2", "braid_F3", "braid_M1", "braid_M2", "braid_M3")
    return dict(zip(names, frame.components(force) + frame.components(moment), strict=True))


def _cylinder(
    frame: _Frame,
    known: dict[str, FloatArray],
    from_right: FloatArray,
    parameters: Sequence[Any] | FloatArray,
    end: EndForce,
) -> dict[str, FloatArray]:
    """Forces, moments and loads of the cylinder.

    F⁽²⁾ = F − F⁽¹⁾ and M⁽²⁾ = M − M⁽¹⁾ − Δ d₁ × F⁽²⁾, (45), where d₁ × (a t₂ + c u₂) = c t₂ − a u₂.
    """
    clearance, lateral = parameters[CLEARANCE], parameters[LATERAL_WEIGHT]
    g1, g2, g3 = (known[f"braid_F{i}"] - known[f"rod_F{i}"] for i in (1, 2, 3))
    m1, m2, m3 = (known[f"braid_M{i}"] - known[f"rod_M{i}"] for i in (1, 2, 3))
    axial = frame.cos * g1 - frame.sin * g3
    around = _cylinder_force_around(frame, from_right[6:], parameters, end)
    bending = frame.sin * m1 + frame.cos * m3  # Δ d₁ × F⁽²⁾ has Δ h along u₂: none without friction
    return {
        "cylinder_F1": axial,
        "cylinder_F2": g2,
        "cylinder_F3": around,
        "T2": -from_right[2],
        "T2_by_moments": frame.cos * m1 - frame.sin * m3 - clearance * around,
        "mu": m2,
        "cylinder_M3": bending,
        "lambda": bending / frame.cos,
        "cylinder_Omega1": -frame.sin / clearance,
        # p⁽²⁾ σ' = −p⁽¹⁾ − mg sin α i (50) and m⁽²⁾ σ' = −Δ d₁ × p⁽²⁾ σ' (51), with σ' = cos η
        "cylinder_p2": -(known["contact_pressure"] + lateral * frame.cos_a) / frame.cos,
        "cylinder_p3": -lateral * frame.sin_a / frame.cos,
        "cylinder_m1": clearance * lateral * frame.sin_a / frame.cos,
    }


def _end_moment(end: EndForce, twist: float) -> FloatArray:
    """Braid moment M(1) = −T₁ t₁ + b ω₂ d₁ along i, j, k, (B13)–(B14)."""
    sin_a, cos_a, cos_eta = np.sin(end.angle), np.cos(end.angle), np.sqrt(1.0 - end.slope**2)
    t1 = np.array([end.slope * sin_a, end.slope * cos_a, cos_eta])
    d1 = np.array([cos_a, -sin_a, 0.0])
    return np.asarray(end.moment * d1 - twist * t1)


def _cylinder_force_around(
    frame: _Frame, from_right: FloatArray, parameters: Sequence[Any] | FloatArray, end: EndForce
) -> FloatArray:
    """F₃⁽²⁾ = (F − F⁽¹⁾)·u₂ with the rod's force F⁽¹⁾ from weight and contact pressure, (48), integrated from s = 1.

    At s = 1 fitting and rim give the rod the force around the cylinder that (45) leaves, and F₂⁽¹⁾ towards the axis.
    """
    clearance, twist = parameters[CLEARANCE], parameters[TWIST]
    sin_a, cos_a, cos_eta = np.sin(end.angle), np.cos(end.angle), np.sqrt(1.0 - end.slope**2)
    around = end.shear - end.stiffness * end.slope**3 / clearance**2  # the rim's part is b ω₃ sin η/Δ
    inward = -end.moment * (twist / end.stiffness - 3.0 * end.slope * cos_eta / clearance)
    inward -= end.stiffness_rate * end.slope**2 / clearance
    rod_i = inward * cos_a + around * sin_a - from_right[0]
    rod_j = -inward * sin_a + around * cos_a - from_right[1]
    along_i, along_j = end.across
    return np.asarray((along_i - rod_i) * frame.sin_a + (along_j - rod_j) * frame.cos_a)


def _tangential_balance(
    known: dict[str, FloatArray],
    below: FloatArray,
    p: Sequence[Any] | FloatArray,
    stiffness: float | FloatArray,
    piece: IntArray | None,
) -> FloatArray:
    """Residual of F₁⁽¹⁾ + ½b(ω₂² + ω₃²) + Δ wₗ cos ξ₂ − wₐ z = const., the first integral of (22)–(24), (48).

    ``below`` stands for −wₐ z, and for what a taper changes. It must vanish, in each section: F₁⁽¹⁾ comes from h = 0,
    this from force balance along t₁, an independent route.
    """
    bending = 0.5 * stiffness * (known["omega2"] ** 2 + known["omega3"] ** 2)
    height = p[CLEARANCE] * p[LATERAL_WEIGHT] * np.cos(known["xi2"]) + below
    total = np.asarray(known["rod_F1"] + bending + height)
    if piece is None:
        return np.asarray(total - total[-1])
    return np.asarray(total - total[np.searchsorted(piece, piece, side="right") - 1])
