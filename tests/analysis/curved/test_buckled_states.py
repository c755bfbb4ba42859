"""Buckled states in a curved hole: reference numbers, balance in space, events, ends, and what the places S ≈ S₀ cost.

The state at κ = 0.2, w = 15, F = −200 is that of the project's notes on curved holes, with every cross-section at its
own place; its largest |θ| there is the largest of 4,001 places.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rodwell import Branch, InputError, Problem, critical_loads, diagram, equilibrium, follow
from rodwell.analysis.state import curved_certificate
from rodwell.analysis.state.own_places import lift_off_with_own_places
from rodwell.physics.on_wall import curved


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(Problem(15.0, build=0.2), 1, until=-200.0)


def test_reference_state(branch: Branch) -> None:
    state = branch[-1].own_places
    assert state.number("energy").value == pytest.approx(-1.516491516e-3, rel=5e-10)
    places = np.linspace(0.0, 1.0, 4001)
    assert np.max(np.abs(state.fields(places)["xi2"])) == pytest.approx(0.4300265034, abs=1e-10)
    assert -state.highest_pressure[0] == pytest.approx(35.90317, abs=1e-5)
    assert branch[-1].stability_index == state.stability_index == 0


def test_places_of_the_branch_are_off_by_less_than_the_shortening(branch: Branch) -> None:
    state = branch[-1]
    errors, shortening = state.place_errors, state.number("end_shortening").value
    assert errors["energy"] == pytest.approx(abs(state.number("energy").value + 1.516491516e-3), rel=1e-3)
    assert errors["energy"] < 0.2 * shortening
    assert 0.0 < errors["largest_pressure"] < 0.2 * 200.0 * shortening


@pytest.mark.parametrize(
    ("given", "drop"),
    [
        ({"weight": 40.0, "alpha": 50.0, "build": 0.5}, 30.0),
        ({"weight": 40.0, "alpha": 130.0, "build": -0.3}, 5.0),
        ({"weight": 15.0, "build": 0.4, "ends": "pinned-pinned"}, 20.0),
        ({"weight": 15.0, "alpha": 70.0, "build": 0.4, "ends": "clamped-free"}, 20.0),
        ({"weight": 15.0, "alpha": 70.0, "build": 0.4, "ends": "guided-pinned"}, 20.0),
        ({"weight": 15.0, "build": 0.2, "twist": 3.0}, 20.0),
        ({"weight": 0.0, "build": -0.4, "on_top": True}, 20.0),
    ],
)
def test_forces_and_moments_balance_in_space(given: dict[str, object], drop: float) -> None:
    problem = Problem(**given)  # type: ignore[arg-type]
    first = critical_loads(problem, 1)[0].force
    state = follow(problem, 1, until=first - drop)[-1]
    assert state.converged, state.certificate.residuals
    assert state.certificate.worst < 1e-8


def test_certificate_sees_a_wrong_formula(branch: Branch, monkeypatch: pytest.MonkeyPatch) -> None:
    state = branch[-1].own_places
    strand = curved_certificate.InHole.strand
    for name in ("rod_F1", "rod_F3", "contact_pressure", "omega2"):

        def wrong(self: object, s: np.ndarray, name: str = name) -> dict[str, np.ndarray]:
            found = strand(self, s)  # type: ignore[arg-type]
            return {**found, name: found[name] * (1.0 + 1e-4 * s)}

        monkeypatch.setattr(curved_certificate.InHole, "strand", wrong)
        residuals = curved_certificate.residuals(state.problem, *state.levels[1])
        assert max(residuals.values()) > 1e-7, name


def test_height_of_the_rod_moves_what_drives_it(branch: Branch) -> None:
    """F₁ + ½(ω₂² + ω₃²) − w × height is the same everywhere, at the rod's own places; on the branch, nearly so."""
    own = branch[-1].own_places.fields(51)["tangential_balance"]
    assert np.max(np.abs(own)) < 1e-9
    assert 1e-6 < np.max(np.abs(branch[-1].fields(51)["tangential_balance"])) < 1e-3


