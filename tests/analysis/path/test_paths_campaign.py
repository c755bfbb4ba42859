"""A sample of the campaign ``benchmarks/campaigns/paths.py``, and its committed result."""

from __future__ import annotations

import json
from types import ModuleType

import pytest
from programs import CAMPAIGNS, loaded

CAMPAIGN = CAMPAIGNS / "paths.py"


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    return loaded(CAMPAIGN)


def test_a_path_with_a_snap_has_no_faults(campaign: ModuleType) -> None:
    found = campaign.trial(5)
    assert found["faults"] == []
    assert found["reached"]
    assert "snap" in found["kinds"]


def test_the_committed_campaign_has_no_faults() -> None:
    result = json.loads(CAMPAIGN.with_suffix(".json").read_text(encoding="utf-8"))
    assert result["with faults"] == 0
    assert (
        result["followed to the end"] + result["refused"] + sum(result["not followed to the end"].values())
        == (result["problems"])
    )
