"""Bad input to the command line: one message, an exit code, no traceback, and no half-written files."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from bad_commands import BEYOND_RANGE, GOOD, INPUT_ERROR, TOLERANCE_MISSED, Run, entries

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