def test_end_force_from_energies_along_the_branch() -> None:
    """DE/dF is minus the way of the loaded end, also with places of their own."""
    problem = Problem(15.0, 80.0, build=0.3)
    first = critical_loads(problem, 1)[0].force
    states = [follow(problem, 1, until=first - 10.0 + step)[-1] for step in (-0.01, 0.0, 0.01)]
    for three in (states, [state.own_places for state in states]):
        low, middle, high = (state.number("energy").value for state in three)
        assert (high - low) / 0.02 == pytest.approx(-three[1].number("end_shortening").value * -1.0, rel=1e-3)
        assert middle < 0.0


def test_lift_off_in_a_drop_and_none_where_the_rod_has_left_before() -> None:
    branch = follow(Problem(15.0, build=-0.1), 1)
    lift = branch.lift_off
    assert lift is not None
    assert abs(lift.solution.highest_pressure[0]) < 1e-6
    assert lift.force > -123.173  # a drop takes contact away
    with pytest.raises(InputError, match="has left the wall before"):
        follow(Problem(15.0, build=-0.4), 1)


def test_straight_limit_of_lift_off() -> None:
    lift = follow(Problem(15.0, build=1e-9), 1).lift_off
    assert lift is not None
    assert lift.force == pytest.approx(-123.1730743, rel=3e-7)  # theory of the straight hole


def test_other_parameters_and_what_is_refused(branch: Branch) -> None:
    heavier = follow(branch.problem, start=branch[-1], parameter="weight", until=16.0)
    assert heavier.reached_end
    again = follow(replace(branch.problem, weight=16.0), 1, until=-200.0)
    assert heavier[-1].number("energy").value == pytest.approx(again[-1].number("energy").value, rel=1e-8)
    for parameter in ("alpha", "clearance"):
        with pytest.raises(InputError, match="in a curved hole"):
            follow(branch.problem, start=branch[-1], parameter=parameter, until=0.02)
    with pytest.raises(InputError, match="straight holes only"):
        branch[-1].wall.torque  # noqa: B018


def test_the_model_names_what_it_is_given() -> None:
    assert len(curved.GIVEN) == curved.FIRST + len(curved.FUNCTIONS) * curved.TERMS


@pytest.mark.parametrize(
    "given",
    [
        {"build": 0.2, "walk": 0.3},
        {"walk": -0.3, "ends": "pinned-free"},
        {"build": 0.2, "twist": 2.0, "ends": "clamped-guided"},
    ],
)
def test_rod_lies_beside_the_bottom_where_the_hole_leaves_the_vertical_plane(given: dict[str, object]) -> None:
    """A solved state that moves with the end force; balance in space is the judge, with the hole's own frame."""
    problem = Problem(15.0, 80.0, **given)  # type: ignore[arg-type]
    state = equilibrium(problem, 0.0)
    assert state.stable
    assert state.converged, state.certificate.residuals
    branch = follow(problem, start=state, until=-60.0)
    assert branch.reached_end
    assert branch[-1].converged, branch[-1].certificate.residuals
    assert abs(branch[-1].largest("xi2").value - state.largest("xi2").value) > 1e-4


def test_walk_to_the_other_side_is_the_mirror_image() -> None:
    angles = [equilibrium(Problem(15.0, 80.0, build=0.2, walk=k), -40.0).fields(11)["xi2"] for k in (0.2, -0.2)]
    np.testing.assert_allclose(angles[0], -angles[1], atol=1e-9)
    assert angles[0][5] * 0.2 != 0.0


