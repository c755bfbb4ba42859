"""The energy of a heavy rod kept on the wall of a curved hole, stated once, in symbols; and the contact pressure.

Running

    python -m rodwell.physics.on_wall.curved_energy

writes ``_curved_density.py``; a test regenerates that file and compares. SymPy is needed for this step only.

The axis of the hole X(S) has the tangent T, towards the end with the load, and a rotation-minimising frame N₁, N₂:
T′ = k₁N₁ + k₂N₂, Nᵢ′ = −kᵢT by its own arclength S. The rod is X − Δ d₁ with d₁ = cos θ N₁ − sin θ N₂, θ = y/Δ, and
u₂ = sin θ N₁ + cos θ N₂ points around the hole. With

    κₙ = k·d₁ = k₁ cos θ − k₂ sin θ,   κₜ = k·u₂ = k₁ sin θ + k₂ cos θ,   h = 1 + Δκₙ,   sin η = y′,   S′ = cos η/h

the unit tangent of the rod is sin η u₂ + cos η T, and its curvature has the components

    Kₙ = sin²η/Δ + cos²η κₙ/h   along d₁,      K_g = η′ + cos η κₜ/h   along u₁ = cos η u₂ − sin η T;

d₁ turns about the tangent at the rate −τ_g, τ_g = sin η cos η (1/Δ − κₙ/h). In a straight hole these are ω₃, −ω₂, −ω₁.

Units: bending stiffness ``B = 1`` and length ``L = 1``. Tension is positive.
"""

from __future__ import annotations

from pathlib import Path

import sympy as sp

from rodwell.physics.generating import generated
from rodwell.physics.on_wall.energy import CosEta, OneMinusCosEta, cos_eta, curvature, sec_eta
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, FORCE, PARAMETERS, TWIST

y, y1, y2, y3, clearance = sp.symbols("y y1 y2 y3 clearance", real=True)
force, weight, twist = (sp.Symbol(PARAMETERS[i], real=True) for i in (FORCE, AXIAL_WEIGHT, TWIST))
k1, k2, g1, g2, lift, offset, inverse = sp.symbols("k1 k2 g1 g2 lift offset inverse", real=True)
k1_rate, k2_rate, k1_bend, k2_bend = sp.symbols("k1_rate k2_rate k1_bend k2_bend", real=True)

FIELDS = (y, y1, y2)
SYMBOLS = (force, weight, sp.Dummy(), sp.Dummy(), twist)
"""What may vary along a branch, in the order of ``parameters``; the hole and its clearance stay."""


class Versine(sp.Function):  # type: ignore[misc]
    """``1 − cos θ``, kept whole so that its value can be computed without cancellation."""

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the derivative."""
        return sp.sin(self.args[0])


class Squeeze(sp.Function):  # type: ignore[misc]
    """``1/h`` as a function of y, k₁, k₂: kept whole, so that there is one division."""

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the derivative: ∂h/∂y = −κₜ, ∂h/∂k₁ = Δ cos θ, ∂h/∂k₂ = −Δ sin θ."""
        rates = (-(k1 * sp.sin(angle) + k2 * sp.cos(angle)), clearance * sp.cos(angle), -clearance * sp.sin(angle))
        return -(self**2) * rates[argindex - 1]


angle = y / clearance
inwards = k1 * sp.cos(angle) - k2 * sp.sin(angle)
around = k1 * sp.sin(angle) + k2 * sp.cos(angle)
squeeze = Squeeze(y, k1, k2)
lying = 1 / (1 + clearance * k1)


def drive() -> sp.Expr:
    """N(s): the force that drives the rod along the hole, reduced to the hole's axis."""
    return (1 + clearance * k1) * (force - weight * lift + offset)


def energy_density() -> sp.Expr:
    """Energy per length of the rod, relative to the rod on the generator θ = 0.

    * bending ½(Kₙ² + K_g²);
    * end force: −N S′ with N(s) = (1 + Δk₁) (F − w A(s) + C(s)), the force that drives the rod at s along the hole,
      reduced to its axis: F acts along the tangent of the rod's end, A is by how much higher that end lies, and C what
      bending gives where the curvature changes (:mod:`rodwell.analysis.discrete.curved`);
    * weight across the hole, −w Δ d₁·k with k = g₁N₁ + g₂N₂ + … vertically up;
    * torque on the rotation against the rotation-minimising frame: −T₁(−τ_g + θ′).
    """
    turned = Versine(angle)
    slack = OneMinusCosEta(y1)
    normal = y1**2 * (1 / clearance - inwards * squeeze) - (k1 * turned + k2 * sp.sin(angle)) * squeeze * lying
    geodesic = y2 / CosEta(y1) + CosEta(y1) * around * squeeze
    axial = drive()
    return (
        geodesic**2 / 2
        - (k2 * lying) ** 2 / 2
        + normal * (normal + 2 * k1 * lying) / 2
        + axial * (slack - clearance * (k1 * turned + k2 * sp.sin(angle)) * lying) * squeeze
        + weight * clearance * (g1 * turned + g2 * sp.sin(angle))
        - twist * y1 * (slack / clearance + CosEta(y1) * inwards * squeeze)
    )


def along(f: sp.Expr) -> sp.Expr:
    """Derivative along s of an expression in y, its derivatives, and the curvatures of the hole."""
    by = {y: y1, y1: y2, y2: y3, k1: k1_rate, k2: k2_rate, k1_rate: k1_bend, k2_rate: k2_bend}
    return sum(sp.diff(f, x) * rate for x, rate in by.items())


