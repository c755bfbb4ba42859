"""Loads on the path of the pipe, curved holes, and friction at the onset. Compression positive."""

from __future__ import annotations

import math

import numpy as np

from rodwell.formulas.inclined import dawson_paslay
from rodwell.formulas.record import FormulaInputs, Value, formula, horizontal, inclined, light, long, pressed, sine
from rodwell.quantities.text import plain

STEEL_WEIGHT = 65.5
"""Density of steel in lb/gal (ppg), the field's buoyancy number."""


@formula(
    "F = F_real + p_i A_i − p_o A_o",
    kind="path",
    source="definition, as in the notes of CTES",
    evidence="read in the source",
    holds="any pipe",
)
def effective_compression(F_real: Value, p_i: Value, p_o: Value, A_i: Value, A_o: Value) -> Value:
    """Effective compression, which buckles a pipe."""
    return F_real + p_i * A_i - p_o * A_o


@formula(
    "w = w_air + ρ_i g A_i − ρ_o g A_o",
    kind="path",
    dimension=(1, -1),
    source="definition, as in the notes of CTES",
    evidence="read in the source",
    holds="any pipe",
)
def buoyed_weight(w_air: Value, gamma_i: Value, gamma_o: Value, A_i: Value, A_o: Value) -> Value:
    """Weight per length in fluids inside and outside."""
    return w_air + gamma_i * A_i - gamma_o * A_o


@formula(
    "w = w_air (1 − MW/65.5), MW in lb/gal",
    kind="path",
    dimension=(1, -1),
    source="definition, as in the notes of CTES",
    evidence="read in the source; tested with the field example",
    holds="steel, the same mud inside and outside",
)
def buoyed_weight_in_mud(w_air: Value, mud: Value) -> Value:
    """Weight per length of steel in mud."""
    return w_air * (1.0 - mud / STEEL_WEIGHT)


@formula(
    "N = √[(w sin α + F dα/ds)² + (F sin α dφ/ds)²]",
    kind="path",
    dimension=(1, -1),
    source="notes of CTES (there with tension positive: w sin α − F_t dα/ds)",
    evidence="read in the source",
    holds="unbuckled pipe on a curved path",
    assumes="no bending stiffness; dα/ds with s downwards, positive where the hole builds",
)
def path_contact_force(w: Value, alpha: Value, F: Value, build: Value, turn: Value) -> Value:
    """Contact force of the unbuckled pipe on a curved path."""
    return ((w * sine(alpha) + F * build) ** 2 + (F * turn) ** 2) ** 0.5


def planar_load(factor: float, B: Value, lateral: Value, r: Value, build: Value) -> Value:
    """The load F of a pipe in a plane bend: F² = factor (B/r)(q + F κ), where the wall below pushes with q + F κ.

    F = (factor B/2r)[κ + √(κ² + 4 q r/(factor B))]: of the two roots the one that is not negative.

    Parameters
    ----------
    factor
        4 for the sinusoidal load, 8 for the helical one.
    B, lateral, r, build
        Stiffness, weight q = w sin α across the hole per length, clearance, and κ = dα/ds with s downwards, positive
        where the hole builds; all in units that fit each other.

    Returns
    -------
    Value
        Compression, positive; nought where a hole that does not build bears no weight.
    """
    bend = 4.0 * lateral * r / (factor * B)
    root = (build**2 + bend) ** 0.5
    if float(build * r) < 0.0:  # the same without the difference of numbers that nearly cancel
        return 2.0 * lateral / (root - build)
    return 0.5 * factor * B / r * (build + root)


def _curved(factor: float, B: Value, w: Value, alpha: Value, r: Value, build: Value, turn: Value) -> Value:
    """Smallest F > 0 with F² = factor (B/r) N(F), from the quartic in u = F₀/F, F₀ the load of the straight hole."""
    lateral = w * sine(alpha)
    if float(lateral * r**3 / B) == 0.0:
        return factor * B / r * (build**2 + turn**2) ** 0.5
    if float(turn * r) == 0.0:
        return planar_load(factor, B, lateral, r, build)
    straight = (factor * B * lateral / r) ** 0.5
    a, b = float(build * straight / lateral), float(turn * straight / lateral)
    roots = np.roots([1.0, 2.0 * a, a * a + b * b, 0.0, -1.0])
    u = max(float(z.real) for z in roots if abs(z.imag) < 1e-9 * max(1.0, abs(z)) and z.real > 0.0)
    for _ in range(2):
        u -= (u * u * ((u + a) ** 2 + b * b) - 1.0) / (2.0 * u * ((u + a) ** 2 + b * b) + 2.0 * u * u * (u + a))
    return straight / u


