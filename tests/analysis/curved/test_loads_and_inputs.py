"""What loads in a curved hole depend on: derivatives, curves in a parameter, and proofs, each against a second way."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from rodwell import (
    Branch,
    InputError,
    Problem,
    certify,
    critical_loads,
    follow,
    lift_off_curve,
    sensitivities,
)
from rodwell.analysis.curves.critical import _half_in_arc, _LoadsOverRange
from rodwell.analysis.curves.points import CurveStart, PlanePoint
from rodwell.analysis.curves.zeros import Touching
from rodwell.analysis.loads.ends import of_lift_off
from rodwell.analysis.loads.sensitivity import of_critical_load
from rodwell.answers.words.shown_loads import at_bottom

INCLINED = Problem(15.0, 70.0, clearance=0.02, build=0.2, ends="pinned-clamped")
STEPS = {"weight": 0.06, "alpha": 0.2, "clearance": 1e-4, "build": 1e-3}


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(INCLINED, rtol=1e-10)


def slope(name: str, values: dict[int, float]) -> float:
    """Central difference of fourth order from values at ±1 and ±2 steps."""
    return (8.0 * (values[1] - values[-1]) - (values[2] - values[-2])) / (12.0 * STEPS[name])


def changed(problem: Problem, name: str, steps: int) -> Problem:
    return problem.but(**{name: getattr(problem, name) + steps * STEPS[name]})


@pytest.mark.parametrize("name", STEPS)
def test_derivatives_of_a_critical_load_are_those_of_finite_differences(name: str) -> None:
    found = of_critical_load(critical_loads(INCLINED, 1)[0]).derivatives[name]
    loads = {k: critical_loads(changed(INCLINED, name, k), 1)[0].force for k in (-2, -1, 1, 2)}
    assert found.value == pytest.approx(slope(name, loads), rel=1e-6)
    assert found.error < 1e-6 * abs(found.value)


@pytest.mark.parametrize("name", ["build", "clearance", "alpha"])
def test_derivatives_of_a_lift_off_load_are_those_of_finite_differences(branch: Branch, name: str) -> None:
    """The load at a neighbouring problem is solved for from the state here, and not by these tangents."""
    lift = branch.lift_off
    assert lift is not None
    found = of_lift_off(lift).derivatives[name]
    zero, start, here = Touching(INCLINED, name), CurveStart(0.0, lift.solution), getattr(INCLINED, name)
    spots = {k: PlanePoint(here + k * STEPS[name], lift.force) for k in (-2, -1, 1, 2)}
    loads = {k: zero.solve(start.meshes, start.guess, spot).spot.value for k, spot in spots.items()}
    assert found.value == pytest.approx(slope(name, loads), rel=1e-6)
    again = follow(changed(INCLINED, name, 2), rtol=1e-10).lift_off
    assert again is not None
    assert loads[2] == pytest.approx(again.force, rel=1e-9)


def test_one_percent_more_length_bends_the_hole_more() -> None:
    """F = (B/L²) f(mg L³/B, α, Δ/L, κL): the length with mg, Δ and κ constant, by a thousandth either way."""
    loads = []
    for times in (0.999, 1.001):
        p = INCLINED.but(
            weight=INCLINED.weight * times**3, clearance=INCLINED.clearance / times, build=INCLINED.build * times
        )
        loads.append(critical_loads(p, 1)[0].force / times**2)
    load = of_critical_load(critical_loads(INCLINED, 1)[0])
    expected = (loads[1] - loads[0]) / (0.002 * load.force)
    assert load.elasticities()["length"].value == pytest.approx(expected, rel=1e-5)


def test_an_axis_through_points_has_its_own_inclination_and_curvature() -> None:
    """Those of an arc of the same shape, by its weight and clearance; the others are the axis's, and are left out."""
    points = INCLINED.hole.points(np.linspace(0.0, 1.0, 41))  # type: ignore[union-attr]
    problem = Problem(15.0, clearance=0.02, ends="pinned-clamped", axis=points.tolist())
    load = of_critical_load(critical_loads(problem, 1)[0])
    arc = of_critical_load(critical_loads(INCLINED, 1)[0])
    assert set(load.derivatives) == {"weight", "clearance"}
    assert set(load.elasticities()) == {"weight_per_length", "clearance", "stiffness"}
    for name in load.derivatives:
        assert load.derivatives[name].value == pytest.approx(arc.derivatives[name].value, rel=1e-6)


def test_modes_of_a_level_arc_are_those_of_its_halves_and_switch_where_the_whole_rod_has_two_equal_loads() -> None:
    loads = _LoadsOverRange(Problem(15.0), "build", 2, 1e-8, split=True)
    loads.nodes = [loads.node(0.22), loads.node(0.26)]
    ((mark, who),) = loads.marks()
    assert mark.kind == "double_point"
    assert set(who) == {(-1, 1), (1, 1)}
    first, second = critical_loads(Problem(15.0, build=mark.x), 2)
    assert first.force == pytest.approx(second.force, rel=1e-9)
    assert mark.value == pytest.approx(first.force, rel=1e-9)
    whole = critical_loads(Problem(15.0, build=0.26), 2)
    halves = sorted((loads.nodes[-1].loads[key].force for key in who), reverse=True)
    assert halves == pytest.approx(list(whole.forces), rel=1e-10)


