"""The load path of a string: against uniform rods, the strong form along each stretch, and closed forms at steps."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rodwell
from rodwell.analysis.off_wall.bumps import step_gap_sizes
from rodwell.analysis.off_wall.measured import position
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.load_path import LoadPath

TWO = rodwell.Problem(weight=15, sections=((0.6, 1.0, 1.0), (0.4, 0.5, 0.8)))


@pytest.fixture(scope="module")
def two() -> LoadPath:
    return load_path(TWO, until=-85.0, seeds=1)


def test_one_section_is_a_uniform_rod_in_other_units() -> None:
    """Of twice the stiffness and twice the weight: every load doubles, places stay (references: test_load_path)."""
    path = load_path(rodwell.Problem(weight=15, sections=((1.0, 2.0, 2.0),)), until=-251.0, seeds=1)
    assert [event.kind for event in path.events] == ["critical", "lift_off", "gap_opens"]
    loads = [event.force.value for event in path.events]
    assert loads == pytest.approx([-2.0 * 111.23344016, -2.0 * 123.173074, -2.0 * 124.1911865], abs=2e-6)
    state = path.at(-2.0 * 125.41829806)[0].state
    assert state.energy.value == pytest.approx(-2.0 * 0.00145016, abs=1e-8)
    ends = [point.s.value for point in state.point_forces]
    assert ends[:3] == pytest.approx([0.11571, 0.21304, 0.42800], abs=0.6e-5)
    assert [point.force.value for point in state.point_forces[:3]] == pytest.approx([0.0934, 0.0974, 0.2034], abs=2e-4)


def test_a_step_of_the_weight_that_is_hardly_one_changes_hardly_anything() -> None:
    """An end of contact passes it on the way: everything is where it is in the uniform rod."""
    path = load_path(rodwell.Problem(weight=15, sections=((0.11, 1.0), (0.89, 1.0, 1.0 + 1e-9))), until=-127.0, seeds=1)
    assert [event.kind for event in path.events] == ["critical", "lift_off", "gap_opens"]
    assert [event.force.value for event in path.events] == pytest.approx(
        [-111.23344016, -123.173074, -124.1911865], abs=1e-6
    )
    before, after = (path.at(force)[0].state for force in (-125.41829806, -125.99602743))
    assert before.gaps[0].start.value == pytest.approx(0.11571, abs=0.6e-5)
    assert after.gaps[0].start.value == pytest.approx(0.105738, abs=0.6e-6)
    assert after.energy.value == pytest.approx(-0.00157218, abs=1e-8)


def _integrated(state: ContactState, left: float, right: float) -> np.ndarray:
    """The tangent's and the force's own equations from one end of a free stretch to the other: x, y there, in Δ.

    b t″ = −n + (t·n − b|t′|²)t − T₁ t × t′ and n′ = q(wₗ i + wₐ k), with b t′ and n continuous at a step.
    """
    problem, inset = state.problem, 1e-9
    start = left + inset
    x, y, _ = position(state.fine, np.array([start]))
    (x, y), rod = (x[:, 0], y[:, 0]), problem.rod
    z1 = np.sqrt(1.0 - x[1] ** 2 - y[1] ** 2)
    t = np.array([x[1], y[1], z1])
    t1 = np.array([x[2], y[2], -(x[1] * x[2] + y[1] * y[2]) / z1])
    z3 = -(x[2] ** 2 + y[2] ** 2 + t1[2] ** 2 + x[1] * x[3] + y[1] * y[3]) / z1
    t2 = np.array([x[3], y[3], z3])
    b = float(rod.stiffness(np.array([start]))[0])
    across = -b * (t2 + t1 @ t1 * t) - problem.twist * np.cross(t, t1)
    along = (state.force + problem.axial_weight * float(rod.lever(np.array([start]))[0]) - across[2]) / z1
    now = np.concatenate([[x[0], y[0]], t, b * t1, across + along * t])
    corners = [start, *(s for s in rod.breaks if start < s < right), right]
    for low, high in pairwise(corners):
        b, q = (float(f(np.array([0.5 * (low + high)]))[0]) for f in (rod.stiffness, rod.weight))
        weight = q * np.array([problem.lateral_weight, 0.0, problem.axial_weight])

        def rates(_: float, v: np.ndarray, b: float = b, weight: np.ndarray = weight) -> np.ndarray:
            t, bend, n = v[2:5], v[5:8], v[8:11]
            t1 = bend / b
            rate = -n + (t @ n - b * t1 @ t1) * t - problem.twist * np.cross(t, t1)
            return np.concatenate([t[:2], t1, rate, weight])

        now = solve_ivp(rates, (low, high), now, method="DOP853", rtol=1e-12, atol=1e-15).y[:, -1]
    return now[:2] / problem.clearance


def test_free_stretches_solve_the_equations_of_a_rod_in_space(two: LoadPath) -> None:
    state = two.at(-84.0)[0].state
    assert any(gap.start.value < 0.6 < gap.end.value for gap in state.gaps)
    for gap in state.gaps:
        end = _integrated(state, gap.start.value, gap.end.value)
        x, y, _ = position(state.fine, np.array([gap.end.value]))
        assert end == pytest.approx(np.array([x[0, 0], y[0, 0]]) / TWO.clearance, abs=1e-8)


def test_the_gap_at_a_step_is_that_of_a_beam_in_closed_form(two: LoadPath) -> None:
    """Soon after buckling: ℓ = √(2[b]κΛ/q), and its part on the stiffer side, within what the slope adds along it."""
    state, eps = two.at(-83.0)[0].state, 1e-6
    (gap,) = state.gaps
    s = np.array([gap.start.value, gap.end.value])
    beside = state.fields(np.array([s[0] - eps, s[1] + eps]))
    slope = np.diff(state.fields(np.array([0.6 - eps, 0.6 + eps]))["angle"])[0] / (2.0 * eps)
    a, factor = step_gap_sizes(0.5)
    length = np.sqrt(2.0 * 0.5 * factor * slope**2 * TWO.clearance / -np.mean(beside["contact_pressure"]))
    assert gap.end.value - gap.start.value == pytest.approx(length, rel=0.05)
    assert (0.6 - gap.start.value) / (gap.end.value - gap.start.value) == pytest.approx(a, rel=0.02)


def test_the_gap_at_a_small_step() -> None:
    a, factor = step_gap_sizes(1.0 - 1e-9)
    assert (a, factor) == pytest.approx((0.5 + np.sqrt(1.0 / 12.0), np.sqrt(3.0)), rel=1e-8)


def test_every_state_is_an_equilibrium_that_the_wall_can_hold(two: LoadPath) -> None:
    assert two.reached
    assert not two.missed
    assert [event.kind for event in two.events] == ["critical", "lift_off"]
    assert two.events[0].force.value == pytest.approx(rodwell.critical_loads(TWO, 1)[0].force, rel=1e-12)
    for force in (-83.0, -84.0):
        state = two.at(force)[0].state
        assert state.certificate.passed
        assert state.stability_index == 0
        h = 1e-3
        low, high = (two.at(force + d)[0].state.energy.value for d in (-h, h))
        assert (high - low) / (2 * h) == pytest.approx(state.shortening.value, rel=1e-6)


def test_a_string_turned_round_has_the_same_path(two: LoadPath) -> None:
    state, other = two.at(-84.0)[0].state, load_path(TWO.turned_round, until=-85.0, seeds=1).at(-84.0)[0].state
    assert other.energy.value == pytest.approx(state.energy.value, rel=1e-9)
    assert [gap.end.value for gap in other.gaps] == pytest.approx([1.0 - gap.start.value for gap in state.gaps])


@pytest.mark.parametrize(
    ("problem", "until", "places"),
    [(TWO, -83.0, (0.6,)), (rodwell.Problem(weight=15, ends="ball-ball"), -78.0, (0.0, 1.0))],
)
def test_what_opens_at_buckling_closes_there(problem: rodwell.Problem, until: float, places: tuple[float, ...]) -> None:
    """Gaps at steps close with the slope, and the string is straight at its critical load again; so at ball joints."""
    path = load_path(problem, until=until, unload_to=-60.0, seeds=1)
    assert path.reached
    assert [event.kind for event in path.events] == ["critical", "lift_off", "critical"]
    assert path.events[0].force.value == path.events[2].force.value
    assert path.events[1].s == places


def test_a_gap_opens_at_a_step_of_the_weight() -> None:
    """The lighter half comes off at its end: half the weight presses it on the wall, and the heavier half goes on."""
    problem = rodwell.Problem(weight=15, sections=((0.5, 1.0, 1.0), (0.5, 1.0, 0.5)))
    path = load_path(problem, until=-106.0, seeds=1)
    assert path.reached
    assert [event.kind for event in path.events] == ["critical", "lift_off", "gap_opens"]
    assert path.events[1].force.value == pytest.approx(rodwell.follow(problem).lift_off.force, rel=1e-7)
    assert path.events[2].s == pytest.approx([0.5], abs=1e-12)
    assert all(event.state.certificate.passed for event in path.events[1:])


def test_a_weightless_string_arches_across_the_hole() -> None:
    """It leaves the wall as a whole, at its Euler load, and touches the opposite side, neither at ½ nor at 0.6."""
    problem = TWO.but(weight=0.0)
    path = load_path(problem, until=-31.0, seeds=1)
    assert [(event.kind, event.s != ()) for event in path.events] == [
        ("critical", False), ("lift_off", False), ("touches", True)
    ]  # fmt: skip
    assert path.events[0].force.value == pytest.approx(rodwell.loads_without_wall(problem, 1).forces[0], rel=1e-9)
    state = path.at(-30.0)[0].state
    assert state.certificate.passed
    (point,) = state.point_forces
    assert point.force.value > 0.0
    for gap in state.gaps:
        end = _integrated(state, gap.start.value, gap.end.value)
        x, y, _ = position(state.fine, np.array([gap.end.value]))
        assert end == pytest.approx(
            np.array([x[0, 0], y[0, 0]]) / TWO.clearance, abs=2e-6
        )  # third derivatives at its start