SINUSOIDAL, HELICAL = 4.0, 8.0
"""The factors of F² = factor (B/r) N(F)."""

HE = "He & Kyllingstad 1993 and 1995, form used by the CTES code"
HE_EVIDENCE = (
    "form read in the code; closed form for a build section derived; limit of no curvature is that of the straight "
    "hole (tested). The papers' text was not available"
)


@formula(
    "F² = 4 (B/r) N(F), N the contact force on the path; in a build section, b = dα/ds: "
    "F = (2B b/r)[1 + √(1 + w sin α r/(B b²))]",
    kind="sinusoidal",
    place="bottom",
    source=HE,
    evidence=HE_EVIDENCE,
    holds="long pipe in a hole of constant curvature, r small against the radius of curvature",
    assumes="local force and local inclination; no axial weight, no friction",
    checks=(pressed, long, light),
)
def he_kyllingstad(B: Value, w: Value, alpha: Value, r: Value, build: Value, turn: Value) -> Value:
    """He–Kyllingstad, sinusoidal, curved hole."""
    return _curved(SINUSOIDAL, B, w, alpha, r, build, turn)


@formula(
    "F² = 8 (B/r) N(F), N the contact force on the path",
    kind="helical",
    place="bottom",
    source=HE,
    evidence=HE_EVIDENCE,
    holds="long pipe in a hole of constant curvature, r small against the radius of curvature",
    assumes="local force and local inclination; no axial weight, no friction",
    checks=(pressed, long, light),
)
def he_kyllingstad_helical(B: Value, w: Value, alpha: Value, r: Value, build: Value, turn: Value) -> Value:
    """He–Kyllingstad, helical, curved hole."""
    return _curved(HELICAL, B, w, alpha, r, build, turn)


MOST_FRICTION = 15.0 / (7.0 * math.pi)
"""0.682: the helical formula has its pole there."""


def _frictional(rod: FormulaInputs) -> list[str]:
    mu = dict(rod.more).get("mu", 0.0)
    return [] if mu <= 0.3 else [f"printed up to μ = 0.3, here μ = {plain(mu)}"]


GAO = "Gao & Miska 2010, from the code of HDD-Push-Buckling-Calc"
GAO_EVIDENCE = (
    "read in that code; limit of no friction checked. Second-hand notes (Oyedokun) give a sinusoidal factor of 1.05 to "
    "1.12 only: a conflict that the originals must resolve"
)


@formula(
    "F = F_sin [½P²(1 − 1.5A²) + (1 + A²/8 + 8μ/(πA))/(2P²)], P = 1 + 0.193 μ^0.67, A = 0.774 μ^0.33 − 0.371 μ",
    kind="sinusoidal",
    place="bottom",
    source=GAO,
    evidence=GAO_EVIDENCE,
    holds="horizontal, long, μ ≤ 0.3 (the values printed)",
    assumes="Coulomb friction against sliding sideways; the exact loads here have no friction",
    checks=(horizontal, inclined, pressed, long, _frictional),
)
def gao_miska(B: Value, w: Value, alpha: Value, r: Value, mu: Value) -> Value:
    """Gao–Miska 2010, sinusoidal with lateral friction."""
    return sinusoidal_friction(mu) * dawson_paslay(B, w, alpha, r)


def sinusoidal_friction(mu: float) -> float:
    """Return factor of Gao and Miska on the sinusoidal load, 1 without friction."""
    if mu == 0.0:
        return 1.0
    P, A = 1.0 + 0.193 * mu**0.67, 0.774 * mu**0.33 - 0.371 * mu
    factor = 0.5 * P**2 * (1.0 - 1.5 * A**2) + (1.0 + A**2 / 8.0 + 8.0 * mu / (math.pi * A)) / (2.0 * P**2)
    return float(factor)


@formula(
    "F = F_sin √(30(π + 2μ)/(π(15 − 7πμ)))",
    kind="helical",
    place="bottom",
    source=GAO,
    evidence=GAO_EVIDENCE,
    holds="horizontal, long, μ ≤ 0.3 (the values printed); no load from μ = 0.682 on",
    assumes="Coulomb friction against sliding sideways; the exact loads here have no friction",
    checks=(horizontal, inclined, pressed, long, _frictional),
)
def gao_miska_helical(B: Value, w: Value, alpha: Value, r: Value, mu: Value) -> Value:
    """Gao–Miska 2010, helical with lateral friction."""
    if mu >= MOST_FRICTION:
        return math.inf * dawson_paslay(B, w, alpha, r)
    factor = (30.0 * (math.pi + 2.0 * mu) / (math.pi * (15.0 - 7.0 * math.pi * mu))) ** 0.5
    return factor * dawson_paslay(B, w, alpha, r)
