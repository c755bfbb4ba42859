"""What is held, what follows, and what varies along s: against matrices written out, and in closed form."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pytest
from discretised import nothing_on_disk
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq
from scipy.special import airy

from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.splines.banded import factorise, solve
from rodwell.numerics.splines.held import Ends, Held
from rodwell.numerics.splines.spaces import SplineSpace


def dense(band: np.ndarray) -> np.ndarray:
    """The symmetric matrix of a lower band."""
    n, width = band.shape
    out = np.zeros((n, n))
    for k in range(min(width, n)):
        i = np.arange(n - k)
        out[i + k, i] = out[i, i + k] = band[: n - k, k]
    return out


def some(seed: int) -> tuple[np.ndarray, Held, np.ndarray]:
    """A banded matrix, a mask at its ends and within, and the matrix (n, unknowns) that spreads the unknowns."""
    rng = np.random.default_rng(seed)
    n, width = int(rng.integers(8, 20)), int(rng.integers(2, 5))
    band = rng.standard_normal((n, width))
    held, follows = rng.random(n) < 0.3, np.arange(n)
    if rng.random() < 0.7:
        held[0], held[1], follows[0] = True, False, 1
    if rng.random() < 0.7:
        held[-1], held[-2], follows[-1] = True, False, n - 2
    spread = np.eye(n)[:, ~held]
    for i in np.flatnonzero(follows != np.arange(n)):
        spread[i] = spread[follows[i]]
    return band, Held(n, np.flatnonzero(held), follows[held]), spread


@given(st.integers(0, 2**31))
def test_matrices_and_vectors_of_the_unknowns(seed: int) -> None:
    """What follows joins what it follows: the matrix is SᵀAS, with S spreading the unknowns."""
    band, held, spread = some(seed)
    expected = spread.T @ dense(band) @ spread
    np.testing.assert_allclose(dense(held.free_part(band)), expected, rtol=0, atol=1e-14)
    whole = dense(held.restrict(band))
    np.testing.assert_allclose(whole[np.ix_(held.free, held.free)], expected, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(whole[held.held], np.eye(len(band))[held.held])
    x = np.random.default_rng(seed).standard_normal(len(band))
    np.testing.assert_allclose(held.gather(x), spread.T @ x, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(held.spread(x[held.free]), spread @ x[held.free])


@given(st.integers(0, 2**31))
def test_held_rows_leave_inertia_and_solution_as_they_are(seed: int) -> None:
    band, held, spread = some(seed)
    inner = spread.T @ dense(band) @ spread
    if inner.size == 0 or np.linalg.cond(inner) > 1e6:
        return
    factors = held.restrict(band)
    assert factorise(factors) == np.sum(np.linalg.eigvalsh(inner) < 0.0)
    x = np.zeros(len(band))
    x[held.free] = np.arange(1.0, held.free.size + 1.0)
    solve(factors, x)
    assert not x[held.held].any()
    np.testing.assert_allclose(inner @ x[held.free], np.arange(1.0, held.free.size + 1.0), rtol=1e-6, atol=1e-6)


class Column(NamedTuple):
    """½u'² − ½λ q(s) u²: a string whose tension is q(s), which is given."""

    u: int = 0

    @staticmethod
    def given() -> tuple[str, ...]:
        return ("q",)

    @staticmethod
    def density(_: Any, u: Any, known: Any, parameters: Any, rates: Any) -> Any:
        lam, rate, q = parameters[0], rates[0], known[0]
        hessian = (-lam * q, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 0.0)
        energy = 0.5 * u[1] ** 2 - 0.5 * lam * q * u[0] ** 2
        slopes = (-lam * q * u[0], u[1], 0.0), (-rate * q * u[0], 0.0, 0.0)
        return energy, -0.5 * rate * q * u[0] ** 2, *slopes, hessian


@pytest.fixture
def _not_on_disk() -> Iterator[None]:
    with nothing_on_disk():
        yield


@pytest.mark.usefixtures("_not_on_disk")
def test_a_coefficient_that_varies_along_s() -> None:
    """u″ + λ(1 + s)u = 0 with u(0) = u(1) = 0: combinations of Airy functions of −λ^⅓(1 + s)."""

    def determinant(lam: float) -> float:
        (a0, _, b0, _), (a1, _, b1, _) = (airy(-(lam ** (1.0 / 3.0)) * (1.0 + s)) for s in (0.0, 1.0))
        return float(a0 * b1 - a1 * b0)

    load = brentq(determinant, 3.0, 10.0, xtol=1e-14, rtol=1e-14)
    space = SplineSpace(np.linspace(0.0, 1.0, 13), 7, 8)
    path = np.array([[0.0], [1.0], [0.0], [0.0]])
    family = Family(Column(), path, space, Ends((1, 1)), 0, 1.0, 1.0, 1.0, given=lambda s: (1.0 + s)[:, None])

    def negative(lam: float) -> int:
        _, _, band = family.assemble(np.zeros(space.size), lam)
        return int(factorise(family.held.restrict(band)))

    assert negative(load * (1.0 - 1e-12)) == 0
    assert negative(load * (1.0 + 1e-12)) == 1
