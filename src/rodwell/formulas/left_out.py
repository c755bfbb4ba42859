"""Formulas that are left out, and why: known from memory only, or refuted."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class LeftOut:
    """A formula or number of practice that is not used here."""

    name: str
    text: str
    reason: str


LEFT_OUT: tuple[LeftOut, ...] = (
    LeftOut(
        "Paslay–Bogy 1964, three-dimensional factor",
        "(1 − ν)/((1 + ν)(1 − 2ν)) on the first term",
        "known from memory only",
    ),
    LeftOut(
        "Miska et al. 1996, end of the stable sinusoidal state",
        "3.75 √(B w sin α/r)",
        "the number is known from memory only; 4√2 is in, as quoted of Mitchell 1997",
    ),
    LeftOut(
        "Lubinski 1950, second order",
        "3.75 ∛(B w²)",
        "known from memory only. For pinned ends the exact second coefficient is 3.75 at L = 50 ∛(B/w), "
        "where the first is 1.571, not 1.94",
    ),
    LeftOut(
        "Wu–Juvkam-Wold 1992, vertical, top of the helix",
        "0.14 ∛(B w²)",
        "known from memory only. The derivation behind 2.55 and 5.55 gives 5.5539 − ∛(16π²) = 0.149",
    ),
    LeftOut(
        "Wu–Juvkam-Wold 1995, curved hole",
        "F_sin = (4B/(rR))[1 + √(1 + w sin α r R²/(4B))]; helical with 12 and 8",
        "only the abstract was available; the helical form tends to 4.24 √(B w sin α/r) in a straight hole, "
        "which matches no straight-hole formula",
    ),
    LeftOut(
        "Helix under torque, contact force of Wicks et al. 2008 as passed on",
        "N = r F/(128B²)·(3T + √(9T² + 32FB))(T + √(9T² + 32FB))",
        "refuted: at T ≠ 0 it breaks the radial balance of the helix, and differs from the exact contact pressure "
        "already in first order of T; twisted_helix_contact has the form that holds",
    ),
    LeftOut(
        "Huang & Pattillo 2000; Miska & Cunha 1995; Cunha 2004",
        "transition between 2.83 and 5.66 √(B w sin α/r), and others",
        "only abstracts or first pages were available",
    ),
)
"""What is left out."""
