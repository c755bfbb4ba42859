"""Branches that hang together with none that is known: the closed loop of a rod at 89°."""

from __future__ import annotations

import pytest

from rodwell import Branch, Diagram, InputError, Problem, diagram, follow, special_curve
from rodwell.analysis.discrete.measures import Measured

FOLDS = (-403.8034, -2713.649)
"""Of the loop of w = 15, α = 89°: found by another program, which confirmed a state of it at F = −500."""


@pytest.fixture(scope="module", params=["unfolding", "deflation"])
def found(request: pytest.FixtureRequest) -> Diagram:
    return diagram(Problem(15.0, 89.0), until=-700.0, search=(request.param,))


def test_the_closed_loop_is_found_either_way(found: Diagram) -> None:
    (loop,) = (branch for branch in found if branch.name.startswith("isolated"))
    assert loop.closed
    assert loop.ended_because == "closed"
    assert sorted(p.force for p in loop.special_points if p.kind == "fold") == pytest.approx(sorted(FOLDS), abs=1e-3)
    assert loop.converged
    assert loop[0].fields(9)["xi2"] == pytest.approx(loop[-1].fields(9)["xi2"], abs=1e-8)


def test_the_closed_loop_is_followed_to_where_it_is_born(found: Diagram) -> None:
    """Its fold at −2713.649, followed in α, turns back at 51.008°: there the loop is cut off from another branch.

    By a second method: on either side of that inclination, from the same state, one parameter after the other.
    """
    (loop,) = (branch for branch in found if branch.name.startswith("isolated"))
    fold = min((p for p in loop.special_points if p.kind == "fold"), key=lambda p: p.force)
    curve = special_curve(fold, "alpha", 45.0)
    born = curve.marks[0]
    assert born.kind == "reconnection"
    assert born.x == pytest.approx(51.0077855, abs=1e-6)
    near = next(p for p in curve.points if p.x < born.x + 0.15)
    assert near.solution is not None

    start = follow(near.solution.problem, start=near.solution, until=near.value + 3.0)[-1]

    def onwards(alpha: float) -> Branch:
        """Down in the end force from a state above the fold, at another inclination; no farther than back up again."""
        tilted = follow(start.problem, start=start, parameter="alpha", until=alpha)[-1]
        back = {"back": lambda state: state.force - start.force - 0.1}
        return follow(tilted.problem, start=tilted, until=born.value - 8.0, stop=back)

    assert [p.kind for p in onwards(born.x + 0.1).special_points] == ["fold", "back", "end"]
    assert [p.kind for p in onwards(born.x - 0.1).special_points] == ["end"]


def test_what_was_searched_is_said(found: Diagram) -> None:
    assert found.searched[0] == "connected to the straight rod"
    assert len(found.searched) == 2
    assert found.as_dict()["searched"] == list(found.searched)


def test_connected_branches_are_the_same_with_and_without_a_search(found: Diagram) -> None:
    plain = diagram(Problem(15.0, 89.0), until=-700.0)
    assert plain.searched == ("connected to the straight rod",)
    assert [b.name for b in found][: len(plain.branches)] == [b.name for b in plain]


def test_all_states_at_a_value() -> None:
    """Mode 1 at w = 15, α = 89° passes F = −300 three times: its folds are at −358.9 and −165.0."""
    branch = follow(Problem(15.0, 89.0), until=-500.0)
    states = branch.states_at(-300.0)
    assert [state.stability_index for state in states] == [0, 1, 0]
    assert all(state.force == -300.0 and state.converged for state in states)
    assert len({round(state.number(Measured.ENERGY).value, 6) for state in states}) == 3
    assert branch.states_at(0.0) == ()
    assert branch.at(-300.0).point.fine.c == pytest.approx(states[0].point.fine.c)


def test_ways_to_search_are_named() -> None:
    with pytest.raises(InputError, match="must be among unfolding, deflation"):
        diagram(Problem(15.0), search=("guessing",))
    with pytest.raises(InputError, match="not coiled"):
        diagram(Problem(15.0, turns=1), search=("deflation",))
