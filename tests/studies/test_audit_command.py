"""The command for audits: words, loads that act, JSON in SI, files, bad input."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.formulas import LEFT_OUT

# -- command

DIMENSIONLESS = "[dimensionless]\nweight = 280\nalpha = 30\n"
PIPE = Path(__file__).parents[2] / "examples" / "inclined-pipe.toml"


def run(*arguments: str) -> Any:
    return CliRunner().invoke(cli, arguments, env={"COLUMNS": "200"})


def test_command_in_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("steep.toml").write_text(DIMENSIONLESS, encoding="utf-8")
    done = run("audit", "steep.toml", "--friction", "0.2", "--details")
    assert done.exit_code == 0, done.output
    assert "+136.1 %" in done.output  # Dellinger's fit, 303.8 beside 128.7
    assert "Compression positive" in done.output
    assert "unsafe" in done.output
    assert all(item.name in done.output for item in LEFT_OUT)
    assert sorted(p.name for p in Path("results/steep-audit").iterdir()) == [
        "audit-chart.csv", "audit-chart.png", "audit-chart.svg", "audit.csv", "audit.json", "report.html",
    ]  # fmt: skip
    with Path("results/steep-audit/audit.csv").open(encoding="utf-8") as file:
        lines = [line for line in csv.DictReader(file) if line["key"] == "dellinger"]
    top = next(line for line in lines if (line["load"], line["place"]) == ("critical", "top"))
    assert float(top["percent"]) == pytest.approx(136.05, abs=0.01)
    assert top["safe"] == "False"


def test_command_names_the_loads_that_act(tmp_path: Path) -> None:
    field = Path(__file__).parents[2] / "examples" / "field-drill-pipe.toml"
    done = run("audit", str(field), "--no-chart", "--details", "--out", str(tmp_path / "here"))
    assert done.exit_code == 0, done.output
    assert "at the first critical load (29\u202f109 lbf of compression at the bottom)" in done.output
    assert (
        "at the applied load, −35\u202f000 lbf at the bottom (35\u202f000 lbf of compression at the bottom)"
        in done.output
    )
    assert done.output.count("Contact force of the helix  ") == 2
    assert "low: below it, but the formula is not meant for such a rod" in done.output


def test_command_as_json_in_si(tmp_path: Path) -> None:
    done = run("audit", str(PIPE), "--no-chart", "--json", "--out", str(tmp_path / "here"))
    assert done.exit_code == 0, done.output
    data = json.loads(done.output)
    row = next(item for item in data["formulas"] if item["key"] == "dawson_paslay")
    lbf = 4.4482216152605
    expected = 36_704.84 * lbf * math.sqrt(math.sin(math.pi / 4.0))  # the field example, at 45°
    assert row["si"]["value"] == pytest.approx(expected, rel=2e-5)
    stress = next(item for item in data["other_formulas"] if item["key"] == "helix_bending_stress")
    bottom = data["exact"][0]["si"]["force"] * -1.0 + 16.523 * lbf / 0.3048 * 300.0 * math.cos(math.pi / 4.0)
    inertia = 14.269158404 * 0.0254**4
    assert stress["si"]["value"] == pytest.approx(5 * 0.0254 * 1.75 * 0.0254 * bottom / (4.0 * inertia), rel=1e-6)
    assert sorted(p.name for p in (tmp_path / "here").iterdir()) == ["audit.csv", "audit.json", "report.html"]


def test_command_refuses_bad_input(tmp_path: Path) -> None:
    assert run("audit", str(tmp_path / "none.toml")).exit_code != 0
    case = tmp_path / "steep.toml"
    case.write_text(DIMENSIONLESS, encoding="utf-8")
    done = run("audit", str(case), "--friction", "-1", "--out", str(tmp_path / "out"))
    assert isinstance(done.exception, InputError)
    assert "mu" in str(done.exception)
    assert not (tmp_path / "out").exists()
