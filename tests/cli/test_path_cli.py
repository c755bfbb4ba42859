"""``rodwell path`` as a user meets it: JSON, text, files, and bad input."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from PIL import Image

from rodwell.analysis.path.load_path import LoadPath
from rodwell.cli.main import INTERRUPTED, cli, main
from rodwell.errors import InputError, NotConvergedError

COMMON = ("path", "--weight", "15", "--alpha", "90", "--seeds", "1")


def run(*arguments: str) -> Any:
    return CliRunner().invoke(cli, arguments)


def test_as_json() -> None:
    done = run(*COMMON, "--until", "-126", "--at", "-125.41829806,-300", "--barrier", "-125", "--json")
    assert done.exit_code == 0, done.output
    data = json.loads(done.output)
    assert [event["kind"] for event in data["events"]] == ["critical", "lift_off", "gap_opens"]
    assert set(data["events"][0]) == {"kind", "force", "s", "leg", "to"}
    state, missing = data["states"]
    assert state["leg"] == "loading"
    assert state["stability_index"] == 0
    assert set(state["gaps"][0]) == {"from", "to", "largest", "at"}
    assert set(state["point_contacts"][0]) >= {"s", "force"}
    assert state["energy"]["value"] == pytest.approx(-0.00145016, abs=1e-8)
    assert missing["reached"] is False
    assert "does not snap from there" in data["barriers"][0]["why"]
    assert data["reached"]
    assert data["converged"]
    assert "tension positive" in data["convention"]


def test_as_text_with_files(tmp_path: Path) -> None:
    out = tmp_path / "path"
    moving = tmp_path / "path.gif"
    done = run(*COMMON, "--until", "-124", "--at", "-123.5", "--out", str(out), "--animation", str(moving))
    assert done.exit_code == 0, done.output
    assert "the rod lifts off the wall, s/L = 0.5" in done.output
    assert "without inertia" in done.output
    assert "at the end of a stretch in contact" in done.output
    files = ["load-path-3d.html", "load-path.csv", "load-path.json", "load-path.nc", "load-path.png", "load-path.svg"]
    assert sorted(file.name for file in out.iterdir()) == files
    with Image.open(moving) as animation:
        assert animation.n_frames > 10
    assert sorted(file.name for file in tmp_path.iterdir()) == ["path", "path.gif"]


def test_an_animation_has_a_suffix_that_is_one(tmp_path: Path) -> None:
    done = run(*COMMON, "--until", "-124", "--animation", str(tmp_path / "path.mp4"))
    assert isinstance(done.exception, InputError)
    assert "must end in .gif or .webp" in str(done.exception)


def test_a_spring_in_series() -> None:
    """Straight until δ = −F/k, F = −111.23344016; then u − F/k."""
    control = ("--control", "shortening", "--spring", "1e4")
    done = run(*COMMON, *control, "--until", "0.0115", "--at", "0.0113", "--json")
    assert done.exit_code == 0, done.output
    data = json.loads(done.output)
    assert data["compliance"] == pytest.approx(1e-4)
    assert data["events"][0]["driven"]["value"] == pytest.approx(0.011123344016, rel=1e-10)
    (state,) = data["states"]
    assert state["driven"] == pytest.approx(0.0113, rel=1e-12)
    assert state["shortening"]["value"] - 1e-4 * state["force"] == pytest.approx(0.0113, rel=1e-12)
    shown = run(*COMMON, *control, "--until", "0.0115")
    assert "driven displacement is" in shown.output
    assert "driven displacement 0.0111233" in shown.output


def test_a_rod_that_stays_straight_is_said_to() -> None:
    assert "The rod stays straight" in run(*COMMON, "--until", "-90").output
    assert "The rod stays straight" not in run(*COMMON, "--until", "-112").output


def test_bad_input() -> None:
    for arguments, field in (
        (("--until", "-130", "--at", "much"), "--at"),
        (("--until", "-130", "--outside"), "outside"),
        (("--until", "nan"), "until"),
        (("--until", "-130", "--spring", "1e4"), "spring"),
    ):
        done = run(*COMMON, *arguments)
        assert isinstance(done.exception, InputError)
        assert done.exception.field == field


def test_loads_of_a_case_are_told_in_its_words() -> None:
    case = Path(__file__).parents[2] / "examples" / "drill-string.toml"
    told = CliRunner().invoke(cli, ["path", str(case), "--until", "-130 kN", "--seeds", "1"])
    assert "(124.6 kN of compression)  the straight rod buckles" in told.output


def test_a_string_of_sections() -> None:
    done = run(*COMMON, "--sections", "0.6:1:1,0.4:0.5:0.8", "--until", "-84", "--at", "-83.5", "--json")
    assert done.exit_code == 0, done.output
    data = json.loads(done.output)
    assert [(event["kind"], event["s"]) for event in data["events"]] == [("critical", []), ("lift_off", [0.6])]
    (gap,) = data["states"][0]["gaps"]
    assert gap["from"]["value"] < 0.6 < gap["to"]["value"]
    assert data["states"][0]["certificate"]["passed"]


def test_steps_of_the_clearance(tmp_path: Path) -> None:
    """Found by the path until it buckles and by ``critical``: the same load, below that of either clearance."""
    steps = ("--weight", "1000", "--alpha", "90", "--sections", "0.5:1:1:1,0.5:1:1:0.6")
    out = tmp_path / "steps"
    done = run("path", *steps, "--at", "-300", "--out", str(out))
    assert done.exit_code == 0, done.output
    assert "the string that bridges steps of the clearance buckles sideways" in done.output
    assert "at the edge of a narrower part of the hole" in done.output
    drawn = ["bridging.png", "bridging.svg", "load-path.png", "load-path.svg"]
    files = sorted([*drawn, "load-path.csv", "load-path.json", "load-path.nc"])
    assert sorted(file.name for file in out.iterdir()) == files
    load = json.loads((out / "load-path.json").read_text())["events"][0]["force"]["value"]
    data = json.loads(run("critical", *steps, "--json").output)
    assert data["critical_loads"] == [load]
    assert [point["kind"] for point in data["bridged"]["point_contacts"]] == ["end", "edge", "end"]
    assert all(one["load"]["value"] < load for one in data["one_clearance"])
    assert isinstance(run("liftoff", *steps).exception, InputError)


@pytest.mark.parametrize("option", ["--at", "--barrier"])
def test_a_shortening_that_is_controlled_is_no_end_force(option: str) -> None:
    done = run(*COMMON, "--until", "0.002", "--control", "shortening", option, "0.001,-127")
    assert isinstance(done.exception, InputError)
    assert (done.exception.field, done.exception.value) == (option, -127.0)
    assert "from 0 to 1: a shortening in L" in str(done.exception)


@pytest.mark.parametrize("given", ["", "nan", "-147,inf"])
def test_loads_of_barriers_are_finite_numbers(given: str) -> None:
    done = run(*COMMON, "--until", "-126", "--barrier", given)
    assert isinstance(done.exception, InputError)
    assert done.exception.field == "--barrier"


def test_a_path_whose_barriers_are_interrupted_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Ctrl-C while the second of three barriers is computed, in Python or in a compiled call."""
    asked: list[float] = []

    def barrier(_path: LoadPath, force: float) -> None:
        asked.append(force)
        if force == -112.0:
            raise SystemError from KeyboardInterrupt()
        raise NotConvergedError("no saddle")

    monkeypatch.setattr(LoadPath, "barrier", barrier)
    out = tmp_path / "path"
    command = ["rodwell", *COMMON, "--until", "-113", "--barrier", "-111.5,-112,-112.5", "--out", str(out)]
    monkeypatch.setattr(sys, "argv", command)
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == INTERRUPTED
    said = capsys.readouterr()
    assert "the path was told, with what had been computed of its barriers" in said.err
    assert "no barrier told; no saddle" in " ".join(said.out.split())
    assert -112.5 not in asked
    written = json.loads((out / "load-path.json").read_text(encoding="utf-8"))
    assert [event["kind"] for event in written["events"]] == ["critical"]
    assert [one["why"] for one in written["barriers"]] == ["no saddle"]
