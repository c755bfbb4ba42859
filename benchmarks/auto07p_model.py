"""The paper's fifteen equations and their end conditions, as AUTO-07p takes them.

Written down from the paper, and from nothing in rodwell. Units B = L = 1. Parameters, in AUTO's order: end force F,
twisting moment T₁, axial and lateral weight, clearance Δ, Poisson's ratio ν, and two quantities that AUTO is made to
report, ω₂(1) and T₂(0). ``math`` is bifpy's: it traces these functions once, with symbols.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

VARIABLES = ["F1", "F2", "F3", "M1", "M2", "M3", "xi1", "T2", "eta", "omega3", "xi2", "lambda", "mu", "omega2", "z"]
F, T1, WA, WL, DELTA, NU, END_CURVATURE, TORQUE = range(8)
CONDITIONS = 17


def equations(u: Sequence[Any], par: Sequence[Any]) -> list[Any]:
    """(22)–(27), (32)–(36), (41)–(44), solved for the derivatives."""
    f1, f2, f3, m1, m2, m3, _xi1, t2, eta, w3, xi2, lam, mu, w2, _z = u
    t1, delta = par[T1], par[DELTA]
    sin, cos = math.sin(eta), math.cos(eta)
    tan = sin / cos
    w1 = -sin * cos / delta  # (20)
    return [
        w3 * f2 - w2 * f3 + par[WA] * cos,  # (22)
        w1 * f3 - w3 * f1,  # (23)
        w2 * f1 - w1 * f2 - par[WA] * sin,  # (24)
        w3 * m2 - w2 * m3,  # (25)
        w1 * m3 - w3 * m1 + f3,  # (26)
        w2 * m1 - w1 * m2 - f2,  # (27)
        t1 * (1.0 + par[NU]) + w1,  # (32), C = 1/(1 + ν)
        delta * par[WL] * math.sin(xi2),  # (33)
        -w2,  # (34)
        2.0 * w1 * w2,  # (35)
        sin / delta,  # (36)
        -f2 - w2 * (t1 + 3.0 * w1) - tan * (lam * w2 - mu / delta),  # (41)
        cos / delta * ((m1 + t1) * cos - (m3 - w3 + lam) * sin - t2),  # (42)
        f3 - (m1 + t1 * cos * cos) / delta + w1 * (w3 - lam) + t2 * cos / delta,  # (43)
        cos,  # (44)
    ]


def end_conditions(left: Sequence[Any], right: Sequence[Any], par: Sequence[Any]) -> list[Any]:
    """(B1)–(B15), and what AUTO is to report."""
    a, b = dict(zip(VARIABLES, left, strict=True)), dict(zip(VARIABLES, right, strict=True))
    sin0 = math.sin(a["eta"])
    return [
        a["xi1"],
        a["xi2"],
        a["z"],
        a["eta"],
        a["omega3"] - sin0 * sin0 / par[DELTA],
        a["M2"] - a["omega2"] - a["mu"],
        b["xi2"],
        b["eta"],
        b["T2"],
        b["lambda"],
        b["mu"],
        b["F2"],
        b["M3"] - b["omega3"],
        b["M1"] + par[T1],
        b["F1"] * math.cos(b["eta"]) - b["F3"] * math.sin(b["eta"]) - par[F],
        b["omega2"] - par[END_CURVATURE],
        a["T2"] - par[TORQUE],
    ]


def straight(parameters: Sequence[float]) -> Callable[[Any, Any, Any], None]:
    """Return AUTO's starting point: the straight, twisted rod, F₁ = F + w cos α (s − 1), M₁ = −T₁."""

    def start(u: Any, par: Any, s: Any) -> None:
        for i in range(len(VARIABLES)):
            u[i] = 0.0
        for i, value in enumerate([*parameters, 0.0, 0.0]):
            par[i] = value
        u[VARIABLES.index("F1")] = parameters[F] + parameters[WA] * (s - 1.0)
        u[VARIABLES.index("M1")] = -parameters[T1]
        u[VARIABLES.index("xi1")] = parameters[T1] * (1.0 + parameters[NU]) * s
        u[VARIABLES.index("z")] = s

    return start


def contact_pressure(fields: dict[str, Any], parameters: Sequence[float], cos: Callable[[Any], Any]) -> Any:
    """p₂⁽¹⁾ as printed, (55); ``cos`` is NumPy's."""
    t1, wl, delta = parameters[T1], parameters[WL], parameters[DELTA]
    f1, f3, m1, m3, t2 = (fields[k] for k in ("F1", "F3", "M1", "M3", "T2"))
    eta, w2, w3, lam = (fields[k] for k in ("eta", "omega2", "omega3", "lambda"))
    cos_eta, sin_eta = cos(eta), cos(eta - math.pi / 2.0)
    w1 = -sin_eta * cos_eta / delta
    return (
        (t1 + 3.0 * w1) * ((m1 + t1 * cos_eta**2) / delta - f3 - w1 * (w3 - lam) - t2 * cos_eta / delta)
        + t2 * sin_eta / delta**2
        - 3.0 * cos(2.0 * eta) / delta * w2**2
        + w1 * ((m1 + t1) / delta - f3)
        + w3 * (f1 + m3 / delta)
        - w3**2 / delta
        - wl * cos(fields["xi2"])
    )
