"""Equilibria in extended precision, by a second method: collocation with polynomials of degree 15 for a first-order system.

The unknowns are y, y', y'' and V = ∂e/∂y' − (∂e/∂y'')' at Chebyshev–Lobatto points of some elements, stored, and put
into the equations, in NumPy's ``longdouble`` (18 digits on x86-64); Newton's corrections come from a factorisation in
double precision. The equations are integrated, not differentiated, so that no digits are lost:

    y' = p,    p' = q,    q' = (∂e/∂y' − V − M_p q) / M_q with M = ∂e/∂y'',    V' = ∂e/∂y

With the engine this shares the energy density and the formula of the contact pressure, which other tests hold against
the paper; no spline, no mesh, no solver, no location of events, no arithmetic.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import mpmath
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.parameters import FORCE
from rodwell.physics.on_wall.strand import towards_lift_off

DEGREE = 15
HELD = {"clamped": (0, 1), "pinned": (0, 2), "guided": (1, 3), "free": (2, 3)}
"""Which of y, y', y'', V vanish at an end."""

LONG = np.longdouble
TINY = LONG("1e-25")
STENCIL = LONG("1e-6")
MOST_STEPS, SETTLED = 60, 1e-17


class NoReference(RuntimeError):
    """The second method did not settle near the state that it was given."""


@cache
def _rule() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points x (k,) on [−1, 1], ∫ from −1 to x_j of Lagrange's ℓ_k (k, k), and barycentric weights (k,)."""
    with mpmath.workdps(50):
        x = [-mpmath.cos(mpmath.pi * j / DEGREE) for j in range(DEGREE + 1)]
        vandermonde = mpmath.matrix([[mpmath.chebyt(m, v) for m in range(DEGREE + 1)] for v in x])
        inverse = vandermonde**-1

        def integral(m: int, v: Any) -> Any:
            if m < 2:
                return v if m == 0 else v * v / 2
            return (mpmath.chebyt(m + 1, v) / (m + 1) - mpmath.chebyt(m - 1, v) / (m - 1)) / 2

        integrals = mpmath.matrix(
            [[integral(m, v) - integral(m, mpmath.mpf(-1)) for m in range(DEGREE + 1)] for v in x]
        )
        rule = integrals * inverse
        signs = [(-1) ** j * (0.5 if j in (0, DEGREE) else 1.0) for j in range(DEGREE + 1)]
        text = [[mpmath.nstr(rule[j, k], 30) for k in range(DEGREE + 1)] for j in range(DEGREE + 1)]
        return np.array([LONG(mpmath.nstr(v, 30)) for v in x]), np.array(text).astype(LONG), np.array(signs, dtype=LONG)


