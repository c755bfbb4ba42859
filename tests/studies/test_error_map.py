"""Maps of the errors of formulas: the same machinery as every map, so kept, resumed, on workers, refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import rodwell
from rodwell.cli.main import cli
from rodwell.errors import InputError, NotConvergedError
from rodwell.studies.audit.error_map import CRITICAL, ErrorMap, chart_over, error_map
from rodwell.studies.maps.cells import IN_WORDS, NOT_COMPUTED

LYING = rodwell.Problem(15.0, 90.0, 0.02, ends="pinned-pinned")
WEIGHTS = [2.0, 15.0, 60.0, 240.0]

CASE = '[dimensionless]\nweight = 15\nalpha = {alpha}\nclearance = 0.02\nends = "pinned-pinned"\n'


def pinned_load(weight: float, clearance: float) -> float:
    """Critical compression of a horizontal rod with pinned ends: that of a beam on springs γ/Δ, the least over n."""
    squares = [(n * math.pi) ** 2 for n in range(1, 12)]
    return min(square + weight / clearance / square for square in squares)


def mapped(over: Any, **more: Any) -> rodwell.Map:
    return rodwell.map(LYING, CRITICAL, over=over, halvings=0, **more)


def test_errors_are_those_of_closed_forms() -> None:
    """Pinned and horizontal: the load is a minimum over half waves, Dawson and Paslay's the one over real numbers."""
    chart = error_map(LYING, WEIGHTS, [90.0])
    exact = np.array([pinned_load(weight, 0.02) for weight in WEIGHTS])
    assert chart.exact("middle")[0] == pytest.approx(exact, rel=1e-8)
    formula = 2.0 * np.sqrt(np.array(WEIGHTS) / 0.02)
    assert chart.percent("dawson_paslay", "middle")[0] == pytest.approx(100.0 * (formula / exact - 1.0), abs=1e-5)


@pytest.mark.parametrize("names", [("alpha", "weight"), ("weight", "alpha")])
def test_a_map_of_a_store_is_the_same_chart(names: tuple[str, ...], tmp_path: Path) -> None:
    grid: dict[str, Any] = {"alpha": [0.0, 30.0, 90.0], "weight": WEIGHTS}
    found = mapped({name: grid[name] for name in names}, out=tmp_path / "loads.zarr")
    chart, alone = ErrorMap.of(found), error_map(LYING, grid["weight"], grid["alpha"])
    assert (chart.problem, alone.problem) == (LYING, LYING)
    assert (chart.weights.tolist(), chart.alphas.tolist()) == (WEIGHTS, grid["alpha"])
    assert np.array_equal(chart.force, alone.force)
    assert np.array_equal(chart.error, alone.error)


def test_one_weight_is_a_row_and_the_case_in_question_stays_the_one_given() -> None:
    chart = error_map(LYING, [60.0], [30.0, 90.0])
    assert (chart.problem.weight, chart.weights.tolist(), chart.force.shape) == (15.0, [60.0], (2, 1))
    assert chart.exact("middle")[1, 0] == pytest.approx(pinned_load(60.0, 0.02), rel=1e-8)
    assert chart_over(LYING, [60.0], [30.0, 90.0]) == {"alpha": [30.0, 90.0], "weight": 60.0}


def test_maps_of_which_no_chart_can_be_made() -> None:
    for of, quantity, over in (
        (LYING, "lift-off", {"weight": [15.0, 20.0]}),
        (LYING, CRITICAL, {"clearance": [0.01, 0.02]}),
        ({"dimensionless": {"weight": 15, "alpha": 90}}, CRITICAL, {"dimensionless.weight": [15.0, 20.0]}),
    ):
        with pytest.raises(InputError, match='must be a map of "critical" of a problem'):
            ErrorMap.of(rodwell.map(of, quantity, over=over, halvings=0))
    with pytest.raises(InputError, match=r"1 of 4 cells have no value; at alpha = 200.0: alpha = 200"):
        error_map(LYING, [2.0], [30.0, 200.0, 60.0, 90.0])
    with pytest.raises(InputError, match="at least one number, and one of two"):
        error_map(LYING, [2.0], [30.0])


def test_a_cell_without_a_load_is_named_with_its_reason() -> None:
    found = mapped({"weight": WEIGHTS})
    found.cells["outcome"][2], found.cells["value"][2] = NOT_COMPUTED, np.nan
    with pytest.raises(NotConvergedError, match=rf"1 of 4 .* at weight = 60.0: {IN_WORDS[NOT_COMPUTED]}"):
        ErrorMap.of(found)


class BrokenOffError(Exception):
    pass


def test_an_audit_that_was_broken_off_goes_on_with_the_chunks_that_are_there(tmp_path: Path) -> None:
    """What stands in the store is not computed again; figure and table are those of an audit without one."""
    case, store = tmp_path / "case.toml", tmp_path / "loads.zarr"
    case.write_text(CASE.format(alpha=60), encoding="utf-8")
    problem = rodwell.Case.read(case).problem
    told: list[str] = []

    def broken_off(what: str, _done: float) -> None:
        told.append(what)
        if len(told) == 4:
            raise BrokenOffError

    with pytest.raises(BrokenOffError):
        rodwell.map(problem, CRITICAL, over=chart_over(problem), out=store, halvings=0, progress=broken_off)
    before = {file: file.stat().st_mtime_ns for file in store.rglob("*") if file.is_file() and "/c/" in str(file)}
    assert before
    for name, options in (("kept", ("--store", str(store))), ("plain", ())):
        done = CliRunner().invoke(cli, ["audit", str(case), "--out", str(tmp_path / name), *options])
        assert done.exit_code == 0, done.output
    now = {file for file in store.rglob("*") if file.is_file() and "/c/" in str(file)}
    assert len(now) > len(before)
    assert {file: file.stat().st_mtime_ns for file in before} == before
    tables = [(tmp_path / name / "audit-chart.csv").read_bytes() for name in ("kept", "plain")]
    assert tables[0] == tables[1]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--workers", "0"), "--workers = 0: must be a whole number"),
        (("--scheduler", "nowhere"), "--scheduler = 'nowhere': is no address of a scheduler"),
        (("--store", "x.zarr", "--no-chart"), "--store = 'x.zarr': keeps the loads of a chart, and none is drawn here"),
        (("--store", " "), "is empty; name it"),
        (("--store", "case.toml"), "--store = 'case.toml'"),
    ],
)
def test_wrong_use_of_the_options(
    options: tuple[str, ...], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(CASE.format(alpha=60), encoding="utf-8")
    done = CliRunner().invoke(cli, ["audit", "case.toml", "--out", "out", *options])
    assert isinstance(done.exception, InputError), done.output
    assert said in str(done.exception)
    assert not (tmp_path / "out").exists()
