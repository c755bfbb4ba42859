"""The command line called in this process, from an empty folder, with or without its computation."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest
from bad_commands import GOOD, Run

from rodwell.answers.result.answer import Answer, answer
from rodwell.case.case import Case
from rodwell.cli.main import main


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
