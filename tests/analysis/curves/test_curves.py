"""Curves in two parameters: against closed forms, single problems solved afresh, and the paper."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell import (
    Curve,
    InputError,
    NotConvergedError,
    Problem,
    critical_curves,
    critical_loads,
    follow,
    lift_off_curve,
    secondary_curve,
    twist_curve,
)
from rodwell.analysis.discrete.measures import Measured

PI = np.pi

TABLE_1 = [
    (1, 3, 1), (2, 4, 1), (1, 5, 2), (3, 5, 1), (2, 6, 2), (4, 6, 1), (1, 7, 3), (3, 7, 2), (5, 7, 1), (2, 8, 3),
    (4, 8, 2), (6, 8, 1), (1, 9, 4), (3, 9, 3), (5, 9, 2), (7, 9, 1), (2, 10, 4), (4, 10, 3), (6, 10, 2), (8, 10, 1),
]  # fmt: skip
"""n, m and the pair of modes that switches: the 20 rows of the paper's Table 1."""


@pytest.fixture(scope="module")
def table() -> tuple[Curve, ...]:
    return critical_curves(Problem(0.0), "weight", (0.0, 6300.0), modes=8)


def test_all_rows_of_table_1(table: tuple[Curve, ...]) -> None:
    """Double points γ = n²m²π⁴Δ at −F = (n² + m²)π², (78): closed form, which the curves do not use."""
    marks = {mark.x: mark for curve in table for mark in curve.marks}.values()
    for n, m, pair in TABLE_1:
        weight, force = n**2 * m**2 * PI**4 * 0.01, -(n**2 + m**2) * PI**2
        mark = min(marks, key=lambda item: abs(item.x - weight) + abs(item.value - force))
        assert mark.kind == "double_point"
        assert mark.x == pytest.approx(weight, rel=1e-11, abs=mark.x_error)
        assert mark.value == pytest.approx(force, rel=1e-11, abs=mark.error)
        assert mark.note == f"modes {2 * pair - 1} and {2 * pair} switch"


def test_critical_curves_agree_with_single_problems(table: tuple[Curve, ...]) -> None:
    for i in (0, 40, -1):
        x = table[0].x[i]
        loads = critical_loads(Problem(x), 8).forces
        assert sorted((c.values[i] for c in table), reverse=True) == pytest.approx(loads, rel=1e-11)


def test_critical_curves_are_resolved_between_their_points(table: tuple[Curve, ...]) -> None:
    """Cubics through the points meet loads computed in between."""
    from scipy.interpolate import CubicSpline

    for x in (3.3, 70.0, 1000.0):
        loads = critical_loads(Problem(x), 8).forces
        between = sorted((float(CubicSpline(c.x, c.values)(x)) for c in table), reverse=True)
        assert between == pytest.approx(loads, rel=1e-4)


@pytest.mark.parametrize("over", ["weight", "alpha", "clearance"])
def test_slopes_are_those_of_the_loads(over: str) -> None:
    """Hellmann–Feynman against differences of loads, by the node spacing that smoothness asks for."""
    limits = {"weight": (20.0, 20.2), "alpha": (60.0, 60.2), "clearance": (0.01, 0.0101)}[over]
    problem = Problem(20.0, alpha=60.0)
    curves = critical_curves(problem, over, limits, modes=2)
    from rodwell.analysis.curves.critical import _LoadsOverRange

    node = _LoadsOverRange(problem, over, 2, 1e-8, split=False).node(0.5 * sum(limits))
    for k, curve in enumerate(curves, start=1):
        difference = (curve.values[-1] - curve.values[0]) / (curve.x[-1] - curve.x[0])
        assert node.loads[0, k].slope == pytest.approx(difference, rel=1e-3)


def test_loads_veer_on_an_inclined_cylinder() -> None:
    """Just off the horizontal the first two loads come close near γ = 8.77 but do not meet."""
    curves = critical_curves(Problem(0.0, alpha=89.5), "weight", (5.0, 12.0), modes=2)
    mark = next(mark for mark in curves[0].marks if mark.kind == "veering")
    assert mark.x == pytest.approx(9 * PI**4 * 0.01, abs=0.05)
    loads = critical_loads(Problem(mark.x, alpha=89.5), 2).forces
    gap = loads[0] - loads[1]
    assert 0.0 < gap < 1.0
    for x in (mark.x - 0.05, mark.x + 0.05):
        beside = critical_loads(Problem(x, alpha=89.5), 2).forces
        assert beside[0] - beside[1] > gap


