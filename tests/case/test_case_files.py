"""A sample of the campaign ``benchmarks/campaigns/case_files.py``, of other seeds, and its committed result."""

from __future__ import annotations

import json
import random
from pathlib import Path
from types import ModuleType

import pytest
from programs import CAMPAIGNS, loaded

CAMPAIGN = CAMPAIGNS / "case_files.py"


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    return loaded(CAMPAIGN)


def test_mutated_files_end_in_a_case_or_a_message(campaign: ModuleType, tmp_path: Path) -> None:
    campaign.trial(0, tmp_path)  # imports
    found = [campaign.trial(7_000_000 + number, tmp_path) for number in range(300)]
    assert not [one for one in found if campaign.fault(one)]
    assert {one["outcome"] for one in found} >= {"case", "refused"}


def test_mutations_change_files(campaign: ModuleType) -> None:
    """The test above would pass if nothing were ever mutated."""
    texts = set(campaign.corpus()) | {campaign.OWN}
    same = sum(campaign.mutated(seed)[1].decode("utf-8", "replace") in texts for seed in range(200))
    assert same < 20
    for mutate in set(campaign.MUTATIONS):
        assert any(mutate(campaign.OWN, random.Random(seed)) != campaign.OWN for seed in range(20))


def test_the_committed_campaign_has_no_faults() -> None:
    result = json.loads(CAMPAIGN.with_suffix(".json").read_text(encoding="utf-8"))
    assert result["files"] >= 20_000
    assert result["faults"] == []
    assert result["seconds"]["largest"] < 1.0
