"""A sample of the campaign ``benchmarks/campaigns/bridged_strings.py``: buckling loads against transfer matrices."""

from __future__ import annotations

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
