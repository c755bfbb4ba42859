"""Bad input to the command line: one message, an exit code, no traceback, and no half-written files."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from rodwell.answers.result.answer import Answer, answer
from rodwell.case.case import Case
from rodwell.cli.main import main
from rodwell.errors import InputError
from rodwell.store.folder import whole_folder

GOOD = "[dimensionless]\nweight = 16.5\n\n[analysis]\nmodes = 1\nrtol = 1e-4\noff_wall = false\n"
BEYOND_RANGE = "[load]\nuntil = -65.0\n\n" + GOOD.replace("16.5", "16.5\nclearance = 0.3")

INPUT_ERROR, COMPUTATION_ERROR, TOLERANCE_MISSED, INTERRUPTED = 2, 1, 3, 130

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def rodwell(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run the command line in this process: exit code, standard output, standard error."""

    def run(*arguments: object) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["rodwell", *map(str, arguments)])
        code: Any = 0
        try:
            main()
        except SystemExit as leaving:
            code = leaving.code
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        return int(code or 0), out, err

    return run


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Change to an empty folder with a good case in it."""
    folder = tmp_path / "work"
    folder.mkdir()
    (folder / "good.toml").write_text(GOOD, encoding="utf-8")
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture(scope="module")
def computed() -> Answer:
    return answer(Case.from_dict({"dimensionless": {"weight": 16.5}, "analysis": {"modes": 1, "rtol": 1e-4}}))


@pytest.fixture
def quick(computed: Answer, nothing_drawn: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let ``rodwell run`` find its answer computed and its figures drawn."""
    monkeypatch.setattr("rodwell.answers.result.answer.answer", lambda *_: computed)
    monkeypatch.setattr("rodwell.report.pages.pdf.render", lambda *_: "<p>new report</p>")


