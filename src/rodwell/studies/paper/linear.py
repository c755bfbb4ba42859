"""Critical loads quoted in the text: weightless rods, (63), (79), (87), (88), rods on top."""

from __future__ import annotations

import math
from collections.abc import Callable

from rodwell.quantities.value import Value
from rodwell.studies.paper import scorer
from rodwell.studies.paper.claims import FORMULA, INTERVAL, Claim, Known
from rodwell.studies.paper.work import CLEARANCE, Work, rod

VERTICAL, NEARLY_VERTICAL = 0.0, 2.0
"""α in degrees: the cylinder of (87), and the one 88° from the horizontal, α = π/90."""

WEIGHTLESS = rod(0.0)
COLUMN = rod(1.0, VERTICAL)
SWAYING = rod(1.0, VERTICAL, ends=("clamped", "guided"))
ON_TOP = rod(1.0, on_top=True)

STEEL = {"E": 2.0e11, "rho": 7.8e3, "r": 0.05, "L": 30.0, "g": 9.8}
"""The drill string of (62), in SI units."""


def drill_string(_work: Work) -> Value:
    """γ = mg L³/B of the drill string (62)."""
    area, inertia = math.pi * STEEL["r"] ** 2, 0.25 * math.pi * STEEL["r"] ** 4
    gamma = STEEL["rho"] * area * STEEL["g"] * STEEL["L"] ** 3 / (STEEL["E"] * inertia)
    return Value(gamma, 1e-15 * gamma)


def wavenumber(mode: int) -> Callable[[Work], Value]:
    """√(−F) of the weightless rod."""

    def compute(work: Work) -> Value:
        load = work.critical(WEIGHTLESS)[mode - 1].load
        k = math.sqrt(-load.value)
        return Value(k, load.error / (2.0 * k))

    return compute


def self_weight(mode: int) -> Callable[[Work], Value]:
    """Weight of the vertical column at which a mode buckles without end force."""
    return lambda work: work.buckling_weight(COLUMN, mode)


def chord(mode: int) -> Callable[[Work], Value]:
    """Slope of the straight line between a vertical column's critical loads at γ = 0 and F = 0, as in (79)."""

    def compute(work: Work) -> Value:
        weight, error = work.buckling_weight(COLUMN, mode)
        first = work.critical(WEIGHTLESS)[mode - 1]
        slope = -first.force / weight
        return Value(slope, slope * (error / weight - first.error / first.force))

    return compute


def ratio_of_heights(work: Work) -> Value:
    """How much taller a column may be whose upper end cannot move sideways."""
    held, held_error = work.buckling_weight(COLUMN)
    free, free_error = work.buckling_weight(SWAYING)
    ratio = (held / free) ** (1.0 / 3.0)
    return Value(ratio, ratio / 3.0 * (held_error / held + free_error / free))


def _second_root(work: Work) -> str:
    """Roots of the determinant beside the engine's second weight."""
    root, error = scorer.root(2)
    value, own = work.buckling_weight(COLUMN, 2)
    return (
        f"Two independent computations agree: the eigenproblem (64) gives {value:.8f} ± {own:.0e}, the zero of the "
        f"determinant (86), with the Scorer function (84), lies at {root:.8f} ± {error:.0e}."
    )


def _wrong_sign(_work: Work) -> str:
    """What the determinant does with t₁ as printed."""
    signs = {math.copysign(1.0, scorer.determinant(w, printed=True)) for w in range(10, 401, 10)}
    roots = ", ".join(f"{scorer.root(k)[0]:.6f}" for k in (1, 2, 3))
    kinds = "one sign" if len(signs) == 1 else "both signs"
    return (
        f"With t₁ as printed the determinant (86) at F = 0 has {kinds} at γ = 10, 20, …, 400; with "
        f"t₁ = (F/mg − 1)(mg)^(1/3), from the definition of t at s = 0, its roots are {roots}, those of (87)."
    )


