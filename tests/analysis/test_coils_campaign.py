"""A sample of the campaign ``benchmarks/campaigns/coils.py``, of other numbers, and its committed result."""

from __future__ import annotations

import importlib.util
import json
import sys
from pathlib import Path
from types import ModuleType

import pytest

CAMPAIGN = Path(__file__).resolve().parents[2] / "benchmarks" / "campaigns" / "coils.py"


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    sys.path.insert(0, str(CAMPAIGN.parent))
    specification = importlib.util.spec_from_file_location("campaign_of_coils", CAMPAIGN)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    sys.path.remove(str(CAMPAIGN.parent))
    return module


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
