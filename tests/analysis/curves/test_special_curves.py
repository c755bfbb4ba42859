"""Special points followed in a second parameter."""

from __future__ import annotations

from contextlib import suppress
from itertools import combinations

import pytest

from rodwell import Branch, InputError, Problem, Solution, follow, lift_off_curve, secondary_curve, special_curve
from rodwell.analysis.curves.curve import Curve, CurvePoint
from rodwell.analysis.curves.points import CurveStart, PlanePoint
from rodwell.analysis.curves.secant import CurveLostError
from rodwell.analysis.curves.zeros import Folding

SHORTER = 5e-4


def shortened(state: Solution) -> float:
    return state.number("end_shortening").value - SHORTER


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(Problem(15.0, 89.0), until=-500.0, events={"shorter": shortened})


def test_folds_end_in_a_cusp(branch: Branch) -> None:
    """The folds at −358.896 and −165.002 of w = 15, α = 89° are two arms of one curve, which meet in a cusp."""
    curve = special_curve(branch.labelled("fold 1"), "alpha", 20.0)
    (cusp,) = [mark for mark in curve.marks if mark.kind == "cusp"]
    assert curve.converged
    assert cusp.x == pytest.approx(38.4303074, abs=1e-6)
    back = min(curve.points[-3:], key=lambda point: abs(point.x - 89.0))
    state = follow(Problem(15.0, back.x), until=-500.0)
    folds = [p.force for p in state.special_points if p.kind == "fold"]
    assert min(abs(force - back.value) for force in folds) < 1e-6


def test_beyond_its_cusp_a_branch_has_no_folds_and_before_it_has_two(branch: Branch) -> None:
    """The cusp by a second method: branches on either side of it, followed by themselves."""
    curve = special_curve(branch.labelled("fold 1"), "alpha", 20.0)
    (cusp,) = [mark for mark in curve.marks if mark.kind == "cusp"]
    for alpha, count in ((cusp.x - 0.05, 0), (cusp.x + 0.05, 2)):
        near = follow(Problem(15.0, alpha), until=cusp.value - 5.0)
        assert [p.kind for p in near.special_points].count("fold") == count


def test_a_fold_followed_is_the_fold_of_the_branch_there(branch: Branch) -> None:
    curve = special_curve(branch.labelled("fold 2"), "weight", 18.0)
    assert curve.ended_because == "end"
    last = curve.points[-1]
    other = follow(Problem(18.0, 89.0), until=-500.0)
    folds = [p for p in other.special_points if p.kind == "fold"]
    nearest = min(folds, key=lambda p: abs(p.force - last.value))
    assert nearest.force == pytest.approx(last.value, abs=nearest.error + last.error + 1e-9)


def test_lift_off_and_loss_of_symmetry_as_the_curves_of_their_own(branch: Branch) -> None:
    curve = special_curve(branch.labelled("lift_off 1"), "weight", 17.0)
    other = lift_off_curve(Problem(15.0, 89.0), "weight", (15.0, 17.0))
    assert curve.values[-1] == pytest.approx(other.values[-1], abs=curve.errors[-1] + other.errors[-1])
    symmetric = follow(Problem(15.0), until=-400.0)
    curve = special_curve(symmetric.labelled("branch_point 1"), "weight", 16.0)
    other = secondary_curve(Problem(15.0), (15.0, 16.0))
    assert curve.values[-1] == pytest.approx(other.values[-1], abs=curve.errors[-1] + other.errors[-1])


