"""Names, symbols, units and equation numbers of every quantity: code, datasets, plots and docs share it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    """One quantity of the theory.

    ``dimension`` says how it scales with the length L and bending stiffness B of the rod: "1", "length",
    "curvature", "force", "force_per_length", "moment", "energy".
    """

    name: str
    symbol: str
    dimension: str
    equation: str
    meaning: str


UNITS = {
    "1": "1",
    "angle": "rad",
    "length": "L",
    "curvature": "1/L",
    "force": "B/L^2",
    "force_per_length": "B/L^3",
    "moment": "B/L",
    "energy": "B/L",
    "stress": "B/L^4",
}
"""Units of the dimensionless problem by dimension."""

POWERS = {
    "1": (0, 0),
    "angle": (0, 0),
    "length": (0, 1),
    "curvature": (0, -1),
    "force": (1, -2),
    "force_per_length": (1, -3),
    "moment": (1, -1),
    "energy": (1, -1),
    "stress": (1, -4),
}
"""Powers of B and L in the unit of each dimension."""

SI_UNITS = {
    "1": "1",
    "angle": "rad",
    "length": "m",
    "curvature": "1/m",
    "force": "N",
    "force_per_length": "N/m",
    "moment": "N m",
    "energy": "J",
    "stress": "Pa",
}

_FIELDS = (
    ("y", "y", "length", "(64)", "circumferential arclength, Δ ξ₂, from the generator of the straight rod"),
    ("xi2", "ξ₂", "angle", "(19)", "angle around the cylinder from its bottom"),
    ("eta", "η", "angle", "(1)", "braid angle between rod and cylinder axis"),
    ("xi1", "ξ₁", "angle", "(32)", "twist angle of the rod against the braid frame"),
    ("z", "z", "length", "(44)", "distance along the cylinder axis from s = 0"),
    ("omega1", "ω₁", "curvature", "(20)", "braid curvature along t₁"),
    ("omega2", "ω₂", "curvature", "(20)", "geodesic curvature, −η'"),
    ("omega3", "ω₃", "curvature", "(20)", "curvature forced by the wall, sin²η/Δ"),
    (
        "contact_pressure",
        "p",
        "force_per_length",
        "(55)",
        "contact pressure: the wall pushes the rod along d₁ (inward) with −p per length; p < 0 is contact from inside",
    ),
    ("rod_F1", "F₁⁽¹⁾", "force", "(52)", "axial force in the rod, along t₁, tension positive"),
    ("rod_F2", "F₂⁽¹⁾", "force", "(53)", "shear force in the rod along d₁, towards the cylinder axis"),
    ("rod_F3", "F₃⁽¹⁾", "force", "(54)", "shear force in the rod along u₁, in the tangent plane"),
    ("rod_M1", "M₁⁽¹⁾", "moment", "(47)", "twisting moment in the rod, −T₁"),
    ("rod_M2", "M₂⁽¹⁾", "moment", "(47)", "bending moment in the rod about d₁, B ω₂"),
    ("rod_M3", "M₃⁽¹⁾", "moment", "(47)", "bending moment in the rod about u₁, B ω₃"),
    ("braid_F1", "F₁", "force", "(22)", "braid force along t₁"),
    ("braid_F2", "F₂", "force", "(23)", "braid force along d₁"),
    ("braid_F3", "F₃", "force", "(24)", "braid force along u₁"),
    ("braid_M1", "M₁", "moment", "(25)", "braid moment about t₁"),
    ("braid_M2", "M₂", "moment", "(26)", "braid moment about d₁"),
    ("braid_M3", "M₃", "moment", "(27)", "braid moment about u₁"),
    ("cylinder_F1", "F₁⁽²⁾ = h", "force", "(56)", "axial force in the cylinder: vanishes without friction"),
    ("cylinder_F2", "F₂⁽²⁾", "force", "(57)", "shear force in the cylinder along d₁"),
    ("cylinder_F3", "F₃⁽²⁾", "force", "(58)", "shear force in the cylinder along u₂"),
    ("T2", "T₂ = M₁⁽²⁾", "moment", "(33), (59)", "twisting moment in the cylinder"),
    ("mu", "μ = M₂⁽²⁾", "moment", "(42), (59)", "bending moment in the cylinder about d₁"),
    ("cylinder_M3", "M₃⁽²⁾ = λ cos η", "moment", "(59)", "bending moment in the cylinder about u₂"),
    ("lambda", "λ", "moment", "(41), (59)", "multiplier of the ω₃ constraint"),
    ("material_omega1", "ω̃₁", "curvature", "(3), (32)", "twist of the rod's material, −T₁/C"),
    ("material_omega2", "ω̃₂", "curvature", "(4)", "curvature of the rod along its material axis d₀"),
    ("material_omega3", "ω̃₃", "curvature", "(5)", "curvature of the rod along its material axis v₁"),
    ("cylinder_Omega1", "Ω₁", "curvature", "(20)", "rotation of the cylinder's braid frame about its axis, −ξ₂'"),
    (
        "cylinder_p2",
        "p₂⁽²⁾",
        "force_per_length",
        "(60)",
        "load on the cylinder along d₁, per length of cylinder: the balance is F⁽²⁾' = p⁽²⁾ z'",
    ),
    ("cylinder_p3", "p₃⁽²⁾", "force_per_length", "(60)", "load on the cylinder along u₂, per length of cylinder"),
    (
        "cylinder_m1",
        "m₁⁽²⁾",
        "force",
        "(61)",
        "distributed twisting moment on the cylinder, per length of cylinder: T₂' = m₁⁽²⁾ z'",
    ),
)

_SCALARS = (
    ("force", "F", "force", "(B15)", "axial end force at s = 1, tension positive"),
    ("energy", "E", "energy", "(30)", "energy relative to the straight rod under the same dead loads"),
    ("bending_energy", "½∫(ω₂² + ω₃²)", "energy", "(28)", "strain energy of bending"),
    ("twist_energy", "½∫C ω̃₁²", "energy", "(28)", "strain energy of twisting, ½ T₁²/C"),
    (
        "lateral_energy",
        "Δ mg sin α ∫(1 − cos ξ₂)",
        "energy",
        "(29)",
        "height gained across the cylinder, from the straight rod",
    ),
    ("axial_energy", "mg cos α ∫(z − s)", "energy", "(90)", "height gained along the cylinder, from the straight rod"),
    (
        "end_work",
        "F (z(1) − 1) + T₁ (ξ₁ + ξ₂)(1)",
        "energy",
        "(7)",
        "work of the end loads from the straight, equally twisted rod",
    ),
    ("end_shortening", "1 − z(1)", "length", "(44)", "approach of the ends"),
    (
        "largest_pressure",
        "max p",
        "force_per_length",
        "(55)",
        "largest contact pressure over s; lift-off where it reaches 0",
    ),
    ("omega2_at_0", "ω₂(0)", "curvature", "(20)", "end geodesic curvature at s = 0"),
    (
        "omega2_at_1",
        "ω₂(1)",
        "curvature",
        "(20)",
        "end geodesic curvature at s = 1, the ordinate of the paper's Fig. 3",
    ),
    (
        "angle_at_middle",
        "ξ₂(½)",
        "angle",
        "(19)",
        "angle around the cylinder at mid-length, from the straight rod",
    ),
    ("support_torque", "T₂(0)", "moment", "(33)", "torque in the cylinder at its support at s = 0"),
)

_VANISHING = (
    ("rod_p1", "p₁⁽¹⁾", "force_per_length", "(55)", "contact load on the rod along t₁: none without friction"),
    ("rod_p3", "p₃⁽¹⁾", "force_per_length", "(55)", "contact load on the rod along u₁: none without friction"),
    ("rod_m1", "m₁⁽¹⁾", "force", "(49)", "contact moment on the rod about t₁: none for equal bending stiffnesses"),
    ("rod_m2", "m₂⁽¹⁾", "force", "(49)", "contact moment on the rod about d₁: none without friction"),
    ("rod_m3", "m₃⁽¹⁾", "force", "(49)", "contact moment on the rod about u₁: none without friction"),
    ("cylinder_p1", "p₁⁽²⁾", "force_per_length", "(60)", "load on the cylinder along t₂: none without friction"),
    ("cylinder_m2", "m₂⁽²⁾", "force", "(61)", "distributed moment on the cylinder about d₁: none without friction"),
    ("cylinder_m3", "m₃⁽²⁾", "force", "(61)", "distributed moment on the cylinder about u₂: none without friction"),
)

_PLACES = (
    ("s", "s", "length", "(1)", "arclength of the rod from the end s = 0"),
    ("support_force", "F⁽ⁱ⁾", "force", "(45)", "force of a support on an end, along i, j, k"),
    ("support_moment", "M⁽ⁱ⁾", "moment", "(45)", "moment of a support on an end, about i, j, k, from its own axis"),
)

QUANTITIES: dict[str, Quantity] = {row[0]: Quantity(*row) for row in _FIELDS + _SCALARS + _VANISHING + _PLACES}
"""All quantities by the name they carry in code and datasets."""

FIELDS: tuple[str, ...] = tuple(row[0] for row in _FIELDS)
"""Names of the fields along the rod."""

VANISHING: tuple[str, ...] = tuple(row[0] for row in _VANISHING)
"""Names of the contact loads that hard frictionless contact makes zero."""

SCALARS: tuple[str, ...] = tuple(row[0] for row in _SCALARS)
"""Names of the numbers of one state."""
