"""Numbers with their errors: what can be done with them, and what cannot."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

import rodwell
from rodwell.analysis.state.compared import compared, compared_peaks
from rodwell.numerics.equilibria.error import CLAIMED_GAIN
from rodwell.problem.problem import Problem
from rodwell.quantities.value import Peak, Value
from rodwell.strength.cylinder import Stress

NUMBERS = st.floats(-1e12, 1e12)
ERRORS = st.floats(0.0, 1e6)
FACTORS = st.floats(-1e6, 1e6)


def test_a_value_can_be_taken_apart_but_is_no_tuple() -> None:
    number, error = Value(-2.5, 0.1)
    assert (number, error) == (-2.5, 0.1)
    assert Value(3.0).error == 0.0  # exact
    for wrong in (lambda x: x[0], lambda x: 2 * x, lambda x: x + x, len):
        with pytest.raises(TypeError):
            wrong(Value(1.0, 0.1))  # type: ignore[no-untyped-call]
    with pytest.raises(FrozenInstanceError):
        Value(1.0).value = 2.0  # type: ignore[misc]
    assert not hasattr(Value(1.0), "__dict__")


def test_a_peak_has_three_parts() -> None:
    number, error, place = Peak(5.0, 0.2, 0.25)
    assert (number, error, place) == (5.0, 0.2, 0.25)
    assert isinstance(Peak(1.0), Value)


@given(NUMBERS, ERRORS, FACTORS)
def test_other_units_scale_number_and_error(number: float, error: float, factor: float) -> None:
    scaled = Value(number, error).times(factor)
    assert scaled == Value(number * factor, error * abs(factor))
    assert scaled.error >= 0.0
    assert Peak(number, error, 0.3).times(factor) == Peak(scaled.value, scaled.error, 0.3)


def test_what_stands_on_a_peak_scales_to_a_peak() -> None:
    """A part of a strength does not change with the unit of the stress: it is left behind."""
    scaled = Stress(2e6, 10.0, 0.5, utilisation=0.01).times(1e-6)
    assert type(scaled) is Peak
    assert tuple(scaled) == pytest.approx((2.0, 1e-5, 0.5))


@pytest.mark.parametrize(("error", "known"), [(0.0, True), (1e-6, True), (1.0001e-6, False), (float("nan"), False)])
def test_known_to_a_tolerance_of_its_scale(error: float, known: bool) -> None:
    assert Value(0.0, error).within(1e-8, 100.0) is known


def test_values_go_to_other_processes() -> None:
    for value in (Value(1.0, 0.1), Peak(1.0, 0.1, 0.5), Stress(1.0, 0.1, 0.5, utilisation=0.2)):
        assert pickle.loads(pickle.dumps(value)) == value
    assert replace(Value(1.0, 0.1), error=0.2) == Value(1.0, 0.2)


def test_two_meshes_tell_the_error() -> None:
    assert compared(1.0, 1.0 + 1e-3).value == 1.0 + 1e-3
    assert compared(1.0, 1.0 + 1e-3).error == pytest.approx(1e-3 / CLAIMED_GAIN, rel=1e-6)
    assert compared_peaks((1.0, 0.2), (1.5, 0.3)) == Peak(1.5, compared(1.0, 1.5).error, 0.3)


def test_results_hold_them() -> None:
    """Every number of a state can be taken apart as before; a mode and a special point keep their attributes."""
    branch = rodwell.follow(Problem(15.0), 1)
    lift = branch.lift_off
    assert lift is not None
    state = lift.solution
    for value in (state.total_wall_force, *state.end_reactions.values(), *state.energies.values(), state.wall.torque):
        number, error = value
        assert abs(number) >= error >= 0.0 or abs(number) < 1e-6
    largest, error, place = state.largest("contact_pressure")
    assert state.wall.contact == Peak(largest, error, place)
    assert (lift.value, lift.error) == tuple(lift.reached)
    assert lift.load == Value(lift.force, lift.error)
    assert lift.value == lift.force  # the branch is followed in the end force
    assert branch.mode is not None
    assert tuple(branch.mode.load) == (branch.mode.force, branch.mode.error)
