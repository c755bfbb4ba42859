"""Code that readers copy: README and quick starts run as they stand. The build of the pages runs their samples."""

from __future__ import annotations

import re
import runpy
import shlex
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rodwell.cli.main import cli

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "docs" / "quickstart.md", *sorted((ROOT / "docs" / "start").glob("*.md"))]


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the examples in it, as in a copy of the repository."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    (tmp_path / "results").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_python_of_the_readme(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """−123.1730743 is AUTO-07p's; the odd mode lifts off at mid-length; critical loads are roots of (77)."""
    (code,) = blocks(ROOT / "README.md", "python")
    names: dict[str, Any] = {}
    exec(compile(code, "README.md", "exec"), names)
    lift = names["branch"].lift_off
    assert lift.force == pytest.approx(-123.1730743, abs=1e-6)
    assert lift.s == pytest.approx((0.5,), abs=1e-9)

    def equation_77(force: float) -> float:
        root = np.sqrt(force**2 - 4.0 * 15.0 / 0.01)
        k1, k3 = np.sqrt((-force - root) / 2.0), np.sqrt((-force + root) / 2.0)
        return float(2 * k1 * k3 * (1 - np.cos(k1) * np.cos(k3)) - (k1**2 + k3**2) * np.sin(k1) * np.sin(k3))

    for force in names["loads"].forces:
        assert equation_77(force * (1 - 1e-9)) * equation_77(force * (1 + 1e-9)) < 0.0
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for force in names["loads"].forces[:2]:
        assert f"−{int(-1e4 * force) / 1e4:.4f}…" in text
    assert names["state"].stable
    assert (place / "branch.nc").stat().st_size > 0
    assert "-123.17307" in capsys.readouterr().out


def commands() -> list[tuple[str, str]]:
    """Every line of the pages that calls rodwell, as (page, line)."""
    call = re.compile(r"(?:^|/)rodwell ([a-z][^#\n]*)", re.MULTILINE)
    return [(page.name, line.strip()) for page in PAGES for sh in blocks(page, "sh") for line in call.findall(sh)]


@pytest.mark.parametrize(("page", "line"), commands())
def test_commands_of_the_pages_are_understood(page: str, line: str, place: Path) -> None:
    words = shlex.split(line)
    words = ["examples/drill-string.toml" if word == "case.toml" else word for word in words]
    words = ["examples/well-survey.csv" if word == "survey.csv" else word for word in words]
    name, command, rest = cli.resolve_command(cli.make_context("rodwell", list(words)), words)
    assert command is not None
    command.make_context(name, rest)


def test_the_readme_is_the_front_door() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for marker in ("<!-- first command -->", "<!-- test command -->"):
        assert re.search(rf"{marker}\n```sh\npython3 .*\n```", text)
    links = re.findall(r"\]\(([^)#]+)", text)
    assert all((ROOT / link).exists() for link in links if not link.startswith("http"))
    assert len(commands()) > 12


def test_check_of_the_site_sees_what_is_wrong(tmp_path: Path) -> None:
    problems = runpy.run_path(str(ROOT / "docs" / "check_site.py"))["problems"]
    good = '<p id="here"></p><a href="#here">x</a><a href="https://example.org">far, but not loaded</a>'
    (tmp_path / "a.html").write_text(good, encoding="utf-8")
    assert problems(tmp_path) == []
    bad = '<script src="https://cdn.example/x.js"></script><a href="b.html">x</a><a href="a.html#gone">y</a>'
    (tmp_path / "c.html").write_text(bad, encoding="utf-8")
    (tmp_path / "s.css").write_text("@import url(//fonts.example/f.css);", encoding="utf-8")
    assert len(problems(tmp_path)) == 4
    assert problems(tmp_path / "nothing") != []
