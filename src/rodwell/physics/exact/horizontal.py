"""Horizontal cylinder: closed forms of the critical loads, the paper's sections 4.1.2 and 4.3.

With c = √(wₗ/Δ) = k₁k₃ the left side of (77) is −4 times the product of an even and an odd factor. In
p = (k₃ + k₁)/2 and q = (k₃ − k₁)/2, so p² = q² + c and −F = 4q² + 2c, they are

    even modes  q sin p + p sin q = 0,        odd modes  q sin p − p sin q = 0.

*No load is skipped.* All loads are real, as (64) is self-adjoint. For c > 0 neither factor vanishes where sin q/q
exceeds abs(sin p)/p. So it is for q² ≤ 0 and for 0 < q ≤ π/2, since sin x/x falls as x² grows up to π² and is at most
1/π in size beyond; hence −F > 2c. At q = (i + ½)π the size of sin q/q is 1/q, again more than that of sin p/p, so
neither factor vanishes there, for any c. Loads move continuously with c, so each strip (i − ½)π < q < (i + ½)π keeps
what it holds at c = 0: for every i ≥ 1 one even root (q = iπ at c = 0) and one odd root (tan q = q), and none for i =
0. Modes 2i − 1 and 2i are therefore those of strip i: the pair i. At q = iπ both factors have the sign of sin p, so
iπ lies between the two roots, and the even one comes first exactly if ⌊√(i² + c/π²)⌋ − i is even. They coincide where
√(i² + c/π²) is a whole number j: that is (78) with n = j − i and m = j + i.

On top, where p and q are conjugate complex, p = P + iQ with PQ = c/4: even modes P tan P + Q tanh Q = 0 with one
root in each ((i − ½)π, iπ), odd modes tan P/P = tanh Q/Q with one root in each (iπ, (i + ½)π), by the same
argument. −F = 4(P² − Q²) grows with P, so even and odd modes alternate for every weight and never switch.

Functions take floats or, where they say so, balls of python-flint. Units B = L = 1.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

Number = Any
"""A float, or a ball (flint.arb)."""


def _sin(x: Number) -> Number:
    return x.sin() if hasattr(x, "sin") else math.sin(x)


def _cos(x: Number) -> Number:
    return x.cos() if hasattr(x, "cos") else math.cos(x)


def _tanh(x: Number) -> Number:
    return x.tanh() if hasattr(x, "tanh") else math.tanh(x)


def _sqrt(x: Number) -> Number:
    return x.sqrt() if hasattr(x, "sqrt") else math.sqrt(x)


def _sinc(x: Number) -> Number:
    """(sin x)/x."""
    if hasattr(x, "sinc"):
        return x.sinc()
    return math.sin(x) / x if x != 0.0 else 1.0


def _tanhc(x: Number) -> Number:
    """(tanh x)/x."""
    if hasattr(x, "tanh"):
        return 1 if x.is_zero() else x.tanh() / x
    return math.tanh(x) / x if x != 0.0 else 1.0


def wavenumbers(force: Number, foundation: Number) -> tuple[Number, Number]:
    """Wavenumbers k₁ ≤ k₃ of (75) in rad/L, at the end force F < −2√b and b = wₗ/Δ; floats or balls."""
    root = _sqrt(force * force - 4 * foundation)
    return _sqrt((-force - root) / 2), _sqrt((-force + root) / 2)


def buckling_equation(k1: Number, k3: Number) -> Number:
    """Left side of (77), both ends clamped; floats or balls."""
    return 2 * k1 * k3 * (1 - _cos(k1) * _cos(k3)) - (k1 * k1 + k3 * k3) * _sin(k1) * _sin(k3)


def even_factor(q: Number, c: Number) -> Number:
    """Factor of (77) whose roots are the even modes: q sin p + p sin q, p² = q² + c; floats or balls."""
    p = _sqrt(q * q + c)
    return q * _sin(p) + p * _sin(q)


def odd_factor(q: Number, c: Number) -> Number:
    """Factor of (77) whose roots are the odd modes, (q sin p − p sin q)/(p − q); floats or balls.

    Written so that nothing cancels for a light rod: its limit at c = 0 is q cos q − sin q.
    """
    p = _sqrt(q * q + c)
    half = c / (p + q) / 2
    return q * _cos((p + q) / 2) * _sinc(half) - _sin(q)


def load_of_q(q: Number, c: Number) -> Number:
    """End force F = −(4q² + 2c), rod at the bottom; floats or balls."""
    return -(4 * q * q + 2 * c)


def even_factor_on_top(p: Number, c: Number) -> Number:
    """Rod on top, both ends clamped: P sin P + Q cos P tanh Q with Q = c/(4P), c = √(wₗ/Δ); floats or balls."""
    q = c / (4 * p)
    return p * _sin(p) + q * _cos(p) * _tanh(q)


def odd_factor_on_top(p: Number, c: Number) -> Number:
    """Rod on top, both ends clamped: sin P − P cos P (tanh Q)/Q with Q = c/(4P); floats or balls."""
    return _sin(p) - p * _cos(p) * _tanhc(c / (4 * p))


def load_of_p_on_top(p: Number, c: Number) -> Number:
    """End force F = −4(P² − Q²) = −(4P² − c²/(4P²)), rod on top; floats or balls."""
    return c * c / (4 * p * p) - 4 * p * p


def even_first(pair: int, c: Number) -> bool:
    """Whether the even mode of pair i comes before the odd one as compression grows; c = √(wₗ/Δ), float.

    At c = 0 it does; each switching (78) of the pair turns it around.
    """
    return (math.floor(math.sqrt(pair**2 + c / math.pi**2)) - pair) % 2 == 0


def pair_loads(pair: int, c: float, *, on_top: bool = False) -> tuple[float, float]:
    """End forces of the even and the odd mode of pair i (modes 2i − 1 and 2i), both ends clamped.

    Parameters
    ----------
    pair
        i ≥ 1.
    c
        √(wₗ/Δ) ≥ 0: the load is in B/L², tension positive, so at the bottom both are below −2c.
    on_top
        The rod lies on top of the cylinder.

    Returns
    -------
    tuple
        F of the even and of the odd mode, to some units of the last place of 4i²π² + 2c.
    """
    middle = pair * math.pi
    if on_top:
        even = _root(lambda p: even_factor_on_top(p, c), middle - math.pi / 2, middle)
        odd = _root(lambda p: odd_factor_on_top(p, c), middle, middle + math.pi / 2)
        return load_of_p_on_top(even, c), load_of_p_on_top(odd, c)
    below, above = (middle - math.pi / 2, middle), (middle, middle + math.pi / 2)
    first = even_first(pair, c)
    even = _root(lambda q: even_factor(q, c), *(below if first else above))
    odd = _root(lambda q: odd_factor(q, c), *(above if first else below))
    return load_of_q(even, c), load_of_q(odd, c)


def _root(function: Any, low: float, high: float) -> float:
    """The one root in [low, high]; an end of it where round-off hides the change of sign next to that end."""
    from scipy.optimize import brentq  # noqa: PLC0415

    at_low, at_high = function(low), function(high)
    if at_low * at_high >= 0.0:
        return low if abs(at_low) < abs(at_high) else high
    return float(brentq(function, low, high, xtol=1e-300, rtol=8.9e-16))


def weights_on_top(count: int, clearance: float) -> list[float]:
    """Weights γ at which a clamped rod on top buckles without end force: x⁴Δ with cos x cosh x = 1 (section 4.3).

    Roots x = 2P = 2Q, one in each ((k + ¼)π, (k + ¾)π), k = 1, 2, …: 5.0056, 38.0354, 146.1763, … at Δ = 0.01.
    """
    roots = (
        _root(lambda x: math.cos(x) - 1.0 / math.cosh(x), (k + 0.25) * math.pi, (k + 0.75) * math.pi)
        for k in range(1, count + 1)
    )
    return [clearance * root**4 for root in roots]


def horizontal_loads(
    foundation: float, count: int, ends: tuple[str, str] = ("clamped", "clamped"), *, on_top: bool = False
) -> list[float]:
    """Critical end forces of a horizontal rod, falling: closed forms of six pairs of ends and their mirror images.

    Clamped–clamped: (77), or its counterpart on top. Clamped–pinned and clamped–guided: the odd and the even modes
    of a clamped rod of twice the length, of which they are halves. Pinned and guided ends: :func:`sine_loads`.

    Parameters
    ----------
    foundation
        b = wₗ/Δ ≥ 0, lateral weight over clearance, in B/L⁴.
    count
        How many.
    ends
        End conditions at s = 0 and s = 1.
    on_top
        The rod lies on top of the cylinder; at least one end must then hold y.

    Raises
    ------
    KeyError
        For a free end: no closed form is given here.
    """
    c = math.sqrt(foundation)
    pair: frozenset[str] = frozenset(ends)
    if pair == {"clamped"}:
        loads = [f for i in range(1, count // 2 + 2) for f in pair_loads(i, c, on_top=on_top)]
    elif pair in ({"clamped", "pinned"}, {"clamped", "guided"}):
        which = int("pinned" in pair)
        loads = [pair_loads(i, 4.0 * c, on_top=on_top)[which] / 4.0 for i in range(1, count + 1)]
    else:
        shift = {frozenset({"pinned"}): 0.0, frozenset({"guided"}): 0.0, frozenset({"pinned", "guided"}): 0.5}[pair]
        return sine_loads(-foundation if on_top else foundation, count, shift)
    return sorted(loads, reverse=True)[:count]


def sine_loads(foundation: float, count: int, shift: float = 0.0) -> list[float]:
    """Loads F = −(k²π² + b/(k²π²)), k = n − shift, n = 1, 2, …, falling: both ends pinned (end of section 4.1.2).

    Both ends guided: the same with cosines. One end pinned, one guided: ``shift`` = ½. ``foundation`` b = wₗ/Δ is
    negative for a rod on top.
    """
    least = math.sqrt(math.sqrt(max(foundation, 0.0))) / math.pi  # k of the lowest load
    last = math.ceil(least) + count + 1
    while True:
        loads = sorted(_sine_load(n - shift, foundation) for n in range(1, last + 1))[::-1]
        if len(loads) > count and _sine_load(last + 1 - shift, foundation) < loads[count - 1]:
            return loads[:count]
        last *= 2


def _sine_load(k: float, foundation: float) -> float:
    square = (k * math.pi) ** 2
    return -(square + foundation / square)


class Switching(NamedTuple):
    """One row of the paper's Table 1: two modes have the same load, (78).

    Attributes
    ----------
    n, m
        k₁ = nπ and k₃ = mπ; n < m, both even or both odd.
    weight
        γ_c = n²m²π⁴Δ, in B/L³.
    force
        F_c = −(n² + m²)π², in B/L², tension positive.
    pair
        (m − n)/2: modes 2·pair − 1 and 2·pair switch.
    """

    n: int
    m: int
    weight: float
    force: float
    pair: int


def switching(n: int, m: int, clearance: float) -> Switching:
    """The mode switching (n, m) of (78) at the clearance Δ; both ends clamped, rod at the bottom.

    Raises
    ------
    ValueError
        Unless 0 < n < m and n and m are both even or both odd.
    """
    if not 0 < n < m or (m - n) % 2:
        raise ValueError(f"n = {n}, m = {m}: 0 < n < m, both even or both odd")
    return Switching(n, m, n**2 * m**2 * math.pi**4 * clearance, -(n**2 + m**2) * math.pi**2, (m - n) // 2)


def switchings(largest: int, clearance: float) -> list[Switching]:
    """All mode switchings with m ≤ ``largest`` in the order of Table 1, which ends at m = 10."""
    pairs = ((n, m) for m in range(3, largest + 1) for n in range(2 - m % 2, m - 1, 2))
    return [switching(n, m, clearance) for n, m in pairs]
