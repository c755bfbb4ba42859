"""Branches that leave the wall where they lift off, and go on off it: against loads of theory-2 and laws of mechanics.

The loads are those of the two independent programs of the theory (see docs/off-wall.md): partial contact up to the
limit point, the helix on its way back, which hang together by an unstable part.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import rodwell
from rodwell import InputError, Problem

HORIZONTAL = Problem(15.0, 90.0)
GAPS, LIMIT, HELIX_LIMIT, HELIX_LIFTS = -124.1911865, -147.1580802, -103.6731326, -109.8311707


@pytest.fixture(scope="module")
def whole() -> rodwell.Branch:
    """From the straight rod to the helix."""
    return rodwell.follow(HORIZONTAL, 1, until=-165.0, off_wall=True)


def test_one_branch_leads_from_the_wall_to_the_helix(whole: rodwell.Branch) -> None:
    assert whole.beyond is not None
    found = [(point.kind, point.force, point.index_before, point.index_after) for point in whole.beyond.special_points]
    by_kind = {kind: [force for name, force, *_ in found if name == kind] for kind, *_ in found}
    assert by_kind["gap_opens"] == pytest.approx([GAPS], rel=1e-7 / 124)
    assert by_kind["fold"] == pytest.approx([LIMIT, HELIX_LIMIT], rel=1e-7 / 147)
    assert by_kind["touch_down"] == pytest.approx([HELIX_LIFTS], rel=3e-7 / 110)
    assert [one[2:] for one in found if one[0] == "fold"] == [(0, 1), (1, 0)]
    assert whole.converged
    assert not whole.reached_end
    assert "contact is complete again" in whole.ended_because
    last = whole.beyond.state(len(whole.beyond) - 1)
    assert last.kind == "helix"
    assert abs(last.turns) == 1


def test_states_of_theory_2(whole: rodwell.Branch) -> None:
    assert whole.beyond is not None
    state = whole.beyond.at(-125.41829806)
    assert [gap.start.value for gap in state.gaps][:2] == pytest.approx([0.11571, 0.42800], abs=6e-6)
    assert state.gaps[1].largest.value == pytest.approx(8.077165e-5, abs=1e-10)
    assert state.energy.value == pytest.approx(-0.00145016, abs=5e-9)
    assert whole.beyond.at(-135.48955152).energy.value == pytest.approx(-0.00436417, abs=5e-9)


def test_three_states_at_one_load(whole: rodwell.Branch) -> None:
    """Between the two limit points there are partial contact, the saddle and, unless it is in contact, the helix."""
    assert whole.beyond is not None
    states = whole.beyond.states_at(-130.0)
    assert [state.stability_index for state in states] == [0, 1]
    assert all(state.certificate.passed for state in states)
    assert [state.stability_index for state in whole.beyond.states_at(-106.0)] == [1, 0]


def test_numbers_go_on_where_those_on_the_wall_end(whole: rodwell.Branch) -> None:
    assert whole.beyond is not None
    assert whole.lift_off is not None
    at = whole.lift_off.solution
    for name in ("energy", "end_shortening", "omega2_at_0", "omega2_at_1"):
        assert whole.beyond.numbers(name)[0] == pytest.approx(at.number(name).value, rel=2e-6)


def test_the_energy_falls_by_the_shortening(whole: rodwell.Branch) -> None:
    """dE/dF = shortening along equilibria: Simpson's rule over a stretch with changes of contact at neither end."""
    assert whole.beyond is not None
    states = [whole.beyond.at(force) for force in (-131.0, -132.0, -133.0)]
    first, middle, last = (state.shortening.value for state in states)
    assert states[2].energy.value - states[0].energy.value == pytest.approx(
        -2.0 * (first + 4.0 * middle + last) / 6.0, rel=1e-7
    )


def test_end_curvature_by_the_field_of_it(whole: rodwell.Branch) -> None:
    """Where the end is in contact the rod is bent there around the hole alone; else the radial part adds to it."""
    assert whole.beyond is not None
    i = int(np.argmin(np.abs(whole.beyond.force[:60] + 140.0)))
    state = whole.beyond.state(i)
    assert state.contacts[-1].end.value == 1.0
    curvature = state.fields(np.array([0.0, 1.0]))["curvature"]
    assert abs(whole.beyond.numbers("omega2_at_1")[i]) == pytest.approx(float(curvature[1]), rel=1e-6)


def test_a_branch_that_meets_its_mirror_image_ends_there() -> None:
    """Mode 3 turns back where it has no sideways part left: both arms meet in a state of the vertical plane."""
    branch = rodwell.follow(HORIZONTAL, 3, until=-275.0, off_wall=True)
    assert branch.beyond is not None
    meeting = branch.beyond.special_points[-2]
    assert meeting.kind == "branch_point"
    assert "mirror image" in branch.ended_because
    y = meeting.state.fields(101)["y"]
    assert float(np.max(np.abs(y))) < 1e-4 * HORIZONTAL.clearance


def test_a_helix_that_is_unloaded_goes_on_off_the_wall() -> None:
    coiled = Problem(15.0, 90.0, turns=1)
    branch = rodwell.follow(coiled, start=rodwell.equilibrium(coiled, -120.0), until=-100.0, off_wall=True)
    assert branch.beyond is not None
    assert branch.lift_off is not None
    assert branch.lift_off.force == pytest.approx(HELIX_LIFTS, rel=2e-9)
    assert branch.beyond.special_points[0].force == pytest.approx(HELIX_LIMIT, rel=1e-9)


