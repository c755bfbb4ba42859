"""Strings in a bend that nothing holds at steps of their stiffness: their load, told beside that of the held one."""

from __future__ import annotations

import pytest

from rodwell import Problem, critical_loads, load_path, sensitivities
from rodwell.analysis.path.sideways.not_held import buckles_if_not_held

STRING = Problem(30.0, 80.0, build=0.3, sections=((0.5, 1.0, 1.0), (0.5, 0.6, 0.8)))


def force(problem: Problem) -> float:
    found = buckles_if_not_held(problem)
    assert found is not None
    assert not isinstance(found, str)
    return found.force.value


def test_it_is_asked_of_strings_with_steps_of_their_stiffness_in_a_bend() -> None:
    assert buckles_if_not_held(Problem(30.0, build=0.3)) is None
    assert buckles_if_not_held(STRING.but(build=0.0)) is None
    assert buckles_if_not_held(STRING.but(sections=((0.5, 1.0, 1.0), (0.5, 1.0, 0.8)))) is None
    why = buckles_if_not_held(STRING.but(walk=0.1))
    assert isinstance(why, str)
    assert "walk" in why


def test_it_is_the_load_of_the_load_path_and_near_that_of_the_held_string() -> None:
    """Which a step of a thousandth hardly lifts: its gaps are shorter with the root of the step."""
    path = load_path(STRING).first("critical")
    assert path is not None
    assert force(STRING) == path.force.value
    small = STRING.but(sections=((0.5, 1.0, 1.0), (0.5, 0.98, 1.0)))
    away, nearer = (abs(force(one) / critical_loads(one)[0].force - 1.0) for one in (STRING, small))
    assert nearer < 0.1 * away < 1e-3


@pytest.mark.parametrize(("name", "step"), [("weight", 1e-3), ("build", 1e-4)])
def test_its_derivatives_are_its_differences(name: str, step: float) -> None:
    *_, lift_off, load = sensitivities(STRING)
    assert (load.name, lift_off.name) == ("load at which it buckles if nothing holds it at its steps", "lift-off load")
    slope, here = load.derivatives[name], getattr(STRING, name)
    near, far = (
        force(STRING.but(**{name: here + k * step})) - force(STRING.but(**{name: here - k * step})) for k in (1, 2)
    )
    assert slope.value == pytest.approx((8.0 * near - far) / (12.0 * step), rel=1e-7)
    assert slope.error < 1e-6 * abs(slope.value)
