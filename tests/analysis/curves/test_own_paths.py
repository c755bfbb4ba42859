"""Branches and curves along paths of one's own, on which several parameters vary; and in Poisson's ratio."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from rodwell import (
    Branch,
    InputError,
    ParameterPath,
    Problem,
    Solution,
    coil,
    critical_curves,
    critical_loads,
    diagram,
    follow,
    lift_off_curve,
    save_branch,
    special_curve,
)

ROD = Problem(15.0, 90.0)


def steps(t: float) -> dict[str, float]:
    """Weight, inclination and end force together: no two of them in proportion."""
    return {"weight": 15.0 + 5.0 * t, "alpha": 90.0 - 40.0 * t * t, "force": -118.0 - 20.0 * math.sin(t)}


@pytest.fixture(scope="module")
def start() -> Solution:
    return follow(ROD, until=-118.0)[-1]


@pytest.fixture(scope="module")
def branch(start: Solution) -> Branch:
    return follow(ROD, start=start, parameter=steps)


def one_by_one(start: Solution, t: float) -> Solution:
    """The same state by another way: one parameter after the other."""
    state = start
    for name in ("force", "weight", "alpha"):
        state = follow(state.problem, start=state, parameter=name, until=steps(t)[name])[-1]
    return state


@pytest.mark.parametrize("t", [0.37, 1.0])
def test_states_on_a_path_are_those_reached_one_parameter_after_the_other(
    branch: Branch, start: Solution, t: float
) -> None:
    mine, other = branch.at(t), one_by_one(start, t)
    assert mine.problem == ROD.but(weight=15.0 + 5.0 * t, alpha=90.0 - 40.0 * t * t)
    assert mine.force == pytest.approx(other.force, rel=1e-13)
    for name in ("energy", "end_shortening", "omega2_at_1", "largest_pressure"):
        one, two = mine.number(name), other.number(name)
        assert one.value == pytest.approx(two.value, abs=one.error + two.error), name
    assert mine.stability_index == other.stability_index
    assert mine.converged


def test_functions_and_lines_by_name_make_the_same_path(branch: Branch, start: Solution) -> None:
    named = ParameterPath(
        {"weight": (15.0, 20.0), "alpha": lambda t: 90.0 - 40.0 * t**2, "force": lambda t: -118.0 - 20.0 * math.sin(t)},
        name="share",
    )
    other = follow(ROD, start=start, parameter=named)
    one, two = other[-1].number("energy"), branch[-1].number("energy")
    assert one.value == pytest.approx(two.value, abs=one.error + two.error)
    assert repr(other).endswith("share = 0 … 1>")


def test_lift_off_on_a_path_is_that_of_the_rod_there(branch: Branch) -> None:
    """As the rod gets heavier and steeper and the force grows, it lifts off: at the lift-off load of the rod there."""
    lift = branch.labelled("lift_off 1")
    there = follow(lift.solution.problem).labelled("lift_off 1")
    slope = 20.0  # of the force in t, at most
    assert lift.force == pytest.approx(there.force, abs=there.error + 10.0 * slope * lift.error + 1e-8)
    assert lift.s == pytest.approx(there.s, abs=1e-6)


def test_a_fold_on_a_path_is_one_of_the_rod_there() -> None:
    """The fold of w = 15, α = 89° at −358.8964174, met on a path on which the clearance grows too."""
    rod = Problem(15.0, 89.0)
    start = follow(rod, until=-340.0).states_at(-340.0)[0]
    along = follow(rod, start=start, parameter={"force": (-340.0, -380.0), "clearance": (0.01, 0.0101)})
    fold = along.labelled("fold 1")
    there = follow(fold.solution.problem, until=-380.0)
    nearest = min((p for p in there.special_points if p.kind == "fold"), key=lambda p: abs(p.force - fold.force))
    assert fold.force == pytest.approx(nearest.force, abs=nearest.error + 40.0 * fold.error + 1e-8)


def test_a_special_point_on_a_path_is_a_start_on_it(branch: Branch) -> None:
    lift = branch.labelled("lift_off 1")
    further = follow(lift.solution.problem, start=lift, parameter=branch.parameter, until=1.0)
    assert further.values[0] == lift.value
    one, two = further[-1].number("energy"), branch[-1].number("energy")
    assert one.value == pytest.approx(two.value, abs=one.error + two.error)


def test_a_rod_that_is_given_weight_loses_its_symmetry() -> None:
    """A weightless rod looks the same from both ends, an inclined one with weight does not."""
    light = Problem(0.0, 60.0)
    start = follow(light, until=-110.0)[-1]
    heavy = follow(light, start=start, parameter="weight", until=10.0)[-1]
    other = follow(Problem(10.0, 60.0), until=-110.0)[-1]
    one, two = heavy.number("energy"), other.number("energy")
    assert heavy.converged
    assert one.value == pytest.approx(two.value, abs=one.error + two.error)


def test_curves_over_a_path_are_those_of_the_rods_on_it() -> None:
    along = {"weight": lambda t: 10.0 + 20.0 * t * t, "alpha": lambda t: 80.0 - 30.0 * t}
    curve = lift_off_curve(Problem(1.0, 90.0), along, (0.0, 1.0))
    assert curve.ended_because == "end"
    assert curve.converged
    for point in curve.points[:: len(curve) // 3]:
        t = point.x
        rod = Problem(10.0 + 20.0 * t * t, 80.0 - 30.0 * t)
        lift = follow(rod).labelled("lift_off 1")
        assert point.value == pytest.approx(lift.force, abs=point.error + lift.error + 1e-9)
    assert set(curve.variables()) >= {"t", "weight", "alpha", "force"}
    assert curve.as_dict()["points"][-1]["at"] == {"weight": 30.0, "alpha": 50.0}


def test_critical_loads_over_a_path_switch_where_they_do_over_the_weight() -> None:
    """The double point of a horizontal rod over γ, met on a path on which γ is no linear function of t."""
    over_weight = critical_curves(ROD, "weight", (55.0, 65.0), modes=2)[0]
    over_path = critical_curves(ROD, {"weight": lambda t: 55.0 + 10.0 * t**3}, (0.0, 1.0), modes=2)[0]
    (known,), (mark,) = over_weight.marks, over_path.marks
    assert 55.0 + 10.0 * mark.x**3 == pytest.approx(known.x, rel=1e-9)
    assert mark.value == pytest.approx(known.value, rel=1e-9)
    tilted = critical_curves(ROD, {"weight": (10.0, 30.0), "alpha": (90.0, 60.0)}, (0.0, 1.0), modes=2)[0]
    last = critical_loads(Problem(30.0, 60.0), 1)[0]
    assert tilted.values[-1] == pytest.approx(last.force, abs=last.error + tilted.errors[-1])


def test_a_fold_is_followed_along_a_path() -> None:
    fold = follow(Problem(15.0, 89.0), until=-380.0).labelled("fold 1")
    curve = special_curve(fold, {"weight": (15.0, 16.0), "alpha": (89.0, 88.0)}, 1.0)
    there = follow(Problem(16.0, 88.0), until=-400.0)
    folds = [p for p in there.special_points if p.kind == "fold"]
    nearest = min(folds, key=lambda p: abs(p.force - curve.values[-1]))
    assert curve.values[-1] == pytest.approx(nearest.force, abs=nearest.error + curve.errors[-1] + 1e-9)


def test_poissons_ratio_twists_the_rod_and_moves_nothing() -> None:
    """The end turns by T₁(1 + ν) more than the shape makes it; states do not depend on ν."""
    rod = Problem(15.0, 90.0, twist=2.0)
    start = follow(rod, until=-115.0)[-1]
    branch = follow(rod, start=start, parameter="poisson", until=0.5)
    first, last = branch[0], branch[-1]
    assert last.problem.poisson == 0.5
    assert last.point.fine.c == pytest.approx(first.point.fine.c, abs=1e-12)
    turned = last.end_rotation.value - first.end_rotation.value
    assert turned == pytest.approx(2.0 * 0.2, rel=1e-9)
    soft = follow(
        rod.but(torsion=0.5), start=follow(rod.but(torsion=0.5), until=-115.0)[-1], parameter="torsion", until=0.25
    )
    assert soft[-1].end_rotation.value - soft[0].end_rotation.value == pytest.approx(4.0, rel=1e-9)


def test_a_diagram_goes_on_along_a_line() -> None:
    found = diagram(
        ROD, modes=1, until=-118.0, secondary=False, then=({"weight": (15.0, 16.0), "alpha": (90.0, 85.0)}, 1.0)
    )
    further = found.branches[-1]
    assert further.name == "mode 1, in weight and alpha"
    assert further[-1].problem == ROD.but(weight=16.0, alpha=85.0)
    data = found.as_dict()["branches"][-1]["special_points"][-1]
    assert (data["parameter"], data["value"], data["at"]) == ("t", 1.0, {"weight": 16.0, "alpha": 85.0})
    assert {"weight", "alpha"} <= set(further.dataset.variables)


@pytest.mark.parametrize(
    ("along", "said"),
    [
        ({"wieght": (15.0, 20.0)}, "did you mean 'weight'"),
        ({"weight": (15.0, 20.0, 25.0)}, "must be a function of t, or two numbers"),
        ({}, "must name at least one number"),
        ({"weight": lambda t: 15.0 + abs(t - 0.3) - 0.3}, "no smooth function of t"),
        ({"weight": (16.0, 20.0)}, r"weight = 16 at t = 0, 15.0 there"),
        ({"weight": (15.0, -20.0)}, r"weight = .*at t = "),
        ({"weight": lambda t: 15.0 / (1.0 - t) if t < 1.0 else math.inf}, "must be finite"),
        ({"force": (-100.0, -120.0)}, r"force = -100 at t = 0"),
        (lambda t: 15.0 + t, "must be the same numbers by name"),
        (7, "must be a name, a mapping of functions of t"),
    ],
)
def test_paths_that_are_none_are_refused(start: Solution, along: object, said: str) -> None:
    with pytest.raises(InputError, match=said):
        follow(ROD, start=start, parameter=along)  # type: ignore[arg-type]


def test_what_does_not_go_with_a_path_is_said(branch: Branch, start: Solution, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="within the limits of the path"):
        follow(ROD, start=start, parameter=steps, until=1.5)
    with pytest.raises(InputError, match="needs a state to start from"):
        follow(ROD, parameter=steps)
    with pytest.raises(InputError, match="functions, which no file keeps"):
        save_branch(branch, tmp_path / "path.nc")
    with pytest.raises(InputError, match="over = 'force'"):
        lift_off_curve(ROD, steps, (0.0, 1.0))
    wound = coil(Problem(15.0, 90.0, turns=1), until=-120.0)
    with pytest.raises(InputError, match="a coiled rod cannot be followed in it"):
        follow(wound.problem, start=wound[-1], parameter={"clearance": (0.01, 0.02)})
    with pytest.raises(InputError, match=r"^limits"):
        ParameterPath({"weight": (1.0, 2.0)}, limits=(1.0, 1.0))
    with pytest.raises(InputError, match=r"^name = 'weight'"):
        ParameterPath({"weight": (1.0, 2.0)}, name="weight")