def claims_63() -> list[Claim]:
    """The weight of the drill string."""
    return [Claim("eq63", "(63)", "γ = mg L³/B of the drill string (62)", "16.5", drill_string)]


def claims_text() -> list[Claim]:
    """Loads of the rod without weight, and of the pinned rod."""
    place = "text after (77)"
    out = [
        Claim("text.k3.1", place, "√(−F_c) of the weightless rod, n = 1", "k₃ = 2π", wavenumber(1), FORMULA,
              2.0 * math.pi),
        Claim("text.k3.2", place, "√(−F_c) of the weightless rod, second mode", "8.9868", wavenumber(2)),
        Claim("text.k3.3", place, "√(−F_c) of the weightless rod, n = 2", "k₃ = 4π", wavenumber(3), FORMULA,
              4.0 * math.pi),
        Claim("text.k3.4", place, "√(−F_c) of the weightless rod, fourth mode", "15.4505", wavenumber(4)),
    ]  # fmt: skip
    out += [
        Claim(f"eq77.{k}", "(77)", f"−F_c at γ = 15, mode {k} [B/L²]", "root of (77)", _load(k), FORMULA, root_of_77(k))
        for k in (1, 2, 3, 4)
    ]
    for n in (1, 2, 3):
        formula = n * n * math.pi**2 + 15.0 / (n * n * math.pi**2 * CLEARANCE)
        out.append(
            Claim(f"text.pinned.{n}", "text before 4.1.3", f"−F of the pinned rod, γ = 15, n = {n} [B/L²]",
                  "n²π² + mg/(n²π²Δ)", _pinned(formula), FORMULA, formula)
        )  # fmt: skip
    return out


def root_of_77(number: int, weight: float = 15.0) -> float:
    """Return a critical compression from (77), with k₁ and k₃ from (75); roots are bracketed on a fine grid."""
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

    b = weight / CLEARANCE

    def residual(a: float) -> float:
        root = math.sqrt(a * a - 4.0 * b)
        k1, k3 = math.sqrt(0.5 * (a - root)), math.sqrt(0.5 * (a + root))
        return 2.0 * k1 * k3 * (1.0 - math.cos(k1) * math.cos(k3)) - a * math.sin(k1) * math.sin(k3)

    low, step, found = 2.0 * math.sqrt(b) + 1.0, 1.0, 0
    while True:
        if residual(low) * residual(low + step) < 0.0:
            found += 1
            if found == number:
                return float(brentq(residual, low, low + step, xtol=1e-12, rtol=1e-14))
        low += step


def clamped_beam_root(number: int) -> float:
    """Return x of cos x cosh x = 1, as in section 4.3."""
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

    middle = (number + 0.5) * math.pi
    zero = brentq(lambda x: math.cos(x) - 1.0 / math.cosh(x), middle - 0.3, middle + 0.3, xtol=1e-14, rtol=1e-15)
    return float(zero)


def _load(mode: int) -> Callable[[Work], Value]:
    """Critical compression of the horizontal rod at γ = 15."""

    def compute(work: Work) -> Value:
        return work.critical(rod(15.0))[mode - 1].load.times(-1.0)

    return compute


def _pinned(formula: float) -> Callable[[Work], Value]:
    """The critical load of the pinned rod nearest to what the formula gives."""

    def compute(work: Work) -> Value:
        modes = work.critical(rod(15.0, ends=("pinned", "pinned")), 5)
        return min(modes, key=lambda mode: abs(mode.force + formula)).load.times(-1.0)

    return compute


def claims_79() -> list[Claim]:
    """Slopes and intercepts of (79)."""
    note = "Slope of the chord to the root at F = 0. The curve is not quite straight: at small weight its slope is 1/2."
    return [
        Claim("eq79.slope1", "(79), first mode", "slope, first mode", "0.5290", chord(1), note=note),
        Claim("eq79.slope2", "(79), second mode", "slope, second mode", "0.5143", chord(2), note=note),
        Claim("eq79.start1", "(79), first mode", "√(−F_c) at mg = 0, first mode", "2π",
              wavenumber(1), FORMULA, 2.0 * math.pi),
        Claim("eq79.start2", "(79), second mode", "√(−F_c) at mg = 0, second mode", "8.9868", wavenumber(2)),
    ]  # fmt: skip