def test_an_axis_through_points_is_the_arc_that_they_lie_on() -> None:
    arc = Problem(15.0, 70.0, build=0.3)
    assert arc.hole is not None
    points = Problem(15.0, axis=tuple(map(tuple, arc.hole.points(np.linspace(0.0, 1.0, 41)))))
    assert points.alpha == pytest.approx(70.0, abs=1e-8)
    ours, known = (critical_loads(problem, 2).forces for problem in (points, arc))
    np.testing.assert_allclose(ours, known, rtol=1e-6)


def test_rod_that_lies_still_has_no_branch_in_the_end_force() -> None:
    state = equilibrium(Problem(15.0, build=0.2), -50.0)
    assert not np.any(state.fields(11)["xi2"])
    assert state.certificate.passed, state.certificate.residuals
    with pytest.raises(InputError, match="follow a mode"):
        follow(state.problem, start=state, until=-100.0)


def test_parts_of_the_energy_add_up_and_ends_bear_what_acts(branch: Branch) -> None:
    state = branch[-1]
    parts = {name: value.value for name, value in state.energies.items()}
    whole = parts["bending_energy"] + parts["lateral_energy"] + parts["axial_energy"] - parts["end_work"]
    assert whole == pytest.approx(state.number("energy").value, rel=1e-9)
    own = state.own_places
    (first, last) = own.reactions
    assert (first.on, first.s, last.on, last.s) == ("rod", 0.0, "rod", 1.0)
    kr = 0.2 / 1.002
    assert last.force[2] == pytest.approx(-200.0 - kr**2, abs=1e-9)  # F, less what bending the rod with the hole takes
    hole = state.problem.hole
    assert hole is not None
    places = np.array([first.s, own.fields(2)["z"][1]]) + 0.5 - 0.5 / 1.002
    forces = [hole.frame(places[i : i + 1])[0].T @ r.force for i, r in enumerate((first, last))]
    s = np.linspace(0.0, 1.0, 20001)
    fields = own.fields(s)
    angle, axes = fields["xi2"], hole.frame(places[0] + fields["z"])
    d1 = np.cos(angle)[:, None] * axes[:, 0] - np.sin(angle)[:, None] * axes[:, 1]
    wall = -np.trapezoid(fields["contact_pressure"][:, None] * d1, s, axis=0)
    np.testing.assert_allclose(forces[0] + forces[1] + wall, [0.0, 0.0, 15.0], atol=1e-5)


def test_diagram_follows_index_and_mirror_images() -> None:
    result = diagram(Problem(15.0, build=0.2), modes=2, until=-225.0, secondary=False)
    assert [branch.stability_index[-1] for branch in result] == [0, 0]
    changes = [point for branch in result for point in branch.special_points if point.kind == "branch_point"]
    assert [(p.index_before, p.index_after) for p in changes] == [(1, 0)]


def test_lift_off_with_own_places() -> None:
    problem = Problem(15.0, build=0.2)
    lift = follow(problem, 1).lift_off
    assert lift is not None
    own = lift_off_with_own_places(problem, lift.solution.meshes, lift.solution.point)
    again = follow(problem, 1, until=own.value)[-1].own_places
    assert abs(again.highest_pressure[0]) < 1e-6
    assert 0.0 < abs(own.value - lift.force) < 0.2 * abs(lift.force) * lift.solution.number("end_shortening").value


def test_the_torque_works_on_the_turn_of_the_end() -> None:
    """DE/dT₁ at constant end force is minus the turn of the end, less T₁/C, which the energy leaves out."""
    states = []
    for twist in (1.99, 2.0, 2.01):
        problem = Problem(15.0, 80.0, build=0.3, twist=twist)
        states.append(follow(problem, 1, until=critical_loads(Problem(15.0, 80.0, build=0.3), 1)[0].force - 15.0)[-1])
    low, middle, high = (state.number("energy").value for state in states)
    turn = states[1].end_rotation.value - 2.0 / states[1].problem.torsional_stiffness
    assert (high - low) / 0.02 == pytest.approx(-turn, rel=1e-4)
    assert middle < 0.0