@pytest.fixture
def never_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fail if anything is computed: bad input must be found before."""

    def fail(*_: object) -> None:
        raise AssertionError("computed in spite of bad input")

    monkeypatch.setattr("rodwell.answers.result.answer.answer", fail)


def entries(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


BAD_OPTIONS = [
    pytest.param("critical --weight nan --alpha 90", ("weight = nan", "must be finite"), id="weight-nan"),
    pytest.param("critical --weight inf --alpha 90", ("weight = inf", "must be finite"), id="weight-inf"),
    pytest.param("critical --weight -5 --alpha 90", ("weight = -5.0", "from 0 to 1e+09"), id="weight-negative"),
    pytest.param("critical --weight x --alpha 90", ("'--weight'", "'x' is not a valid float"), id="weight-text"),
    pytest.param("critical --alpha 90", ("Missing option '--weight'",), id="weight-missing"),
    pytest.param("critical --weight 15", ("Missing option '--alpha'",), id="alpha-missing"),
    pytest.param("critical --weight 5 --alpha 90 --modes 0", ("modes = 0", "from 1 to 200"), id="modes-zero"),
    pytest.param("critical --weight 5 --alpha 90 --modes 999", ("modes = 999", "from 1 to 200"), id="modes-many"),
    pytest.param("critical --weight 5 --alpha 90 --modes 2.5", ("'--modes'", "not a valid integer"), id="modes-2.5"),
    pytest.param("critical --weight 5 --alpha 90 --rtol 1", ("rtol = 1.0", "to 0.01"), id="rtol-large"),
    pytest.param("critical --weight 5 --alpha 90 --rtol nan", ("rtol = nan", "from 1e-11"), id="rtol-nan"),
    pytest.param("critical --weight 5 --alpha 90 --clearance 0", ("clearance = 0", "above 0"), id="clearance-zero"),
    pytest.param("critical --wieght 5 --alpha 90", ("--wieght", "--weight"), id="option-misspelt"),
    pytest.param(
        "twist --weight 5 --alpha 90 --poisson .4 --torsion .6", ("--poisson = 0.4", "--torsion"), id="both-torsions"
    ),
    pytest.param(
        "map --quantity critical --weight 5 --alpha 90 --poisson .4 --torsion .6 --out m",
        ("--poisson", "give one"),
        id="map-both",
    ),
    pytest.param("critical --weight 5 --alpha 90 more", ("unexpected extra argument", "more"), id="extra-argument"),
    pytest.param("liftoff --weight 15 --alpha 195", ("alpha = 195.0", "to 180 (s = 1 below)"), id="alpha-195"),
    pytest.param("liftoff --weight 15 --alpha -1", ("alpha = -1.0", "from 0 (vertical)"), id="alpha-negative"),
    pytest.param("liftoff --weight 15 --alpha nan", ("alpha = nan", "must be finite"), id="alpha-nan"),
    pytest.param("liftoff --weight 15 --alpha 90 --clearance 1", ("clearance = 1.0", "below 1"), id="clearance-one"),
    pytest.param("liftoff --weight 15 --alpha 90 --mode 0", ("mode", "= 0", "from 1 to 200"), id="mode-zero"),
    pytest.param("liftoff --weight 15 --alpha 90 --twist inf", ("twist = inf", "must be finite"), id="twist-inf"),
    pytest.param("liftoff --weight 2e9 --alpha 90", ("weight = 2000000000.0", "to 1e+09"), id="weight-large"),
    pytest.param("rn good.toml", ("No such command 'rn'",), id="command-misspelt"),
    pytest.param("run", ("Missing argument 'CASE'",), id="case-missing"),
    pytest.param("run good.toml --jsn", ("--jsn", "--json"), id="run-option-misspelt"),
    pytest.param("run good.toml --out", ("--out", "requires an argument"), id="out-without-folder"),
]


@pytest.mark.parametrize("as_json", [False, True], ids=["text", "json"])
@pytest.mark.parametrize(("line", "phrases"), BAD_OPTIONS)
@pytest.mark.usefixtures("never_computed")
def test_bad_option(rodwell: Run, place: Path, line: str, phrases: tuple[str, ...], as_json: bool) -> None:
    arguments = line.split()
    if as_json:
        arguments.insert(1, "--json")
    code, out, err = rodwell(*arguments)
    assert code == INPUT_ERROR
    assert out == ""
    assert err.lower().count("error:") == 1
    for phrase in phrases:
        assert phrase in err
    assert entries(place) == ["good.toml"]


BAD_CASES = [
    pytest.param("nothing.toml", None, ("case file = 'nothing.toml'", "does not exist"), id="missing"),
    pytest.param("god.toml", None, ("does not exist", "did you mean 'good.toml'?"), id="misspelt"),
    pytest.param(".", None, ("is a folder", "name a TOML file in it"), id="folder"),
    pytest.param("good.toml/case.toml", None, ("case file", "cannot be read"), id="below-a-file"),
    pytest.param("bad.toml", b"", ("bad.toml: rod: is missing", "[dimensionless]"), id="empty"),
    pytest.param("bad.toml", b"[rod\n", ("bad.toml", "is not valid TOML", "line 1"), id="not-toml"),
    pytest.param("bad.toml", b"\xff\x00", ("bad.toml", "is not text in UTF-8"), id="binary"),
    pytest.param("bad.toml", b"[dimensionless]\nweight = nan\n", ("dimensionless.weight = nan",), id="nan"),
    pytest.param("bad.toml", b"[dimensionless]\nweight = 3\nalfa = 9\n", ("did you mean 'alpha'?",), id="misspelt-key"),
    pytest.param("bad.toml", b"rod = 5\n", ("rod = 5", "write [rod]"), id="not-a-section"),
    pytest.param(
        "bad.toml",
        b"[rod]\nlength = '30 kg'\n[hole]\n",
        ("bad.toml: rod.length = '30 kg'", "must be a length", '"30 m"'),
        id="wrong-unit",
    ),
]


@pytest.mark.parametrize("options", [[], ["--json"], ["--quiet"]], ids=["text", "json", "quiet"])
@pytest.mark.parametrize(("name", "content", "phrases"), BAD_CASES)
@pytest.mark.usefixtures("never_computed")
def test_bad_case(
    rodwell: Run, place: Path, name: str, content: bytes | None, phrases: tuple[str, ...], options: list[str]
) -> None:
    if content is not None:
        (place / name).write_bytes(content)
    before = entries(place)
    code, out, err = rodwell("run", name, *options)
    assert code == INPUT_ERROR
    assert out == ""
    assert err.startswith("rodwell: error: ")
    assert err.count("\n") == 1
    for phrase in phrases:
        assert phrase in err
    assert entries(place) == before


def test_all_that_is_wrong_is_said_at_once(rodwell: Run, place: Path) -> None:
    (place / "bad.toml").write_text("[rod]\nlength = '0 m'\nlenght = '3 m'\n[hole]\ndiameter = 70\n", encoding="utf-8")
    code, out, err = rodwell("run", "bad.toml")
    assert (code, out) == (INPUT_ERROR, "")
    assert err.count("rodwell: error") == 1
    assert "rod.length = '0 m': must be above 0" in err
    assert "did you mean 'length'?" in err
    assert "hole.diameter = 70: needs a unit" in err


UNWRITABLE = [
    pytest.param("good.toml", "is a file; name a folder", id="a-file"),
    pytest.param("good.toml/results", "good.toml' is a file", id="below-a-file"),
    pytest.param("good.toml/a/b/c", "good.toml' is a file", id="deep-below-a-file"),
    pytest.param(f"{os.devnull}/results", "is a file", id="below-a-device"),
]


@pytest.mark.parametrize("options", [[], ["--json"]], ids=["text", "json"])
@pytest.mark.parametrize(("out", "phrase"), UNWRITABLE)
@pytest.mark.usefixtures("never_computed")
def test_unwritable_folder(rodwell: Run, place: Path, out: str, phrase: str, options: list[str]) -> None:
    code, printed, err = rodwell("run", "good.toml", "--out", out, *options)
    assert code == INPUT_ERROR
    assert printed == ""
    assert err.startswith(f"rodwell: error: --out = '{out}': ")
    assert err.count("\n") == 1
    assert phrase in err
    assert entries(place) == ["good.toml"]
    assert (place / "good.toml").read_text(encoding="utf-8") == GOOD


@pytest.mark.usefixtures("never_computed")
def test_folder_without_permission(rodwell: Run, place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(**_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(tempfile, "TemporaryDirectory", refuse)
    code, out, err = rodwell("run", "good.toml", "--out", "results")
    assert (code, out) == (INPUT_ERROR, "")
    assert "--out = 'results': cannot be written (Permission denied); name another folder" in err
    assert entries(place) == ["good.toml"]


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="needs /proc")
@pytest.mark.usefixtures("never_computed")
def test_folder_where_nothing_can_be_made(rodwell: Run, place: Path) -> None:
    code, out, err = rodwell("run", "good.toml", "--out", "/proc/results")
    assert (code, out) == (INPUT_ERROR, "")
    assert "--out = '/proc/results': cannot be written (" in err
    assert "name another folder" in err


@pytest.mark.usefixtures("nothing_drawn")
def test_load_beyond_ninety_degrees(rodwell: Run, place: Path) -> None:
    (place / "steep.toml").write_text(BEYOND_RANGE, encoding="utf-8")
    code, out, err = rodwell("run", "steep.toml", "--out", "results", "--json")
    assert (code, err) == (0, "")
    until = json.loads(out)["until"]
    assert (until["force"]["value"], until["reached"]) == (-65.0, False)
    assert "goes no farther than the end force −5" in until["why"]
    assert "results/answer.json" in entries(place)


@pytest.mark.usefixtures("nothing_drawn")
def test_states_that_miss_the_tolerance(rodwell: Run, place: Path) -> None:
    """In a wide cylinder the last states before the end miss a strict tolerance: that is said."""
    strict = BEYOND_RANGE.replace("0.3", "0.7").replace("1e-4", "1e-8")
    (place / "wide.toml").write_text(strict, encoding="utf-8")
    code, out, err = rodwell("run", "wide.toml", "--out", "results", "--json")
    assert code == TOLERANCE_MISSED
    assert re.match(r"rodwell: tolerance missed: mode 1: \d of \d+ points, the first at force = −55\.", err)
    assert err.count("\n") == 1
    data = json.loads(out)
    assert not data["converged"]
    assert [point["converged"] for point in data["branches"][0]["special_points"]] == [True, True, False]
    page = (place / "results" / "report.html").read_text(encoding="utf-8")
    assert "misses the tolerance" in page


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


def test_installed_command_on_bad_input(place: Path) -> None:
    """Once through a fresh interpreter: exit code and streams as the shell sees them."""
    done = subprocess.run(
        [sys.executable, "-m", "rodwell", "run", "god.toml"],
        cwd=place,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
        timeout=100,
    )
    assert done.returncode == INPUT_ERROR
    assert done.stdout == ""
    assert done.stderr == "rodwell: error: case file = 'god.toml': does not exist; did you mean 'good.toml'?\n"