@dataclass
class Rod:
    """A rod on the wall: parameters as the engine orders them (7,), ends, and mesh points (e + 1,)."""

    parameters: np.ndarray
    ends: tuple[str, str]
    breaks: np.ndarray

    def __post_init__(self) -> None:
        x, self.rule, self.bary = _rule()
        self.breaks = np.asarray(self.breaks, dtype=LONG)
        self.half = 0.5 * np.diff(self.breaks)
        e = self.half.size
        self.where = np.arange(e)[:, None] * DEGREE + np.arange(DEGREE + 1)  # nodes of each element
        inside = self.breaks[:-1, None] + self.half[:, None] * (x + 1.0)
        self.s = np.empty(e * DEGREE + 1, dtype=LONG)
        self.s[self.where] = inside
        self.count = self.s.size
        held = [(0, i) for i in HELD[self.ends[0]]] + [(self.count - 1, i) for i in HELD[self.ends[1]]]
        self.held = np.array(held)

    def _at(self, lam: Any) -> np.ndarray:
        out = self.parameters.astype(np.result_type(LONG, lam))
        out[FORCE] = lam
        return out

    def rates(self, x: np.ndarray, lam: Any) -> np.ndarray:
        """Right-hand sides (n, 4) at ``x`` (n, 4)."""
        y, p, q, v = x.T
        _, _, gradient, _, hessian = rod_density(self.s, y, p, q, self._at(lam), np.zeros(7))
        return np.stack([p, q, (gradient[1] - v - hessian[1][2] * q) / hessian[2][2], gradient[0]], axis=1)

    def slopes(self, x: np.ndarray, lam: Any) -> np.ndarray:
        """∂rates_m/∂x_i (n, 4, 4), by complex steps."""
        out = np.empty((self.count, 4, 4), dtype=LONG)
        for i in range(4):
            moved = x.astype(np.clongdouble)
            moved[:, i] += 1j * TINY
            out[:, :, i] = self.rates(moved, np.clongdouble(lam)).imag / TINY
        return out

    def load_slopes(self, x: np.ndarray, lam: Any) -> np.ndarray:
        """∂rates/∂λ (n, 4)."""
        return self.rates(x.astype(np.clongdouble), lam + 1j * TINY).imag / TINY

    def _integrated(self, x: np.ndarray, f: np.ndarray) -> np.ndarray:
        """x_j − x_0 − ∫ f at all points of the elements but the first, then what the ends hold: (4 n,)."""
        inner = f[self.where]  # (e, k, 4)
        rows = x[self.where[:, 1:]] - x[self.where[:, :1]]
        rows = rows - self.half[:, None, None] * np.einsum("jk,eki->eji", self.rule[1:], inner)
        return np.concatenate([rows.ravel(), x[self.held[:, 0], self.held[:, 1]]])

    def residual(self, x: np.ndarray, lam: Any) -> np.ndarray:
        return self._integrated(x, self.rates(x, lam))

    def load_residual(self, x: np.ndarray, lam: Any) -> np.ndarray:
        return self._integrated(np.zeros_like(x), self.load_slopes(x, lam))

    def times(self, slopes: np.ndarray, v: np.ndarray) -> np.ndarray:
        """J v in extended precision."""
        v = v.reshape(-1, 4)
        return self._integrated(v, np.einsum("nmi,ni->nm", slopes, v))

    def matrix(self, slopes: np.ndarray) -> Any:
        """J in double precision."""
        e, k = self.where.shape
        f = slopes[self.where].astype(float)  # (e, k, m, i)
        blocks = -np.einsum("e,jk,ekmi->ejmki", self.half.astype(float), self.rule[1:].astype(float), f)
        for j in range(DEGREE):
            for m in range(4):
                blocks[:, j, m, j + 1, m] += 1.0
                blocks[:, j, m, 0, m] -= 1.0
        rows = np.arange(e * DEGREE * 4).reshape(e, DEGREE, 4)
        columns = self.where[:, :, None] * 4 + np.arange(4)
        i, j = np.broadcast_arrays(rows[:, :, :, None, None], columns[:, None, None, :, :])
        last = e * DEGREE * 4
        parts = (
            np.concatenate([blocks.ravel(), np.ones(4)]),
            (np.concatenate([i.ravel(), last + np.arange(4)]), np.concatenate([j.ravel(), self.held @ [4, 1]])),
        )
        return coo_matrix(parts, shape=(4 * self.count,) * 2)

    def pressure(self, x: np.ndarray, lam: Any) -> np.ndarray:
        """Contact pressure, negative in contact, at the points (n,)."""
        y, p, q, _ = x.T
        return towards_lift_off(self.s, y, p, q, self.rates(x, lam)[:, 2], self._at(lam))

    def highest(self, x: np.ndarray, lam: Any) -> tuple[Any, np.ndarray, float]:
        """Largest pressure; the weights (n,) that read a function at its place; the place."""
        values = self.pressure(x, lam)
        best: tuple[Any, np.ndarray, float] = (-np.inf, np.empty(0), 0.0)
        bound = values.max() - 0.05 * (values.max() - values.min())
        for e in range(self.half.size):
            here = self.where[e]
            if values[here].max() < bound:
                continue
            for t in self._peaks(values[here]):
                weights = self._weights(t)
                value = weights @ values[here]
                if value > best[0]:
                    full = np.zeros(self.count, dtype=LONG)
                    full[here] = weights
                    best = value, full, float(self.breaks[e] + self.half[e] * (t + 1.0))
        return best

    def _weights(self, t: Any) -> np.ndarray:
        x = _rule()[0]
        gap = t - x
        if np.any(gap == 0.0):
            return (gap == 0.0).astype(LONG)
        terms = self.bary / gap
        return terms / terms.sum()

    def read(self, values: np.ndarray, place: float) -> Any:
        """A function known at the points, at any place."""
        e = min(int(np.searchsorted(self.breaks, LONG(place), side="right")) - 1, self.half.size - 1)
        return self._weights((LONG(place) - self.breaks[e]) / self.half[e] - 1.0) @ values[self.where[e]]

    def _peaks(self, values: np.ndarray) -> list[Any]:
        """Places on [−1, 1] of the maxima of a polynomial known at the points."""
        x = _rule()[0].astype(float)
        series = np.polynomial.Chebyshev.fit(x, (values - values.mean()).astype(float), DEGREE, domain=[-1, 1])
        roots = series.deriv().roots()
        real = roots[(np.abs(roots.imag) < 1e-6) & (np.abs(roots.real) <= 1.0)].real
        return [LONG(t) for t in (*real, -1.0, 1.0)]

    def pressure_slopes(self, x: np.ndarray, lam: Any, weights: np.ndarray) -> tuple[np.ndarray, Any]:
        """Derivatives of the pressure at a place, read by ``weights``, by x (n, 4) and λ."""
        out = np.zeros((self.count, 4), dtype=LONG)
        for i in range(4):
            moved = x.astype(np.clongdouble)
            moved[:, i] += 1j * TINY
            out[:, i] = weights * self.pressure(moved, np.clongdouble(lam)).imag / TINY
        rate = weights @ (self.pressure(x.astype(np.clongdouble), lam + 1j * TINY).imag / TINY)
        return out, rate


