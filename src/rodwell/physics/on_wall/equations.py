"""The paper's own system, to be read beside it: fifteen equations, fifteen end conditions, and the relations between.

The engine does not solve this system; it solves for one function y(s), and :mod:`rodwell.physics.on_wall.braid`
rebuilds the fifteen variables from it. Here the paper's equations are stated as printed, (22)–(27), (32)–(36),
(41)–(44), as sums of terms, so that a solution can be put into them term by term (the certificate) and so that another
solver can be given them (``rodwell verify``). Units B = L = 1; primes are derivatives by s; tension is positive.
Nothing is shared with the energy from which the engine works.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Terms = tuple[Any, ...]


class Fifteen(NamedTuple):
    """The fifteen variables in the paper's order; numbers, or arrays over s."""

    F1: Any
    F2: Any
    F3: Any
    M1: Any
    M2: Any
    M3: Any
    xi1: Any
    T2: Any
    eta: Any
    omega3: Any
    xi2: Any
    lam: Any
    mu: Any
    omega2: Any
    z: Any


NAMES = Fifteen(
    *("braid_F1", "braid_F2", "braid_F3", "braid_M1", "braid_M2", "braid_M3", "xi1", "T2", "eta"),
    *("omega3", "xi2", "lambda", "mu", "omega2", "z"),
)
"""Names of the variables among the fields of a solution."""

NUMBERS = Fifteen(
    *("(22)", "(23)", "(24)", "(25)", "(26)", "(27)", "(32)", "(33)", "(34)", "(35)", "(36)", "(41)", "(42)"),
    *("(43)", "(44)"),
)
"""Number of the differential equation of each variable."""


class Load(NamedTuple):
    """What the system is given: loads, weight, geometry, stiffness ratio and where the rod starts and ends.

    ``force`` F and ``twist`` T₁ act at s = 1; ``axial_weight`` mg cos α and ``lateral_weight`` mg sin α; ``C`` is the
    torsional stiffness; ``turn`` is ξ₂(1), where ξ₂(0) = 0; ``ends`` are the conditions at both ends. Numbers, or
    arrays over s where sections of a string differ. ``stiffness_rate`` and ``stiffness_bend`` are b′/b and b″/b where
    the bending stiffness varies: the paper's rod has neither, and what they add stands last in each sum.
    """

    force: Any
    twist: Any
    axial_weight: Any
    lateral_weight: Any
    clearance: float
    C: Any
    turn: float = 0.0
    ends: tuple[str, str] = ("clamped", "clamped")
    stiffness_rate: Any = 0.0
    stiffness_bend: Any = 0.0


def omega1(x: Fifteen, load: Load) -> Any:
    """ω₁ = −sin η cos η/Δ, (20)₁."""
    return -np.sin(x.eta) * np.cos(x.eta) / load.clearance


def right_hand_sides(x: Fifteen, load: Load) -> Fifteen:
    """Terms whose sum is the derivative of each variable by s."""
    (F1, F2, F3, M1, M2, M3, _, T2, eta, w3, xi2, lam, mu, w2, _) = x
    sin, cos, tan, w1 = np.sin(eta), np.cos(eta), np.tan(eta), omega1(x, load)
    T1, D, axial, lateral = load.twist, load.clearance, load.axial_weight, load.lateral_weight
    taper = load.stiffness_rate
    return Fifteen(
        F1=(-w2 * F3, w3 * F2, axial * cos),  # (22)
        F2=(-w3 * F1, w1 * F3),  # (23)
        F3=(-w1 * F2, w2 * F1, -axial * sin),  # (24)
        M1=(-w2 * M3, w3 * M2),  # (25)
        M2=(-w3 * M1, w1 * M3, F3),  # (26)
        M3=(-w1 * M2, w2 * M1, -F2),  # (27)
        xi1=(T1 / load.C + 0.0 * eta, w1),  # (32)
        T2=(D * lateral * np.sin(xi2),),  # (33)
        eta=(-w2,),  # (34)
        omega3=(2.0 * w1 * w2,),  # (35)
        xi2=(sin / D,),  # (36)
        lam=(-F2, -w2 * T1, -w2 * 3.0 * w1, -tan * lam * w2, tan * mu / D, -taper * w3),  # (41)
        mu=(cos**2 * M1 / D, cos**2 * T1 / D, -cos * sin * M3 / D, cos * sin * (w3 - lam) / D, -cos * T2 / D),  # (42)
        omega2=(F3, -M1 / D, -T1 * cos**2 / D, w1 * w3, -w1 * lam, T2 * cos / D, -taper * w2),  # (43)
        z=(cos,),  # (44)
    )


def rates(x: FloatArray, load: Load) -> FloatArray:
    """Derivatives (15, m) of the variables ``x`` (15, m) by s."""
    out = np.empty_like(x)
    for row, terms in zip(out, right_hand_sides(Fifteen(*x), load), strict=True):
        row[:] = sum(terms)
    return out


class Strands(NamedTuple):
    """Forces in rod (1) and cylinder (2), contact pressure: the paper's (52)–(58), each as the terms of a sum."""

    F11: Terms
    F12: Terms
    F13: Terms
    F21: Terms
    F22: Terms
    F23: Terms
    p: Terms