def test_critical_loads_do_not_depend_on_twist() -> None:
    curves = critical_curves(Problem(15.0), "twist", (-5.0, 5.0), modes=2)
    assert all(np.ptp(curve.values) < 1e-11 * abs(curve.values[0]) for curve in curves)


@pytest.mark.parametrize(
    ("over", "limits"),
    [("weight", (15.0, 40.0)), ("alpha", (90.0, 20.0)), ("clearance", (0.01, 0.015)), ("twist", (0.0, -3.0))],
)  # fmt: skip
def test_lift_off_curves_agree_with_single_branches(over: str, limits: tuple[float, float]) -> None:
    curve = lift_off_curve(Problem(15.0), over, limits)
    assert curve.converged
    assert curve.ended_because == "end"
    assert (curve.x[0], curve.x[-1]) == limits
    for point in curve.points[5 :: len(curve) // 3]:
        lift = follow(Problem(15.0).but(**{over: point.x})).lift_off
        assert lift is not None
        assert abs(point.value - lift.force) <= point.error + lift.error
        assert point.s == pytest.approx(lift.s, abs=1e-6)


def test_lift_off_begins_with_buckling_where_the_weight_does() -> None:
    curve = lift_off_curve(Problem(0.0), "weight", (0.0, 10.0))
    assert curve.values[0] == pytest.approx(-4.0 * PI**2, rel=1e-11)
    assert np.all(np.diff(curve.values) < 0.0)
    down = lift_off_curve(Problem(15.0), "alpha", (40.0, 0.0))
    assert down.values[-1] == pytest.approx(critical_loads(Problem(15.0, alpha=0.0), 1)[0].force, rel=1e-11)


def test_the_touching_place_switches_where_both_places_touch() -> None:
    curve = lift_off_curve(Problem(15.0), "weight", (16.0, 20.0))
    (mark,) = curve.marks
    assert mark.kind == "switch"
    before, after = (follow(Problem(mark.x + d)).lift_off for d in (-1e-3, 1e-3))
    assert before is not None
    assert after is not None
    assert len(before.s) == 1
    assert len(after.s) == 2
    at = follow(Problem(mark.x)).lift_off
    assert at is not None
    p = at.solution.fields(np.array([0.5, after.s[0]]))["contact_pressure"]
    assert p == pytest.approx([0.0, 0.0], abs=1e-5)


def crossings(weight: float, until: float) -> int:
    """How often the largest contact pressure changes its sign on the first branch at α = 60°, by following it in F."""
    branch = follow(Problem(weight, alpha=60.0), until=until)
    return int(np.sum(np.diff(np.sign([state.number(Measured.P_MAX).value for state in branch])) != 0.0))


def test_lift_off_curve_turns_back_where_modes_exchange() -> None:
    """Fig. 6(a) near γ = 10.55: an S with two folds and a corner, told from states at fixed weights on either side."""
    up = lift_off_curve(Problem(0.0, alpha=60.0), "weight", (9.5, 11.5))
    down = lift_off_curve(Problem(0.0, alpha=60.0), "weight", (11.5, 9.5))
    assert up.ended_because == down.ended_because == "end"
    assert up.converged
    assert down.converged
    assert [mark.kind for mark in up.marks] == ["turn", "turn", "switch"]
    for one, other in zip(up.marks, down.marks[::-1], strict=True):
        assert one.x == pytest.approx(other.x, abs=one.x_error + other.x_error)
    first, second, corner = up.marks
    assert second.x < corner.x < first.x
    beside = [second.x - 1e-3, second.x + 4e-4, corner.x + 1e-3, first.x - 1e-3, first.x + 1e-3]
    assert [crossings(weight, -108.0) for weight in beside] == [1, 3, 3, 3, 1]
    for weight, value in ((9.6, up), (first.x - 1e-3, up), (first.x + 1e-3, up), (11.4, down)):
        lift = follow(Problem(weight, alpha=60.0)).lift_off
        assert lift is not None
        assert np.min(np.hypot(value.x - weight, value.values - lift.force)) < 0.1
    point = next(p for p in up.points if p.x == corner.x)
    assert point.solution is not None
    places = np.array([0.2022197, 0.5489509])
    assert point.solution.fields(places)["contact_pressure"] == pytest.approx([0.0, 0.0], abs=1e-4)


def test_lift_off_curve_does_not_leap_to_the_other_mode() -> None:
    """Close to the horizontal the first two modes nearly cross; the curve stays on the branch that leaves first."""
    curve = lift_off_curve(Problem(0.0, alpha=89.9), "weight", (8.0, 18.0))
    assert curve.ended_because == "end"
    lift = follow(Problem(18.0, alpha=89.9)).lift_off
    assert lift is not None
    assert abs(curve.values[-1] - lift.force) <= curve.errors[-1] + lift.error
    level = [follow(Problem(weight)).lift_off for weight in (17.702, 17.703)]  # where the horizontal rod's place jumps
    assert [len(at.s) for at in level if at is not None] == [1, 2]
    assert curve.marks[-1].x == pytest.approx(17.7027, abs=0.01)


def test_secondary_curve_ends_at_the_double_point() -> None:
    """Just after mode switching there is a secondary bifurcation along the first branch (paper, section 4.1.2)."""
    curve = secondary_curve(Problem(15.0), (15.0, 8.0))
    assert curve.values[0] == pytest.approx(-362.629366, abs=1e-6)
    assert curve.ended_because == "the buckled rod becomes straight"
    assert curve.x[-1] == pytest.approx(9 * PI**4 * 0.01, abs=1e-4)
    assert curve.values[-1] == pytest.approx(-10 * PI**2, abs=0.01)
    middle = curve.points[10]
    points = follow(Problem(middle.x), until=middle.value - 10.0).special_points
    found = next(p for p in points if p.kind == "branch_point")
    assert abs(middle.value - found.force) <= middle.error + found.error


def test_the_second_mode_loses_its_symmetry_where_the_end_curvature_vanishes() -> None:
    """The exact fact: translation along the cylinder makes every zero of ω₂(1) a branch point."""
    curve = secondary_curve(Problem(15.0), (15.0, 20.0), mode=2)
    assert curve.values[0] == pytest.approx(-164.784232, abs=1e-6)
    assert curve.converged
    for point in curve.points[:: len(curve) // 3]:
        assert point.solution is not None
        size = np.max(np.abs(point.solution.fields()["omega2"]))
        assert abs(point.solution.number(Measured.OMEGA2_1).value) < 1e-8 * size


def test_twist_curve_agrees_with_single_problems() -> None:
    from rodwell import torsion

    curve = twist_curve(Problem(30.0), (30.0, 24.0))
    assert curve.quantity == "twist"
    assert curve.converged
    last = curve.points[-1]
    single = torsion(Problem(last.x)).again
    assert single is not None
    assert abs(last.value - single.value) <= last.error + single.error


def test_twist_curve_turns_the_corner_of_the_load_without_twist() -> None:
    from rodwell import torsion

    curve = twist_curve(Problem(0.0), (18.0, 17.4), mirror=True)
    assert curve.ended_because == "end"
    assert curve.converged
    (mark,) = curve.marks
    assert mark.kind == "switch"
    assert [torsion(Problem(mark.x + d), mirror=True).prepared.s[0] for d in (-1e-3, 1e-3)] == pytest.approx(
        [0.5, 0.1678], abs=1e-3
    )
    single = torsion(Problem(17.4), mirror=True).again
    assert single is not None
    assert abs(curve.values[-1] - single.value) <= curve.errors[-1] + single.error


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: lift_off_curve(Problem(15.0), "length", (1.0, 2.0)), "over = 'length'"),
        (lambda: lift_off_curve(Problem(15.0), "weight", (1.0, 1.0)), "must differ"),
        (lambda: lift_off_curve(Problem(15.0), "weight", (-1.0, 1.0)), "weight = -1.0"),
        (lambda: critical_curves(Problem(15.0), "weight", (1.0,)), "start and end"),
        (lambda: critical_curves(Problem(15.0), "weight", (1.0, 2.0), modes=0), "modes = 0"),
        (lambda: secondary_curve(Problem(15.0, alpha=60.0), (15.0, 20.0)), "alpha = 60"),
        (lambda: secondary_curve(Problem(15.0), (80.0, 90.0), over="alpha"), "over = 'alpha'"),
    ],
)
def test_bad_ranges(call, message: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match=message):
        call()


def test_a_curve_that_cannot_start_says_why() -> None:
    with pytest.raises(NotConvergedError, match="has 0 secondary"):
        secondary_curve(Problem(5.0), (5.0, 6.0))
    with pytest.raises(NotConvergedError, match="either sign"):
        twist_curve(Problem(5.0), (5.0, 6.0))
