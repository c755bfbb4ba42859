"""The search for the largest value along a rod: functions whose maxima are known."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell.analysis.state.fields import largest_of


@pytest.mark.parametrize("waves", [1.0, 7.0, 40.0])
def test_largest_of_a_wave_under_an_envelope(waves: float) -> None:
    """Peaks of nearly equal height, of which the grid sees another as the highest: cos k(s − c) exp(−(s − c)²/8)."""
    for centre in np.linspace(0.31, 0.69, 9):
        value, place = largest_of(
            lambda s, c=centre: np.cos(2.0 * np.pi * waves * (s - c)) * np.exp(-((s - c) ** 2) / 8.0)
        )
        assert value == pytest.approx(1.0, abs=1e-10)
        assert place == pytest.approx(centre, abs=1e-5)


def test_first_place_of_equal_values() -> None:
    assert largest_of(lambda s: np.abs(np.sin(3.0 * np.pi * s))) == pytest.approx((1.0, 1.0 / 6.0), abs=1e-6)
    assert largest_of(np.ones_like) == (1.0, 0.0)
    assert largest_of(np.zeros_like) == (0.0, 0.0)
    assert largest_of(lambda s: s) == (1.0, 1.0)
    value, place = largest_of(lambda s: np.sin(20.0 * s), zooms=1)
    assert np.sin(20.0 * place) == value > 0.99
