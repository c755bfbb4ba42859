"""What reaches terminal and files is harmless and never lost: encodings, control characters, signals, empty names."""

from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import h5netcdf
import numpy as np
import pytest

from rodwell.answers.result.answer import answer
from rodwell.case.case import Case
from rodwell.cli.catalogue import catalogue
from rodwell.cli.main import main
from rodwell.cli.options import print_json
from rodwell.cli.terminal import PLAIN, ending_well, has_all_characters, never_fail_to_encode
from rodwell.report.folders.case import write_results
from rodwell.store.folder import whole_folder

GOOD = "[dimensionless]\nweight = 16.5\n\n[analysis]\nmodes = 1\nrtol = 1e-4\n"


def run(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> int:
    monkeypatch.setattr(sys, "argv", ["rodwell", *arguments])
    try:
        main()
    except SystemExit as end:
        return int(end.code or 0)
    return 0


# Encodings


@pytest.mark.parametrize(
    ("encoding", "shown"),
    [
        ("ascii", r"gamma = -1 +/- 2 B/L^2, 3 deg ... \u4e2d \udc80"),
        ("cp1252", r"gamma = -1 ± 2 B/L²,3° … \u4e2d \udc80".replace(",3", ", 3")),
        ("utf-8", r"γ = −1 ± 2 B/L², 3° … 中 \udc80"),
    ],
)
def test_no_character_ends_a_run(monkeypatch: pytest.MonkeyPatch, encoding: str, shown: str) -> None:
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding=encoding))
    never_fail_to_encode()
    print("γ = −1 ± 2 B/L², 3° … 中 \udc80", flush=True)
    assert raw.getvalue().decode(encoding) == shown + os.linesep
    assert has_all_characters() is (encoding == "utf-8")
    monkeypatch.undo()


def test_what_stands_for_characters_can_be_written() -> None:
    assert all(plain.isascii() for plain in PLAIN.values())


ON_ASCII = ("critical", "--weight", "0", "--alpha", "90", "--rtol", "1e-4")


