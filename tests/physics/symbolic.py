"""Exact zero tests and total derivatives for the symbolic checks beside this file."""

from __future__ import annotations

import random
from collections.abc import Iterable

import sympy as sp
from sympy.core.function import AppliedUndef

s = sp.Symbol("s", real=True)
DRAWS = 3
"""Random points per expression. A rational expression other than zero vanishes at one of them with a probability
below (degree / 10⁶) each."""


def _fraction(rng: random.Random) -> sp.Rational:
    return sp.Rational(rng.randrange(10**6, 2 * 10**6), rng.randrange(10**6, 2 * 10**6))


def vanishes(expression: sp.Expr) -> bool:
    """Whether an expression is identically zero, by its exact value at random rational points.

    Every function of ``s``, every derivative of one and every symbol is an independent unknown. Sine, cosine and
    tangent of an unknown (or of an unknown over a symbol) take the rational values that a rational tangent of the
    half angle gives them, so that nothing is rounded. The unknown itself must not occur outside of them.
    """
    expression = sp.sympify(expression).doit()
    if any(f.args[0].as_coeff_Mul()[0] != 1 for f in expression.atoms(sp.sin, sp.cos, sp.tan)):
        expression = sp.expand_trig(expression)  # cos 2η
    rng = random.Random(2024)
    for _ in range(DRAWS):
        rule: dict[sp.Expr, sp.Expr] = {}
        turned = {f.args[0] for f in expression.atoms(sp.sin, sp.cos, sp.tan)}
        assert all(angle.as_coeff_Mul()[0] == 1 for angle in turned), "angles must be independent"
        for angle in sorted(turned, key=str):
            half = _fraction(rng)
            sine, cosine = 2 * half / (1 + half**2), (1 - half**2) / (1 + half**2)
            rule |= {sp.sin(angle): sine, sp.cos(angle): cosine, sp.tan(angle): sine / cosine}
        unknowns = expression.atoms(sp.Derivative, AppliedUndef, sp.Symbol)
        rule |= {u: _fraction(rng) for u in sorted(unknowns, key=str)}
        value = expression.xreplace(rule)
        assert value.is_Rational, f"not decided: {value}"
        if value != 0:
            return False
    return True


def all_vanish(expressions: Iterable[sp.Expr]) -> bool:
    """Whether each of several expressions is identically zero."""
    return all(vanishes(e) for e in expressions)


def euler(lagrangian: sp.Expr, variable: sp.Expr) -> sp.Expr:
    """Return ∂L/∂ζ − (∂L/∂ζ′)′ for one function ζ of ``s``, as printed above (90)."""
    return sp.diff(lagrangian, variable) - sp.diff(sp.diff(lagrangian, variable.diff(s)), s)


def cross(a: sp.Matrix, b: sp.Matrix) -> sp.Matrix:
    """Return a × b."""
    return a.cross(b)
