"""Banded factorisation, assembly and eigenvalues against dense algebra."""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
import scipy.linalg
from discretised import discretised
from hypothesis import given
from hypothesis import strategies as st

from rodwell.numerics.equilibria import eigen
from rodwell.numerics.splines import assembly, banded
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.model import RodOnCylinder

SIZES = st.tuples(st.integers(1, 30), st.integers(1, 10), st.integers(0, 2**31))


def dense(band: np.ndarray) -> np.ndarray:
    n, width = band.shape
    full = np.zeros((n, n))
    for k in range(min(width, n)):
        i = np.arange(n - k)
        full[i + k, i] = full[i, i + k] = band[: n - k, k]
    return full


@given(SIZES)
def test_factorisation_gives_solution_and_inertia(sizes: tuple[int, int, int]) -> None:
    n, width, seed = sizes
    rng = np.random.default_rng(seed)
    band = rng.standard_normal((n, width))
    full = dense(band)
    x = rng.standard_normal(n)
    assert banded.multiply(band, x) == pytest.approx(full @ x, abs=1e-12)
    eigenvalues = np.linalg.eigvalsh(full)
    minors = [abs(np.linalg.det(full[:k, :k])) for k in range(1, n + 1)]
    if np.min(np.abs(eigenvalues)) < 1e-3 or min(minors) < 1e-3:
        return  # without pivoting, accuracy is promised away from singular leading minors only
    factors = band.copy()
    assert banded.factorise(factors) == np.sum(eigenvalues < 0.0)
    b = full @ x
    banded.solve(factors, b)
    assert b == pytest.approx(x, rel=1e-5, abs=1e-5)


def test_a_pivot_that_vanishes_counts_as_positive_and_tiny() -> None:
    """Of the stiffness of a chain that is held nowhere the last pivot is nothing: it may move as a whole."""
    chain = np.array([[1.0, -1.0], [2.0, -1.0], [1.0, 0.0]])
    factors = chain.copy()
    assert banded.factorise(factors) == 0
    assert 0.0 < factors[2, 0] < 1e-12
    moved = np.array([1.0, 0.0, 0.0])
    banded.solve(factors, moved)
    assert moved / moved[0] == pytest.approx(1.0, abs=1e-12)


def rod_system(c: np.ndarray, space: SplineSpace, p: np.ndarray) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    gradient, mixed = np.empty(space.size), np.empty(space.size)
    band = np.empty((space.size, space.degree + 1))
    rates = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    energy, _ = assembly.assemble(discretised(RodOnCylinder(), space), c, p, rates, gradient, mixed, band)
    return energy, gradient, mixed, dense(band)


@pytest.mark.parametrize(("degree", "per_element"), [(4, 3), (7, None), (9, 6), (10, 9)])
def test_gradient_and_hessian_of_the_rod_agree_with_finite_differences(degree: int, per_element: int | None) -> None:
    space = SplineSpace(np.array([0.0, 0.2, 0.45, 0.5, 0.9, 1.0]), degree, per_element)
    rng = np.random.default_rng(3)
    p = np.array([-120.0, 25.0, 15.0, 0.05, 1.3, 1.0, 0.0])
    c = 0.004 * rng.standard_normal(space.size)
    _, gradient, mixed, hessian = rod_system(c, space, p)
    h = 1e-6
    for i in range(space.size):
        shift = np.zeros(space.size)
        shift[i] = h
        above, below = rod_system(c + shift, space, p), rod_system(c - shift, space, p)
        assert gradient[i] == pytest.approx((above[0] - below[0]) / (2 * h), rel=1e-5, abs=1e-6)
        assert hessian[i] == pytest.approx((above[1] - below[1]) / (2 * h), rel=1e-5, abs=1e-4)
    step = np.array([1e-4, 0, 0, 0, 0, 0, 0])
    slope = (rod_system(c, space, p + step)[1] - rod_system(c, space, p - step)[1]) / 2e-4
    assert mixed == pytest.approx(slope, rel=1e-7, abs=1e-9)


def test_variation_along_a_direction_is_that_of_the_hessian() -> None:
    space = SplineSpace(np.linspace(0.0, 1.0, 7), 7)
    rng = np.random.default_rng(4)
    c, v = 0.004 * rng.standard_normal(space.size), rng.standard_normal(space.size)
    p, rates = np.array([-90.0, 10.0, 15.0, 0.05, 0.4, 1.0, 0.0]), np.zeros(7)
    above, size, below = assembly.variation(discretised(RodOnCylinder(), space), c, p, rates, v)
    assert above == pytest.approx(v @ rod_system(c, space, p)[3] @ v, rel=1e-9)
    assert below == pytest.approx(v @ dense(space.slope_gram) @ v, rel=1e-11)
    assert size >= abs(above)


@pytest.mark.parametrize(("degree", "per_element"), [(4, 3), (9, 8), (9, 6), (6, 1)])
def test_forms_and_gram_matrices_are_sums_over_the_points(degree: int, per_element: int) -> None:
    space = SplineSpace(np.sort(np.append(np.random.default_rng(1).random(9), [0.0, 1.0])), degree, per_element)
    rng = np.random.default_rng(2)
    density, block = rng.standard_normal((3, space.points.size)), rng.standard_normal((5, space.size))
    basis = np.array([space.evaluate(one, space.points, 3) for one in np.eye(space.size)])
    form = np.einsum("idq,dq,q,jdq->ij", basis, density, space.weights, basis)
    np.testing.assert_allclose(dense(space.form(density)), form, rtol=1e-12, atol=1e-12 * np.max(np.abs(form)))
    slopes = np.einsum("iq,q,jq->ij", basis[:, 1], space.weights, basis[:, 1])
    for found, expected in zip(space.grams(density, block), (form, slopes), strict=True):
        expected = block @ expected @ block.T  # noqa: PLW2901
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.max(np.abs(expected)))