class _Bordered:
    """A sparse matrix with k borders, factorised in double precision with rows and columns scaled."""

    def __init__(self, inner: Any, columns: np.ndarray, rows: np.ndarray, corner: np.ndarray) -> None:
        k, n = len(rows), inner.shape[0]
        whole = np.zeros((k, n + k))
        whole[:, :n], whole[:, n:] = rows, corner
        i, j = np.nonzero(whole)
        ci, cj = np.nonzero(columns)
        full = coo_matrix(
            (
                np.concatenate([inner.data, columns[ci, cj], whole[i, j]]),
                (np.concatenate([inner.row, ci, n + i]), np.concatenate([inner.col, n + cj, j])),
            ),
            shape=(n + k,) * 2,
        ).tocsc()
        self.row = 1.0 / np.maximum(abs(full).max(axis=1).toarray().ravel(), 1e-300)
        full = full.multiply(self.row[:, None]).tocsc()
        self.column = 1.0 / np.maximum(abs(full).max(axis=0).toarray().ravel(), 1e-300)
        self.factors = splu(full.multiply(self.column[None, :]).tocsc())

    def solve(self, b: np.ndarray) -> np.ndarray:
        return self.column * self.factors.solve((self.row * b).astype(float))

    def solve_transposed(self, b: np.ndarray) -> np.ndarray:
        return self.row * self.factors.solve((self.column * b).astype(float), trans="T")


def _settled(step: float, last: float, number: int) -> bool:
    """Whether Newton's method has come as far as round-off in extended precision lets it."""
    return step < SETTLED or (number > 2 and step < 1e-14 and step > 0.1 * last)


def _newton(rod: Rod, x: np.ndarray, lam: Any, borders: Any) -> tuple[np.ndarray, Any]:
    """Newton's method for residual = 0 with a further unknown λ and a further equation (or none)."""
    x, lam = x.astype(LONG), LONG(lam)
    last, size = np.inf, np.max(np.abs(x), axis=0)
    for number in range(MOST_STEPS):
        slopes = rod.slopes(x, lam)
        value, row, corner, more, columns = borders(x, lam, slopes)
        load = rod.load_residual(x, lam).astype(float)
        columns = np.column_stack([load, *columns])
        bordered = _Bordered(rod.matrix(slopes), columns, row, corner)
        step = bordered.solve(np.concatenate([-rod.residual(x, lam), -value]))
        x = x + step[: x.size].reshape(x.shape)
        lam = lam + step[x.size]
        now = float(np.max(np.abs(step[: x.size].reshape(x.shape)) / size)) + abs(float(step[x.size] / lam))
        if not np.isfinite(now) or now > 0.3:
            raise NoReference(f"Newton's method moved by {now:.1e}")
        if _settled(now, last, number):
            return x, lam
        last = now
    raise NoReference(f"Newton's method did not settle: {now:.1e}")


