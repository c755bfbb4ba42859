"""Shifts of inverse iteration, on pencils whose eigenvalues are known, and which vectors break a symmetry."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell.numerics.equilibria.cells import breaks
from rodwell.numerics.equilibria.eigen import _shift, _shift_above

SCALES = np.array([2.0, 0.5, 1.0, 3.0, 1.5, 0.7])


def pencil(values: list[float]) -> tuple[np.ndarray, np.ndarray]:
    """Bands of a diagonal pencil with these eigenvalues, in another order and of another scale each."""
    gram = SCALES[: len(values), None]
    return gram * np.array(values)[::-1, None], gram.copy()


@pytest.mark.parametrize("near", [None, (1.1, 5.8), (40.0, 50.0)])
def test_a_shift_lies_just_below_the_first_eigenvalue(near: tuple[float, float] | None) -> None:
    """Nearer than a tenth of the distance to the last of the block, whatever was expected of the two."""
    shift = _shift(*pencil([1.0, 1.2, 1.5, 4.0, 5.0, 6.0]), -7.0, 6, near)
    assert 1.0 - 0.25 * 5.0 < shift < 1.0


def test_a_shift_below_eigenvalues_that_are_all_alike_is_found() -> None:
    shift = _shift(*pencil([5.0] * 6), -7.0, 6)
    assert 5.0 - 1e-9 < shift < 5.0


@pytest.mark.parametrize(("kept", "ends"), [(1, (1.0, 1.2)), (3, (1.5, 4.0)), (4, (4.0, 5.0))])
def test_a_shift_above_those_that_are_known_lies_just_below_the_next(kept: int, ends: tuple[float, float]) -> None:
    """Nearer than two fiftieths of what follows in the block, if that is nearer than half the way."""
    values = [1.0, 1.2, 1.5, 4.0, 5.0, 6.0]
    shift = _shift_above(*pencil(values), np.array(values), kept)
    low, high = ends
    assert max(0.49 * (low + high) - 0.01, high - 0.041 * (6.0 - high)) <= shift < high


def test_a_vector_of_the_other_parity_breaks_a_symmetry() -> None:
    odd, even = np.array([-0.6, 0.4, 0.0, -0.4, 0.6]), np.array([0.6, 0.4, -0.3, 0.4, 0.6])
    assert [breaks(odd, 1), breaks(even, 1), breaks(odd, -1), breaks(even, -1)] == [True, False, False, True]
    assert not breaks(even + 0.1 * odd, 1), "a tenth of it is noise"
