"""Tubing in a packer: the printed example of 1962, closed forms, limits, forces."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

import rodwell
from rodwell.analysis.endless.shortening import (
    LOADING,
    RULES,
    UNLOADING,
    largest_curvature,
    state_at,
    string_shortening,
)
from rodwell.errors import InputError
from rodwell.formulas import pushing
from rodwell.physics.exact.helix import LARGEST, helix_shortening, sine_squared, weightless_helix
from rodwell.studies.packer.lengths import Conditions, Tubing, elongations, total
from rodwell.studies.packer.motion import Moved, Stops, moved

# inches, pounds, °F, with the areas, the inertia and the ratio of diameters as printed, rounded, in Lubinski, Althouse
# and Logan 1962: 2 7/8 in, 6.5 lb/ft tubing in 7 in, 32 lb/ft casing, 10,000 ft
TUBING = Tubing(
    length=120e3, angle=0.0, modulus=30e6, poisson=0.3, expansion=6.9e-6, inertia=1.61, area=1.81, inner_area=4.68,
    outer_area=6.49, clearance=1.61, seal_area=8.30, ratio=1.178,
)  # fmt: skip


def fluids(
    inside: float, outside: float, in_gradient: float, out_gradient: float, temperature: float = 0.0
) -> Conditions:
    weight = 6.5 / 12.0 + TUBING.inner_area * in_gradient - TUBING.outer_area * out_gradient
    return Conditions(weight, inside, outside, in_gradient, out_gradient, temperature)


LANDED = fluids(0.0, 0.0, 0.0317, 0.0317)
SQUEEZED = fluids(5000.0, 1000.0, 0.0649, 0.0317, -20.0)
SMALL_SLOPE = 1.61**2 * 66267.2**2 / (8.0 * 30e6 * 1.61 * SQUEEZED.weight)
"""r²F²/(8EIw) of the printed example, in inches."""


def squeezed(stops: Stops = Stops(), landed_with: float = 0.0) -> Moved:  # noqa: B008
    return moved(TUBING, LANDED, SQUEEZED, stops, landed_with)


def test_lubinski_althouse_and_logan_to_the_printed_digits() -> None:
    changes = squeezed().changes
    assert changes["piston"].value == pytest.approx(-67.87, abs=0.005)
    assert changes["ballooning"].value == pytest.approx(-34.69, abs=0.005)
    assert changes["temperature"].value == pytest.approx(-16.56, abs=0.005)
    assert total(changes).value == pytest.approx(-165.2, abs=0.05)
    # printed for small slopes: −46.05, −165.18; the exact helix is 0.09 % shorter
    assert pytest.approx(-46.05, abs=0.005) == -SMALL_SLOPE
    small = pushing.tubing_shortening(30e6 * 1.61, SQUEEZED.weight, 1.61, 66267.2)
    assert abs(small) == pytest.approx(SMALL_SLOPE, rel=1e-12)
    others = sum(changes[kind].value for kind in ("piston", "ballooning", "temperature"))
    assert others - SMALL_SLOPE == pytest.approx(-165.18, abs=0.005)
    assert 1.0005 < -changes["buckling"].value / SMALL_SLOPE < 1.0015


def test_slack_off_as_printed() -> None:
    """20,000 lb slacked off: 49.7 in, F L/(E A) + r²F²/(8EIw)."""
    assert squeezed(Stops(math.inf, 0.0), -20e3).landed.value == pytest.approx(49.7, abs=0.05)
    assert squeezed(Stops(math.inf, 0.0), -20e3).landed.value == pytest.approx(49.74, abs=0.005)


def test_no_helix_is_shorter_than_the_exact_one_by_more_than_its_slope() -> None:
    """−r²F²/(8EIw) is the limit of small clearance, at the rate of sin²η."""
    ratios = []
    for clearance in (0.4, 0.2):
        exact = string_shortening(66e3, 0.64, 0.0, 120e3, 48.3e6, clearance, LOADING).value
        ratios.append(exact / (clearance**2 * 66e3**2 / (8.0 * 48.3e6 * 0.64)) - 1.0)
    assert 0.0 < ratios[1] < 1e-4
    assert ratios[0] == pytest.approx(4.0 * ratios[1], rel=1e-3)


@given(st.floats(1e-6, LARGEST))
def test_the_weightless_helix_by_its_load(load: float) -> None:
    """u √(1 − u) = load is the balance of the closed form; the shortening is the integral of 1 − cos η."""
    u = sine_squared(load)
    assert 0.0 < u <= 2.0 / 3.0 + 1e-7
    assert u * math.sqrt(1.0 - u) == pytest.approx(load, rel=1e-13)
    assert -0.5 * weightless_helix(math.asin(math.sqrt(u)), 1.0).force == pytest.approx(load, rel=1e-12)
    part = min(load, 0.95 * LARGEST)
    by_quadrature = quad(lambda x: 2.0 * (1.0 - math.sqrt(1.0 - sine_squared(x))), 0.0, part, epsrel=1e-10, epsabs=0.0)[
        0
    ]
    assert helix_shortening(part) == pytest.approx(by_quadrature, rel=1e-7)


@pytest.mark.parametrize("rule", RULES)
def test_an_inclined_string_is_the_sum_of_its_places(rule: str) -> None:
    """By the midpoint rule over many places; nearly vertical it tends to the closed form."""
    p, w, b, d, length = 66e3, 0.64, 48.3e6, 1.61, 120e3
    axial, lateral = w * math.cos(0.5), w * math.sin(0.5)
    places = p - axial * (np.arange(4000) + 0.5) * length / 4000
    beta = places / math.sqrt(b * lateral / d)
    switch = {LOADING: 3.541672075077364, UNLOADING: 2.7446866924272406}[rule]
    strains = np.zeros_like(beta)
    for kind, here in (("sinusoidal", (beta > 2.0) & (beta < switch)), ("helical", beta >= switch)):
        state = rodwell.local_state(beta[here], kind, (lateral * d**3 / b) ** 0.25)
        strains[here] = state.shortening
    by_sum = float(np.sum(strains)) * math.sqrt(lateral * d**3 / b) * length / 4000
    assert string_shortening(p, axial, lateral, length, b, d, rule).value == pytest.approx(by_sum, rel=1e-3)
    nearly = string_shortening(p, w, w * 1e-5, length, b, d, rule)
    vertical = string_shortening(p, w, 0.0, length, b, d, rule)
    assert abs(nearly.value - vertical.value) < nearly.error + 1e-4 * vertical.value
    level = string_shortening(p, 0.0, lateral, length, b, d, rule)
    hardly = string_shortening(p, lateral * 1e-7, lateral, length, b, d, rule)
    assert hardly.value == pytest.approx(level.value, rel=1e-5)


@pytest.mark.parametrize("lateral", [0.0, 0.05])
def test_a_string_that_is_buckled_to_the_top_is_the_sum_of_its_halves(lateral: float) -> None:
    p, axial, b, d, length = 66e3, 0.6, 48.3e6, 1.61, 40e3
    lower, upper = (
        string_shortening(at, axial, lateral, 0.5 * length, b, d, LOADING).value for at in (p, p - 0.5 * axial * length)
    )
    whole = string_shortening(p, axial, lateral, length, b, d, LOADING).value
    assert whole == pytest.approx(lower + upper, rel=1e-9)
    assert 0.3 * whole < upper < lower


def test_what_is_helical_stays_so_longer_on_the_way_back() -> None:
    """Between β = 2.745 and 3.542 both states exist."""
    b, d, w = 48.3e6, 1.61, 0.3
    p = 3.0 * math.sqrt(b * w / d)
    assert [state_at(p, w, b, d, rule) for rule in RULES] == ["sinusoidal", "helical"]
    assert [state_at(x, w, b, d, LOADING) for x in (-1.0, 0.5 * p, 2.0 * p)] == ["straight", "straight", "helical"]
    curvatures = [largest_curvature(p, w, b, d, rule) * b / math.sqrt(b * w * d) for rule in RULES]
    assert curvatures[0] == pytest.approx(0.99135133, rel=1e-3)
    assert curvatures[1] == pytest.approx(1.74365663, rel=2e-3)
    assert largest_curvature(p, 0.0, b, d, LOADING) == pytest.approx(0.5 * p * d / b, rel=1e-3)


def test_a_packer_that_allows_no_motion_holds_what_the_length_would_change() -> None:
    """With the force found, the tubing is as long as when it was landed."""
    for landed_with in (0.0, -20e3, 15e3):
        held = squeezed(Stops(0.0, 0.0), landed_with)
        assert held.movement.value == 0.0
        after = total(elongations(TUBING, SQUEEZED, -held.packer.value, LOADING)).value
        before = total(elongations(TUBING, LANDED, -landed_with, LOADING)).value
        assert after == pytest.approx(before, abs=1e-7)
        assert held.stopped == "up"
        assert held.packer.value > 0.0  # the squeeze shortens it: the packer holds it down


def test_a_stroke_is_used_up_before_the_packer_holds() -> None:
    free = squeezed().free.value
    assert squeezed(Stops(200.0, 0.0)).movement.value == pytest.approx(free)
    assert squeezed(Stops(200.0, 0.0)).packer.value == 0.0
    forces = [squeezed(Stops(up, 0.0)).packer.value for up in (0.0, 50.0, 100.0, 160.0)]
    assert forces == sorted(forces, reverse=True)
    held = squeezed(Stops(50.0, 0.0))
    assert held.movement.value == -50.0
    lengths = [total(elongations(TUBING, *at, LOADING)).value for at in ((SQUEEZED, -held.packer.value), (LANDED, 0.0))]
    assert lengths[0] - lengths[1] == pytest.approx(-50.0, abs=1e-7)
    warmer = replace(LANDED, temperature=100.0)
    down = moved(TUBING, LANDED, warmer, Stops(math.inf, 0.0))
    assert down.stopped == "down"
    assert down.packer.value < 0.0
    # without buckling, E A ε; buckling lets it go with less
    assert 0.0 < -down.packer.value < 30e6 * 1.81 * 6.9e-6 * 100.0


@settings(max_examples=30, deadline=None)
@given(
    st.floats(0.0, 8000.0), st.floats(0.0, 4000.0), st.floats(-60.0, 200.0), st.floats(0.0, 89.0), st.floats(0.0, 60.0)
)
def test_stops_are_never_passed_and_forces_point_away_from_them(
    inside: float, outside: float, temperature: float, angle: float, stroke: float
) -> None:
    after = fluids(inside, outside, 0.0433, 0.04, temperature)
    tubing = replace(TUBING, angle=angle)
    for rule in RULES:
        m = moved(tubing, LANDED, after, Stops(stroke, 0.5 * stroke), rule=rule)
        assert -stroke <= m.movement.value <= 0.5 * stroke
        assert {"": m.packer.value == 0.0, "up": m.packer.value > 0.0, "down": m.packer.value < 0.0}[m.stopped]
        assert 0.0 <= m.neutral.value <= tubing.length


def test_nothing_changes_where_nothing_changes() -> None:
    same = moved(TUBING, LANDED, LANDED, Stops(0.0, 0.0), -20e3)
    assert same.free.value == pytest.approx(same.landed.value)
    assert same.packer.value == pytest.approx(-20e3, rel=1e-9)
    level = replace(TUBING, angle=90.0)
    assert level.height == 0.0
    assert moved(level, LANDED, LANDED, Stops()).free.value == 0.0


def test_more_than_a_helix_bears_is_told() -> None:
    with pytest.raises(InputError, match=r"no helix bears it: the largest is 0.7698 B/D² = "):
        moved(replace(TUBING, clearance=40.0), LANDED, SQUEEZED, Stops())
    with pytest.raises(InputError, match="stops the tubing from moving down at once"):
        squeezed(Stops(), -20e3)
