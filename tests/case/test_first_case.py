"""First cases of ``rodwell init``: they run, hold the answers, overwrite nothing, are written whole or not at all."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from rodwell import Case, InputError
from rodwell.case.first_case import KINDS, first_case
from rodwell.case.keys import every_key
from rodwell.cli import init as command
from rodwell.cli.main import cli


def run(*words: str, typed: str = "") -> Result:
    return CliRunner().invoke(cli, list(words), input=typed)


@pytest.mark.parametrize("kind", list(KINDS))
def test_the_file_runs(kind: str, tmp_path: Path) -> None:
    file = tmp_path / "first.toml"
    assert run("init", str(file), "--kind", kind).exit_code == 0
    done = run("run", str(file), "--no-path", "--out", str(tmp_path / "out"), "--json")
    assert done.exit_code == 0
    answer = json.loads(done.output)
    assert answer["converged"]
    assert answer["figures"]["critical_load_1"]["value"] < 0.0


@pytest.mark.parametrize("units", ["si", "field", "mm"])
@pytest.mark.parametrize("kind", list(KINDS))
def test_every_kind_in_all_units_is_a_case_with_comments(kind: str, units: str) -> None:
    text = first_case(kind, {}, units)
    case = Case.from_dict(tomllib.loads(text))
    assert case.scales is not None
    assert case.scales.system.name == units
    lines = text.splitlines()
    assert max(map(len, lines)) <= 100
    known = {key.name for keys in every_key().values() for key in keys}
    for number, line in enumerate(lines):
        name = line.removeprefix("# ").partition(" = ")[0]
        if " = " in line and name in known - {"title", "units"}:
            assert lines[number - 1].startswith("# ")


@pytest.mark.parametrize("kind", list(KINDS))
def test_hints_are_right_when_they_are_taken(kind: str) -> None:
    """Keys in comments, with the marks taken away, make a case as well."""
    names = {key.name for keys in every_key().values() for key in keys}
    sections = {f"[{section}]" for section in every_key()}

    def taken(line: str) -> str:
        bare = line.removeprefix("# ")
        return bare if bare in sections or bare.partition(" = ")[0] in names else line

    Case.from_dict(tomllib.loads("\n".join(map(taken, first_case(kind, {}).splitlines()))))


def test_answers_stand_in_the_file(tmp_path: Path) -> None:
    file = tmp_path / "wire.toml"
    given = {"pipe": "5 Fr catheter", "length": "200 mm", "stiffness": "900 N·mm²", "weight": "0 N/m", "load": "-2 N"}
    options = [word for name, value in given.items() for word in (f"--{name}", value)]
    assert run("init", str(file), "--kind", "wire", "--title", 'A "5 Fr" shaft', *options).exit_code == 0
    case = Case.read(file)
    assert case.title == 'A "5 Fr" shaft'
    assert case.scales is not None
    assert (case.scales.length, case.scales.stiffness) == pytest.approx((0.2, 9e-4))
    assert case.applied[0].given == -2.0


def test_nothing_is_overwritten_without_force(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("precious", encoding="utf-8")
    refused = run("init", str(file), "--kind", "well")
    assert refused.exit_code != 0
    assert isinstance(refused.exception, InputError)
    assert "--force" in str(refused.exception)
    assert file.read_text(encoding="utf-8") == "precious"
    assert run("init", str(file), "--kind", "well", "--force").exit_code == 0
    assert Case.read(file).problem.alpha == 30.0
    assert [one.name for one in tmp_path.iterdir()] == ["mine.toml"]


@pytest.mark.parametrize("force", [[], ["--force"]])
def test_a_file_is_written_whole_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, force: list[str]
) -> None:
    file = tmp_path / "mine.toml"
    if force:
        file.write_text("precious", encoding="utf-8")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    result = run("init", str(file), "--kind", "well", *force)
    assert isinstance(result.exception, InputError)
    assert "No space left on device" in str(result.exception)
    assert [one.name for one in tmp_path.iterdir()] == (["mine.toml"] if force else [])
    assert not force or file.read_text(encoding="utf-8") == "precious"


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--kind", "rocket"], ["rocket", "well", "wire", "robot"]),
        ([], ["--kind", "well, wire, robot"]),
        (["--kind", "well", "--length", "30 kg"], ["rod.length", "30 kg", "must be a length"]),
        (["--kind", "well", "--pipe", "hose"], ["rod.pipe", "hose", "not in the catalogue"]),
        (["--kind", "well", "--hole", "4 in"], ["hole.diameter", "4 in", "does not fit"]),
        (["--kind", "well", "--length", "0 m", "--angle", "95"], ["rod.length", "hole.angle_from_vertical"]),
        (["--kind", "robot", "--mud", "10 lb/gal"], ["mud", "10 lb/gal", "is not asked for kind robot"]),
        (["--kind", "well", "--pipe", "a\x00b"], ["first case"]),
        (["--kind", "well", "--units", "imperial"], ["imperial", "field"]),
    ],
)
def test_wrong_answers_leave_no_file(tmp_path: Path, words: list[str], told: list[str]) -> None:
    file = tmp_path / "first.toml"
    result = run("init", str(file), *words)
    assert result.exit_code != 0
    said = result.output + str(result.exception)
    for word in told:
        assert word in said
    assert not list(tmp_path.iterdir())


def test_no_folder(tmp_path: Path) -> None:
    result = run("init", str(tmp_path / "none" / "first.toml"), "--kind", "well")
    assert isinstance(result.exception, InputError)
    assert "make its folder" in str(result.exception)


def test_on_a_terminal_it_asks_and_asks_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command, "_asks", lambda: True)
    file = tmp_path / "first.toml"
    typed = "rocket\nrobot\nmm\nwood\nPEEK\n2 kg\n2 m\n\n50 mm\n"
    result = run("init", str(file), "--diameter", "8 mm", typed=typed + "10 deg\n")
    assert result.exit_code == 0, result.output
    assert "must be a length" in result.output
    assert "not in the catalogue; it holds" in result.output
    case = Case.read(file)
    assert case.rod is not None
    assert (case.rod.length, case.rod.outer_diameter, case.problem.alpha) == pytest.approx((2.0, 8e-3, 10.0))