def strands(x: Fifteen, load: Load) -> Strands:
    """Individual strand forces and the contact pressure p₂⁽¹⁾ from the fifteen variables, (52)–(58)."""
    sin, cos, w1, w2, w3 = np.sin(x.eta), np.cos(x.eta), omega1(x, load), x.omega2, x.omega3
    T1, D, lam = load.twist, load.clearance, x.lam
    lever, taper = 3.0 * w1 + T1, load.stiffness_rate
    return Strands(
        F11=(x.F1, (x.M3 - w3) / D, lam * w3, -lam / D, x.T2 * sin / D),  # (52)
        F12=(-w2 * lever, -taper * w3),  # (53)
        F13=(x.F3, -(x.M1 + T1) / D, -lam * w1, x.T2 * cos / D),  # (54)
        F21=cylinder_tension(x, load),
        F22=(x.F2, w2 * lever, taper * w3),  # (57)
        F23=((x.M1 + T1) * cos / D, -(x.M3 - w3) * sin / D, -x.T2 / D),  # (58)
        p=(  # (55)
            *(lever * (x.M1 + T1 * cos**2) / D, -lever * x.F3, -lever * w1 * (w3 - lam), -lever * x.T2 * cos / D),
            *(x.T2 * sin / D**2, -3.0 * np.cos(2.0 * x.eta) / D * w2**2, w1 * (x.M1 + T1) / D, -w1 * x.F3),
            *(w3 * (x.F1 + x.M3 / D), -(w3**2) / D, -load.lateral_weight * np.cos(x.xi2)),
            *(taper * lever * w2, -5.0 * taper * w1 * w2, -load.stiffness_bend * w3),
        ),
    )


def cylinder_tension(x: Fifteen, load: Load) -> Terms:
    """The cylinder's force F₁⁽²⁾ along its axis, the constant h: (56)."""
    sin, cos, D = np.sin(x.eta), np.cos(x.eta), load.clearance
    return x.omega3 * cos / D, -x.M3 * cos / D, -(x.M1 + load.twist) * sin / D, x.lam * cos / D


def moments(x: Fifteen, mu_rate: Any, load: Load) -> dict[str, Terms]:
    """(37)–(39) as sums that vanish; ``mu_rate`` is μ′ and h the constant of (56)."""
    sin, cos = np.sin(x.eta), np.cos(x.eta)
    D, h = load.clearance, sum(cylinder_tension(x, load))
    lam_cos = 2.0 * x.lam * sin * cos
    return {
        "(37)": (-x.M1, -load.twist, -D * h * sin, lam_cos, D * mu_rate, x.T2 * cos),
        "(38)": (-x.M2, x.omega2, x.mu),
        "(39)": (
            *(-x.M3, x.omega3, -D * h * cos, x.lam, -2.0 * x.lam * sin**2),
            *(-D * mu_rate * sin / cos, -x.T2 * sin),
        ),
    }


class Condition(NamedTuple):
    """An end condition: a residual that vanishes, and the variables whose largest size it is judged against."""

    residual: Any
    against: tuple[str, ...]


def end_conditions(first: Fifteen, last: Fifteen, load: Load) -> dict[str, Condition]:
    """(B1)–(B15); ``first`` and ``last`` are the variables at s = 0 and s = 1.

    With clamped ends they are the paper's. An end that can turn (pinned, free) has ω₂ = 0 in place of (B4), (B8), and
    at s = 1 no fitting gives it the moment ω₃ u₁: (B13) is then M₃ = 0, and (B10) λ = −ω₃. An end that can move around
    the wall (guided, free) has no circumferential force on it in place of (B2), (B7): at s = 1, where the rod alone
    is loaded, that of the braid; at s = 0 that of the rod, with the part ω₃ sin η/Δ that the rim of contact takes
    where the end is not along the axis.
    """
    holds_angle = [end in ("clamped", "pinned") for end in load.ends]
    holds_slope = [end in ("clamped", "guided") for end in load.ends]

    def at(residual: Any, *against: str) -> Condition:
        return Condition(residual, against)

    return {
        "(B1)": at(first.xi1, "xi1"),
        "(B2)": at(first.xi2, "xi2") if holds_angle[0] else at(_rod_around(first, load), "F1"),
        "(B3)": at(first.z, "z"),
        "(B4)": at(first.eta, "eta") if holds_slope[0] else at(first.omega2, "omega2", "omega3"),
        "(B5)": at(first.omega3 - np.sin(first.eta) ** 2 / load.clearance, "omega3"),
        "(B6)": at(first.M2 - first.omega2 - first.mu, "M2"),
        "(B7)": at(last.xi2 - load.turn, "xi2") if holds_angle[1] else at(_around(last), "F1"),
        "(B8)": at(last.eta, "eta") if holds_slope[1] else at(last.omega2, "omega2", "omega3"),
        "(B9)": at(last.T2, "T2"),
        "(B10)": at(last.lam, "lam") if holds_slope[1] else at(last.lam + last.omega3, "lam"),
        "(B11)": at(last.mu, "M2"),
        "(B12)": at(last.F2, "F1"),
        "(B13)": at(last.M3 - last.omega3 if holds_slope[1] else last.M3, "M2"),
        "(B14)": at(last.M1 + load.twist, "M2"),
        "(B15)": at(last.F1 * np.cos(last.eta) - last.F3 * np.sin(last.eta) - load.force, "F1"),
    }


def _around(x: Fifteen) -> Any:
    """Braid force along u₂, around the cylinder."""
    return x.F1 * np.sin(x.eta) + x.F3 * np.cos(x.eta)


def _rod_around(x: Fifteen, load: Load) -> Any:
    """Circumferential force that an end lets go of at s = 0: that of the rod, and the rim's part ω₃ sin η/Δ."""
    rod, sin = strands(x, load), np.sin(x.eta)
    return sum(rod.F11) * sin + sum(rod.F13) * np.cos(x.eta) + x.omega3 * sin / load.clearance
