"""Rods that float in curved holes: they lie on the high side, where weight would have pulled them off.

Upside down a build is a drop: the loads of the project's notes on curved holes for a build with weight (checked there
against a polyline on a torus) are those of a drop with lift. The other truths: contact by hand, and an elastic curve in
space that is given the hole and the lift as they are (:mod:`in_space`).
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from in_space import CLAMPED, CLEARANCE, energy_in_space, least_energy
from numpy.polynomial import chebyshev

from rodwell import InputError, Problem, certify, critical_curves, critical_loads, follow, sensitivities
from rodwell.analysis.loads.lying_rod import lying_rod
from rodwell.analysis.straight.critical import tensile_loads
from rodwell.analysis.straight.lying import least_contact, lies_between
from rodwell.problem.hole import Hole
from rodwell.problem.words import side_of_wall
from rodwell.survey.path import path_of_survey
from rodwell.survey.survey import Survey

LEVEL_DROP = Problem(15.0, build=-0.2, floats=True)
STEEP = Problem(15.0, 70.0, build=-0.4, floats=True)
TILTED = Problem(15.0, 80.0, build=-0.2, walk=0.3, floats=True)


def test_a_drop_holds_a_rod_that_floats_as_a_build_one_with_weight() -> None:
    """κ = 0.2, w = 15: −177.320540182, −186.614565944; in tension it leaves its middle at w cos(κᵣ/2)/κᵣ + κᵣ²."""
    np.testing.assert_allclose(critical_loads(LEVEL_DROP, 2).forces, (-177.320540182, -186.614565944), rtol=1e-9)
    _, high = lies_between(LEVEL_DROP)
    assert high is not None
    bent = 0.2 / (1.0 + 0.2 * CLEARANCE)
    assert high.value == pytest.approx(15.0 * math.cos(0.5 * bent) / bent + bent**2, rel=1e-9)
    assert side_of_wall(LEVEL_DROP) == "high"
    assert side_of_wall(LEVEL_DROP.but(on_top=True)) == "low"


@pytest.mark.parametrize("build", [0.4, -0.4])
@pytest.mark.parametrize("force", [0.0, -30.0, 30.0])
def test_contact_by_hand(build: float, force: float) -> None:
    """P = w sin ψ + κᵣ(N − κᵣ²): the rod is on the inside of a build, and N = F + w (rise from s to s = 1).

    ψ, the inclination of the rod at s, falls by κᵣ(s − ½) towards s = 1 where the hole is concave upward.
    """
    bent = build / (1.0 - CLEARANCE * build)
    s = np.linspace(0.0, 1.0, 20_001)
    inclination = math.radians(70.0) - bent * (s - 0.5)
    climbed = np.concatenate([[0.0], np.cumsum(0.5 * (np.cos(inclination)[1:] + np.cos(inclination)[:-1]))]) * s[1]
    axial = force + 15.0 * (climbed[-1] - climbed)
    contact = 15.0 * np.sin(inclination) + bent * (axial - bent**2)
    problem = STEEP.but(build=build)
    assert least_contact(problem, force).value == pytest.approx(float(np.min(contact)), abs=1e-6)
    assert problem.hung_weight == pytest.approx(-15.0 * climbed[-1], abs=1e-7)


def test_the_angle_is_that_of_least_energy_in_space() -> None:
    force = -120.0
    found = lying_rod(TILTED)
    state = found.at(force).own_places
    least = least_energy(TILTED, force, 13)
    s = np.linspace(0.05, 0.95, 19)
    angle = state.fields(s)["xi2"]
    assert np.max(np.abs(angle)) > 0.5
    assert chebyshev.chebval(2.0 * s - 1.0, chebyshev.chebmul(CLAMPED, least)) == pytest.approx(angle, abs=2e-6)
    energy = energy_in_space(least, TILTED, force) - energy_in_space(np.zeros(1), TILTED, force)
    assert energy == pytest.approx(state.number("energy").value, rel=1e-9)
    assert state.certificate.passed


def test_a_buckled_state_stands_in_space_under_the_high_side() -> None:
    """The centre line in the frame of the hole's middle, i up, from the hole as it was given and the angle alone."""
    state = follow(STEEP, 1, until=-260.0)[-1]
    rod, fields = state.geometry(41), state.fields(np.linspace(0.0, 1.0, 41))
    hole, angle = Hole.arc(70.0, -0.4), fields["xi2"]
    place = 0.5 - 0.5 / (1.0 + 0.4 * CLEARANCE) + fields["z"]
    (middle,), (centre,) = hole.frame(np.array([0.5])), hole.points(np.array([0.5]))
    n1, n2, _ = hole.frame(place).transpose(1, 0, 2)
    by_hand = hole.points(place) + CLEARANCE * (np.cos(angle)[:, None] * n1 - np.sin(angle)[:, None] * n2) - centre
    assert np.max(np.abs(angle)) > 0.25
    np.testing.assert_allclose(rod.centreline - [0.0, 0.0, 0.5], by_hand @ middle.T, atol=1e-12)
    assert rod.centreline[0, 0] > rod.axis[0, 0]  # above the axis
    assert state.certificate.passed


def test_an_axis_and_stations_are_the_arc_that_they_are_taken_from() -> None:
    hole = Hole.arc(70.0, -0.4)
    points = Problem(15.0, axis=hole.points(np.linspace(0.0, 1.0, 81)), floats=True)
    assert critical_loads(points, 2).forces == pytest.approx(critical_loads(STEEP, 2).forces, rel=1e-7)
    dropping = path_of_survey(Survey.of([0.0, 100.0, 200.0], [52.0, 44.0, 36.0], [70.0, 70.0, 70.0])).piece(0.0, 200.0)
    drop = Problem(15.0, 44.0, build=-math.radians(16.0), floats=True)
    mine = Problem(15.0, axis=dropping.axis, floats=True)
    assert mine.alpha == pytest.approx(44.0, abs=1e-9)
    assert critical_loads(mine, 2).forces == pytest.approx(critical_loads(drop, 2).forces, rel=1e-5)


def test_curves_slopes_and_proofs_know_it() -> None:
    """Differences of loads for slopes; loads in pairs of even and odd halves; exact loads of a weightless arc."""
    (load, *_) = sensitivities(STEEP)
    for name, step in (("alpha", 1e-3), ("build", 1e-5)):
        value = getattr(STEEP, name)
        low, high = (critical_loads(STEEP.but(**{name: value + h}), 1).forces[0] for h in (-step, step))
        assert load.derivatives[name].value == pytest.approx((high - low) / (2.0 * step), rel=1e-5)
    curves = critical_curves(LEVEL_DROP, "build", (-0.2, -0.25), modes=2)
    assert [curve.points[0].value for curve in curves] == pytest.approx((-177.320540182, -186.614565944), rel=1e-9)
    (proved,) = certify(Problem(0.0, build=-0.5, floats=True), 1)
    assert float(proved.force.middle) == pytest.approx(-260.399015064, rel=1e-9)  # the notes' build of 0.5


def test_in_tension_it_leaves_the_outside_of_the_drop() -> None:
    """A weightless rod is pressed by the bend alone, whatever floats."""
    light = Problem(0.0, build=0.5, ends="pinned-pinned")
    assert tensile_loads(light.but(build=-0.5, floats=True), 2).forces == pytest.approx(tensile_loads(light, 2).forces)


def test_on_the_inside_of_a_build_compression_lifts_it_off_before_it_buckles() -> None:
    with pytest.raises(InputError, match="the wall would have to pull the rod"):
        follow(STEEP.but(build=0.4), 1)
