"""What makes a case file a parameter study: a range, or lists in a file that says so."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

import rodwell
from rodwell import InputError
from rodwell.cli.main import cli
from rodwell.studies.sweep.varied import is_study, varied_inputs

TAPER = """
[rod]
length = "30 m"
bending_stiffness = ["1e6 N m^2", "2e6 N m^2"]
weight_per_length = "300 N/m"
[hole]
clearance = "30 cm"
angle_from_vertical = "90 deg"
"""
WEIGHTS = "[dimensionless]\nweight = [5, 15]\n"


def run(folder: Path, text: str) -> Result:
    file = folder / "case.toml"
    file.write_text(text, encoding="utf-8")
    return CliRunner().invoke(cli, ["run", str(file), "--out", str(folder / "out"), "--json"])


def test_a_list_meant_as_a_taper_is_refused(tmp_path: Path) -> None:
    told = str(run(tmp_path, TAPER).exception)
    assert "rod.bending_stiffness = ['1e6 N m^2', '2e6 N m^2']" in told
    assert "study = true at the top of the file" in told
    assert "written as one [[string]] for each section" in told
    assert not (tmp_path / "out").exists()


def test_a_list_beside_a_range_is_refused_too(tmp_path: Path) -> None:
    told = str(run(tmp_path, TAPER.replace('"90 deg"', '"60..90 deg in 2"')).exception)
    assert "rod.bending_stiffness" in told
    assert "study = true" in told


@pytest.mark.parametrize("text", [WEIGHTS, TAPER])
def test_declared_lists_are_a_study(tmp_path: Path, text: str) -> None:
    data: dict[str, Any] = json.loads(run(tmp_path, f"study = true\n{text}").output)
    assert len(data["points"]) == 2
    assert "study" not in data.get("given", {})


def test_a_range_needs_no_word(tmp_path: Path) -> None:
    assert len(json.loads(run(tmp_path, WEIGHTS.replace("[5, 15]", '"5..15 in 2"')).output)["points"]) == 2


def test_what_counts_as_a_study(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    for text, is_one in (
        (WEIGHTS, False), (f"study = true\n{WEIGHTS}", True), (f"study = false\n{WEIGHTS}", False),
        ('[dimensionless]\nweight = "5..15 in 2"\n', True), ("study = true\n[dimensionless]\nweight = 5\n", True),
        ("[dimensionless]\nweight = 5\n[load]\napplied = [-1, -2]\n", False),
    ):  # fmt: skip
        file.write_text(text, encoding="utf-8")
        assert is_study(file) is is_one


def test_a_study_in_which_nothing_varies_says_so(tmp_path: Path) -> None:
    told = str(run(tmp_path, "study = true\n[dimensionless]\nweight = 5\n").exception)
    assert "no input that varies" in told


def test_from_python_the_call_says_it_for_a_dictionary_and_the_file_for_itself(tmp_path: Path) -> None:
    assert len(rodwell.study({"dimensionless": {"weight": [5, 15]}}).points) == 2
    file = tmp_path / "case.toml"
    file.write_text(WEIGHTS, encoding="utf-8")
    with pytest.raises(InputError, match=r"dimensionless.weight = \[5, 15\].*study = true"):
        rodwell.study(file)


@pytest.mark.parametrize(
    ("text", "remedy"),
    [
        ("1...2 m in 3", "1..2 m in 3"),
        ("1 ... 2 m in 3", "1..2 m in 3"),
        ("30 deg...90 deg in 3", "30 deg..90 deg in 3"),
        ("0.5...2 m in 3", "0.5..2 m in 3"),
        ("-2...-1 kN in 3", "-2..-1 kN in 3"),
        ("1…2 m in 3", "1..2 m in 3"),
        ("1....2 m in 3", "..2 m in 3"),
    ],
)
def test_three_dots_are_refused_with_the_range_that_is_meant(text: str, remedy: str) -> None:
    with pytest.raises(InputError) as caught:
        varied_inputs({"rod": {"length": text}})
    told = str(caught.value)
    assert f"rod.length = {text!r}" in told
    assert remedy in told or "is not a range" in told


@pytest.mark.parametrize("text", ["1." + "1" * 50_000 + ".. 2 in 3", "." * 100_000, "1" + ".. in 3" * 20_000])
def test_long_texts_are_no_ranges_and_take_no_time(text: str) -> None:
    start = time.perf_counter()
    assert varied_inputs({"rod": {"length": text}}) == ()
    with pytest.raises(InputError, match=r"rod.length"):
        rodwell.Case.from_dict({"rod": {"length": text}, "hole": {"diameter": "1 m", "angle_from_vertical": "0 deg"}})
    assert time.perf_counter() - start < 2.0


@pytest.mark.parametrize("text", [".1...3 m in 3", "1 .. .2 m in 3", "0.1..0.3 m in 3"])
def test_numbers_that_begin_with_their_point(text: str) -> None:
    (found,) = varied_inputs({"rod": {"length": text}})
    assert found.numbers is not None
    assert len(found.numbers) == 3