def test_without_lift_off_nothing_changes() -> None:
    kept, crossing = (rodwell.follow(HORIZONTAL, 1, until=-120.0, off_wall=away) for away in (False, True))
    assert crossing.beyond is None
    assert crossing.reached_end
    assert np.array_equal(kept.force, crossing.force)
    assert [p.force for p in kept.special_points] == [p.force for p in crossing.special_points]


def test_it_is_followed_on_from_lift_off() -> None:
    branch = rodwell.follow(HORIZONTAL, 1, until=-126.0, off_wall=True)
    assert branch.reached_end
    assert branch.ended_because == "end"
    assert branch.beyond is not None
    assert branch.beyond.force[-1] == pytest.approx(-126.0, rel=1e-12)
    further = rodwell.extended(branch, -130.0)
    assert further.beyond is not None
    assert further.beyond.force[-1] == pytest.approx(-130.0, rel=1e-12)
    assert branch.renamed(branch.origin).beyond is branch.beyond


TAPERS = {
    "smooth": (Problem(15.0, sections=((1.0, (1.0, 0.5), (1.0, 0.7)),)), -107.0),
    "begins to fall": (Problem(15.0, sections=((0.4, 1.0), (0.6, (1.0, 0.5)))), -112.0),
    "long gap there": (Problem(30.0, 60.0, 0.05, sections=((0.4, 1.0), (0.6, (1.0, 0.5)))), -72.0),
    "begins to rise": (Problem(15.0, sections=((0.4, 0.5), (0.6, (0.5, 1.0)))), -107.0),
}


@pytest.mark.parametrize(("problem", "until"), TAPERS.values(), ids=TAPERS)
def test_rods_that_taper_go_on_as_their_load_path_does(problem: Problem, until: float) -> None:
    """Which takes them from the rod on the wall another way."""
    path = rodwell.load_path(problem, until=until, seeds=1)
    branch = rodwell.follow(problem, 1, until=until, off_wall=True)
    assert branch.beyond is not None
    assert branch.lift_off is not None
    assert path.lift_off is not None
    assert branch.converged
    assert branch.lift_off.force == pytest.approx(path.lift_off.force.value, abs=3e-7)
    opened = [event.force.value for event in path.events if event.kind == "gap_opens"]
    stable = [point for point in branch.beyond.special_points if point.index_after == 0]
    found = [point.force for point in stable if point.kind == "gap_opens"]
    assert found[: len(opened)] == pytest.approx(opened, abs=1e-7)
    force = path.lift_off.force.value - 1.0
    ours, theirs = branch.beyond.at(force), path.at(force)[0].state
    assert ours.certificate.passed
    assert ours.energy.value == pytest.approx(theirs.energy.value, rel=1e-11)
    assert [gap.start.value for gap in ours.gaps] == pytest.approx([gap.start.value for gap in theirs.gaps], abs=1e-9)
    assert all(branch.beyond.state(i).certificate.passed for i in range(1, len(branch.beyond) - 1, 5))


REFUSED: list[tuple[dict[str, Any], str, str]] = [
    ({"weight": 0.0}, "off_wall", "rodwell.load_path"),
    ({"ends": "ball-clamped"}, "ends", "rodwell.load_path"),
    ({"outside": True, "on_top": True}, "outside", "leave off_wall out"),
    ({"on_top": True}, "on_top", "leave off_wall out"),
    ({"walk": 0.1, "sections": ((0.5, 1.0, 1.0), (0.5, 0.6, 0.8))}, "walk", "beside sections"),
    ({"sections": ((0.5, 1.0, 1.0), (0.5, 0.5, 1.0))}, "off_wall", "rodwell.load_path"),
    ({"sections": ((0.5, 1.0, 1.0), (0.5, 1.0, 1.0, 2.0))}, "sections", "must have one clearance"),
]


@pytest.mark.parametrize(("data", "field", "reason"), REFUSED, ids=str)
def test_rods_that_are_not_followed_off_the_wall(data: dict[str, Any], field: str, reason: str) -> None:
    problem = Problem(**{"weight": 15.0, "alpha": 90.0, **data})
    with pytest.raises(InputError, match=reason) as caught:
        rodwell.follow(problem, 1, until=-150.0, off_wall=True)
    assert caught.value.field == field


def test_what_does_not_go_with_it() -> None:
    start = rodwell.follow(HORIZONTAL, 1, until=-120.0)[-1]
    coiled = Problem(15.0, 90.0, turns=1)
    pulled = rodwell.equilibrium(coiled, -50.0)
    for field, asked in (
        ("until", lambda: rodwell.follow(HORIZONTAL, 1, off_wall=True)),
        ("parameter", lambda: rodwell.follow(HORIZONTAL, start=start, parameter="weight", until=20.0, off_wall=True)),
        ("start", lambda: rodwell.follow(coiled, start=pulled, until=-100.0, off_wall=True)),
        ("turns", lambda: rodwell.diagram(coiled, off_wall=True)),
        ("search", lambda: rodwell.diagram(HORIZONTAL, search=("deflation",), off_wall=True)),
        ("then", lambda: rodwell.diagram(HORIZONTAL, then=("weight", 20.0), off_wall=True)),
    ):
        with pytest.raises(InputError) as caught:
            asked()
        assert caught.value.field == field


def test_what_is_asked_of_states_off_the_wall(whole: rodwell.Branch) -> None:
    assert whole.beyond is not None
    with pytest.raises(InputError, match="contact is complete again"):
        whole.beyond.at(-150.0)
    with pytest.raises(InputError, match="known on the wall only"):
        whole.beyond.numbers("support_torque")
    assert whole.beyond.states_at(-150.0) == ()
