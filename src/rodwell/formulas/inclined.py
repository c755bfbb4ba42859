"""Critical loads in straight inclined holes. Compression positive; rodwell's end forces are tension positive."""

from __future__ import annotations

import math

from rodwell.formulas.record import (
    LONG,
    FormulaInputs,
    Value,
    ends_are,
    formula,
    horizontal,
    inclined,
    light,
    long,
    pressed,
    sine,
)
from rodwell.quantities.text import plain

HELICAL = 2.0 * math.sqrt(2.0)
WU = 2.0 * (2.0 * math.sqrt(2.0) - 1.0)

LONG_HOLE = "long pipe (37.2 ∜(B r/(w sin α))), not near vertical, small axial weight"
NO_AXIAL = "constant axial force, small angles, no friction; ends do not matter"
LOCAL = (inclined, pressed, long, light)


def _best(whole: float) -> tuple[int, int]:
    """The whole numbers next to a number, 1 at least: between them a convex function of it is smallest."""
    low = max(1, math.floor(whole))
    return low, max(1, math.ceil(whole))


def _weightless(rod: FormulaInputs) -> list[str]:
    return [] if rod.w == 0.0 else ["for a weightless rod"]


@formula(
    "F = 4π²B/L²",
    kind="sinusoidal",
    place="middle",
    source="Euler; the paper, start values of Fig. 5",
    evidence="paper; checked here against the exact loads",
    holds="weightless rod, both ends clamped",
    assumes="no weight",
    checks=(_weightless, ends_are("clamped", "clamped")),
)
def euler_clamped(B: Value, L: Value) -> Value:
    """Euler, clamped–clamped."""
    return 4.0 * math.pi**2 * B / L**2


@formula(
    "F = min over n of n²π²B/L² + w sin α L²/(n²π²r)",
    kind="sinusoidal",
    place="middle",
    source="Paslay & Bogy 1964, as Eq. (2) of Wicks et al. 2008; the paper's pinned case",
    evidence="second-hand, and equal to the exact loads of a pinned rod in a horizontal hole (tested); "
    "the original's factor of three-dimensional elasticity is known from memory only and left out",
    holds="both ends pinned; exact if horizontal",
    assumes="constant axial force (n half waves see the mean force, that at the middle), small angle, no friction",
    checks=(pressed, ends_are("pinned", "pinned"), light),
)
def paslay_bogy(B: Value, w: Value, alpha: Value, r: Value, L: Value) -> Value:
    """Paslay–Bogy 1964, finite length."""
    lateral = w * sine(alpha)
    best = float(lateral * L**4 / (math.pi**4 * B * r)) ** 0.25
    return min(n**2 * math.pi**2 * B / L**2 + lateral * L**2 / (n**2 * math.pi**2 * r) for n in _best(best))


