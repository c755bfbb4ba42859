"""From y(s) back to the braid: all fields of rod and cylinder, with their equation numbers.

Vectors are given in the braid frame {t₁, d₁, u₁} of the rod unless said otherwise. The angle ``y/Δ`` is ξ₂ for a
rod at the bottom and ξ₂ − π for a rod on top; lateral weight carries the sign that goes with it. Units B = L = 1.

Conditions (B9)–(B14): the end loads at s = 1 act on the rod alone, the cylinder is free of load there. What the
supports of the cylinder must bear is therefore found at s = 0. For other ends than clamped ones the constants of
integration follow from the same rule. An end that holds y bears the circumferential force F₃(1), one that holds
y′ the moment M₂(1); what an end does not hold vanishes (natural conditions). At an end that can turn (pinned,
free) the rod keeps the curvature ω₃ = sin²η/Δ, though no fitting bends it: the moment ω₃ u₁ there comes from the
rim of contact, as a pair of opposite radial forces close together, which does no work and acts on the cylinder
in return. Where y is free, it is F₁ sin η + F₃ cos η of the rod together with ω₃ sin η/Δ from that pair that vanishes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rodwell.physics.parameters import AXIAL_WEIGHT, CLEARANCE, LATERAL_WEIGHT, TWIST
from rodwell.physics.strand import axial_resultant, contact_pressure, curvatures, strand_force

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class EndForce:
    """What acts on the rod at s = 1 besides F and T₁, and where that is.

    ``shear`` is the circumferential force, F₃(1) = ω₂'(1) at a clamped end, (B12); ``omega2`` the curvature there,
    (B13)–(B14); ``angle`` and ``slope`` are y(1)/Δ and sin η(1), both zero at a clamped end.
    """

    shear: float
    omega2: float
    angle: float = 0.0
    slope: float = 0.0


def end_force(moment: float, reaction: float, y: float, y1: float, parameters: FloatArray) -> EndForce:
    """Shear and bending moment at the end s = 1 from the natural boundary terms of the energy.

    ``moment`` is ∂e/∂y″ = y″/cos²η, so ω₂(1) = −moment cos η; ``reaction`` is ∂e/∂y′ − (∂e/∂y″)′, which at a clamped
    end is −y‴(1) = ω₂′(1). At an end that holds y but can turn, the end torque −T₁ t₁
    has a part T₁ (cos η − 1)/Δ in it.
    They come from virtual work, which knows them far better than the derivatives of a spline at its end.
    """
    clearance, twist = float(parameters[CLEARANCE]), float(parameters[TWIST])
    cos_eta = float(np.sqrt(1.0 - y1 * y1))
    return EndForce(reaction - twist * (cos_eta - 1.0) / clearance, -moment * cos_eta, y / clearance, y1)


def rates(
    s: FloatArray, u: FloatArray, parameters: FloatArray, torsional_stiffness: float, end: EndForce
) -> FloatArray:
    """Derivatives along s of what has to be integrated, (6, m).

    z' (44), ξ₁' (32), T₂' (33), and M' = −t₁ × F (25)–(27) of the braid moment along i, j, k, with the braid
    force F = N(s) k + F₃(1) j.
    """
    clearance = parameters[CLEARANCE]
    angle, sin_eta = u[0] / clearance, u[1]
    cos_eta, omega1, *_ = curvatures(u[1], u[2], u[3], clearance)
    axial, shear = axial_resultant(s, parameters), end.shear
    return np.array(
        [
            cos_eta,
            parameters[TWIST] / torsional_stiffness + omega1,
            clearance * parameters[LATERAL_WEIGHT] * np.sin(angle),
            cos_eta * shear - sin_eta * np.cos(angle) * axial,
            sin_eta * np.sin(angle) * axial,
            -sin_eta * np.sin(angle) * shear,
        ]
    )


def reconstruct(
    s: FloatArray,
    u: FloatArray,
    from_left: FloatArray,
    from_right: FloatArray,
    parameters: FloatArray,
    end: EndForce,
) -> dict[str, FloatArray]:
    """All fields at ``s`` (m,).

    Parameters
    ----------
    s, u
        Places (m,) and y, y', y'', y''' there (4, m).
    from_left, from_right
        Integrals of :func:`rates` (6, m): from 0 to s, and from s to 1.
    parameters
        Physical parameters (6,).
    end
        Loads at s = 1.

    Returns
    -------
    dict
        Field name to values (m,); names, symbols, units and equations are in ``rodwell.analysis.nomenclature``.
    """
    clearance, twist = parameters[CLEARANCE], parameters[TWIST]
    angle, sin_eta = u[0] / clearance, u[1]
    cos_eta, omega1, omega2, omega3, _ = curvatures(u[1], u[2], u[3], clearance)
    f1, f2, f3 = strand_force(s, u[1], u[2], u[3], parameters)
    out = {
        "y": u[0],
        "xi2": angle,
        "eta": np.arcsin(sin_eta),
        "omega1": omega1,
        "omega2": omega2,
        "omega3": omega3,
        "z": from_left[0],
        "xi1": from_left[1],
        "contact_pressure": contact_pressure(s, u[0], u[1], u[2], u[3], parameters),
        "rod_F1": f1,
        "rod_F2": f2,
        "rod_F3": f3,
        "rod_M1": np.full_like(s, -twist),
        "rod_M2": omega2,
        "rod_M3": omega3,
    }
    # braid force and moment: components along i, j, k, then along t1, d1, u1
    sin_a, cos_a = np.sin(angle), np.cos(angle)
    t1 = np.array([sin_eta * sin_a, sin_eta * cos_a, cos_eta])
    d1 = np.array([cos_a, -sin_a, np.zeros_like(s)])
    u1 = np.array([cos_eta * sin_a, cos_eta * cos_a, -sin_eta])
    force = np.array([np.zeros_like(s), np.full_like(s, end.shear), axial_resultant(s, parameters)])
    moment = _end_moment(end, twist)[:, None] - from_right[3:]
    for name, vector in (("braid_F", force), ("braid_M", moment)):
        for i, axis in enumerate((t1, d1, u1), start=1):
            out[f"{name}{i}"] = np.sum(vector * axis, axis=0)
    # cylinder: F² = F − F¹, M² = M − M¹ − Δ d1 × F² (45), with d1 × (a t1 + b d1 + c u1) = c t1 − a u1
    g1, g2, g3 = (out[f"braid_F{i}"] - out[f"rod_F{i}"] for i in (1, 2, 3))
    m1, m2, m3 = (out[f"braid_M{i}"] - out[f"rod_M{i}"] for i in (1, 2, 3))
    m1, m3 = m1 - clearance * g3, m3 + clearance * g1
    out |= {
        "cylinder_F1": cos_eta * g1 - sin_eta * g3,
        "cylinder_F2": g2,
        "cylinder_F3": sin_eta * g1 + cos_eta * g3,
        "T2": -from_right[2],
        "T2_by_moments": cos_eta * m1 - sin_eta * m3,
        "mu": m2,
        "cylinder_M3": sin_eta * m1 + cos_eta * m3,
    }
    out["lambda"] = out["cylinder_M3"] / cos_eta
    out["tangential_balance"] = _tangential_balance(f1, omega2, omega3, angle, from_right[0], parameters)
    return out


def _end_moment(end: EndForce, twist: float) -> FloatArray:
    """Braid moment M(1) = −T₁ t₁ + ω₂ d₁ along i, j, k, (B13)–(B14)."""
    sin_a, cos_a, cos_eta = np.sin(end.angle), np.cos(end.angle), np.sqrt(1.0 - end.slope**2)
    t1 = np.array([end.slope * sin_a, end.slope * cos_a, cos_eta])
    d1 = np.array([cos_a, -sin_a, 0.0])
    return np.asarray(end.omega2 * d1 - twist * t1)


def _tangential_balance(
    f1: FloatArray,
    omega2: FloatArray,
    omega3: FloatArray,
    angle: FloatArray,
    z_right: FloatArray,
    p: FloatArray,
) -> FloatArray:
    """Residual of F₁⁽¹⁾ + ½(ω₂² + ω₃²) + Δ wₗ cos ξ₂ − wₐ z = const., the first integral of (22)–(24), (48).

    It must vanish: F₁⁽¹⁾ comes from h = 0, this from force balance along t₁, an independent route.
    """
    weight = p[CLEARANCE] * p[LATERAL_WEIGHT]
    total = f1 + 0.5 * (omega2**2 + omega3**2) + weight * np.cos(angle) + p[AXIAL_WEIGHT] * z_right
    return np.asarray(total - total[-1])
