"""The answer to a case: numbers, sentences, results folder, report, command line."""

from __future__ import annotations

import csv
import json
import re
import sys
from pathlib import Path

import numpy as np
import openpyxl
import pytest
import xarray as xr

import rodwell
from rodwell.analysis.state.extent import buckled_to
from rodwell.answers.words.meaning import sentences
from rodwell.cli.main import main
from rodwell.quantities.text import SEPARATOR
from rodwell.quantities.value import Value
from rodwell.report.reports.files import FILES
from rodwell.report.reports.texts import number

EXAMPLE = Path(__file__).parents[2] / "examples" / "drill-string.toml"


def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, *arguments: str) -> str:
    monkeypatch.setattr(sys, "argv", ["rodwell", *arguments])
    main()
    return capsys.readouterr().out


def dimensionless(weight: float, alpha: float = 90.0, **load: float) -> rodwell.Case:
    return rodwell.Case.from_dict({"dimensionless": {"weight": weight, "alpha": alpha}, "load": load})


@pytest.fixture(scope="module")
def drill_string() -> rodwell.Answer:
    return rodwell.answer(rodwell.Case.read(EXAMPLE))


def test_answer_holds_the_numbers_of_the_engine(drill_string: rodwell.Answer) -> None:
    problem = drill_string.case.problem
    assert drill_string.critical.forces == pytest.approx(rodwell.critical_loads(problem, 4).forces, rel=1e-12)
    lift = rodwell.follow(problem).lift_off
    assert lift is not None
    assert drill_string.lift_off is not None
    assert drill_string.lift_off.force == pytest.approx(lift.force, abs=lift.error + drill_string.lift_off.error)
    force, _, unit = drill_string.key_numbers["lift_off_load"].physical(drill_string.case)  # type: ignore[misc]
    assert (force, unit) == (pytest.approx(lift.force * 2e11 * np.pi * 0.05**4 / 4.0 / 30.0**2), "N")
    assert drill_string.converged
    assert drill_string.worst_certificate.passed


def test_weight_is_in_balance_with_the_wall(drill_string: rodwell.Answer) -> None:
    """Vertical balance of the whole rod at lift-off: ∫−p cos ξ₂ ds plus end shears carry mg L."""
    state = drill_string.at_lift_off
    assert state is not None
    s = np.linspace(0.0, 1.0, 4001)
    f = state.fields(s)
    lift = np.trapezoid(-f["contact_pressure"] * np.cos(f["xi2"]), s)
    ends = f["rod_F2"][-1] - f["rod_F2"][0]  # d₁ points up at both ends
    assert lift + ends == pytest.approx(state.problem.weight, rel=1e-6)


def test_sentences_say_end_sign_and_condition(drill_string: rodwell.Answer) -> None:
    text = " ".join(sentences(drill_string))
    assert "stable until the compression reaches 124.6 kN" in text
    assert "lifts off at 15 m from the end s = 0" in text
    assert "supports need no torque" in text


@pytest.mark.parametrize(
    ("case", "phrase"),
    [
        (dimensionless(100.0, 0.0), "buckles under its own weight"),
        (dimensionless(0.0), "Lift-off coincides with buckling"),
        (dimensionless(5.0), "must provide a torque"),
        (dimensionless(15.0, until=-50.0), "the straight rod is stable; the diagrams go beyond"),
        (dimensionless(15.0, until=-115.0), "does not lift off the wall down to"),
        (dimensionless(62.3), "imperfections may favour either"),
    ],
    ids=["self-weight", "weightless", "torque", "safe load", "no lift-off", "close modes"],
)
def test_sentences_of_other_cases(case: rodwell.Case, phrase: str) -> None:
    assert phrase in " ".join(sentences(rodwell.answer(case)))