def test_a_terminal_of_ascii() -> None:
    """Through a fresh interpreter, as the shell sees it."""
    done = subprocess.run(
        [sys.executable, "-m", "rodwell", *ON_ASCII],
        env=os.environ | {"PYTHONIOENCODING": "ascii"},
        capture_output=True,
        check=False,
        timeout=100,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert "B/L^2" in done.stdout.decode("ascii")


def test_json_on_a_terminal_of_ascii(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the escapes of JSON, not with what stands for a character elsewhere."""
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding="ascii"))
    never_fail_to_encode()
    print_json({"unit": "B/L², 中"})
    sys.stdout.flush()
    assert json.loads(raw.getvalue().decode("ascii")) == {"unit": "B/L², 中"}
    monkeypatch.undo()


# Control characters, from the title of a case to every file

ESCAPES = "a\x1b[31mb\x00c\u202e <b> = [bold]"
PICTURES = ("bifurcation", "modes", "wall-loads", "cylinder", "rod-3d", "along-rod")
HARMLESS = r"a\x1b[31mb\x00c\u202e <b> = [bold]"


def test_a_title_with_control_characters_loses_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pypdf = pytest.importorskip("pypdf")
    empty = {"svg": b'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"></svg>'}
    pictures = dict.fromkeys(PICTURES, empty)
    monkeypatch.setattr("rodwell.report.folders.beside.drawing", lambda: lambda *_: pictures)  # they have no title
    text = f"title = {json.dumps(ESCAPES)}\n{GOOD}"
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    case = Case.read(tmp_path / "case.toml")
    files = write_results(answer(case), tmp_path / "out", with_pdf=True)
    for name in files:
        if Path(name).suffix in (".html", ".json", ".csv", ".svg", ".toml"):
            content = (tmp_path / "out" / name).read_text(encoding="utf-8")
            assert not [c for c in content if c in "\x00\x1b\u202e"], name
    assert HARMLESS.replace("<", "&lt;").replace(">", "&gt;") in (tmp_path / "out" / "report.html").read_text("utf-8")
    assert HARMLESS in json.dumps(json.loads((tmp_path / "out" / "answer.json").read_text("utf-8"))).replace(
        "\\\\", "\\"
    )
    assert (tmp_path / "out" / "case.toml").read_text(encoding="utf-8") == text
    with h5netcdf.File(tmp_path / "out" / "branches.nc") as file:
        assert file.attrs["title"] == HARMLESS
    pages = "".join(page.extract_text() for page in pypdf.PdfReader(tmp_path / "out" / "report.pdf").pages)
    assert r"\x1b[31mb\x00c" in pages.replace("\n", "")


def test_an_escape_sequence_in_an_option(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(monkeypatch, "run", "\x1b[31m.toml") == 2
    assert "\x1b" not in capsys.readouterr().err


# Names of folders, options without meaning


@pytest.mark.parametrize(
    "arguments",
    [
        ("run", "case.toml"), ("audit", "case.toml"), ("screen", "well.csv", "--case", "case.toml"),
        ("diagram", "--weight", "1", "--alpha", "90"),
        ("curve", "critical", "--over", "weight", "--from", "1", "--to", "2", "--alpha", "90"), ("paper",),
    ],
    ids=lambda given: given[0],
)  # fmt: skip
def test_an_empty_name_is_no_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(monkeypatch, *arguments, "--out", "") == 2
    err = capsys.readouterr().err
    assert err.startswith("rodwell: error: --out = '': is empty; name a folder")
    assert list(tmp_path.iterdir()) == []


def test_a_unit_without_a_column(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("well.csv").write_text("MD [m],Inc [deg]\n0,0\n100,20\n", encoding="utf-8")
    Path("case.toml").write_text(GOOD, encoding="utf-8")
    assert run(monkeypatch, "screen", "well.csv", "--case", "case.toml", "--force-unit", "xx") == 2
    assert "--force-unit = 'xx': is given, but there is no column of force" in capsys.readouterr().err


def test_results_of_a_case_without_a_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """From standard input they go to results/case; the study is found in what was read once."""
    monkeypatch.chdir(tmp_path)
    study = "study = true\n" + GOOD.replace("16.5", "[0.0, 0.1]")
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(study.encode())))
    assert run(monkeypatch, "run", "-", "--quiet") == 0
    assert capsys.readouterr().err == ""
    assert (tmp_path / "results" / "case" / "points.csv").exists()
    assert (tmp_path / "results" / "case" / "case.toml").read_text(encoding="utf-8") == study


# Signals

SCRIPT = """
import signal, time
signal.signal(signal.{name}, signal.SIG_DFL)  # also where the parent ignores it
from pathlib import Path
from rodwell.cli.catalogue import catalogue
from rodwell.cli.catalogue import catalogue
from rodwell.cli.main import main
from rodwell.cli.options import print_json
from rodwell.store.folder import whole_folder

def endless(**_):
    with whole_folder(Path("results")) as folder:
        (folder / "half.png").write_bytes(b"half")
        print("ready", flush=True)
        time.sleep(120)

catalogue.callback = endless
import sys
sys.argv = ["rodwell", "catalogue"]
main()
"""


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_signals_that_end_a_run_leave_nothing(tmp_path: Path, name: str) -> None:
    number = getattr(signal, name)
    with subprocess.Popen(
        [sys.executable, "-c", SCRIPT.format(name=name)],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "ready\n"
            process.send_signal(number)
            _, err = process.communicate(timeout=60)
        finally:
            process.kill()
    assert process.returncode == 128 + number
    assert err.strip() == f"rodwell: ended by {name}; nothing was written"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="signals of POSIX")
def test_a_signal_that_is_ignored_stays_ignored() -> None:
    """Under nohup."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with ending_well():
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
            assert signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL
        assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    finally:
        signal.signal(signal.SIGHUP, before)


# Memory


def test_too_little_memory_is_said_in_a_line_and_leaves_nothing_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def greedy(**_: object) -> None:
        with whole_folder(tmp_path / "results") as folder:
            (folder / "half.png").write_bytes(b"half")
            np.ones(10**15)

    monkeypatch.setattr(catalogue, "callback", greedy)
    assert run(monkeypatch, "catalogue") == 1
    said = capsys.readouterr().err
    assert said.startswith("rodwell: error: there is not memory enough: Unable to allocate")
    assert said.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


# Reasons


def test_why_there_is_no_lift_off(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    given = ("--weight", "1.5293", "--alpha", "34.887", "--clearance", "0.016756", "--ends", "guided-free")
    assert run(monkeypatch, "liftoff", *given) == 1
    assert "without lift-off (the end of the search was reached)" in capsys.readouterr().err