def strand() -> dict[str, sp.Expr]:
    """Curvatures, forces and contact pressure of the rod: from the balance of moments and forces, d₁ and u₁.

    M = (−T₁, −K_g, Kₙ) along t₁, d₁, u₁. The tangential force follows from the force that drives the rod along the
    hole, N = h F·T + M·(κₙu₂ − κₜd₁): a step along the hole turns the rod with T.
    """
    eta1 = y2 / CosEta(y1)
    normal = y1**2 / clearance + CosEta(y1) ** 2 * inwards * squeeze
    geodesic = eta1 + CosEta(y1) * around * squeeze
    turning = y1 * CosEta(y1) * (1 / clearance - inwards * squeeze)
    f2 = twist * geodesic - along(normal) - geodesic * turning
    f3 = -twist * normal + normal * turning - along(geodesic)
    guided = inwards * (normal * CosEta(y1) - twist * y1) + around * geodesic
    f1 = ((drive() - guided) * squeeze + f3 * y1) / CosEta(y1)
    upwards = g1 * sp.cos(angle) - g2 * sp.sin(angle)
    pressure = along(f2) + normal * f1 + turning * f3 - weight * upwards
    return {
        "omega1": -turning, "omega2": -geodesic, "omega3": normal, "f1": f1, "f2": f2, "f3": f3, "pressure": pressure,
    }  # fmt: skip


# What the formulas compute once, and how the functions above are evaluated from it.
PRELUDE = """\
    curvature = 1.0 / clearance
    half_angle = 0.5 * y * curvature
    sin_half, cos_half = np.sin(half_angle), np.cos(half_angle)
    cos_eta = np.sqrt((1.0 - y1) * (1.0 + y1))
    sec_eta = 1.0 / cos_eta
    lying = 1.0 / (1.0 + clearance * k1)
    versine, sine = 2.0 * sin_half * sin_half, 2.0 * sin_half * cos_half
    inverse = 1.0 / (1.0 + clearance * (k1 * (1.0 - versine) - k2 * sine))"""
versine, sine, lying_symbol = sp.symbols("versine sine lying")


def _cheap(expression: sp.Expr) -> sp.Expr:
    """Rewrite in the quantities of the prelude: two trigonometric calls and a few divisions in all."""
    expression = expression.subs(squeeze, inverse).subs(
        {
            Versine(angle): versine,
            sp.sin(angle): sine,
            sp.cos(angle): 1 - versine,
            OneMinusCosEta(y1): y1**2 / (1 + cos_eta),
        }
    )
    for base, symbol in ((CosEta(y1), sec_eta), (1 + clearance * k1, lying_symbol), (clearance, curvature)):
        expression = expression.replace(
            lambda e, base=base: e.is_Pow and e.base == base and e.exp.is_negative,
            lambda e, symbol=symbol: symbol ** (-e.exp),
        )
    return expression.subs(CosEta(y1), cos_eta)


def generate() -> str:
    """Return the text of ``_curved_density.py``."""
    body = generated(energy_density(), FIELDS, SYMBOLS, _cheap, PRELUDE)
    found = strand()
    replacements, reduced = sp.cse(
        [_cheap(e) for e in found.values()], symbols=sp.numbered_symbols("t"), order="canonical"
    )
    lines = [PRELUDE.replace("    lying = 1.0 / (1.0 + clearance * k1)\n", "")]
    lines += [f"    {name} = {sp.pycode(e)}" for name, e in replacements]
    lines += [f"    {name} = {sp.pycode(e)}" for name, e in zip(found, reduced, strict=True)]
    lines.append(f"    return {', '.join(found)}")
    return _TEMPLATE.format(body=body, strand="\n".join(lines))


_TEMPLATE = '''\
"""Generated by ``python -m rodwell.physics.on_wall.curved_energy``. Do not edit: change the symbolic energy instead."""

from typing import Any

import numpy as np


def curved_density(y: Any, y1: Any, y2: Any, hole: Any, clearance: Any, parameters: Any, rates: Any) -> Any:
    """Energy per length of the rod, relative to θ = 0, and its derivatives, from y, y', y''.

    ``hole`` is k₁, k₂, g₁, g₂, A and C there; of ``parameters`` F, the weight w (first two) and T₁ enter. Returns as
    :func:`rodwell.physics.on_wall._density.rod_density` does.
    """
    k1, k2, g1, g2, lift, offset = hole
{body}


def curved_strand(
    y: Any, y1: Any, y2: Any, y3: Any, hole: Any, rates: Any, clearance: Any, twist: Any, force: Any, axial_weight: Any
) -> Any:
    """Curvatures ω₁, ω₂, ω₃ of the rod, its force F₁, F₂, F₃ along t₁, d₁, u₁, and the contact pressure p.

    ``rates`` are the first derivatives along s of k₁ and k₂, and the second ones.
    """
    k1, k2, g1, g2, lift, offset = hole
    k1_rate, k2_rate, k1_bend, k2_bend = rates
{strand}
'''


def main() -> None:
    """Write ``_curved_density.py`` beside this file."""
    Path(__file__).with_name("_curved_density.py").write_text(generate(), encoding="utf-8")


if __name__ == "__main__":
    main()