def test_gram_matrices_do_not_depend_on_how_many_values_are_computed_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    space = SplineSpace(np.linspace(0.0, 1.0, 12), 5)
    rng = np.random.default_rng(3)
    density, block = rng.standard_normal((3, space.points.size)), rng.standard_normal((3, space.size))
    whole = space.grams(density, block)
    monkeypatch.setattr("rodwell.numerics.splines.spaces.AT_ONCE", 200)  # five elements
    for part, all_of_it in zip(space.grams(density, block), whole, strict=True):
        np.testing.assert_allclose(part, all_of_it, rtol=1e-12)


def test_a_ramp_beside_the_spline_is_the_spline_of_the_sum() -> None:
    space = SplineSpace(np.linspace(0.0, 1.0, 7), 7)
    c = 0.004 * np.random.default_rng(8).standard_normal(space.size)
    p = np.array([-90.0, 10.0, 15.0, 0.05, 0.4, 1.0, 0.1])
    split = rod_system(c, space, p)
    whole = rod_system(c + 0.1 * space.greville, space, np.append(p[:6], 0.0))
    for one, other in zip(split, whole, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-9)


class TwoBeams(NamedTuple):
    """Two coupled fields, since assembly takes any number: e = ½(a″² + 4 b″²) + a′b + ½ a b′² − p (a b + b′)."""

    a: int = 0
    b: int = 0

    @staticmethod
    def given() -> tuple[str, ...]:
        return ()

    @staticmethod
    def density(s: Any, u: Any, _: Any, parameters: Any, rates: Any) -> Any:
        hessian: list[list[Any]] = [[0.0] * 6 for _ in range(6)]
        hessian[0][4] = hessian[4][0] = u[4]
        hessian[1][3] = hessian[3][1] = 1.0
        hessian[2][2], hessian[4][4], hessian[5][5] = 1.0, u[0], 4.0
        p, zero = parameters[0], 0.0 * u[0]
        hessian[0][3] = hessian[3][0] = zero - p
        work = u[0] * u[3] + u[4]
        energy = 0.5 * (u[2] ** 2 + 4.0 * u[5] ** 2) + u[1] * u[3] + 0.5 * u[0] * u[4] ** 2 - p * work
        gradient = 0.5 * u[4] ** 2 - p * u[3], u[3], u[2], u[1] - p * u[0], u[0] * u[4] - p, 4.0 * u[5]
        mixed = -rates[0] * u[3], zero, zero, -rates[0] * u[0], zero - rates[0], zero
        return energy, -rates[0] * work, gradient, mixed, hessian


def test_assembly_of_two_coupled_fields() -> None:
    assemble = numba.njit(assembly.assemble.py_func)  # not cached: this model is known to this test alone
    space = SplineSpace(np.array([0.0, 0.3, 0.55, 1.0]), 4)
    n = 2 * space.size
    c = np.random.default_rng(5).standard_normal(n)
    rates = np.array([2.0])

    def system(x: np.ndarray, p: float = 0.7) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
        gradient, mixed, band = np.empty(n), np.empty(n), np.empty((n, 2 * (space.degree + 1)))
        energy, _ = assemble(discretised(TwoBeams(), space), x, np.array([p]), rates, gradient, mixed, band)
        return energy, gradient, dense(band), mixed

    _, gradient, hessian, mixed = system(c)
    assert mixed == pytest.approx(system(c, 1.7)[1] - system(c, -0.3)[1], rel=1e-12, abs=1e-12)  # twice dg/dp
    h = 1e-6
    for i in range(n):
        shift = np.zeros(n)
        shift[i] = h
        above, below = system(c + shift), system(c - shift)
        assert gradient[i] == pytest.approx((above[0] - below[0]) / (2 * h), rel=1e-6, abs=1e-4)
        assert hessian[i] == pytest.approx((above[1] - below[1]) / (2 * h), rel=1e-5, abs=1e-4)


@given(st.floats(0.0, 1e6), st.floats(0.0, 300.0), st.integers(1, 8))
def test_lowest_eigenvalues_agree_with_dense_algebra(foundation: float, axial: float, count: int) -> None:
    space = SplineSpace(np.linspace(0.0, 1.0, 15), 6)
    factors = np.array(
        [np.full(space.points.size, foundation), axial * (space.points - 1.0), np.ones(space.points.size)]
    )
    inner = slice(2, space.size - 2)

    def clamped(band: np.ndarray) -> np.ndarray:
        full = dense(band)[inner, inner]
        out = np.zeros((len(full), space.degree + 1))
        for k in range(space.degree + 1):
            out[: len(full) - k, k] = np.diagonal(full, -k)
        return out

    stiffness, gram = clamped(space.form(factors)), clamped(space.slope_gram)

    def quadrature(block: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return block @ dense(stiffness) @ block.T, block @ dense(gram) @ block.T

    values, vectors = eigen.lowest(stiffness, gram, quadrature, count, -axial - 1.0, None)
    expected = scipy.linalg.eigh(dense(stiffness), dense(gram), eigvals_only=True)[:count]
    assert values[:count] == pytest.approx(expected, rel=1e-8, abs=1e-6)
    for value, vector in zip(values[:count], vectors[:count], strict=True):
        residual = dense(stiffness) @ vector - value * dense(gram) @ vector
        assert np.linalg.norm(residual) <= 1e-5 * np.linalg.norm(dense(stiffness) @ vector) + 1e-6