def at_load(rod: Rod, x: np.ndarray, lam: Any) -> np.ndarray:
    """The state at a load, (n, 4)."""
    row = np.zeros((1, 4 * rod.count))
    return _newton(rod, x, lam, lambda *_: (np.zeros(1), row, np.ones((1, 1)), None, ()))[0]


def lift_off(rod: Rod, x: np.ndarray, lam: Any) -> tuple[np.ndarray, Any]:
    """The state in which the largest pressure is zero, and its load."""

    def border(x: np.ndarray, lam: Any, _: np.ndarray) -> Any:
        top, weights, _ = rod.highest(x, lam)
        row, rate = rod.pressure_slopes(x, lam, weights)
        return np.array([top]), row.reshape(1, -1).astype(float), np.array([[float(rate)]]), None, ()

    return _newton(rod, x, lam, border)


def singular(rod: Rod, x: np.ndarray, lam: Any, *, fold: bool) -> tuple[np.ndarray, Any]:
    """A fold, or a point where states branch off that break a symmetry; and its load.

    The measure g of how far J is from singular comes from J with a border, solved to extended precision; its
    derivatives by x and λ from those of the rates. Where a symmetry is broken, J with its border is singular too: a
    multiple of the border is allowed in the equations, and the state is kept from moving along the null vector.
    """
    n = 4 * rod.count
    # row and column of the border: the null vectors themselves, from an arbitrary border
    rng = np.random.default_rng(0)
    b, c = rng.standard_normal((2, n)) * _sizes(rod, x)
    slopes = rod.slopes(x.astype(LONG), LONG(lam))
    for _ in range(2):
        first = _Bordered(rod.matrix(slopes), b[:, None], c[None], np.zeros((1, 1)))
        v, w = first.solve(np.append(np.zeros(n), 1.0))[:n], first.solve_transposed(np.append(np.zeros(n), 1.0))[:n]
        sizes = _sizes(rod, x)
        c, b = v / sizes**2 / np.sum((v / sizes) ** 2), w / np.sum(w * w)
    start, null = x, c

    def border(x: np.ndarray, lam: Any, slopes: np.ndarray) -> Any:
        j = _Bordered(rod.matrix(slopes), b[:, None], c[None], np.zeros((1, 1)))
        v, g = _refined(rod, slopes, j, b, c)
        w = j.solve_transposed(np.append(np.zeros(n), 1.0))[:n]
        inner = np.zeros((rod.count, 4))
        parts = w[:-4].reshape(rod.half.size, DEGREE, 4)
        spread = -np.einsum("e,jk,ejm->ekm", rod.half.astype(float), rod.rule[1:].astype(float), parts)
        np.add.at(inner, rod.where, spread)
        vector = v.reshape(-1, 4)
        h = STENCIL * np.max(np.abs(start)) / np.max(np.abs(vector[:, 0]))
        second = (rod.slopes(x + h * vector, lam) - rod.slopes(x - h * vector, lam)) / (2.0 * h)
        row = -np.einsum("nm,nmi->ni", inner, second.astype(float)).ravel()
        dl = STENCIL * abs(lam)
        by_load = (rod.slopes(x, lam + dl) - rod.slopes(x, lam - dl)) / (2.0 * dl)
        rate = -float(np.einsum("nm,nmi,ni->", inner, by_load, vector))
        if fold:
            return np.array([g]), row[None], np.array([[rate]]), None, ()
        rows = np.stack([row, null])
        moved = null @ (x - start).ravel()
        return np.array([g, moved]), rows, np.array([[rate, 0.0], [0.0, 0.0]]), None, (b,)

    return _newton(rod, x, lam, border)


def _sizes(rod: Rod, x: np.ndarray) -> np.ndarray:
    return np.tile(np.max(np.abs(x), axis=0).astype(float), rod.count)


def _refined(rod: Rod, slopes: np.ndarray, j: _Bordered, b: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, Any]:
    """v and g of J v + b g = 0, c·v = 1, to extended precision."""
    n = b.size
    v, g = np.zeros(n, dtype=LONG), LONG(0.0)
    for _ in range(4):
        rest = np.concatenate([-(rod.times(slopes, v) + b * g), [1.0 - c @ v]])
        step = j.solve(rest)
        v, g = v + step[:n], g + step[n]
    return v, g
