"""The buckled rod: shape, contact force and stress of sinusoidal and helical pipe. Compression positive.

Small angles: for a weightless helix that is free to rotate the exact relations are F = (2B/r²) sin²η cos η and
N = B sin⁴η/r³, with η the angle between pipe and hole. :func:`small_angle_error` compares with them.
"""

from __future__ import annotations

import math

from rodwell.errors import InputError
from rodwell.formulas.record import FormulaInputs, Value, formula, sine
from rodwell.quantities.text import plain

LARGEST_HELIX = 4.0 / (3.0 * math.sqrt(3.0))
"""Largest F r²/B of a weightless helix, 0.7698, at sin²η = 2/3."""

HELIX = "weightless helix, small angle (N is too small by sin²η of the exact: 1 % at η = 0.1, 8.7 % at 0.3)"
FREE = "weight small against the helix force; ends free to rotate; no friction; no torque"


def _small(rod: FormulaInputs) -> list[str]:
    force = dict(rod.more).get("F", 0.0)
    if force <= 0.0:
        return ["no compression"]
    size = force * rod.r**2 / rod.B
    if size >= LARGEST_HELIX:
        return [f"no weightless helix bears this force: F r²/B = {plain(size, 3)} > 0.7698"]
    angle = helix_angle(size)
    return (
        []
        if angle <= 0.1
        else [f"not a small angle: η = {plain(angle, 2)} rad, N is {100 * math.sin(angle) ** 2:.1f} % low"]
    )


def helix_angle(force: float) -> float:
    """Return the angle η of an exact weightless helix under F r²/B = ``force``, the smaller of the two.

    Raises
    ------
    InputError
        If no helix bears the force: it must be from 0 to 0.7698.
    """
    if not 0.0 <= force <= LARGEST_HELIX:
        raise InputError("F r²/B", force, "must be from 0 to 0.7698: no weightless helix bears more")
    low, high = 0.0, math.asin(math.sqrt(2.0 / 3.0))
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if 2.0 * math.sin(middle) ** 2 * math.cos(middle) < force else (low, middle)
    return 0.5 * (low + high)


def small_angle_error(key: str, B: float, r: float, F: float) -> float | None:
    """Relative error of a small-angle formula of the weightless helix, exact = 0; None if it has no exact counterpart.

    Parameters
    ----------
    key
        "helical_contact", "helix_curvature", "helix_rate", "lubinski_woods_pitch" or "helix_strain".
    B, r, F
        Bending stiffness, clearance and compression in coherent units.
    """
    eta = helix_angle(F * r**2 / B)
    s, c = math.sin(eta), math.cos(eta)
    ratios = {
        "helical_contact": c**2,
        "helix_curvature": c,
        "helix_rate": math.sqrt(c),  # exact rate per arclength sin η/r
        "lubinski_woods_pitch": c**-1.5,
        "helix_strain": 0.5 * s**2 * c / (1.0 - c) if s > 0.0 else 1.0,
    }
    return ratios[key] - 1.0 if key in ratios else None


@formula(
    "p = π√(8B/F)",
    kind="helix",
    dimension=(0, 1),
    source="Lubinski & Woods; Wicks et al. 2008; SPE 55039",
    evidence="read in sources; derived",
    holds=HELIX,
    assumes=FREE,
    checks=(_small,),
)
def lubinski_woods_pitch(B: Value, F: Value) -> Value:
    """Pitch of the helix, Lubinski–Woods."""
    return math.pi * (8.0 * B / F) ** 0.5


@formula(
    "θ' = √(F/(2B))",
    kind="helix",
    dimension=(0, -1),
    source="SPE 55039",
    evidence="read in the source; derived",
    holds=HELIX,
    assumes=FREE,
    checks=(_small,),
)
def helix_rate(B: Value, F: Value) -> Value:
    """Rate of the angle around the hole in a helix."""
    return (F / (2.0 * B)) ** 0.5


@formula(
    "N = r F²/(4B)",
    kind="helix",
    dimension=(1, -1),
    source="Wicks et al. 2008, Oyedokun 2014, CTES; + w sin α cos θ along a turn",
    evidence="read in sources; derived; checked here against the exact contact pressure of a coil",
    holds=HELIX,
    assumes=FREE,
    checks=(_small,),
)
def helical_contact(B: Value, r: Value, F: Value) -> Value:
    """Contact force of the helix."""
    return r * F**2 / (4.0 * B)


@formula(
    "N = (16π⁴B r β₀²/p⁴)[−β₀² cos⁴ + 3 sin² − 4 cos²] + (4π² r β₀² F/p²) cos² + w sin α cos β, of 2πx/p, β = β₀ sin",
    kind="helix",
    dimension=(1, -1),
    source="Wicks et al. 2008, Eq. (F5)",
    evidence="second-hand; re-derived from the radial balance; checked here against the exact contact pressure",
    holds="sinusoidal state θ = β₀ sin(2πx/p), small slope",
    assumes="no friction",
)
def sinusoidal_contact(
    B: Value, w: Value, alpha: Value, r: Value, F: Value, p: Value, beta_0: Value, x: Value
) -> Value:
    """Contact force of the sinusoidal state at x."""
    phase = 2.0 * math.pi * float(x / p)
    s, c = math.sin(phase), math.cos(phase)
    bending = 16.0 * math.pi**4 * B * r * beta_0**2 / p**4 * (-(beta_0**2) * c**4 + 3.0 * s**2 - 4.0 * c**2)
    compression = 4.0 * math.pi**2 * r * beta_0**2 * F / p**2 * c**2
    return bending + compression + w * sine(alpha) * math.cos(beta_0 * s)


