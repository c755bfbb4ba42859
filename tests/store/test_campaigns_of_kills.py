"""The committed campaigns of kills: of maps, and of runs of a case and of a study."""

from __future__ import annotations

import json
from pathlib import Path

CAMPAIGNS = Path(__file__).resolve().parents[2] / "benchmarks" / "campaigns"


def test_kills_of_maps_left_no_fault() -> None:
    result = json.loads((CAMPAIGNS / "map_kills.json").read_text(encoding="utf-8"))
    assert result["kills"] >= 100
    assert result["faults"] == []
    assert result["equal_to_the_undisturbed_map_after_the_next_run"] == result["kills"]
    assert result["chunks_done_again_although_they_were_there"] == 0
    assert result["maps_that_ended_although_a_worker_was_killed"] == result["targets"]["worker"]


def test_kills_of_runs_left_no_fault() -> None:
    result = json.loads((CAMPAIGNS / "run_kills.json").read_text(encoding="utf-8"))
    assert result["kills"] >= 100
    assert result["faults"] == []
    assert min(result["kinds"].values()) > 0
    assert sum(result["left"].values()) == result["kills"]
    assert result["hidden_folders_after_the_next_run"] == 0
