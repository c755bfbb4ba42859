"""Strings of so many equal joints that several disturbances begin to grow within one step of the load."""

import pytest

from rodwell import Problem, jointed_string, load_path


def _string(joints: int) -> Problem:
    """Equal joints, each with half a tool joint at either end, in units of one joint."""
    half, body = (0.03 / joints, 3.0, 2.0, 0.5), (0.94 / joints, 1.0, 1.0, 1.0)
    between = (0.06 / joints, 3.0, 2.0, 0.5)
    inner = [one for _ in range(joints - 1) for one in (body, between)]
    return Problem(0.05 * joints**3, clearance=0.01 / joints, sections=(half, *inner, body, half))


def test_the_first_load_of_many_joints_comes_down_to_the_endless_string_with_the_square_of_their_number() -> None:
    endless = jointed_string(_string(1)).load
    above = []
    for joints in (100, 200):
        first = load_path(_string(joints)).first("critical")
        assert first is not None
        assert first.met
        above.append(abs(first.force.value) / joints**2 - abs(endless.value))
    assert above[0] / above[1] == pytest.approx(4.0, rel=0.01)
