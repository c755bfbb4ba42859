"""The rod along a hole that leaves the vertical plane: limits, symmetries, and an elastic curve in space beside it.

The second method knows no formula of the rod on the wall: :mod:`in_space`.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from in_space import CLAMPED, CLEARANCE, energy_in_space, least_energy
from numpy.polynomial import chebyshev

from rodwell import InputError, Problem, critical_loads, diagram, follow
from rodwell.analysis.branch.special import BRANCH_POINT, LIFT_OFF
from rodwell.analysis.branch.symmetry import reflections
from rodwell.analysis.discrete.measures import AS_FIELD, Measured, measure
from rodwell.analysis.loads.lying_rod import LyingRod, lying_rod
from rodwell.analysis.state.fields import fields_at

TILTED = Problem(15.0, 80.0, build=0.2, walk=0.3)


@pytest.fixture(scope="module")
def tilted() -> LyingRod:
    return lying_rod(TILTED)


def test_it_lies_on_the_wall_and_stable_down_to_where_it_leaves_it(tilted: LyingRod) -> None:
    assert tilted.end is not None
    assert tilted.end.kind == LIFT_OFF
    assert tilted.buckled is None
    assert tilted.end_in_tension is not None
    for force in np.linspace(tilted.lowest.value, tilted.highest.value, 7)[1:-1]:
        state = tilted.at(float(force))
        assert state.stability_index == 0
        assert state.number("largest_pressure").value < 0.0
        assert state.certificate.passed  # forces and moments balance in space
    assert all(state.converged for state in tilted.pressed)
    assert tilted.last.number("largest_pressure").value == pytest.approx(0.0, abs=1e-6 * tilted.last.wall.contact.value)
    with pytest.raises(InputError, match="there the rod lies on the wall, stable"):
        tilted.at(tilted.lowest.value - 1.0)


def test_the_angle_is_that_of_least_energy_in_space(tilted: LyingRod) -> None:
    force = -120.0
    state = tilted.at(force).own_places
    found = least_energy(TILTED, force, 13)
    s = np.linspace(0.05, 0.95, 19)
    angle = state.fields(s)["xi2"]
    assert np.max(np.abs(angle)) > 0.5
    assert chebyshev.chebval(2.0 * s - 1.0, chebyshev.chebmul(CLAMPED, found)) == pytest.approx(angle, abs=2e-6)
    energy = energy_in_space(found, TILTED, force) - energy_in_space(np.zeros(1), TILTED, force)
    assert energy == pytest.approx(state.number("energy").value, rel=1e-9)


def test_walk_to_the_other_side_mirrors_the_story(tilted: LyingRod) -> None:
    other = lying_rod(TILTED.but(walk=-0.3))
    assert other.lowest.value == pytest.approx(tilted.lowest.value, rel=1e-8)
    assert other.highest.value == pytest.approx(tilted.highest.value, rel=1e-7)
    s = np.linspace(0.0, 1.0, 9)
    assert other.at(-150.0).fields(s)["xi2"] == pytest.approx(-tilted.at(-150.0).fields(s)["xi2"], abs=1e-9)


@pytest.mark.parametrize("walk", [1e-6, -1e-6])
def test_a_level_hole_that_hardly_turns_buckles_as_one_that_does_not(walk: float) -> None:
    """Theory of curved holes, κ = 0.2, w = 15: −177.320540182; in tension F = w cos(κᵣ/2)/κᵣ + κᵣ², first at an end."""
    found = lying_rod(Problem(15.0, build=0.2, walk=walk))
    assert found.end is not None
    assert found.end.kind == BRANCH_POINT
    assert found.lowest.value == pytest.approx(-177.320540182, abs=5e-9)  # moved by 3.9e3 walk²
    curvature = 0.2 / (1.0 + 0.2 * CLEARANCE)
    assert found.highest.value == pytest.approx(15.0 * math.cos(0.5 * curvature) / curvature + curvature**2, rel=1e-6)
    assert found.buckled is not None
    planar = follow(Problem(15.0, build=0.2), 1)
    assert planar.lift_off is not None
    assert found.buckled.lift_off is not None
    assert found.buckled.lift_off.force == pytest.approx(planar.lift_off.force, rel=1e-6)
    assert found.rest.point.fine.symmetry == 1


def test_a_diagram_has_the_rod_as_it_lies_and_what_leaves_it() -> None:
    """Theory of curved holes, κ = 0.2, w = 15, without walk: −177.320540182."""
    level = Problem(15.0, build=0.2, walk=1e-6)
    found = diagram(level, until=-181.0)
    assert [branch.name for branch in found] == ["as it lies", "as it lies, pulled", "secondary 1"]
    lies, pulled, buckled = found
    assert found.primary == (lies, pulled)
    assert [joint.child for joint in found.joints] == ["secondary 1"]
    assert found.joints[0].force == pytest.approx(-177.320540182, abs=5e-9)
    assert (lies[-1].force, buckled[-1].force) == (-181.0, -181.0)
    assert (lies[-1].stability_index, buckled[-1].stability_index) == (1, 0)
    assert pulled.reach[1] > 0.0
    assert buckled[-1].number("energy").value < lies[-1].number("energy").value
    assert found.searched == ("connected to the rod as it lies",)
    with pytest.raises(InputError, match="starts from modes of the straight rod"):
        diagram(level, search=["deflation"])
    with pytest.raises(InputError, match="must be below the force at rest, 0 B/L²"):
        diagram(level, until=5.0)


def test_without_weight_only_the_plane_of_the_bend_counts() -> None:
    """Ends that slide: the rod turns into the plane of the arc, and buckles there at the load of an arc upright.

    The end force is that of the rod on the low side, whose tangent goes (1 + Δk₁) as far as the axis (theory of curved
    holes); on the outside of the bend it would go (1 + Δκ) as far.
    """
    kappa = math.hypot(0.2, 0.2)
    found = lying_rod(Problem(0.0, 60.0, build=0.2, walk=0.2, ends="guided-guided"))  # type: ignore[arg-type]
    angle = found.rest.fields(np.linspace(0.0, 1.0, 5))["xi2"]
    assert angle == pytest.approx(math.pi / 4.0, abs=1e-9)
    planar = critical_loads(Problem(0.0, 90.0, build=kappa, ends="guided-guided"), 1)[0].force  # type: ignore[arg-type]
    share = (1.0 + CLEARANCE * kappa) / (1.0 + CLEARANCE * 0.2)
    assert found.lowest.value == pytest.approx(planar * share, rel=1e-8)


def test_symmetries_of_the_hole() -> None:
    holes = ((90.0, 0.1), (80.0, 0.1), (90.0, 0.0))
    level, tilted, planar = (Problem(15.0, alpha, build=0.2, walk=walk) for alpha, walk in holes)
    assert [r.name for r in reflections(level)] == ["y(s)", "y(1−s)"]
    assert [r.name for r in reflections(tilted)] == ["y(s)"]
    assert len(reflections(planar)) == 4
    assert level.hung_weight == 0.0


def test_loads_to_be_reached_and_what_is_refused() -> None:
    heavy = Problem(200.0, 60.0, walk=0.1)
    found = lying_rod(heavy, [1000.0])
    assert found.highest.value >= 1000.0
    assert found.end_in_tension is None
    with pytest.raises(InputError, match="a straight generator"):
        lying_rod(Problem(15.0, build=0.2))
    with pytest.raises(InputError, match="finite"):
        lying_rod(TILTED, [math.nan])


def test_a_rod_that_touches_down_beyond_rest_lies_there() -> None:
    """Stiff and light in a drop that turns: at rest the wall would have to pull it near the ends, under tension not."""
    found = lying_rod(Problem(0.1, 60.0, build=-0.4, walk=0.3))
    assert found.rest.number("largest_pressure").value < 0.0
    assert found.lowest.value <= found.rest.force <= found.highest.value


def test_a_rod_that_lies_nowhere_is_told_why(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same rod, looked at no farther than a little way around rest."""
    monkeypatch.setattr("rodwell.analysis.branch.rest.REACH", 1e-4)
    with pytest.raises(InputError, match="lies on the wall at no end force from") as caught:
        lying_rod(Problem(0.1, 60.0, build=-0.4, walk=0.3))
    assert "the wall would have to pull it at s/L = " in caught.value.reason


def test_the_largest_contact_force_is_held_to_the_tolerance(tilted: LyingRod) -> None:
    """It is measured at its place, which is another one than that of the least, as the field has it there."""
    state = tilted.last
    for family, on in state.levels:
        numbers, scales, _ = measure(family, on)
        field = fields_at(TILTED, family, on, np.linspace(0.0, 1.0, 20001), balance=False)["contact_pressure"]
        assert numbers[AS_FIELD] == pytest.approx(float(np.min(field)), rel=1e-7)
        assert numbers[AS_FIELD] <= float(np.min(field)) * (1.0 - 4.0 * np.finfo(float).eps)  # kernels round otherwise
        assert numbers[Measured.P_MAX] > 0.1 * numbers[AS_FIELD]
        assert scales[AS_FIELD] <= 0.5 * abs(numbers[AS_FIELD])
    for force in (tilted.lowest.value, tilted.rest.force):
        contact = tilted.at(force).largest("contact_pressure")
        assert contact.error < 1e-8 * contact.value
