"""A sample of the campaign ``benchmarks/campaigns/paths.py``, and its committed result."""

from __future__ import annotations

import importlib.util
import json
import sys
from pathlib import Path
from types import ModuleType

import pytest

CAMPAIGN = Path(__file__).resolve().parents[2] / "benchmarks" / "campaigns" / "paths.py"


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    sys.path.insert(0, str(CAMPAIGN.parent))
    specification = importlib.util.spec_from_file_location("campaign_of_paths", CAMPAIGN)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    sys.path.remove(str(CAMPAIGN.parent))
    return module


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
