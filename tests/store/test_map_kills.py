"""The committed campaign of kills of maps."""

from __future__ import annotations

import json
from pathlib import Path

RESULT = Path(__file__).resolve().parents[2] / "benchmarks" / "campaigns" / "map_kills.json"


def test_the_committed_campaign_has_no_faults() -> None:
    result = json.loads(RESULT.read_text(encoding="utf-8"))
    assert result["kills"] >= 100
    assert result["faults"] == []
    assert result["equal_to_the_undisturbed_map_after_the_next_run"] == result["kills"]
    assert result["chunks_done_again_although_they_were_there"] == 0
    assert result["maps_that_ended_although_a_worker_was_killed"] == result["targets"]["worker"]