@formula(
    "N = w sin α",
    kind="helix",
    dimension=(1, -1),
    source="practice of most torque-and-drag codes",
    evidence="read in two codes",
    holds="straight pipe; in practice used until the helical load",
    assumes="the sinusoidal state adds nothing",
)
def straight_contact(w: Value, alpha: Value) -> Value:
    """Contact force before helical buckling, in practice."""
    return w * sine(alpha)


def _lateral_range(rod: FormulaInputs) -> list[str]:
    known = rod.known()
    if "F" not in known or rod.lateral == 0.0:
        return ["needs a compression and a lateral weight"]
    part = known["F"] / (2.0 * math.sqrt(rod.B * rod.lateral / rod.r))
    return [] if 1.0 <= part <= 2.8 else [f"F is {plain(part, 3)} F_p, must be from 1 to 2.8"]


@formula(
    "θ'_max = 1.1227/√(2B) · F^0.04 (F − F_p)^0.46",
    kind="helix",
    dimension=(0, -1),
    source="Mitchell 1996 and 1999, SPE 55039",
    evidence="read in the source: correlation of numerical solutions",
    holds="F_p < F < 2.8 F_p",
    assumes="constant force, long pipe",
    checks=(_lateral_range,),
)
def mitchell_lateral_rate(B: Value, F: Value, F_p: Value) -> Value:
    """Largest rate of the angle in lateral buckling, Mitchell."""
    excess = F - F_p
    if excess < 0.0 * F:
        raise InputError("F", F, f"must be at least F_p = {F_p}: below it the pipe is straight")
    return 1.1227 / (2.0 * B) ** 0.5 * F**0.04 * excess**0.46


@formula(
    "κ = r F/(2B)",
    kind="helix",
    dimension=(0, -1),
    source="derived (dogleg of the helix)",
    evidence="derived; checked against the exact helix",
    holds=HELIX,
    assumes=FREE,
    checks=(_small,),
)
def helix_curvature(B: Value, r: Value, F: Value) -> Value:
    """Curvature of the helix."""
    return r * F / (2.0 * B)


@formula(
    "r²F/(4B)",
    kind="helix",
    dimension=(0, 0),
    source="derived",
    evidence="derived; checked against the exact helix",
    holds=HELIX,
    assumes=FREE,
    checks=(_small,),
)
def helix_strain(B: Value, r: Value, F: Value) -> Value:
    """Shortening per length of the helix."""
    return r**2 * F / (4.0 * B)


@formula(
    "σ = D r F/(4I)",
    kind="helix",
    dimension=(1, -2),
    source="practice",
    evidence="read in sources; derived",
    holds=HELIX,
    assumes=FREE,
    checks=(_small,),
)
def helix_bending_stress(r: Value, F: Value, D: Value, I: Value) -> Value:
    """Bending stress of the helix at the outer fibre."""
    return D * r * F / (4.0 * I)


@formula(
    "F = 8π²B/p² − 3πT/p",
    kind="torque",
    source="Wicks et al. 2008 (Deli, Qiu)",
    evidence="second-hand; derived: no torque of the wall about the axis of the hole",
    holds=HELIX,
    assumes="as the weightless helix; T > 0 turns with the helix",
    checks=(_small,),
)
def twisted_helix_force(B: Value, T: Value, p: Value) -> Value:
    """Compression of a helix of given pitch under torque."""
    return 8.0 * math.pi**2 * B / p**2 - 3.0 * math.pi * T / p


@formula(
    "N = r q³(2B q − T)/2, q = (3T + √(9T² + 32 F B))/(8B)",
    kind="torque",
    dimension=(1, -1),
    source="derived here, in place of the form of Wicks et al. 2008 (see the formulas left out)",
    evidence="derived from the radial balance; checked here against the exact contact pressure of a twisted coil",
    holds=HELIX,
    assumes="as the weightless helix; T > 0 turns with the helix",
    checks=(_small,),
)
def twisted_helix_contact(B: Value, r: Value, F: Value, T: Value) -> Value:
    """Contact force of a helix under torque."""
    q = (3.0 * T + (9.0 * T**2 + 32.0 * F * B) ** 0.5) / (8.0 * B)
    return 0.5 * r * q**3 * (2.0 * B * q - T)


@formula(
    "√2 T/√(F B)",
    kind="torque",
    dimension=(0, 0),
    source="Wicks et al. 2008",
    evidence="second-hand, with its example (tested)",
    holds="any helix",
    assumes="small: torque matters little; on the onset it has no effect (the paper, section 4.2)",
)
def torque_parameter(B: Value, F: Value, T: Value) -> Value:
    """Size of the effect of torque on a helix."""
    return 2.0**0.5 * T / (F * B) ** 0.5
