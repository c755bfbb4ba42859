"""Errors of measured numbers from two meshes, against the same in NumPy; how far meshes are refined."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rodwell.numerics.equilibria import two_meshes
from rodwell.numerics.equilibria.error import CLAIMED_GAIN, NUMBER_NOISE
from rodwell.numerics.equilibria.two_meshes import KIN, _judged
from rodwell.numerics.splines.spaces import SplineSpace

NONE = np.empty((0, 2), dtype=np.int64)


def test_errors_from_two_meshes() -> None:
    rng = np.random.default_rng(0)
    fine, coarse = rng.uniform(0.1, 1.0, (2, 3, 6))
    fine[1, 5] = np.inf  # a guard: it is not judged
    error, worst = _judged(fine, coarse, np.array([[2, 4]]), NONE)
    expected = np.abs(fine[0] - coarse[0]) / CLAIMED_GAIN + NUMBER_NOISE * np.abs(fine[0]) + fine[2]
    expected[:5] += NUMBER_NOISE * fine[1, :5]
    expected[2:5] = expected[2:5].max()  # numbers of one kind share the largest error
    np.testing.assert_allclose(error, expected, rtol=1e-14)
    assert worst == pytest.approx(np.max(expected[:5] / fine[1, :5]), rel=1e-14)


def test_numbers_without_kin_keep_their_own_errors() -> None:
    fine, coarse = np.array([[1.0, 2.0], [1.0, 1.0], [0.0, 0.0]]), np.zeros((3, 2))
    error, worst = _judged(fine, coarse, NONE, NONE)
    np.testing.assert_allclose(error, np.array([1.0, 2.0]) / CLAIMED_GAIN, rtol=1e-10)
    assert worst == error[1]
    assert len(_judged.signatures) == 1, "the same machine code for any number of groups"


def test_a_number_shares_the_error_of_its_kin_at_other_places() -> None:
    """Both meshes agree on the first by chance; the guard behind, which is not judged, tells how well they do."""
    fine, coarse = np.array([[1.0, 1.0, 3.0], [1.0, 1.0, np.inf], [0.0, 0.0, 0.0]]), np.ones((3, 3))
    error, worst = _judged(fine, coarse, NONE, np.array([[0, 2]]))
    np.testing.assert_allclose(error, [KIN * 2.0 / CLAIMED_GAIN, 0.0, 2.0 / CLAIMED_GAIN], atol=1e-10)
    assert worst == error[0]


@pytest.mark.parametrize("place", range(3))
def test_a_number_that_is_none_is_not_passed_over(place: int) -> None:
    fine, coarse = np.ones((3, 3)), np.ones((3, 3))
    fine[0, place] = np.nan
    assert np.isnan(_judged(fine, coarse, np.array([[0, 1]]), NONE)[1])


class OnMesh:
    """What meshes ask of a family."""

    tolerance = 1e-12

    def __init__(self, space: SplineSpace) -> None:
        self.space = space

    def on(self, space: SplineSpace) -> OnMesh:
        return OnMesh(space)


@pytest.mark.parametrize(("most", "elements"), [(16, 8), (15, None)])
def test_meshes_are_refined_up_to_the_limit_and_not_beyond(
    most: int, elements: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Halved everywhere, four elements become eight, and the finer mesh has sixteen."""
    monkeypatch.setattr(two_meshes, "_least_resolved", lambda *_: np.ones(4, dtype=bool))
    family: Any = OnMesh(SplineSpace(np.linspace(0.0, 1.0, 5), 3))
    point: Any = SimpleNamespace(coarse=None, fine=None)
    finer = two_meshes.TwoMeshes(family, lambda *_: np.zeros((3, 1)), 1e-8, most).refined(point)
    assert (None if finer is None else finer.coarse.space.elements) == elements
