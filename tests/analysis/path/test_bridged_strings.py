"""A sample of the campaign ``benchmarks/campaigns/bridged_strings.py``: buckling loads against transfer matrices."""

from __future__ import annotations

import math
from types import ModuleType

import pytest
from programs import CAMPAIGNS, loaded

from rodwell import NotConvergedError, Problem, load_path


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    return loaded(CAMPAIGNS / "bridged_strings.py")


@pytest.mark.parametrize("number", [3, 11])
def test_strings_of_very_different_sections_buckle_where_transfer_matrices_say(
    campaign: ModuleType, number: int
) -> None:
    found = campaign.trial(number)
    assert not found["fault"]
    assert found["met"]
    assert found["checked"] < 1e-3


def test_a_string_levered_up_to_the_upper_side_is_told_so() -> None:
    """A stiff string over a narrow place, with a heavy short arm on one side: its light long arm rises."""
    light, heavy = (100, 0.01), (100, 100)
    sections = ((0.05, 0.001, 0.01, 2), (0.45, *light, 2), (0.05, *light, 0.5), (0.2, *heavy, 2), (0.25, 0.001, 1, 2))
    problem = Problem(1000.0, clearance=1e-3, sections=sections)
    with pytest.raises(NotConvergedError, match="upper side"):
        load_path(problem)


def test_bodies_bow_sideways_between_their_tool_joints(campaign: ModuleType) -> None:
    """Six joints of pipe, with 2√(Bw/Δ) of the tool joints' clearance far above π²B/ℓ² of one joint: near the latter.

    The bound from below is that of hinges at every tool joint; clamped ends and stiff tool joints raise it.
    """
    body, joint = (17.0 / 108.0, 1, 1, 1), (1.0 / 108.0, 4.0, 2.5, 0.54)
    half = (0.5 * joint[0], *joint[1:])
    problem = Problem(33.0, clearance=8.2e-4, sections=(half, *5 * (body, joint), body, half))
    found = load_path(problem).first("critical")
    assert found is not None
    assert found.state is not None
    assert [point.kind for point in found.state.point_forces] == 12 * ["edge"]
    assert "fault" not in campaign.checked(found.state, found.force.value, found.force.error)
    assert 1.0 < -found.force.value / (36.0 * math.pi**2) < 1.2
    assert -found.force.value < 0.75 * 2.0 * math.sqrt(33.0 / (0.54 * 8.2e-4))
