"""Two fields as one complex function: coefficients, forms against quadrature, what is held; signs of symmetries."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial import legendre

from rodwell.numerics.continuation.crossings import _wanders
from rodwell.numerics.splines import pair
from rodwell.numerics.splines.banded import multiply
from rodwell.numerics.splines.held import Ends
from rodwell.numerics.splines.spaces import SplineSpace

SPACE = SplineSpace(np.linspace(0.0, 1.0, 6), 4, 5)


def coefficients() -> np.ndarray:
    rng = np.random.default_rng(2)
    return np.asarray(rng.standard_normal(SPACE.size) + 1j * rng.standard_normal(SPACE.size))


def test_vectors_hold_x_before_y_function_by_function() -> None:
    assert pair.as_real(np.array([1.0 + 2.0j, 3.0 - 4.0j])) == pytest.approx([1.0, 2.0, 3.0, -4.0])
    assert pair.as_complex(np.array([[1.0, 2.0, 3.0, -4.0]])) == pytest.approx(np.array([[1.0 + 2.0j, 3.0 - 4.0j]]))


def test_forms_of_a_pair_are_integrals() -> None:
    """Σ ∫ d |u⁽ᵏ⁾|² + 1.7 ∫ Im(ū′u″), by Gauss's rule in each element."""
    factors = np.array([2.0, -0.6, 0.3])
    nodes, weights = legendre.leggauss(8)
    places = (np.arange(5)[:, None] + 0.5 * (nodes + 1.0)).ravel() / 5.0
    u, vector = pair.evaluate(SPACE, coefficients(), places, 3), pair.as_real(coefficients())
    diagonal = np.repeat(factors[:, None], SPACE.weights.size, axis=1)
    for coupling in (1.7, 0.0):
        inside = factors @ np.abs(u) ** 2 + coupling * (u[1].conj() * u[2]).imag
        form = vector @ np.asarray(multiply(pair.pair_band(SPACE, diagonal, coupling), vector))
        assert form == pytest.approx(float(inside @ np.tile(0.1 * weights, 5)), rel=1e-11)


def test_what_ends_hold_of_each_field_is_held_of_the_pair() -> None:
    """x vanishes at both ends, y with its slope at s = 0: the first and last function of x, the first two of y."""
    held = pair.held_pair(Ends((1, 1)), Ends((2, 0)), 6)
    assert sorted(held.held.tolist()) == [0, 1, 3, 10]
    free = np.setdiff1d(np.arange(12), held.held)
    assert np.array_equal(np.sort(held.free), free)


def test_symmetry_forbids_newtons_method_to_leave_along_a_vector_of_the_other_parity() -> None:
    even, odd = np.array([1.3, 0.4, 0.4, 1.3]), np.array([1.3, 0.4, -0.4, -1.3])
    assert [_wanders(1, even), _wanders(1, odd), _wanders(-1, even), _wanders(-1, odd)] == [True, False, False, True]
    assert _wanders(0, odd)
