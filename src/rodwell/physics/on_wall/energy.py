"""The energy of a heavy rod on a cylinder, stated once, in symbols.

Everything that the solver differentiates comes from :func:`energy_density`. Running

    python -m rodwell.physics.on_wall.energy

writes ``_density.py`` (value, gradient, Hessian and parameter derivatives as plain arithmetic);
a test regenerates that file and compares. SymPy is needed for this step only: nothing that is
imported at run time imports this module.

Units: bending stiffness ``B = 1`` and length ``L = 1``, so forces are in ``B/L²`` and moments in
``B/L``. Tension is positive.
"""

from __future__ import annotations

from pathlib import Path

import sympy as sp

from rodwell.physics.on_wall.parameters import PARAMETERS

s, y, y1, y2 = sp.symbols("s y y1 y2", real=True)
force, axial_weight, lateral_weight, clearance, twist, side = sp.symbols(PARAMETERS, real=True)

FIELDS = (y, y1, y2)
SYMBOLS = (force, axial_weight, lateral_weight, clearance, twist, side)


class OneMinusCos(sp.Function):  # type: ignore[misc]
    """``1 − cos x``, kept whole so that its value can be computed without cancellation for small ``x``."""

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the derivative."""
        return sp.sin(self.args[0])


class CosEta(sp.Function):  # type: ignore[misc]
    """``cos η = √(1 − y'²)``, kept whole so that derivatives are rational in it."""

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the derivative."""
        return -self.args[0] / CosEta(self.args[0])


class OneMinusCosEta(sp.Function):  # type: ignore[misc]
    """``1 − cos η``, kept whole so that its value can be computed without cancellation for small slopes."""

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return the derivative."""
        return self.args[0] / CosEta(self.args[0])


def energy_density() -> sp.Expr:
    """Energy per length of the rod, relative to the straight rod on the same generator.

    With ``y = Δ ξ₂`` the circumferential arclength and ``sin η = y'``, the constraints (19)–(20)
    eliminated from the Lagrangian (30) of the paper and the Routhian of ``ξ₁`` taken:

    * bending in the tangent plane, ``ω₂ = −η' = −y''/cos η`` (20)₂,
    * bending by the curved wall, ``ω₃ = sin²η/Δ`` (20)₃,
    * lateral weight, (29): ``−Δ wₗ cos ξ₂``, less its value for ``ξ₂ = 0``,
    * end force with axial weight: ``−N(s) z'`` with ``z' = cos η`` (44), less its value for ``η = 0``;
      ``N(s) = F + wₐ (s − 1)`` is the axial resultant, (22)–(24),
    * dead end torque: ``−T₁ ω₁`` with ``ω₁ = −sin η cos η/Δ`` (20)₁, and ``−T₁ ξ₂'``: the torque works on the whole
      rotation ξ₁ + ξ₂ of the end. The latter is a null Lagrangian, which matters only where an end slides around
      the cylinder (in the paper both ends are held).
    """
    cos_eta = CosEta(y1)
    omega2 = y2 / cos_eta
    omega3 = y1**2 / clearance
    axial_force = force + axial_weight * (s - 1)
    return (
        omega2**2 / 2
        + omega3**2 / 2
        + clearance * lateral_weight * OneMinusCos(y / clearance)
        + axial_force * OneMinusCosEta(y1)
        - twist * y1 * OneMinusCosEta(y1) / clearance
    )


# What the formulas compute once, and how the functions above are evaluated from it.
PRELUDE = """\
    curvature = 1.0 / clearance
    half_angle = 0.5 * y * curvature
    sin_half, cos_half = np.sin(half_angle), np.cos(half_angle)
    cos_eta = np.sqrt((1.0 - y1) * (1.0 + y1))
    sec_eta = 1.0 / cos_eta"""
curvature, sin_half, cos_half, cos_eta, sec_eta = sp.symbols("curvature sin_half cos_half cos_eta sec_eta")


def _cheap(expression: sp.Expr) -> sp.Expr:
    """Rewrite in the quantities of the prelude: two trigonometric calls and two divisions in all."""
    angle = y / clearance
    expression = expression.subs(
        {
            OneMinusCos(angle): 2 * sin_half**2,
            sp.sin(angle): 2 * sin_half * cos_half,
            sp.cos(angle): 1 - 2 * sin_half**2,
            OneMinusCosEta(y1): y1**2 / (1 + cos_eta),
        }
    )
    expression = expression.replace(
        lambda e: e.is_Pow and e.base == CosEta(y1) and e.exp.is_negative, lambda e: sec_eta ** (-e.exp)
    ).subs(CosEta(y1), cos_eta)
    return expression.replace(
        lambda e: e.is_Pow and e.base == clearance and e.exp.is_negative, lambda e: curvature ** (-e.exp)
    )


def generate() -> str:
    """Return the text of ``_density.py``, generated from :func:`energy_density`."""
    density = energy_density()
    gradient = [sp.diff(density, f) for f in FIELDS]
    outputs: dict[str, sp.Expr] = {"energy": density}
    for i, g in enumerate(gradient):
        outputs[f"gradient{i}"] = g
    for i, g in enumerate(gradient):
        for j in range(i + 1):
            outputs[f"hessian{i}{j}"] = sp.diff(g, FIELDS[j])
    rates = sp.symbols([f"{name}_rate" for name in PARAMETERS], real=True)

    def along_rates(expression: sp.Expr) -> sp.Expr:
        return sum(r * sp.diff(expression, p) for r, p in zip(rates, SYMBOLS, strict=True))

    for i, g in enumerate(gradient):
        outputs[f"mixed{i}"] = along_rates(g)
    outputs["rate"] = along_rates(density)

    replacements, reduced = sp.cse(
        [_cheap(e) for e in outputs.values()], symbols=sp.numbered_symbols("t"), order="canonical"
    )
    lines = [f"    {name} = {sp.pycode(expr)}" for name, expr in replacements]
    lines += [f"    {target} = {sp.pycode(expr)}" for target, expr in zip(outputs, reduced, strict=True)]
    vectors = [", ".join(f"{name}{i}" for i in range(3)) for name in ("gradient", "mixed")]
    rows = [", ".join(f"hessian{max(i, j)}{min(i, j)}" for j in range(3)) for i in range(3)]
    lines.append(f"    return energy, rate, ({vectors[0]}), ({vectors[1]}), (({rows[0]}), ({rows[1]}), ({rows[2]}))")
    used = [(i, p.name) for i, p in enumerate(SYMBOLS) if p in density.free_symbols]
    unpack = [f"    {name} = parameters[{i}]" for i, name in used]
    unpack += [f"    {name}_rate = rates[{i}]" for i, name in used]
    return _TEMPLATE.format(body="\n".join([*unpack, PRELUDE, *lines]))


_TEMPLATE = '''\
"""Generated by ``python -m rodwell.physics.on_wall.energy``. Do not edit: change the symbolic energy instead."""

from typing import Any

import numpy as np


def rod_density(s: Any, y: Any, y1: Any, y2: Any, parameters: Any, rates: Any) -> Any:
    """Energy per length of the rod, relative to the straight rod, and its derivatives at ``s``, from y, y', y''.

    The order of ``parameters`` is that of ``rodwell.physics.on_wall.parameters``. Returns the energy, its derivative
    along ``rates``, the gradient (3) by y, y', y'', its derivative along ``rates`` (3), and the Hessian (3, 3).
    Arguments are numbers, arrays, or lanes of vector registers (``rodwell.numerics.splines.lanes``).
    """
{body}
'''


def main() -> None:
    """Write ``_density.py`` beside this file."""
    Path(__file__).with_name("_density.py").write_text(generate(), encoding="utf-8")


if __name__ == "__main__":
    main()
