"""Least quotients on a cone, against every choice of what is active; images about the ends of cells."""

from __future__ import annotations

from itertools import chain, combinations
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh, null_space

from rodwell.numerics.equilibria.cells import _is_reflected
from rodwell.numerics.equilibria.one_sided import OneSided
from rodwell.numerics.equilibria.state import _part
from rodwell.numerics.splines.spaces import SplineSpace

SIZE = 7


def banded(matrix: np.ndarray) -> np.ndarray:
    """Diagonal and the one above it, (n, 2)."""
    return np.column_stack([np.diag(matrix), np.append(np.diag(matrix, 1), 0.0)])


def least_of_all(stiffness: np.ndarray, gram: np.ndarray, rows: np.ndarray) -> float:
    """The least quotient with ``rows @ z >= 0``: the least of those on each face that lie in the cone."""
    found = []
    for active in chain.from_iterable(combinations(range(len(rows)), k) for k in range(len(rows) + 1)):
        face = null_space(rows[list(active)]) if active else np.eye(SIZE)
        values, vectors = eigh(face.T @ stiffness @ face, face.T @ gram @ face)
        for value, vector in zip(values, (face @ vectors).T, strict=True):
            found += [value for z in (vector, -vector) if np.all(rows @ z >= -1e-12)]
    return min(found)


@pytest.mark.parametrize("places", [(0,), (0, 6), (1, 4, 6), (0, 3, 6)])
def test_least_quotient_on_a_cone_is_that_of_the_best_face(places: tuple[int, ...]) -> None:
    """A chain of springs whose lowest mode is of one sign; displacements at some places must alternate in sign."""
    stiffness = np.diag(2.0 + 0.1 * np.arange(SIZE)) - np.eye(SIZE, k=1) - np.eye(SIZE, k=-1)
    gram = np.diag(1.0 + 0.2 * np.cos(np.arange(SIZE)))
    rows = np.array([(-1.0) ** i * np.eye(SIZE)[place] for i, place in enumerate(places)])
    cone = OneSided(banded(stiffness), banded(gram), rows, 0.0)
    starts = np.random.default_rng(3).standard_normal((12, SIZE))
    found = [cone.lowest(start, lambda z: float(z @ stiffness @ z / (z @ gram @ z))) for start in starts]
    value, z, active, forces = min(found, key=lambda one: one[0])
    assert value == pytest.approx(least_of_all(stiffness, gram, rows), rel=1e-9)
    assert np.all(rows @ z >= -1e-9)
    assert stiffness @ z - value * gram @ z == pytest.approx(forces @ rows[active], abs=1e-5)


def test_functions_are_their_own_images_about_the_ends_of_cells() -> None:
    """A cosine of two whole waves on four cells, at every end; with a sine beside it only about the ends of the odd."""
    space = SplineSpace(np.linspace(0.0, 1.0, 41), 6)
    places = np.linspace(0.0, 1.0, 400)
    basis = np.array([space.evaluate(one, places, 1)[0] for one in np.eye(space.size)]).T

    def like(function: Any) -> np.ndarray:
        return np.asarray(np.linalg.lstsq(basis, function(places), rcond=None)[0])

    state: Any = SimpleNamespace(space=space)
    even = like(lambda x: np.cos(4.0 * np.pi * x))
    uneven = like(lambda x: np.cos(4.0 * np.pi * x) + 0.3 * np.sin(2.0 * np.pi * x))
    assert [_is_reflected(state, even, 4, cell, 1, 1e-6) for cell in (1, 2, 3)] == [True, True, True]
    assert [_is_reflected(state, uneven, 4, cell, 1, 1e-6) for cell in (1, 2, 3)] == [True, False, True]
    assert [_is_reflected(state, even, 4, cell, -1, 1e-6) for cell in (1, 2, 3)] == [False, False, False]


def test_parts_of_coefficients_are_even_and_odd_up_to_a_constant() -> None:
    odd, even = np.array([-3.0, -1.0, 0.0, 1.0, 3.0]), np.array([2.0, 5.0, 1.0, 5.0, 2.0])
    assert _part(odd + 0.7, -1) == pytest.approx(odd + 0.7, abs=1e-15)
    assert _part(odd + even, 1) == pytest.approx(even, abs=1e-15)
    assert _part(even, -1) == pytest.approx(np.full(5, 2.0), abs=1e-15)
