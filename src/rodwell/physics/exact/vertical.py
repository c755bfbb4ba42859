"""Vertical cylinder: closed forms of the critical loads and self-weights, the paper's section 4.1.4.

The slope η = y' solves η'' − N(s)η = c, (80), N = F + γ(s − 1); with t = (s − 1 + F/γ)γ^⅓ it is η̈ − tη = c̄, (81). Three
solutions serve here, in hypergeometric functions of z = t³/9,

    f = ₀F₁(2/3; z),   g = t ₀F₁(4/3; z),   h = (t²/2) ₁F₂(1; 4/3, 5/3; z)    (h solves (81) with c̄ = 1),

and their primitives t ₁F₂(1/3; 2/3, 4/3; z), (t²/2) ₁F₂(2/3; 4/3, 5/3; z) and (t³/6) ₂F₃(1, 1; 4/3, 5/3, 2; z). So
Scorer functions have hypergeometric primitives after all: Gi = αAi + βBi − h/π, and no quadrature is needed. Functions
take balls of python-flint (flint.arb) where they say so; those for floats raise the precision until the digits are
there. Misprints in the paper: t₁ below (86) must be (F/γ − 1)γ^⅓, and
Γ(⅔) on the right of (88) has no square.

Units B = L = 1; F is the end force at s = 1 in B/L², tension positive; γ = mg L³/B.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from rodwell.errors import NotConvergedError

Ball = Any
"""A real number with a bound of its error: flint.arb."""

MOST_BITS = 4000


def airy_places(force: Ball, weight: Ball) -> tuple[Ball, Ball]:
    """t₁ = (F/γ − 1)γ^⅓ (at s = 0) and t₂ = F/γ^⅔ (at s = 1) of (86), balls; misprint of t₁ corrected."""
    cube = weight.root(3)
    return (force / weight - 1) * cube, force / cube**2


def airy_basis(t: Ball) -> tuple[tuple[Ball, Ball, Ball], tuple[Ball, Ball, Ball]]:
    """Solutions f, g, h of (81) at t, and their integrals from 0 to t; balls."""
    from flint import arb, fmpq  # noqa: PLC0415

    z = t**3 / 9
    third, two, four, five = (arb(fmpq(k, 3)) for k in (1, 2, 4, 5))
    values = z.hypgeom([], [two]), t * z.hypgeom([], [four]), t**2 / 2 * z.hypgeom([arb(1)], [four, five])
    integrals = (
        t * z.hypgeom([third], [two, four]),
        t**2 / 2 * z.hypgeom([two], [four, five]),
        t**3 / 6 * z.hypgeom([arb(1), arb(1)], [four, five, arb(2)]),
    )
    return values, integrals


def scorer_determinant(force: Ball, weight: Ball) -> Ball:
    """D(F, γ) of (86), both ends clamped, γ > 0; balls.

    det of Ai, Bi, Gi is −1/π² times that of f, g, h, since Ai and Bi have the Wronskian 1/π, f and g have 1.
    """
    first, second = (airy_basis(t) for t in airy_places(force, weight))
    (a, b, c), (d, e, f) = first[0], second[0]
    u, v, w = (after - before for after, before in zip(second[1], first[1], strict=True))
    return -(u * (b * f - c * e) - v * (a * f - c * d) + w * (a * e - b * d)) / u.pi() ** 2


def sway_determinant(force: Ball, weight: Ball) -> Ball:
    """Ai(t₁)Bi(t₂) − Ai(t₂)Bi(t₁), left side of (88): clamped, end s = 1 free to slide without turning; balls.

    It is 1/π times the same determinant of f and g.
    """
    ((a, b, _), _), ((d, e, _), _) = (airy_basis(t) for t in airy_places(force, weight))
    return (a * e - b * d) / a.pi()


def sway_bessel(weight: Ball) -> Ball:
    """Right side of (88), F = 0: 2γ^⅙/(3^{7/6} Γ(⅔)) J_⅓(⅔√γ); balls.

    The paper prints Γ(⅔)², which contradicts its own middle part: √3 Ai(−x) − Bi(−x) = 2√(x/3) J_⅓(⅔x^{3/2}). The roots
    are the same.
    """
    from flint import arb, fmpq  # noqa: PLC0415

    factor = 2 * weight.root(6) / (arb(3).root(6) ** 7 * arb.gamma_fmpq(fmpq(2, 3)))
    return factor * (2 * weight.sqrt() / 3).bessel_j(arb(fmpq(1, 3)))


def as_float(function: Callable[..., Ball], *arguments: float) -> float:
    """Value of one of the functions above at floats, to double precision.

    Raises
    ------
    NotConvergedError
        If 4000 bits do not suffice: the series cancel as exp(⅔|t|^{3/2}), t in the hundreds.
    """
    from flint import arb, ctx  # noqa: PLC0415

    bits = 100
    while bits <= MOST_BITS:
        with ctx.workprec(bits):
            value = function(*(arb(x) for x in arguments))
            if value.is_finite() and (value.rel_accuracy_bits() >= 53 or value.is_zero()):
                return float(value)
        bits *= 2
    raise NotConvergedError(f"{function.__name__}{arguments}: more than {MOST_BITS} bits are needed")


def sway_weights(count: int) -> list[float]:
    """Self-weights γ at which a column whose upper end is free to sway buckles at F = 0: (9/4) j²_{1/3,k}, from (88).

    The zeros lie in (k − 1/12)π < j < (k − 1/24)π (G. N. Watson, *Theory of Bessel Functions*, §15.33), so that none is
    skipped. The first is 18.956266.
    """
    from scipy.optimize import brentq  # noqa: PLC0415
    from scipy.special import jv  # noqa: PLC0415

    third = 1.0 / 3.0
    zeros = (
        brentq(lambda x: jv(third, x), (k - 1 / 12) * math.pi, (k - 1 / 24) * math.pi, xtol=1e-300, rtol=8.9e-16)
        for k in range(1, count + 1)
    )
    return [2.25 * float(zero) ** 2 for zero in zeros]


def self_weights(count: int) -> list[float]:
    """Self-weights γ at which a column with both ends clamped buckles at F = 0: (87), second root corrected.

    Both ends aligned is one constraint more than one end free to sway, so by the minimax principle each γ_k lies
    between the k-th and the (k + 1)-th of :func:`sway_weights`: none is skipped. 74.628569, 157.032780, 325.513452, …
    """
    from scipy.optimize import brentq  # noqa: PLC0415

    bounds = sway_weights(count + 1)
    roots = (
        brentq(lambda w: as_float(scorer_determinant, 0.0, w), *bounds[k : k + 2], xtol=1e-300, rtol=8.9e-16)
        for k in range(count)
    )
    return [float(root) for root in roots]


def chord_slope(mode: int) -> float:
    """Slope k of the line kγ − F = −F₀ of (79) through the loads at γ = 0 and at F = 0: 0.5290, 0.5143, ….

    The curves bend: at small γ the slope is ½ for every mode (:func:`tangent_slope`).
    """
    from rodwell.physics.exact.columns import weightless_loads  # noqa: PLC0415

    return -weightless_loads(mode)[mode - 1] / self_weights(mode)[mode - 1]


def tangent_slope() -> float:
    """Slope dF/dγ of each critical load at γ = 0: ½, since y'² of a weightless mode is even about mid-length.

    dF/dγ = ∫(1 − s)y'² ds/∫y'² ds.
    """
    return 0.5


def critical_length(stiffness: float, weight_per_length: float) -> float:
    """Tallest column with both ends clamped that stands under its own weight, L_cr = (74.628569 B/(mg))^⅓.

    Paper, section 5. Any coherent units: B in N m², mg in N/m give metres.
    """
    return float((self_weights(1)[0] * stiffness / weight_per_length) ** (1.0 / 3.0))