def test_an_event_of_ones_own_is_followed(branch: Branch) -> None:
    curve = special_curve(branch.labelled("shorter 1"), "alpha", 80.0, function=shortened)
    assert curve.ended_because == "end"
    for point in curve.points[:: len(curve) // 3]:
        assert point.solution is not None
        assert abs(shortened(point.solution)) < 1e-11


@pytest.mark.parametrize("ends", ["free-clamped", "pinned-guided"])
def test_lift_off_from_any_ends(ends: str) -> None:
    rod = Problem(30.0, 70.0, ends=ends)  # type: ignore[arg-type]
    lift = follow(rod).labelled("lift_off 1")
    curve = special_curve(lift, "alpha", 72.0)
    there = follow(rod.but(alpha=72.0)).labelled("lift_off 1")
    assert curve.values[-1] == pytest.approx(there.force, abs=there.error + curve.errors[-1] + 1e-9)


def test_what_cannot_be_followed_is_refused(branch: Branch) -> None:
    with pytest.raises(InputError, match=r"^point = 'critical': must be of kind"):
        special_curve(branch.labelled("critical 1"), "weight", 20.0)
    with pytest.raises(InputError, match=r"^point = 'shorter'.*needs function"):
        special_curve(branch.labelled("shorter 1"), "weight", 20.0)
    with pytest.raises(InputError, match=r"^over = 'angle'"):
        special_curve(branch.labelled("fold 1"), "angle", 20.0)
    symmetric = follow(Problem(15.0), until=-400.0)
    with pytest.raises(InputError, match="leaves no symmetry"):
        special_curve(symmetric.labelled("branch_point 1"), "alpha", 80.0)
    other = follow(Problem(15.0, 89.0), start=branch[5], parameter="weight", until=16.0)
    with pytest.raises(InputError, match="a branch in the end force"):
        special_curve(other.special_points[-1], "alpha", 80.0)


def test_from_a_fold_a_branch_goes_on_as_it_did() -> None:
    """At the fold −358.8964174 of γ = 15, α = 89° both arms lead up: the one behind it is followed, of index 1."""
    problem = Problem(15.0, 89.0)
    branch = follow(problem, until=-380.0)
    fold = branch.labelled("fold 1")
    on = follow(problem, start=fold, until=-340.0)
    assert on.reached_end
    assert [point.kind for point in on.special_points] == ["end"]
    assert set(on.stability_index[1:]) == {1}
    behind = max(branch.states_at(-340.0), key=lambda state: state.number("energy").value)
    assert on[-1].number("energy").value == pytest.approx(behind.number("energy").value, rel=1e-9)


def test_the_side_of_a_fold_without_states_is_told() -> None:
    problem = Problem(15.0, 89.0)
    fold = follow(problem, until=-380.0).labelled("fold 1")
    with pytest.raises(
        InputError, match=r"no states beside its fold at force = -358\.8964174.*values above it"
    ) as caught:
        follow(problem, start=fold, until=-360.0)
    assert caught.value.field == "until"


FOLDS_BY_THE_CUSP = Problem(15.0, 38.6)
"""Two folds, 0.17 degrees from where they meet."""


def by_the_cusp(rtol: float) -> Curve:
    """The curve of the folds through the cusp, to a tolerance."""
    fold = follow(FOLDS_BY_THE_CUSP, until=-115.0, rtol=rtol).labelled("fold 1")
    return special_curve(fold, "alpha", 38.0)


def error_at(point: CurvePoint, other: Curve) -> tuple[float, float]:
    """By how much a point misses the fold at its inclination, on the meshes of another curve, and what is allowed."""
    found = []
    for near in sorted(other.points, key=lambda q: 1e4 * (q.x - point.x) ** 2 + (q.value - point.value) ** 2)[:3]:
        assert near.solution is not None
        start = CurveStart(near.x, near.solution, along=True)
        with suppress(CurveLostError):
            place = PlanePoint(point.x, near.value)
            found.append(Folding(FOLDS_BY_THE_CUSP, "alpha").solve(start.meshes, start.guess, place))
    if not found:  # on the other side of the other curve's cusp
        (cusp,) = other.marks
        return abs(point.x - cusp.x), point.x_error + cusp.x_error
    exact = min(found, key=lambda one: abs(one.spot.value - point.value))
    slope = (point.value + 104.849639) / (point.x - 38.4303074) if abs(point.x - 38.4303074) > 1e-3 else 4.29
    return abs(exact.spot.value - point.value), point.error + exact.error + abs(slope) * point.x_error


def test_errors_hold_beside_a_cusp_and_where_round_off_is_left() -> None:
    """Against the same folds on meshes for another tolerance: the load at a place, and the place of the cusp itself."""
    curves = {rtol: by_the_cusp(rtol) for rtol in (1e-5, 1e-8, 1e-10)}
    for rtol, other in ((1e-5, 1e-8), (1e-10, 1e-8)):
        for point in curves[rtol].points[::3]:
            missed, allowed = error_at(point, curves[other])
            assert missed <= allowed + 1e-12, (rtol, point.x, missed, allowed)
    cusps = [mark for curve in curves.values() for mark in curve.marks]
    assert [cusp.kind for cusp in cusps] == ["cusp"] * 3
    for one, two in combinations(cusps, 2):
        assert abs(one.x - two.x) <= one.x_error + two.x_error
        assert abs(one.value - two.value) <= one.error + two.error
    assert curves[1e-8].converged
    assert not curves[1e-10].converged  # said so, since round-off leaves less
