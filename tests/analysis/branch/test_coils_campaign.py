"""A sample of the campaign ``benchmarks/campaigns/coils.py``, of other numbers, and its committed result."""

from __future__ import annotations

import json
from types import ModuleType

import pytest
from programs import CAMPAIGNS, loaded

CAMPAIGN = CAMPAIGNS / "coils.py"


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    return loaded(CAMPAIGN)


def test_coils_are_found_or_it_is_said_why_not(campaign: ModuleType) -> None:
    found = [campaign.trial(1_000_000 + number) for number in range(24)]
    assert not [one for one in found if one["fault"]]
    assert sum(one["ended"] == "found" for one in found) >= 16
    assert all(one["why"] for one in found if one["ended"] != "found")


def test_the_committed_campaign_has_no_faults() -> None:
    result = json.loads(CAMPAIGN.with_suffix(".json").read_text(encoding="utf-8"))
    assert result["count"] >= 1000
    assert result["faults"] == 0
    assert result["found"] + sum(result["not_found"].values()) == result["count"]
