"""The table of states of the endless rod against the states, and computed again."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell.analysis.endless import local, tabulate
from rodwell.analysis.endless.limits import limits
from rodwell.analysis.endless.local import LIMITS, LocalState, helical_contact, load_and_slope, local_state
from rodwell.analysis.endless.state import periodic_state
from rodwell.errors import InputError
from rodwell.formulas import path


def _apart(kind: str, beta: float, slope: float) -> tuple[float, float]:
    """Largest difference of a state of the table from the state computed, relative, and the error that it tells."""
    told, state = local_state(beta, kind, slope), periodic_state(kind, beta, slope)
    differences = []
    for name in LocalState._fields[:-1]:
        exact = getattr(state, name).value
        size = state.contact_mean.value if name == "contact_least" else abs(exact)
        differences.append(abs(getattr(told, name) - exact) / size)
    return max(differences), float(told.error)


@settings(max_examples=12, deadline=None)
@given(st.floats(2.001, LIMITS.sinusoidal_lift_off.value))
def test_sinusoidal_states_of_the_table(beta: float) -> None:
    apart, error = _apart("sinusoidal", beta, 0.0)
    assert apart < max(3.0 * error, 1e-10)


@settings(max_examples=12, deadline=None)
@given(st.floats(LIMITS.helix_lift_off.value, 300.0))
def test_helices_of_the_table(beta: float) -> None:
    apart, error = _apart("helical", beta, 0.0)
    assert apart < max(3.0 * error, 1e-10)


@pytest.mark.parametrize(
    ("kind", "beta", "slope"),
    [("sinusoidal", 2.3, 0.05), ("sinusoidal", 3.4, 0.03), ("helical", 3.0, 0.05), ("helical", 40.0, 0.015)],
)
def test_slopes_are_taken_in_first_order(kind: str, beta: float, slope: float) -> None:
    apart, error = _apart(kind, beta, slope)
    assert 0.01 * error < apart < 1.5 * error
    assert apart < 0.1 * abs(local_state(beta, kind, slope).contact_mean / local_state(beta, kind).contact_mean - 1.0)


def test_the_table_computed_again() -> None:
    again, shipped = tabulate.table(), json.loads(tabulate.FILE.read_text(encoding="utf-8"))
    for kind in ("sinusoidal", "helical"):
        for new, old in zip(again["states"][kind]["pieces"], shipped["states"][kind]["pieces"], strict=True):
            np.testing.assert_allclose([new["from"], new["to"]], [old["from"], old["to"]], rtol=0.0, atol=1e-9)
            np.testing.assert_allclose(new["series"], old["series"], rtol=0.0, atol=1e-9)
            np.testing.assert_allclose(new["slope_series"], old["slope_series"], rtol=0.0, atol=1e-6)
            assert max(new["error"], old["error"]) < 1e-10
            assert max(new["slope_error"], old["slope_error"]) < 0.4
    assert again["numbers"] == shipped["numbers"] == list(LocalState._fields[:-1])
    for name, (value, error) in again["loads"].items():
        assert abs(value - shipped["loads"][name][0]) <= 2.0 * error
        assert getattr(LIMITS, name).value == shipped["loads"][name][0]


def test_many_are_as_one() -> None:
    beta = np.array([[2.0, 2.2, 2.5], [2.9, 3.2, 3.5]])
    many = local_state(beta, "sinusoidal", 0.02)
    for name in LocalState._fields:
        assert getattr(many, name).shape == beta.shape
        ones = [getattr(local_state(float(b), "sinusoidal", 0.02), name) for b in beta.ravel()]
        np.testing.assert_allclose(getattr(many, name).ravel(), ones, rtol=1e-14, atol=1e-15)
    assert isinstance(local_state(3, "helical").energy, float)


def test_ends_of_the_table() -> None:
    first = local_state(2.0)
    assert (first.amplitude, first.contact_mean, first.energy) == (0.0, pytest.approx(1.0), pytest.approx(-1.0))
    assert local_state(LIMITS.sinusoidal_lift_off.value).contact_least == pytest.approx(0.0, abs=1e-10)
    assert local_state(LIMITS.helix_lift_off.value, "helical").contact_least == pytest.approx(0.0, abs=1e-10)
    assert local_state(1e6, "helical").contact_mean == pytest.approx(0.25e12, rel=1e-12)
    # a slope moves the lift-off, and the table goes as far
    end = limits(0.05).helix_lift_off
    assert end is not None
    assert end.value < LIMITS.helix_lift_off.value
    assert local_state(end.value, "helical", 0.05).contact_least == pytest.approx(0.0, abs=1e-4)


@pytest.mark.parametrize("many", [False, True])
@pytest.mark.parametrize(
    ("beta", "kind", "slope", "said"),
    [
        (1.99, "sinusoidal", 0.0, "from 2, where the rod buckles, to 3.541672"),
        (3.55, "sinusoidal", 0.0, "where it lifts off"),
        (4.0, "sinusoidal", 0.0, "where it lifts off"),
        (2.74, "helical", 0.0, "from 2.744687"),
        (-3.0, "helical", 0.0, "from 2.744687"),
        (np.inf, "helical", 0.0, "any finite load"),
        (np.nan, "helical", 0.0, "from 2.744687"),
        (3.0, "helical", 0.1, "at most 0.02"),
        (3.0, "helical", -0.1, "at least 0"),
        (3.0, "helical", np.nan, "at least 0"),
        (3.0, "spiral", 0.0, "must be 'sinusoidal' or 'helical'"),
    ],
)  # fmt: skip
def test_states_that_there_are_not(many: bool, beta: float, kind: str, slope: float, said: str) -> None:
    with pytest.raises(InputError, match=said):
        local_state(np.array([3.0, beta]) if many else beta, kind, slope)


def test_helical_contact_without_weight_and_with_it() -> None:
    p, q, b, d = 200e3, np.array([0.0, 1.0, 120.0]), 1.2e6, 0.044
    contact = helical_contact(p, q, b, d)
    assert contact[0] == pytest.approx(p * p * d / (4.0 * b), rel=1e-12)
    beta, slope = load_and_slope(p, q[1:], b, d)
    np.testing.assert_allclose(contact[1:], q[1:] * local_state(beta, "helical").contact_mean, rtol=1e-12)
    np.testing.assert_allclose(slope, (q[1:] * d**3 / b) ** 0.25, rtol=1e-14)
    with pytest.raises(InputError, match=r"at least 2\.744687"):
        helical_contact(20e3, 120.0, b, d)
    with pytest.raises(InputError, match="positive"):
        load_and_slope(1.0, 0.0, 1.0, 1.0)


@pytest.mark.parametrize(("build", "turn"), [(0.0, 0.0), (2e-3, 0.0), (-5e-4, 1e-3)])
def test_in_a_curved_hole_the_string_buckles_at_2(build: float, turn: float) -> None:
    """The load of He and Kyllingstad, from its quartic: F² = 4 (B/r) N(F), with N of weight and curvature together."""
    b, w, alpha, r = 1.228e6, 241.0, 60.0, 0.04445
    load = path.he_kyllingstad(b, w, alpha, r, build, turn)
    beta, _ = load_and_slope(load, path.path_contact_force(w, alpha, load, build, turn), b, r)
    assert beta == pytest.approx(LIMITS.buckling.value, rel=1e-12)


def test_the_table_is_read_once() -> None:
    assert local._tables() is local._tables()