def test_curves_of_critical_loads_go_through_the_straight_hole() -> None:
    """Nodes are joined by cubics with slopes of their own: they fit to both sides of a hole without curvature."""
    loads = _LoadsOverRange(Problem(15.0, 60.0), "build", 1, 1e-8, split=False)
    nodes = [loads.node(x) for x in (-0.002, 0.0, 0.002)]
    straight = critical_loads(Problem(15.0, 60.0), 1)[0].force
    assert nodes[1].loads[0, 1].force == pytest.approx(straight, rel=1e-12)
    for a, b in pairwise(nodes):
        mean = 0.5 * (a.loads[0, 1].slope + b.loads[0, 1].slope)
        assert (b.loads[0, 1].force - a.loads[0, 1].force) / 0.002 == pytest.approx(mean, rel=1e-4)
    assert _half_in_arc(Problem(15.0), 1).alpha == 90.0


def test_a_curve_of_lift_off_begins_in_the_straight_hole() -> None:
    straight = follow(Problem(15.0)).lift_off
    assert straight is not None
    zero, start = Touching(Problem(15.0), "build"), CurveStart(0.0, straight.solution)
    here = zero.solve(start.meshes, start.guess, PlanePoint(0.0, straight.force))
    assert here.spot.value == pytest.approx(straight.force, rel=1e-12)
    there = zero.solve(here.solution.meshes, here.guess, PlanePoint(2e-3, here.spot.value))
    curved = follow(Problem(15.0, build=2e-3)).lift_off
    assert curved is not None
    assert there.spot.value == pytest.approx(curved.force, rel=1e-9)


def test_proofs_in_an_arc_without_weight() -> None:
    """κ = 0.5, w = 0, clamped: theory of curved holes; pinned: N(q) of docs/curved-holes.md at q = nπ."""
    loads = certify(Problem(0.0, build=0.5), 2, digits=12)
    expected = [-260.399015064, -284.053630192]
    assert [float(load.force.middle) for load in loads] == pytest.approx(expected, abs=1e-9)
    bent = 0.5 / (1.0 + 0.01 * 0.5)
    q = math.pi * np.arange(1, 9)
    closed = -(q**4 - 2.0 * bent**2 * q**2 + bent**3 / 0.01) / (q**2 - bent / 0.01)
    pinned = certify(Problem(0.0, build=0.5, ends="pinned-pinned"), 3, digits=12)
    assert [float(x.force.middle) for x in pinned] == pytest.approx(sorted(closed[closed < 0.0])[:-4:-1], rel=1e-11)
    guided = Problem(0.0, build=0.3, on_top=True, ends="clamped-guided")
    (first,) = certify(guided, 1, digits=12)
    assert float(first.force.middle) == pytest.approx(critical_loads(guided, 1)[0].force, rel=1e-10)


@pytest.mark.parametrize(
    ("problem", "field", "why"),
    [
        (Problem(15.0, build=0.2), "weight", "constant coefficients"),
        (Problem(0.0, build=0.2, ends="clamped-free"), "ends", "free end"),
        (Problem(15.0, build=0.2, walk=0.1), "walk", "in a vertical plane"),
        (Problem(0.0, build=0.2, twist=1.0, ends="pinned-pinned"), "twist", "turns around the hole"),
    ],
)
def test_what_cannot_be_proved_is_refused(problem: Problem, field: str, why: str) -> None:
    with pytest.raises(InputError, match=why) as refused:
        certify(problem, 1)
    assert refused.value.field == field


def test_what_an_axis_fixes_no_curve_can_change() -> None:
    points = INCLINED.hole.points(np.linspace(0.0, 1.0, 9))  # type: ignore[union-attr]
    with pytest.raises(InputError, match="is that of the axis"):
        lift_off_curve(Problem(15.0, axis=points.tolist()), "alpha", (70.0, 75.0))
    with pytest.raises(InputError, match="loads as functions of it are curves"):
        follow(Problem(15.0), start=follow(Problem(15.0), until=-115.0)[-1], parameter={"build": (0.0, 0.1)}, until=1.0)


def test_of_a_rod_that_has_left_the_wall_of_a_drop_that_is_said() -> None:
    """The inside of the curve: theory of curved holes has −74.434, where it leaves the wall, above mode 2."""
    (load,) = sensitivities(Problem(15.0, build=-0.2), 2)
    assert "left the wall" in load.note
    assert load.force < -74.4344023


@pytest.mark.parametrize("name", STEPS)
def test_at_the_bottom_the_weight_over_the_rise_of_the_rod_changes_too(name: str) -> None:
    found = at_bottom(of_critical_load(critical_loads(INCLINED, 1)[0]))
    problems = {k: changed(INCLINED, name, k) for k in (-2, -1, 1, 2)}
    loads = {k: critical_loads(one, 1)[0].force - one.hung_weight for k, one in problems.items()}
    assert found.derivatives[name].value == pytest.approx(slope(name, loads), rel=1e-6)
    assert found.force == critical_loads(INCLINED, 1)[0].force - INCLINED.hung_weight