@formula(
    "F = 2√(B w sin α/r)",
    kind="sinusoidal",
    place="bottom",
    source="Dawson & Paslay 1984, as in Wicks et al. 2008 and several codes; Mitchell's Paslay load F_p",
    evidence="second-hand from several sources, and the limit of Paslay–Bogy (tested)",
    holds=LONG_HOLE,
    assumes=NO_AXIAL + "; a local test, first met where compression is largest, at the bottom",
    checks=LOCAL,
)
def dawson_paslay(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Dawson–Paslay 1984, sinusoidal, long."""
    return 2.0 * (B * w * sine(alpha) / r) ** 0.5


@formula(
    "F = 2.93 B^0.479 w^0.521 (sin α/r)^0.436",
    kind="sinusoidal",
    place="top",
    source="Dellinger et al. 1983; Eq. (89) of the paper, which compares it with the force at s = 1",
    evidence="paper, Eq. (89); US patent 4,384,483",
    holds="inclined holes, not near vertical; a fit to experiments, whose range is not stated (flagged below α = 30°, "
    "our choice)",
    assumes="any coherent units: its dimension fails by length^0.001 (metres against inches: 0.4 %)",
    checks=(inclined, pressed, lambda rod: [f"near vertical: α = {plain(rod.alpha)}°"] if rod.alpha < 30.0 else []),
    defect=0.001,
)
def dellinger(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Dellinger 1983, empirical fit (89)."""
    return 2.93 * B**0.479 * w**0.521 * (sine(alpha) / r) ** 0.436


@formula(
    "F = 2√2 √(B w sin α/r) = 1.414 F_sin",
    kind="helical",
    place="bottom",
    source="Chen, Lin & Cheatham 1990",
    evidence="read in sources as 2√(2EIW/r); re-derived: a weightless helix and the straight rod have equal energy",
    holds=LONG_HOLE,
    assumes=NO_AXIAL + "; an energy-equality load, not a bifurcation",
    checks=LOCAL,
)
def chen_lin_cheatham(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Chen–Lin–Cheatham 1990, helical."""
    return HELICAL * (B * w * sine(alpha) / r) ** 0.5


@formula(
    "F = min over m of 4m²π²B/L² + w sin α L²/(2m²π²r)",
    kind="helical",
    place="middle",
    source="Chen, Lin & Cheatham 1990",
    evidence="read in sources; its long limit is 2√2 √(B w sin α/r) (tested)",
    holds="a helix of m whole turns over the length",
    assumes="constant axial force (taken as that at the middle), small angle, no friction; an energy-equality load",
    checks=(inclined, pressed, light),
)
def chen_lin_cheatham_finite(B: Value, w: Value, alpha: Value, r: Value, L: Value) -> Value:
    """Chen–Lin–Cheatham 1990, helical, finite length."""
    lateral = w * sine(alpha)
    best = float(lateral * L**4 / (8.0 * math.pi**4 * B * r)) ** 0.25
    return min(4 * m**2 * math.pi**2 * B / L**2 + lateral * L**2 / (2 * m**2 * math.pi**2 * r) for m in _best(best))


@formula(
    "F = 2(2√2 − 1) √(B w sin α/r) = 3.657 √(…), printed as 1.83 F_sin",
    kind="helical",
    place="bottom",
    source="Wu & Juvkam-Wold 1993, SPE-25503 and ASME 115(3):190",
    evidence='abstract: "about 1.8 times" the sinusoidal and "about 1.3 times" the so-called helical load; closed form '
    "consistent with both: mean of it and of the sinusoidal load is 2√2 √(…) (tested)",
    holds=LONG_HOLE,
    assumes=NO_AXIAL,
    checks=LOCAL,
)
def wu_juvkam_wold(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Wu–Juvkam-Wold 1993, helical."""
    return WU * (B * w * sine(alpha) / r) ** 0.5


@formula(
    "F = 1.3 · 2√2 √(B w sin α/r)",
    kind="helical",
    place="bottom",
    source="Qiu 1998, as quoted by Wicks et al. 2008",
    evidence="second-hand, printed as about 1.3 times the load of Chen",
    holds="horizontal, long",
    assumes=NO_AXIAL,
    checks=(horizontal, *LOCAL),
)
def qiu(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Qiu 1998, helical."""
    return 1.3 * HELICAL * (B * w * sine(alpha) / r) ** 0.5


@formula(
    "F = 4√2 √(B w sin α/r)",
    kind="helical",
    place="bottom",
    source="Mitchell 1997, as quoted by Wicks et al. 2008",
    evidence="second-hand, printed as about twice the load of Chen; Miska et al. 1996 are said to have the same number",
    holds="horizontal, long",
    assumes=NO_AXIAL + "; equilibrium of a stable helix",
    checks=(horizontal, *LOCAL),
)
def mitchell_1997(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Mitchell 1997, helical, stable helix."""
    return 2.0 * HELICAL * (B * w * sine(alpha) / r) ** 0.5


@formula(
    "F = 2.8 F_p, F_p = √(4 B w sin α/r)",
    kind="helical",
    place="bottom",
    source="Mitchell 1996 and 1999, SPE 55039",
    evidence="read in the source: correlation of numerical solutions",
    holds=LONG_HOLE,
    assumes=NO_AXIAL + "; loading: lateral buckling from F_p to 2.8 F_p, helical above",
    checks=LOCAL,
)
def mitchell_loading(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Mitchell 1999, helical on loading."""
    return 2.8 * dawson_paslay(B, w, alpha, r)


@formula(
    "F = 1.4 F_p",
    kind="helical",
    place="bottom",
    source="Mitchell 1996 and 1999, SPE 55039",
    evidence="read in the source: correlation of numerical solutions",
    holds=LONG_HOLE,
    assumes=NO_AXIAL + "; unloading: the helix survives down to this load",
    checks=LOCAL,
)
def mitchell_unloading(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Mitchell 1999, helical on unloading."""
    return 1.4 * dawson_paslay(B, w, alpha, r)


@formula(
    "L = 37.2 ∜(B r/(w sin α))",
    kind="limit",
    dimension=(0, 1),
    source="Wicks et al. 2008, Appendix B",
    evidence="second-hand, with its steel example (tested)",
    holds="horizontal in the source; here with the lateral weight for w",
    checks=(inclined,),
)
def long_pipe(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Length from which a pipe is long."""
    return LONG * (B * r / (w * sine(alpha))) ** 0.25


@formula(
    "L = 2.9 ∜(B r/(w sin α))",
    kind="limit",
    dimension=(0, 1),
    source="Wicks et al. 2008, Appendix B",
    evidence="second-hand",
    holds="horizontal in the source; here with the lateral weight for w",
    checks=(inclined,),
)
def unsupported_end(B: Value, w: Value, alpha: Value, r: Value) -> Value:
    """Length of an unsupported end."""
    return 2.9 * (B * r / (w * sine(alpha))) ** 0.25


def _on_top(rod: FormulaInputs) -> list[str]:
    return ["for a rod that lies on top"] if rod.pressed else []


@formula(
    "w = 500.5639 B r/L⁴, from cos x cosh x = 1, x⁴ = w L⁴/(B r)",
    kind="limit",
    dimension=(1, -1),
    source="the paper, section 4.3",
    evidence="paper; checked here against the exact loads (tested)",
    holds="rod on top of a horizontal cylinder, both ends clamped, no end force",
    checks=(horizontal, ends_are("clamped", "clamped"), _on_top),
)
def heaviest_on_top(B: Value, r: Value, L: Value) -> Value:
    """Weight at which a rod on top falls without end force."""
    return 500.5639017404 * B * r / L**4
