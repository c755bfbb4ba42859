"""Small rules by which the numerics decide: least values, when Newton's method has settled, which cells are sought."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell.numerics.equilibria.cells import CELLS
from rodwell.numerics.equilibria.newton import _settles
from rodwell.numerics.stretches.minima import lowest


def test_least_values_of_smooth_functions_are_those_of_closed_forms() -> None:
    """cos x is least at π, a parabola at its vertex, a straight line at its end; of a constant every place will do."""
    samples = np.linspace(0.0, 1.0, 9) * np.array([[5.0], [2.0], [3.0], [1.0]])

    def values(x: np.ndarray) -> np.ndarray:
        return np.stack([np.cos(x[0]), (x[1] - 0.7) ** 2 - 0.25, 4.0 - x[2], np.full_like(x[3], 2.5)])

    least, where = lowest(values, samples)
    assert least == pytest.approx([-1.0, -0.25, 1.0, 2.5], abs=1e-9)
    assert where[:3] == pytest.approx([np.pi, 0.7, 3.0], abs=1e-5)


def test_newton_has_settled_when_its_next_step_would_be_round_off() -> None:
    """Steps fall like κ d²: from 10⁻² to 10⁻⁶ κ is 10⁻², and the next is 10⁻¹⁴; from 10⁻² to 10⁻⁵ it is 10⁻¹¹."""
    assert _settles(1e-6, 1e-2)
    assert not _settles(1e-5, 1e-2)
    assert not _settles(1e-6, 1e-7), "steps grow"
    assert not _settles(1e-6, 2.0), "far from where they fall like that"


def test_numbers_of_cells_are_all_powers_of_primes_up_to_their_largest() -> None:
    primes = [n for n in range(2, 32) if all(n % k for k in range(2, n))]
    assert list(CELLS) == sorted(p**k for p in primes for k in range(1, 6) if p**k < 32)