def test_run_writes_everything(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "deep" / "results"
    text = run(capsys, monkeypatch, "run", str(EXAMPLE), "--no-path", "--out", str(out))
    assert "124.6 kN" in text
    assert f"Report: {out / 'report.html'}" in text.replace("\n", "")
    pictures = {
        f"{name}.png" for name in ("sketch", "bifurcation", "modes", "wall-loads", "cylinder", "rod-3d", "along-rod")
    }
    drawn = {name.replace("png", "svg") for name in pictures} - {"rod-3d.svg"}
    assert {file.name for file in out.iterdir()} == set(FILES) - {
        "load-path.csv",
        "load-path-3d.html",
    } | pictures | drawn
    assert list(out.parent.iterdir()) == [out]
    assert (out / "case.toml").read_text(encoding="utf-8") == EXAMPLE.read_text(encoding="utf-8")
    page = (out / "report.html").read_text(encoding="utf-8")
    shown = re.findall(r"src=\"([^\"]{0,5})", page)
    assert set(shown) == {"data:"}  # self-contained: works offline
    links = [link for link in re.findall(r"href=\"([^\"]*)\"", page) if not link.startswith("#")]
    assert set(links) == {file.name for file in out.iterdir()} - {
        "report.html"
    }  # to every file beside it, and to no other
    assert "139.582" in page
    for file in pictures:
        assert (out / file).stat().st_size > 10_000
    _check_sheets(out)
    with xr.open_dataset(out / "branches.nc", engine="h5netcdf") as data:
        assert data["contact_pressure"].attrs["equation"] == "(55)"
        assert data["contact_pressure"].attrs["si_units"] == "N/m"
        assert data.attrs["rodwell_version"] == rodwell.__version__
        assert data.attrs["rtol"] == 1e-8
        assert "outer_diameter" in data.attrs["case"]
        assert set(np.unique(data["branch"])) == {1, 2, 3, 4}
        kinds = data["special_kind"].values[data["special_branch"].values == 1]
        assert list(kinds) == ["critical", "lift_off", "end"]


def _check_sheets(out: Path) -> None:
    """The workbook has a sheet for each state, with the rows that the CSV file has of it, and what must hold there."""
    book = openpyxl.load_workbook(out / "tables.xlsx", read_only=True)
    assert book.sheetnames == ["Key figures", "Special points", "at buckling", "at lift-off"]
    with (out / "along-rod.csv").open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    for state in book.sheetnames[2:]:
        title, *sheet = book[state].iter_rows(values_only=True)
        assert list(title) == head[1:]
        numbers = [row for row in sheet if isinstance(row[1], float | int)]
        expected = [[float(x) for x in row[1:]] for row in rows if row[0] == state]
        np.testing.assert_allclose(np.array(numbers, dtype=float), expected, rtol=1e-14)
        pressure = head.index("contact force per length on the wall, -p [N/m]") - 1
        least = min(float(row[pressure]) for row in numbers)
        weight = 7800.0 * 9.8 * np.pi * 0.05**2  # of the drill string: the straight rod bears on the wall with it
        assert least == pytest.approx(weight if state == "at buckling" else 0.0, abs=1e-3)


@pytest.mark.usefixtures("nothing_drawn")
def test_run_as_json(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    case = tmp_path / "case.toml"
    case.write_text("[dimensionless]\nweight = 15.0\n[load]\nuntil = -150.0\n", encoding="utf-8")
    data = json.loads(run(capsys, monkeypatch, "run", str(case), "--no-path", "--out", str(tmp_path / "r"), "--json"))
    assert data["critical_loads"][:2] == pytest.approx([-111.2334402, -127.2577803], abs=5e-8)
    assert data["lift_off"]["force"] == pytest.approx(-123.173074, abs=5e-7)
    assert data["figures"]["support_torque"]["value"] == 0.0
    assert data["converged"] is True


@pytest.mark.usefixtures("nothing_drawn")
def test_quiet_prints_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    case = tmp_path / "case.toml"
    case.write_text("[dimensionless]\nweight = 15.0\n[analysis]\nmodes = 1\n", encoding="utf-8")
    assert run(capsys, monkeypatch, "run", str(case), "--no-path", "--out", str(tmp_path / "r"), "--quiet") == ""


def test_critical_and_liftoff_as_json(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    loads = json.loads(run(capsys, monkeypatch, "critical", "--weight", "15", "--alpha", "90", "--json"))
    assert loads["critical_loads"][:2] == pytest.approx([-111.2334402, -127.2577803], abs=5e-8)
    assert len(loads["critical_loads"]) == len(loads["error"]) == 5
    top = json.loads(run(capsys, monkeypatch, "critical", "--weight", "5.0056", "--alpha", "90", "--on-top", "--json"))
    assert top["critical_loads"][0] == pytest.approx(0.0, abs=1e-3)
    lift = json.loads(run(capsys, monkeypatch, "liftoff", "--weight", "15", "--alpha", "90", "--json"))
    assert lift["critical_load"] == pytest.approx(-111.2334402, abs=5e-8)
    assert lift["lift_off"]["force"] == pytest.approx(-123.173074, abs=5e-7)
    assert lift["lift_off"]["s"] == pytest.approx([0.5], abs=1e-7)
    vertical = json.loads(run(capsys, monkeypatch, "liftoff", "--weight", "100", "--alpha", "0", "--json"))
    assert vertical["coincides_with_buckling"] is True
    assert vertical["lift_off"]["force"] == vertical["critical_load"] == pytest.approx(14.3626, abs=5e-5)


def test_human_output_states_end_sign_and_error(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for command in ("critical", "liftoff"):
        text = run(capsys, monkeypatch, command, "--weight", "15", "--alpha", "90")
        assert "End force" in text or "end force" in text
        assert "s = 1" in text
        assert "tension positive" in text
        assert "both ends clamped" in text
        assert "±" in text
        assert "−111.2334402" in text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [(-123.17307438, 4e-9, "−123.1730744"), (-123.17307438, 1e-3, "−123.173"), (0.0, 1e-9, "0"), (5.0, 4.0, "5")],
)
def test_numbers_show_the_digits_that_their_error_supports(value: float, error: float, text: str) -> None:
    assert number(Value(value, error)) == text


def test_a_long_string_buckles_at_its_lower_end() -> None:
    """Of 3,000 m the wave fades above the place where compression has fallen to 2√(B w sin α/r)."""
    answer = rodwell.answer(rodwell.Case.read(EXAMPLE.with_name("long-string.toml")))
    problem, first = answer.case.problem, answer.critical[0]
    fades = 1.0 - (2.0 * np.sqrt(problem.lateral_weight / problem.clearance) + first.force) / problem.axial_weight
    assert answer.converged
    text = " ".join(sentences(answer))
    printed = re.search(r"Beyond ([0-9.\u202f]+) m above .*? the rod stays straight", text).group(1)  # type: ignore[union-attr]
    printed = f"{float(printed.replace(SEPARATOR, '')) / answer.case.scales.length:.3g}"
    assert 0.0 < fades < float(printed) < fades + 0.06
    assert f"{buckled_to(first):.{len(printed) - 2}f}" == printed


@pytest.mark.parametrize("alpha", [0.0, 60.0, 89.0])
def test_where_a_long_string_is_straight(alpha: float) -> None:
    """A look at every place: at the end of the buckled part it deflects by a thousandth, nowhere beyond by as much."""
    for mode in rodwell.critical_loads(rodwell.Problem(1e5, alpha=alpha, clearance=1e-4), 2):
        end = buckled_to(mode)
        largest = np.max(np.abs(mode.shape(np.linspace(0.0, 1.0, 200_001))))
        assert 0.01 < end < 1.0
        assert np.abs(mode.shape(np.array([end])))[0] == pytest.approx(1e-3 * largest, rel=1e-4)
        assert np.max(np.abs(mode.shape(np.linspace(end + 1e-9, 1.0, 200_001)))) < 1e-3 * largest


def test_straight_and_short_rods_have_an_extent_too() -> None:
    mode = rodwell.critical_loads(rodwell.Problem(15.0, ends=("clamped", "free")), 1)[0]
    assert buckled_to(mode) == 1.0
    assert buckled_to(rodwell.follow(rodwell.Problem(15.0))[0]) == 0.0
