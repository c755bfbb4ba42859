"""Local loads of a long rod, and the table between them, against limits and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from local_pipe import PIPE, dawson_paslay
from scipy.special import ai_zeros

from rodwell.analysis.loads.by_inclination import Precision, angle_at, loads_at, place
from rodwell.analysis.loads.long_rod import (
    HALF_WAVES,
    LocalLoad,
    PipeString,
    critical_compression,
    length_effect,
    lift_off_compression,
)
from rodwell.quantities.value import Value


def value(load: LocalLoad) -> float:
    assert load.compression is not None, load.reason
    return load.compression.value


def test_horizontal_rod_is_within_one_percent_of_the_endless_rod() -> None:
    """The limit is 2√(B w/r); between clamped ends n half waves add 2/n² to leading order."""
    ratio = value(critical_compression(PIPE, 90.0)) / dawson_paslay(90.0)
    assert 1.0 < ratio < 1.01
    assert ratio - 1.0 == pytest.approx(2.0 / HALF_WAVES**2, rel=0.01)


def test_pinned_horizontal_rod_is_the_endless_rod() -> None:
    """n half waves exactly: Paslay and Bogy's load for a length that is a multiple of the half wave."""
    pinned = PipeString(PIPE.stiffness, PIPE.weight, PIPE.clearance, ("pinned", "pinned"))
    assert value(critical_compression(pinned, 90.0)) == pytest.approx(dawson_paslay(90.0), rel=1e-6)


@pytest.mark.parametrize("alpha", [0.05, 3.0, 45.0, 80.0, 88.0])
def test_length_is_long_enough(alpha: float) -> None:
    """Twice the length changes the load by less than 1 %, and no more than the effect that is reported says."""
    load, longer = (value(critical_compression(PIPE, alpha, n)) for n in (HALF_WAVES, 2 * HALF_WAVES))
    assert abs(load / longer - 1.0) < 0.01
    assert abs(load / longer - 1.0) <= length_effect(PIPE, alpha) + 1e-9


@pytest.mark.parametrize("ends", [("pinned", "free"), ("free", "clamped")])
def test_vertical_rod_that_may_sway_at_one_end(ends: tuple[str, str]) -> None:
    """1.018793 (B w²)^⅓, the first zero of Ai': a long string with a hinged bit, free sideways at the other end."""
    string = PipeString(PIPE.stiffness, PIPE.weight, PIPE.clearance, ends)
    unit = (PIPE.stiffness * PIPE.weight**2) ** (1.0 / 3.0)
    assert value(critical_compression(string, 0.0)) / unit == pytest.approx(-ai_zeros(1)[1][0], rel=1e-7)


def test_vertical_rod_guided_at_the_bottom() -> None:
    """y' = 0 at the bottom: the first zero of Ai."""
    string = PipeString(PIPE.stiffness, PIPE.weight, PIPE.clearance, ("guided", "clamped"))
    unit = (PIPE.stiffness * PIPE.weight**2) ** (1.0 / 3.0)
    assert value(critical_compression(string, 0.0)) / unit == pytest.approx(-ai_zeros(1)[0][0], rel=1e-7)


@pytest.mark.parametrize("alpha", [20.0, 50.0, 74.0, 90.0])
def test_lift_off_is_later_than_buckling_and_hardly_depends_on_length(alpha: float) -> None:
    lift, longer = (value(lift_off_compression(PIPE, alpha, n)) for n in (12, 18))
    assert lift > value(critical_compression(PIPE, alpha))
    assert lift == pytest.approx(longer, rel=0.012)


def test_lift_off_of_a_vertical_rod_is_buckling() -> None:
    assert lift_off_compression(PIPE, 0.0) == critical_compression(PIPE, 0.0)


@given(st.floats(0.0, 90.0))
def test_places_of_the_table_are_inclinations(alpha: float) -> None:
    assert angle_at(place(alpha)) == pytest.approx(alpha, abs=1e-9)


@pytest.mark.parametrize(("low", "high"), [(0.3, 90.0), (60.0, 90.0), (0.05, 5.0)])
def test_interpolated_loads_are_as_exact_as_they_say(low: float, high: float) -> None:
    alphas = np.random.default_rng(3).uniform(low, high, 100)
    loads = loads_at(alphas.tolist(), lambda alpha: critical_compression(PIPE, alpha), Precision(1e-3, 6))
    assert loads.solved < 45
    assert not loads.reasons
    assert np.all(loads.errors <= 1.1e-3 * loads.values)
    for i in range(0, 100, 12):
        assert abs(loads.values[i] - value(critical_compression(PIPE, alphas[i]))) <= loads.errors[i]


def test_few_inclinations_are_all_solved_for() -> None:
    asked = []

    def solve(alpha: float) -> LocalLoad:
        asked.append(alpha)
        return LocalLoad(Value(alpha + 1.0))

    loads = loads_at([30.0, 10.0, 30.0, 0.0], solve, Precision(1e-3, 6))
    assert sorted(asked) == [0.0, 10.0, 30.0]
    assert loads.values.tolist() == [31.0, 11.0, 31.0, 1.0]
    assert loads.interpolated == 0.0


@settings(max_examples=30)
@given(st.floats(5.0, 85.0), st.floats(0.02, 0.5))
def test_a_jump_is_inside_the_error(at: float, size: float) -> None:
    """Where the load jumps, the error covers it, at every inclination."""

    def truth(alpha: float) -> float:
        return 2.0 + math.sin(math.radians(alpha)) + (size if alpha > at else 0.0)

    alphas = np.linspace(1.0, 90.0, 200)
    loads = loads_at(alphas.tolist(), lambda alpha: LocalLoad(Value(truth(alpha))), Precision(1e-2, 5))
    off = np.abs(loads.values - [truth(alpha) for alpha in alphas])
    assert np.all(off <= loads.errors)


def test_a_load_that_is_not_found_is_said() -> None:
    def solve(alpha: float) -> LocalLoad:
        return LocalLoad(None, reason="no luck") if alpha > 60.0 else LocalLoad(Value(1.0 + alpha))

    alphas = np.linspace(1.0, 90.0, 60).tolist()
    loads = loads_at(alphas, solve, Precision(1e-2, 4))
    lost = {i for i, alpha in enumerate(alphas) if alpha > 60.0}
    assert lost <= set(loads.reasons)
    assert all("no luck" in reason for reason in loads.reasons.values())
    assert set(np.nonzero(np.isnan(loads.values))[0]) == set(loads.reasons)
