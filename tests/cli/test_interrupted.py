"""Interrupted runs and full disks: one message, an exit code, and results that are whole, or the earlier ones."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bad_commands import COMPUTATION_ERROR, INPUT_ERROR, INTERRUPTED, Run, entries

from rodwell.errors import InputError
from rodwell.store.folder import whole_folder

# Interruptions and failures in the middle


def stopped(*_: object, **__: object) -> None:
    raise KeyboardInterrupt


def disk_full(*_: object, **__: object) -> None:
    raise OSError(28, "No space left on device")


STAGES = [
    pytest.param("rodwell.answers.result.answer.answer", id="computing"),
    pytest.param("rodwell.report.folders.pictures.draw_branches", id="drawing"),
    pytest.param("rodwell.report.folders.pictures.draw_rod", id="drawing the rod"),
    pytest.param("rodwell.report.pages.pdf.render", id="rendering"),
    pytest.param("rodwell.report.folders.case.write_answer", id="writing-data"),
]


@pytest.fixture
def earlier(place: Path) -> Iterator[dict[str, str]]:
    """Results of an earlier run, and a file of the user's; they must be there afterwards, and nothing else."""
    files = {"report.html": "old report", "answer.json": "old answer", "notes.txt": "mine"}
    (place / "results").mkdir()
    for name, text in files.items():
        (place / "results" / name).write_text(text, encoding="utf-8")
    yield files
    assert entries(place) == sorted(["good.toml", "results", *(f"results{os.sep}{name}" for name in files)])
    for name, text in files.items():
        assert (place / "results" / name).read_text(encoding="utf-8") == text


@pytest.mark.parametrize("options", [[], ["--json"]], ids=["text", "json"])
@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.usefixtures("quick")
def test_interrupted(
    rodwell: Run, place: Path, monkeypatch: pytest.MonkeyPatch, stage: str, options: list[str]
) -> None:
    monkeypatch.setattr(stage, stopped)
    code, out, err = rodwell("run", "good.toml", "--out", "results", *options)
    assert code == INTERRUPTED
    assert "Report:" not in out  # what was computed is said, and no file
    assert bool(out) == (stage != "rodwell.answers.result.answer.answer" and not options)
    assert err.strip() == "rodwell: interrupted; nothing was written"
    assert entries(place) == ["good.toml"]


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.usefixtures("quick", "earlier")
def test_interrupted_over_earlier_results(rodwell: Run, monkeypatch: pytest.MonkeyPatch, stage: str) -> None:
    monkeypatch.setattr(stage, stopped)
    code, _, err = rodwell("run", "good.toml", "--out", "results")
    assert code == INTERRUPTED
    assert "nothing was written" in err


@pytest.mark.parametrize("stage", STAGES[1:])
@pytest.mark.usefixtures("quick", "earlier")
def test_disk_full_over_earlier_results(rodwell: Run, monkeypatch: pytest.MonkeyPatch, stage: str) -> None:
    monkeypatch.setattr(stage, disk_full)
    code, out, err = rodwell("run", "good.toml", "--out", "results")
    assert code in (INPUT_ERROR, COMPUTATION_ERROR)
    assert "Report:" not in out
    assert err.startswith("rodwell: error: ")
    assert "No space left on device" in err
    assert err.count("\n") == 1


@pytest.mark.parametrize("command", ["critical", "liftoff"])
def test_quick_answers_interrupted(rodwell: Run, monkeypatch: pytest.MonkeyPatch, command: str) -> None:
    monkeypatch.setattr("rodwell.problem.problem.Problem.__post_init__", stopped)
    code, out, err = rodwell(command, "--weight", 15, "--alpha", 90, "--json")
    assert (code, out) == (INTERRUPTED, "")
    assert "rodwell: interrupted" in err


@pytest.mark.usefixtures("quick")
def test_whole_run_writes_all_files(rodwell: Run, place: Path) -> None:
    """The tests above would pass if nothing were ever written."""
    code, out, err = rodwell("run", "good.toml", "--out", "results", "--quiet")
    assert (code, out, err) == (0, "", "")
    assert {"report.html", "answer.json", "case.toml", "branches.nc", "bifurcation.png"} <= {
        path.name for path in (place / "results").iterdir()
    }
    assert not [name for name in entries(place) if name.startswith(".")]


@pytest.mark.parametrize("failure", [KeyboardInterrupt, RuntimeError, SystemExit, GeneratorExit])
def test_folder_is_whole_or_not_there(tmp_path: Path, failure: type[BaseException]) -> None:
    with pytest.raises(failure), whole_folder(tmp_path / "results") as folder:  # noqa: PT012
        (folder / "half").write_text("half", encoding="utf-8")
        raise failure
    assert entries(tmp_path) == []


@pytest.mark.parametrize("failure", [KeyboardInterrupt, RuntimeError])
def test_earlier_folder_is_untouched(tmp_path: Path, failure: type[BaseException]) -> None:
    out = tmp_path / "results"
    out.mkdir()
    (out / "report.html").write_text("old", encoding="utf-8")
    with pytest.raises(failure), whole_folder(out) as folder:  # noqa: PT012
        (folder / "report.html").write_text("new", encoding="utf-8")
        raise failure
    assert entries(tmp_path) == ["results", f"results{os.sep}report.html"]
    assert (out / "report.html").read_text(encoding="utf-8") == "old"


def test_folder_below_a_file(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    with (
        pytest.raises(InputError, match=r"--out = .*cannot be made.*is a file"),
        whole_folder(tmp_path / "file" / "results"),
    ):
        pytest.fail("must not begin")
    assert (tmp_path / "file").read_text(encoding="utf-8") == "mine"


# A real signal. The script stops at a known place, says so, and waits there for Ctrl-C.

SCRIPT = """
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)  # also where the parent ignores it

{where}

from rodwell.cli.main import main
sys.argv = ["rodwell", "run", "good.toml", "--out", "results"]
main()
"""

COMPUTING = """
import rodwell.analysis.loads.arms as module
genuine = module.follow

def endless(*arguments, **options):
    genuine(*arguments, **options)
    print("ready", flush=True)
    while True:
        genuine(*arguments, **options)

module.follow = endless
"""

COMPILED = """
import rodwell.analysis.loads.arms as module

def interrupted(*arguments, **options):  # what a compiled call raises when the signal meets it
    print("ready", flush=True)
    try:
        time.sleep(120)
    except KeyboardInterrupt as problem:
        raise SystemError("returned a result with an exception set") from problem

module.follow = interrupted
"""

WRITING = """
import rodwell.report.folders.case as module

def write(answer, file):
    file.write_bytes(b"half")
    print("ready", flush=True)
    time.sleep(120)

module.write_answer = write
"""


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("where", [COMPUTING, COMPILED, WRITING], ids=["computing", "compiled", "writing"])
def test_ctrl_c(place: Path, where: str) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", SCRIPT.format(where=where)],
        cwd=place,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        encoding="utf-8",
    ) as process:
        try:
            assert process.stdout is not None
            said = []
            while (line := process.stdout.readline()) not in ("", "ready\n"):
                said.append(line)
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=100)
        finally:
            process.kill()
    assert bool(said) == (where == WRITING), err  # the verdict was known, and said, before files were written
    assert process.returncode == INTERRUPTED
    assert out == ""
    assert err.strip() == "rodwell: interrupted; nothing was written"
    assert entries(place) == ["good.toml"]
