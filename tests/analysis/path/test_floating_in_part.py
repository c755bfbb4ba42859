"""Strings of sections that sink and others that float: closed forms, finite elements beside, limits, what is refused.

The second methods are for small slopes: a dense beam of Hermite elements that finds its contact with both sides of the
hole by itself, and transfer matrices for the load at which the string leaves the vertical plane.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

from rodwell import InputError, NotConvergedError, Problem, critical_loads, follow, load_path
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.state import BRIDGED, ContactState, contact_state
from rodwell.analysis.path.bridging import bridged
from rodwell.problem.sections import sections_from

Array = np.ndarray

FLOATS_BETWEEN = ((0.3, 1, 1), (0.4, 1, -1), (0.3, 1, 1))
UNEVEN = ((0.3, 1, 1), (0.2, 2, -0.5), (0.2, 1, 0.4), (0.3, 1, -1))


def lying(problem: Problem, load: float = 0.0) -> ContactState:
    """How the string lies at a load that compresses it nowhere."""
    found = bridged(RodInHole(problem), load)
    assert found is not None
    return contact_state(found)


def test_between_both_sides_it_has_the_closed_form() -> None:
    """Small slopes, no end force: over a⁴ = 24Δ/w beside the step it goes from a wall to the axis; that bears wa/2.

    From y⁗ = ∓w, y = y′ = y″ = 0 where contact ends, and y″ = 0 at the step, about which the shape is its own image.
    """
    weight, clearance = 3.0, 1e-5
    state = lying(Problem(weight, clearance=clearance, sections=FLOATS_BETWEEN))
    a = (24.0 * clearance / weight) ** 0.25
    places = [point.s.value for point in state.point_forces]
    assert places == pytest.approx([0.3 - a, 0.3 + a, 0.7 - a, 0.7 + a], abs=1e-7)
    assert [point.force.value for point in state.point_forces] == pytest.approx([0.5 * weight * a] * 4, rel=1e-7)
    assert [abs(point.angle) for point in state.point_forces] == pytest.approx([0.0, np.pi, np.pi, 0.0], abs=1e-9)
    heights = state.fields(np.array([0.1, 0.3, 0.5, 0.7, 0.9]))["x"] / clearance
    assert heights == pytest.approx([-1.0, 0.0, 1.0, 0.0, -1.0], abs=1e-6)
    assert state.contact_total.value == pytest.approx(
        weight * (1.0 - 2.0 * a), rel=1e-7
    )  # at steps they bear each other
    assert state.kind == BRIDGED
    assert state.stability_index == 0
    assert state.certificate.passed


def dense_beam(problem: Problem, load: float, elements: int) -> tuple[Array, Array, Array]:
    """Nodes, heights in Δ, and forces of the walls on a clamped beam of small slopes: an active set, dense matrices."""
    s, h = np.linspace(0.0, 1.0, elements + 1), 1.0 / elements
    middle = 0.5 * (s[1:] + s[:-1])
    rod, angle = problem.rod, math.radians(problem.alpha)
    bend = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2], [-12, -6 * h, 12, -6 * h],
                     [6 * h, 2 * h**2, -6 * h, 4 * h**2]]) / h**3  # fmt: skip
    pull = np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -(h**2)], [-36, -3 * h, 36, -3 * h],
                     [3 * h, -(h**2), -3 * h, 4 * h**2]]) / (30 * h)  # fmt: skip
    push = np.array([h / 2, h**2 / 12, h / 2, -(h**2) / 12])
    matrix, force = np.zeros((2 * s.size, 2 * s.size)), np.zeros(2 * s.size)
    above = np.cumsum((rod.weight(middle) * h)[::-1])[::-1] - 0.5 * h * rod.weight(middle)
    for e, (at, hung) in enumerate(zip(middle, above, strict=True)):
        own = slice(2 * e, 2 * e + 4)
        axial = load - problem.weight * math.cos(angle) * hung
        matrix[own, own] += rod.stiffness(np.array([at]))[0] * bend + axial * pull
        force[own] -= problem.weight * math.sin(angle) * rod.weight(np.array([at]))[0] / problem.clearance * push
    side = np.zeros(s.size)
    side[[0, -1]] = -1.0
    for _ in range(200):
        known = {2 * i: side[i] for i in np.flatnonzero(side)} | {1: 0.0, 2 * s.size - 1: 0.0}
        held = np.array(sorted(known))
        free = np.setdiff1d(np.arange(2 * s.size), held)
        u = np.zeros(2 * s.size)
        u[held] = [known[i] for i in held]
        u[free] = np.linalg.solve(matrix[np.ix_(free, free)], force[free] - matrix[np.ix_(free, held)] @ u[held])
        wall = (matrix @ u - force)[::2]
        wanted = np.where(side != 0.0, np.where(-wall * side >= 0.0, side, 0.0), np.where(
            u[::2] < -1.0, -1.0, np.where(u[::2] > 1.0, 1.0, 0.0)))  # fmt: skip
        wanted[[0, -1]] = -1.0
        if np.array_equal(wanted, side):
            return s, u[::2], wall
        side = wanted
    raise AssertionError("the active set did not settle")


@pytest.mark.parametrize(
    ("problem", "touches"),
    [
        (Problem(15.0, clearance=1e-4, sections=((0.5, 1, 1), (0.5, 1, -1))), True),
        (Problem(0.15, clearance=1e-4, sections=((0.5, 1, 1), (0.5, 1, -1))), False),
        (Problem(30.0, 60.0, clearance=1e-4, sections=UNEVEN), True),
    ],
)
def test_it_lies_as_a_beam_of_finite_elements_does(problem: Problem, touches: bool) -> None:
    load = max(problem.heaviest, 0.0)
    state = lying(problem, load)
    s, height, wall = dense_beam(problem, load, 600)
    assert state.fields(s)["x"] / problem.clearance == pytest.approx(height, abs=1e-3)
    assert bool(np.max(height) >= 1.0 - 1e-9) is touches
    assert state.contact_total.value == pytest.approx(float(np.sum(np.abs(wall[1:-1]))) * problem.clearance, rel=5e-3)
    assert state.certificate.passed


def crossing(weight: float, clearance: float, compression: float) -> tuple[float, float]:
    """Length a from where contact ends to the step, and force there, under compression: y⁗ + C y″ = −w.

    y = A (kx − sin kx)/k² − w/C (x²/2 + (cos kx − 1)/k²), k² = C, with y″(a) = 0 and y(a) = Δ.
    """
    k, q = math.sqrt(compression), weight / compression

    def height(a: float) -> float:
        amplitude = q * math.tan(0.5 * k * a)
        return amplitude * (k * a - math.sin(k * a)) / k**2 - q * (0.5 * a**2 + (math.cos(k * a) - 1.0) / k**2)

    still = (24.0 * clearance / weight) ** 0.25
    a = float(brentq(lambda x: height(x) - clearance, 0.2 * still, min(1.5 * still, 0.999 * math.pi / k), xtol=1e-15))
    return a, q * math.tan(0.5 * k * a) * k


def sideways(weight: float, clearance: float, compression: float) -> float:
    """Zero where the string leaves the plane: det of what clamped ends leave of the transfer matrix, small slopes.

    v⁗ + C v″ + f v = 0: the walls hold it by their force over the clearance, below and above alike.
    """
    a, force = crossing(weight, clearance, compression)

    def along(length: float, bed: float) -> Array:
        rates = np.diag([1.0, 1.0, 1.0], 1)
        rates[3, 0], rates[3, 2] = -bed, -compression
        return np.asarray(expm(length * rates))

    point, bed = np.eye(4), weight / clearance
    point[3, 0] = -force / clearance
    over = point @ along(2.0 * a, 0.0) @ point
    whole = along(0.3 - a, bed) @ over @ along(0.4 - 2.0 * a, bed) @ over @ along(0.3 - a, bed)
    return float(np.linalg.det(whole[:2, 2:]))


def test_the_buckling_load_is_that_of_transfer_matrices_for_small_slopes() -> None:
    weight, clearance = 0.3, 1e-6
    loads = np.linspace(300.0, 1200.0, 181)
    values = [sideways(weight, clearance, float(c)) for c in loads]
    first = int(np.flatnonzero(np.diff(np.sign(values)))[0])
    exact = float(brentq(lambda c: sideways(weight, clearance, c), loads[first], loads[first + 1], xtol=1e-12))
    path = load_path(Problem(weight, clearance=clearance, sections=FLOATS_BETWEEN))
    found = path.first("critical")
    assert found is not None
    assert found.met
    assert found.force.value == pytest.approx(-exact, rel=1e-7)
    assert found.meaning == "the string of sections that sink and float buckles sideways"
    assert "where some sections sink and others float" in path.ended_because


def test_a_short_piece_that_floats_changes_little_and_one_without_lift_nothing_of_the_pattern() -> None:
    """Limits: as the part that floats, or its lift, vanishes, the load tends to that of the uniform rod."""
    uniform = critical_loads(Problem(1000.0), 1)[0].force
    misses = []
    for length in (1e-2, 1e-3):
        half = 0.5 * (1.0 - length)
        found = load_path(Problem(1000.0, sections=((half, 1, 1), (length, 1, -1), (half, 1, 1)))).first("critical")
        assert found is not None
        misses.append(abs(found.force.value / uniform - 1.0))
    assert misses == sorted(misses, reverse=True)
    assert misses[-1] < 5e-3


def test_upside_down_is_the_other_kind_of_string() -> None:
    """Lift for weight: the same sections with ``floats`` lie on the other side, and nothing else is another."""
    problem = Problem(3000.0, 60.0, sections=UNEVEN)
    other = problem.but(floats=True, alpha=120.0)
    one, two = (load_path(each, until=-900.0) for each in (problem, other))
    assert [event.force.value for event in one.events] == [event.force.value for event in two.events]
    assert one.events[-1].kind == "critical"
    hung = (0.0, -0.3, -0.22, -0.32, -0.02)  # weight above the ends of the sections, from s = 1 down
    assert problem.heaviest == 0.0
    assert problem.but(alpha=120.0).heaviest == pytest.approx(-1500.0 * min(hung), abs=1e-9)


@pytest.mark.parametrize(
    ("sections", "match"),
    [
        (((0.5, 1, -1), (0.5, 1, -2)), "floats=True"),
        (((0.5, 1, (1.0, -1.0)), (0.5, 1, 1)), "must not change its sign within a section"),
    ],
)
def test_what_is_no_such_string_is_refused(sections: tuple[tuple[object, ...], ...], match: str) -> None:
    with pytest.raises(InputError, match=match):
        Problem(15.0, sections=sections)  # type: ignore[arg-type]


def test_what_is_computed_of_rods_on_the_wall_is_refused() -> None:
    problem = Problem(15.0, sections=sections_from("0.5:1,0.5:1:-1"))  # type: ignore[arg-type]
    for compute in (lambda: critical_loads(problem), lambda: follow(problem, until=-200.0)):
        with pytest.raises(InputError, match="must all sink or all float"):
            compute()
    with pytest.raises(InputError, match="must have one sign of weight in a hole that leaves the vertical plane"):
        problem.but(walk=0.2)
    with pytest.raises(InputError, match="no lateral weight lays the string on the walls"):
        load_path(problem.but(alpha=0.0))
    with pytest.raises(InputError, match="where some sections sink and others float"):
        load_path(problem.but(twist=1.0), until=-30.0)


def test_an_end_that_slides_around_the_wall_does_not_stay_at_the_bottom_with_a_section_that_floats() -> None:
    """A pendulum the wrong way up: nothing holds it, however short the part of it that floats and however light."""
    problem = Problem(1800.0, 34.0, sections=((0.5, 1, 1), (0.5, 1, -0.7)))
    with pytest.raises(NotConvergedError, match="rolls up with the section beside it"):
        load_path(problem.but(ends=("clamped", "free")))
    assert load_path(problem.but(ends=("clamped", "pinned"))).first("critical") is not None
    turned = problem.but(ends=("free", "clamped"))  # the end that sinks may slide
    assert load_path(turned).legs[0].runs[0][0].solved.index == 0
