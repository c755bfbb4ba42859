"""Where files cannot be written any more, the answer is told all the same, then the error, with its exit code."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from bad_commands import GOOD, INPUT_ERROR, Run

EXAMPLES = Path(__file__).parents[2] / "examples"
PATH = ("path", "--weight", "15", "--alpha", "90", "--until", "-112", "--seeds", "1", "--rtol", "1e-6")


def disk_full(*_: object, **__: object) -> None:
    raise OSError(28, "No space left on device")


@pytest.fixture
def full(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every folder of results find the disk full when it is to appear."""
    monkeypatch.setattr("rodwell.store.folder.put_in_place", disk_full)


SURVEY = "MD (m),Inc (deg)\n0,0\n500,10\n"
WELL = """
[hole]
survey = "well.csv"
diameter = "8.5 in"
friction = 0.25

[[string]]
outer_diameter = "5 in"
inner_diameter = "4.276 in"
youngs_modulus = "207 GPa"
weight_per_length = "241 N/m"
yield_strength = "135000 psi"

[[well.operation]]
kind = "pull-out"
"""
STUDY = GOOD.replace("16.5", "[16.5, 17.0]").replace("[dim", "study = true\n\n[dim")


@pytest.mark.usefixtures("full", "quick")
@pytest.mark.parametrize("options", [[], ["--json"]], ids=["text", "json"])
def test_run(rodwell: Run, place: Path, options: list[str]) -> None:
    code, out, err = rodwell("run", "good.toml", "--out", "results", *options)
    assert code == INPUT_ERROR
    assert "No space left on device" in err
    assert "Report:" not in out
    assert json.loads(out)["verdict"] if options else "buckles" in out
    assert [entry.name for entry in place.iterdir()] == ["good.toml"]


@pytest.mark.parametrize("options", [[], ["--json"]], ids=["text", "json"])
def test_a_path_on_a_full_disk(rodwell: Run, place: Path, full: None, options: list[str]) -> None:
    code, out, err = rodwell(*PATH, "--out", "folder", *options)
    assert code == INPUT_ERROR
    assert "cannot be written (No space left on device)" in err
    told = [event["kind"] for event in json.loads(out)["events"]] if options else out
    assert "critical" in told if options else "the straight rod buckles" in told
    assert "Written to" not in out


def test_a_path_whose_folder_has_gone(rodwell: Run, place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The folder stands in one that is there before the path is followed, and not afterwards."""
    from rodwell.analysis.path import follow

    (place / "there").mkdir()
    load_path = follow.load_path

    def followed(*given: Any, **more: Any) -> Any:
        shutil.rmtree(place / "there")
        (place / "there").write_text("a file", encoding="utf-8")
        return load_path(*given, **more)

    monkeypatch.setattr(follow, "load_path", followed)
    code, out, err = rodwell(*PATH, "--out", "there/folder")
    assert code == INPUT_ERROR
    assert "there' is a file" in err
    assert "the straight rod buckles" in out


def test_of_a_path_what_was_written_before_is_named(rodwell: Run, place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rodwell.report.folders.path.pictures", disk_full)
    code, out, err = rodwell(*PATH, "--out", "folder", "--animation", "rod.gif")
    assert code != 0
    assert "No space left on device" in err
    assert "the straight rod buckles" in out
    assert "Written to folder" in out
    assert "rod.gif" not in out
    assert sorted(entry.name for entry in place.iterdir()) == ["folder", "good.toml"]


LINES = {
    "diagram": "diagram --weight 15 --alpha 90 --modes 1 --no-secondary --until -112 --rtol 1e-5 --out out",
    "curve": "curve critical --over weight --from 1 --to 3 --alpha 90 --modes 1 --rtol 1e-5 --out out",
    "audit": "audit good.toml --no-chart --out out",
    "packer": f"packer {EXAMPLES / 'tubing-packer.toml'} --out out",
    "study": "run study.toml --out out",
    "screen": f"screen well.csv --case {EXAMPLES / 'well-string.toml'} --out out",
    "drag": "drag well.toml --out out",
    "bridged": f"run {EXAMPLES / 'tubing-two-casings.toml'} --out out",
}


@pytest.mark.parametrize("name", LINES)
@pytest.mark.usefixtures("full")
def test_every_command_that_writes(rodwell: Run, place: Path, name: str) -> None:
    (place / "well.csv").write_text(SURVEY, encoding="utf-8")
    (place / "well.toml").write_text(WELL, encoding="utf-8")
    (place / "study.toml").write_text(STUDY, encoding="utf-8")
    code, out, err = rodwell(*LINES[name].split(), "--json")
    assert code == INPUT_ERROR, err
    assert "cannot be written (No space left on device)" in err
    assert json.loads(out)
    assert not (place / "out").exists()


def test_a_map_whose_picture_cannot_be_drawn(rodwell: Run, place: Path) -> None:
    line = "map --quantity critical --weight 10;20 --alpha 90 --out map.zarr --picture nowhere/map.png --json"
    code, out, err = rodwell(*line.split())
    assert code == INPUT_ERROR
    assert "--picture" in err
    assert json.loads(out)["complete"] is True
