"""Critical loads in vertical holes, under the weight of the string itself. Compression positive."""

from __future__ import annotations

import math

from rodwell.formulas.record import FormulaInputs, Value, ends_are, formula, vertical
from rodwell.quantities.text import plain

HANGING = 1.0187929716474710
"""−a′₁, the first zero of Ai′ with its sign changed."""


def _hanging_length(rod: FormulaInputs) -> list[str]:
    """In a string of less than four natural lengths the top end is felt."""
    if rod.w == 0.0:
        return ["weightless"]
    size = rod.L / (rod.B / rod.w) ** (1.0 / 3.0)
    return [] if size >= 4.0 else [f"short: L is {plain(size, 2)} of ∛(B/w)"]


def _number_depends(rod: FormulaInputs) -> list[str]:
    """The length at which the coefficient 1.94 is exact for pinned ends is near 8 ∛(B/w)."""
    if rod.w == 0.0:
        return ["weightless"]
    size = rod.L / (rod.B / rod.w) ** (1.0 / 3.0)
    return [] if 6.0 <= size <= 10.0 else [f"the number fits L of about 8 ∛(B/w), here it is {plain(size, 3)}"]


@formula(
    "F = 1.94 ∛(B w²)",
    kind="sinusoidal",
    place="bottom",
    source="Lubinski 1950, first order",
    evidence="read in sources; for pinned ends the exact coefficient is 1.94 at a length of 7.93 ∛(B/w) (tested)",
    holds="vertical, hinged bit; as a number, strings of about 8 ∛(B/w) with pinned ends (6 to 10: 5 %)",
    assumes="string in its own weight, no wall; force at the bit",
    checks=(vertical, ends_are("pinned", "pinned"), _number_depends),
)
def lubinski(B: Value, w: Value) -> Value:
    """Lubinski 1950, vertical bit load."""
    return 1.94 * (B * w**2) ** (1.0 / 3.0)


@formula(
    "F = 2.55 ∛(B w²)",
    kind="sinusoidal",
    place="bottom",
    source="Wu & Juvkam-Wold 1992, as in Oyedokun 2014",
    evidence="second-hand; equal to ¾ ∛(4π²): a half sine over the length of the smallest load (derived, tested)",
    holds="vertical, pinned ends",
    assumes="energy method with one half sine over the buckled length, about 3.40 ∛(B/w); an upper bound there",
    checks=(vertical, ends_are("pinned", "pinned")),
)
def wu_vertical_sinusoidal(B: Value, w: Value) -> Value:
    """Wu–Juvkam-Wold 1992, vertical, sinusoidal."""
    return 2.55 * (B * w**2) ** (1.0 / 3.0)


@formula(
    "F = 5.55 ∛(B w²)",
    kind="helical",
    place="bottom",
    source="Wu & Juvkam-Wold 1992, as in Oyedokun 2014",
    evidence="second-hand; equal to twice the energy-equality load ¾ ∛(16π²) less ¾ ∛(4π²) (derived, tested)",
    holds="vertical",
    assumes="energy method; the mean of it and of the sinusoidal load is the energy-equality load",
    checks=(vertical,),
)
def wu_vertical_helical(B: Value, w: Value) -> Value:
    """Wu–Juvkam-Wold 1992, vertical, helical."""
    return 5.55 * (B * w**2) ** (1.0 / 3.0)


@formula(
    "F = 1.018793 ∛(B w²), −a′₁ with Ai′(a′₁) = 0",
    kind="sinusoidal",
    place="bottom",
    source="closed form; attribution to Wang 1983 and 1986 is from memory only",
    evidence="derived: Airy's equation with no moment at the bit; checked here against the exact loads",
    holds="vertical, pinned bit, upper end free to move sideways and turn, L ≥ 4 ∛(B/w)",
    assumes="hanging string, no wall; force at the bit",
    checks=(vertical, ends_are("pinned", "free"), _hanging_length),
)
def long_hanging(B: Value, w: Value) -> Value:
    """Long hanging string, pinned bit."""
    return HANGING * (B * w**2) ** (1.0 / 3.0)


def _chord(rod: FormulaInputs) -> list[str]:
    limit = 74.628569 * rod.B / rod.L**3
    return (
        []
        if rod.w <= limit
        else [f"w L³/B above 74.63, where the chord (79) ends: {plain(rod.w * rod.L**3 / rod.B, 4)}"]
    )


@formula(
    "F = 4π²B/L² − 0.5290 w L",
    kind="sinusoidal",
    place="top",
    source="the paper, Eq. (79)",
    evidence="paper; checked here against the exact loads: exact at w = 0 and at w L³/B = 74.628569, a chord between",
    holds="vertical, both ends clamped, w L³/B ≤ 74.63",
    assumes="straight line between two exact points; force at s = 1",
    checks=(vertical, ends_are("clamped", "clamped"), _chord),
)
def clamped_vertical(B: Value, w: Value, L: Value) -> Value:
    """Vertical clamped–clamped chord (79)."""
    return 4.0 * math.pi**2 * B / L**2 - 0.5290 * w * L


@formula(
    "L = ∛(74.628569 B/w)",
    kind="limit",
    dimension=(0, 1),
    source="the paper, Eq. (87) and section 5",
    evidence="paper; checked here against the exact loads",
    holds="vertical, both ends clamped, no end force at the top",
    checks=(vertical, ends_are("clamped", "clamped")),
)
def tallest_clamped(B: Value, w: Value) -> Value:
    """Length of the tallest clamped–clamped column."""
    return (74.628569 * B / w) ** (1.0 / 3.0)


@formula(
    "L = ∛(18.956266 B/w)",
    kind="limit",
    dimension=(0, 1),
    source="the paper, Eq. (88); Wang 1987",
    evidence="paper; checked here against the exact loads",
    holds="vertical, clamped below, upper end free to sway but not to turn, no end force at the top",
    checks=(vertical, ends_are("clamped", "guided")),
)
def tallest_swaying(B: Value, w: Value) -> Value:
    """Length of the tallest column whose top sways."""
    return (18.956266 * B / w) ** (1.0 / 3.0)


@formula(
    "M = 3πB/∛(4π²B/w)",
    kind="torque",
    dimension=(1, 1),
    source="Oyedokun 2014",
    evidence="second-hand; the length in it is that of the 2.55 formula",
    holds="vertical; contradicts the paper, section 4.2: on the wall, torque does not enter the critical load",
    assumes="a string that may leave the wall; there is no exact counterpart here",
    checks=(vertical,),
)
def oyedokun_torque(B: Value, w: Value) -> Value:
    """Oyedokun 2014, torsional threshold, vertical."""
    return 3.0 * math.pi * B / (4.0 * math.pi**2 * B / w) ** (1.0 / 3.0)