def claims_87() -> list[Claim]:
    """Weights of buckling of the vertical column under its own weight."""
    second = Known("157.032780", "The last printed digit is off by 3: 157.032783 should read 157.032780.", _second_root)
    sign = Known("-1", "t₁ below (86) is printed with the wrong sign.", _wrong_sign)
    return [
        Claim("eq87.1", "(87)", "mg of self-weight buckling, first mode", "74.628569", self_weight(1)),
        Claim("eq87.2", "(87)", "mg of self-weight buckling, second mode", "157.032783", self_weight(2), known=second),
        Claim("eq87.3", "(87)", "mg of self-weight buckling, third mode", "325.513452", self_weight(3)),
        Claim("eq87.engelhardt", "text after (87), Engelhardt 1954", "mg of self-weight buckling, first mode",
              "74.6285 ± 0.0005", self_weight(1), INTERVAL),
        Claim("eq86.t1", "below (86)", "t₁/(mg)^(1/3) at F = 0", "1",
              lambda _work: Value(scorer.start(1.0)), known=sign),
    ]  # fmt: skip


def claims_88() -> list[Claim]:
    """The column whose upper end sways, and the ratio of heights."""
    bessel = scorer.bessel_root()
    return [
        Claim("eq88", "(88)", "mg of self-weight buckling, upper end free to sway", "18.956266",
              lambda work: work.buckling_weight(SWAYING)),
        Claim("eq88.bessel", "(88)", "mg of self-weight buckling, upper end free to sway", "J_⅓(⅔√mg) = 0",
              lambda work: work.buckling_weight(SWAYING), FORMULA, bessel),
        Claim("L_cr", "section 5, L_cr", "mg L³/EI of the tallest fixed–fixed column", "74.628569", self_weight(1)),
        Claim("ratio", "section 5", "ratio of critical heights, held to swaying", "1.58", ratio_of_heights),
    ]  # fmt: skip


def claims_6() -> list[Claim]:
    """Weights at which the buckling curves of Fig. 6(e) and (f) cross the axis."""
    nearly = rod(1.0, NEARLY_VERTICAL)
    place = "section 4.1.3, Fig. 6"
    return [
        Claim("fig6.88", place, "mg of self-weight buckling at 88° (α = π/90)", "125.95",
              lambda work: work.buckling_weight(nearly)),
        Claim("fig6.90", place, "mg of self-weight buckling at 90° (α = 0)", "74.63", self_weight(1)),
    ]  # fmt: skip


def claims_12() -> list[Claim]:
    """Weights at which the rod on top buckles without end force."""
    exact = [
        Claim(f"fig12.x{k}", "section 4.3", f"mg at F = 0, rod on top, mode {k}", "b^¼ with cos x cosh x = 1",
              _top(k), FORMULA, CLEARANCE * clamped_beam_root(k) ** 4)
        for k in (1, 2, 3)
    ]  # fmt: skip
    return exact + [
        Claim(f"fig12.{k}", "section 4.3, Fig. 12(b)", f"mg at F = 0, rod on top, mode {k}", printed, _top(k))
        for k, printed in ((1, "5.0056"), (2, "38.0354"), (3, "146.1763"))
    ]  # fmt: skip


def _top(mode: int) -> Callable[[Work], Value]:
    return lambda work: work.buckling_weight(ON_TOP, mode)


def claims_9() -> list[Claim]:
    """The first mode of the vertical column of Fig. 9, which buckles in tension."""

    def first(work: Work) -> Value:
        return work.critical(rod(100.0, VERTICAL))[0].load

    return [Claim("fig9.first", "caption of Fig. 9", "F_c of the first mode, γ = 100, α = 0 [B/L²]", "14.3626", first)]
