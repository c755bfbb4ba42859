"""Results of runs that were killed or ran at once: a sample of the campaign ``benchmarks/campaigns/kills.py``."""

from __future__ import annotations

import json
import multiprocessing
import warnings
from pathlib import Path
from types import ModuleType

import pytest
from programs import CAMPAIGNS, loaded
from result_files import POSIX, texts

from rodwell.store.folder import check_writable, whole_folder

CAMPAIGN = CAMPAIGNS / "kills.py"


# A sample of the campaign of kills


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    return loaded(CAMPAIGN)


@POSIX
@pytest.mark.parametrize("seed", [7_000_002, 7_000_003, 7_000_004, 7_000_005, 7_000_006])
def test_killed(campaign: ModuleType, seed: int) -> None:
    found = campaign.trial(seed)
    assert not campaign.fault(found), found


@POSIX
def test_killed_between_files(campaign: ModuleType, tmp_path: Path) -> None:
    """Where files are moved one by one, the next run ends what was begun."""
    left = []
    for at in range(20, campaign.steps("folder"), 4):
        place = tmp_path / str(at)
        place.mkdir()
        out = campaign.prepared(place, "folder")
        campaign.killed(out, at=at)
        left.append(campaign.state(out, "folder"))
        check_writable(out)
        assert campaign.state(out, "folder") == "whole"
    assert set(left) == {"whole", "mixed"}


def test_the_committed_campaign_has_no_faults() -> None:
    result = json.loads(CAMPAIGN.with_suffix(".json").read_text(encoding="utf-8"))
    assert result["kills"] >= 100
    assert result["faults"] == []


def _several_times(out: Path, who: int) -> None:
    for k in range(8):
        check_writable(out)
        with whole_folder(out) as folder:
            for name in ("a.txt", "b.txt", "c.txt"):
                (folder / name).write_text(f"{who}, {k}", encoding="utf-8")


@POSIX
@pytest.mark.parametrize("there", [True, False])
def test_several_runs_at_once_into_one_place(tmp_path: Path, there: bool) -> None:
    """Each ends well, and what stands there in the end is all of one of them, beside what is the user's."""
    out = tmp_path / "results"
    if there:
        out.mkdir()
        (out / "notes.txt").write_text("mine", encoding="utf-8")
    runs = [multiprocessing.get_context("fork").Process(target=_several_times, args=(out, who)) for who in range(4)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of threads, which the runs do not use
        for run in runs:
            run.start()
    for run in runs:
        run.join()
    assert [run.exitcode for run in runs] == [0, 0, 0, 0]
    assert [entry.name for entry in tmp_path.iterdir()] == ["results"]
    found = texts(out)
    assert found.pop("notes.txt", "mine") == "mine"
    assert sorted(found) == ["a.txt", "b.txt", "c.txt"]
    assert len(set(found.values())) == 1
