"""How far a buckled pipe can be pushed, how much it shortens, what it bears. Compression positive."""

from __future__ import annotations

import math

from rodwell.errors import InputError
from rodwell.formulas.record import FormulaInputs, Value, formula, horizontal
from rodwell.quantities.text import plain

WEIGHTLESS = "helical over the whole distance, weight dropped"


@formula(
    "F_y = σ_y/(1/A + r D/(4I))",
    kind="strength",
    source="Oyedokun 2014",
    evidence="second-hand; equal to axial stress plus bending stress of the helix reaching the yield stress",
    holds="helical coiled tubing, small angle",
    assumes="no pressure, no torque, no residual stress",
)
def coiled_tubing_yield(sigma_y: Value, A: Value, r: Value, D: Value, I: Value) -> Value:
    """Compression at which helical coiled tubing yields."""
    return sigma_y / (1.0 / A + r * D / (4.0 * I))


@formula(
    "ΔL = r²F²/(8 B w)",
    kind="pushing",
    dimension=(0, 1),
    source="Lubinski's tubing formula, from memory; derived here",
    evidence="derived: strain r²F/(4B) of the helix over the length F/w",
    holds="vertical, neutral point inside the string",
    assumes="helical from the packer to the neutral point; F at the packer; elastic and pressure terms apart",
    checks=(lambda rod: [] if rod.alpha == 0.0 else [f"for a vertical hole, α is {plain(rod.alpha)}°"],),
)
def tubing_shortening(B: Value, w: Value, r: Value, F: Value) -> Value:
    """Shortening of long vertical tubing by helical buckling."""
    return r**2 * F**2 / (8.0 * B * w)


@formula(
    "F(x) = 1/(1/F − μ r x/(4B))",
    kind="pushing",
    source="second-hand",
    evidence="derived from dF/dx = μ r F²/(4B) (tested)",
    holds=WEIGHTLESS,
    assumes="Coulomb friction; F at the far end, x towards the push",
)
def helical_push(B: Value, r: Value, mu: Value, F: Value, x: Value) -> Value:
    """Compression at distance x from the far end of a helical pipe."""
    part = float(F * mu * r * x / (4.0 * B))
    if part >= 1.0:
        raise InputError("x", x, "must be below the lock-up length 4B/(μ r F): no push reaches so far")
    return F / (1.0 - part)


@formula(
    "x = 4B/(μ r F)",
    kind="pushing",
    dimension=(0, 1),
    source="second-hand",
    evidence="derived: the push grows without bound (tested)",
    holds=WEIGHTLESS,
    assumes="Coulomb friction; F at the far end",
)
def helical_lock_up(B: Value, r: Value, mu: Value, F: Value) -> Value:
    """Lock-up length of a helical pipe."""
    return 4.0 * B / (mu * r * F)


@formula(
    "x = (2/μ)√(B/(r w)) [arctan(F₂√(r/(4Bw))) − arctan(F₁√(r/(4Bw)))]",
    kind="pushing",
    dimension=(0, 1),
    source="Oyedokun 2014, Eq. (5.49)",
    evidence="second-hand; derived from dF/dx = μ(r F²/(4B) + w) (tested)",
    holds="horizontal, helical between the forces F₁ < F₂",
    assumes="Coulomb friction, contact force r F²/(4B) + w",
    checks=(horizontal,),
)
def helical_length(B: Value, w: Value, r: Value, mu: Value, F_1: Value, F_2: Value) -> Value:
    """Length over which compression in a heavy helical pipe grows from F₁ to F₂."""
    unit = (r / (4.0 * B * w)) ** 0.5
    return 2.0 / mu * (B / (r * w)) ** 0.5 * (math.atan(float(F_2 * unit)) - math.atan(float(F_1 * unit)))


def _weighed(rod: FormulaInputs) -> list[str]:
    return [] if rod.w > 0.0 else ["weightless"]


@formula(
    "x = (1.231/μ)√(B/(r w)), 1.231 = 2(π/2 − arctan √2)",
    kind="pushing",
    dimension=(0, 1),
    source="derived; Oyedokun 2014",
    evidence="derived: the formula above from the load of Chen to infinity (tested)",
    holds="horizontal, helical",
    assumes="Coulomb friction, contact force r F²/(4B) + w",
    checks=(horizontal, _weighed),
)
def helical_lock_up_heavy(B: Value, w: Value, r: Value, mu: Value) -> Value:
    """Lock-up length of the helical part, with weight."""
    return (math.pi - 2.0 * math.atan(math.sqrt(2.0))) / mu * (B / (r * w)) ** 0.5


@formula(
    "x = (3√2/μ)√(B/(w r))",
    kind="pushing",
    dimension=(0, 1),
    source="Wicks et al. 2008",
    evidence="second-hand; derived: F_hel/(μw) + 4B/(μ r F_hel); its steel case, μ = 0.3: 5653 m, printed as ≈ 5700 m",
    holds="horizontal, unpushed at the far end",
    assumes="Coulomb friction; straight part with N = w, helical part with weight dropped",
    checks=(horizontal, _weighed),
)
def total_lock_up(B: Value, w: Value, r: Value, mu: Value) -> Value:
    """Total lock-up length, unbuckled and helical."""
    return 3.0 * 2.0**0.5 / mu * (B / (w * r)) ** 0.5
