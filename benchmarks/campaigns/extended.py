"""States, lift-offs and singular points of a rod in extended precision: Newton's method for :mod:`extended_rod`.

Corrections come from a factorisation in double precision, what they correct is computed in extended precision.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from extended_rod import DEGREE, LONG, Rod
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

STENCIL = LONG("1e-6")
MOST_STEPS, SETTLED = 60, 1e-17


class UnsettledError(RuntimeError):
    """The second method did not settle near the state that it was given."""


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
        value, row, corner, columns = borders(x, lam, slopes)
        load = rod.load_residual(x, lam).astype(float)
        columns = np.column_stack([load, *columns])
        bordered = _Bordered(rod.matrix(slopes), columns, row, corner)
        step = bordered.solve(np.concatenate([-rod.residual(x, lam), -value]))
        x = x + step[: x.size].reshape(x.shape)
        lam = lam + step[x.size]
        now = float(np.max(np.abs(step[: x.size].reshape(x.shape)) / size)) + abs(float(step[x.size] / lam))
        if not np.isfinite(now) or now > 0.3:
            raise UnsettledError(f"Newton's method moved by {now:.1e}")
        if _settled(now, last, number):
            return x, lam
        last = now
    raise UnsettledError(f"Newton's method did not settle: {now:.1e}")


def at_load(rod: Rod, x: np.ndarray, lam: Any) -> np.ndarray:
    """The state at a load, (n, 4)."""
    row = np.zeros((1, 4 * rod.count))
    return _newton(rod, x, lam, lambda *_: (np.zeros(1), row, np.ones((1, 1)), ()))[0]


def lift_off(rod: Rod, x: np.ndarray, lam: Any) -> tuple[np.ndarray, Any]:
    """The state in which the largest pressure is zero, and its load."""

    def border(x: np.ndarray, lam: Any, _: np.ndarray) -> Any:
        top, weights, _ = rod.highest(x, lam)
        row, rate = rod.pressure_slopes(x, lam, weights)
        return np.array([top]), row.reshape(1, -1).astype(float), np.array([[float(rate)]]), ()

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
            return np.array([g]), row[None], np.array([[rate]]), ()
        rows = np.stack([row, null])
        moved = null @ (x - start).ravel()
        return np.array([g, moved]), rows, np.array([[rate, 0.0], [0.0, 0.0]]), (b,)

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
