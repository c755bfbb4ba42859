"""``rodwell diagram``, ``curve`` and ``twist`` as a user meets them: JSON, files, and bad input."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from rodwell.cli.main import cli
from rodwell.errors import InputError, NotConvergedError


def run(*arguments: str) -> Any:
    return CliRunner().invoke(cli, arguments)


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_diagram_as_json(place: Path) -> None:
    done = run("diagram", "--weight", "15", "--alpha", "90", "--modes", "2", "--until", "-400", "--json")
    assert done.exit_code == 0, done.output
    data = json.loads(done.output)
    assert [b["name"] for b in data["branches"]] == ["mode 1", "mode 2", "secondary 1"]
    assert [b["parent"] for b in data["branches"]] == [None, None, "mode 1"]
    assert [b["mode"] for b in data["branches"]] == [1, 2, None]
    first = {p["kind"]: p for p in data["branches"][0]["special_points"]}
    assert set(first["branch_point"]) >= {"kind", "force", "error", "index_before", "index_after", "s"}
    assert first["branch_point"]["force"] == pytest.approx(-362.629366, abs=1e-6)
    assert first["lift_off"]["s"] == pytest.approx([0.5], abs=1e-7)
    assert "tension positive" in data["convention"]
    assert "both ends clamped" in data["convention"]
    assert sorted(p.name for p in (place / "results/diagram").iterdir()) == [
        "branches.nc", "diagram.json", "diagram.png", "diagram.svg",
    ]  # fmt: skip


def test_diagram_in_words_and_its_netcdf(place: Path) -> None:
    import xarray as xr

    options = ("--ends", "clamped-pinned", "--modes", "2", "--until", "-180", "--out", "here")
    done = run("diagram", "--weight", "15", "--alpha", "60", *options)
    assert done.exit_code == 0, done.output
    assert "end s = 0 clamped, end s = 1 pinned" in " ".join(done.output.split())
    with xr.open_dataset(place / "here/branches.nc") as data:
        assert list(data["branch_name"].values) == ["mode 1", "mode 2"]
        assert data.attrs["ends"] == "clamped-pinned"
        assert float(data["force"].min()) == -180.0
        assert set(data["branch"].values) == {1, 2}


def test_a_closed_loop_is_told_and_what_was_searched(place: Path) -> None:
    done = run("diagram", "--weight", "15", "--alpha", "89", "--until", "-700", "--search", "unfolding")
    assert done.exit_code == 0, done.output
    loop = done.output.split("\nisolated 1")[1].split("\n\n")[0]
    assert "closed: the end is where it began" in loop
    assert "Searched: connected to the straight rod; unfolded from alpha = 90" in done.output
    assert "There may be other branches." in done.output


def test_diagram_continued_in_the_inclination(place: Path) -> None:
    from rodwell import Problem, follow
    from rodwell.analysis.discrete.measures import Measured

    options = ("--modes", "1", "--until", "-140", "--then", "alpha", "--to", "75", "--json")
    done = run("diagram", "--weight", "15", "--alpha", "90", *options)
    assert done.exit_code == 0, done.output
    data = json.loads(done.output)
    further = data["branches"][1]
    assert (further["name"], further["parent"]) == ("mode 1, in alpha", "mode 1")
    assert further["images"] == ["y(s)", "−y(s)"]
    end = further["special_points"][-1]
    assert (end["kind"], end["parameter"], end["value"], end["force"]) == ("end", "alpha", 75.0, -140.0)
    direct = follow(Problem(15.0, alpha=75.0), until=-140.0)[-1]
    from rodwell import diagram

    state = diagram(Problem(15.0), modes=1, until=-140.0, then=("alpha", 75.0))["mode 1, in alpha"][-1]
    assert state.number(Measured.ENERGY).value == pytest.approx(direct.number(Measured.ENERGY).value, rel=1e-8)


def test_lines_in_several_parameters(place: Path) -> None:
    """The end of a line is the rod there, reached in another way; curves over a line end at that rod's load too."""
    import xarray as xr

    from rodwell import Problem, follow

    line = ("--then", "alpha", "--to", "75", "--then", "weight", "--to", "16")
    done = run("diagram", "--weight", "15", "--alpha", "90", "--modes", "1", "--until", "-140", *line, "--json")
    assert done.exit_code == 0, done.output
    further = json.loads(done.output)["branches"][1]
    assert further["name"] == "mode 1, in alpha and weight"
    assert further["special_points"][-1]["at"] == {"alpha": 75.0, "weight": 16.0}
    over = ("--over", "weight", "--from", "15", "--to", "16", "--over", "alpha", "--from", "90", "--to", "75")
    done = run("curve", "lift-off", *over)
    assert done.exit_code == 0, done.output
    assert "lift-off over weight and alpha" in done.output
    assert "(weight 16, alpha 75)" in done.output
    with xr.open_dataset(place / "results/curve/curves.nc") as data:
        assert (data["t"][-1], data["weight"][-1], data["alpha"][-1]) == (1.0, 16.0, 75.0)
        lift = follow(Problem(16.0, 75.0)).labelled("lift_off 1")
        assert float(data["force"][-1]) == pytest.approx(lift.force, rel=1e-9)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["diagram", "--weight", "15", "--alpha", "90", "--then", "alpha"], "--then and --to belong together"),
        (
            ["curve", "critical", "--alpha", "90", "--over", "weight", "--from", "1", "--from", "2", "--to", "3"],
            "--over, --from and --to belong together",
        ),
        (
            ["diagram", "--weight", "15", "--alpha", "90", *("--then", "alpha", "--to", "80") * 2],
            "alpha is given twice",
        ),
    ],
)
def test_lines_that_are_none_are_refused(arguments: list[str], message: str) -> None:
    done = run(*arguments)
    assert done.exit_code == 2
    assert message in done.output


def test_diagram_of_a_coil(place: Path) -> None:
    done = run("diagram", "--weight", "15", "--alpha", "90", "--turns", "1", "--until", "-220", "--json")
    kinds = [p["kind"] for p in json.loads(done.output)["branches"][0]["special_points"]]
    assert kinds == ["touch_down", "equal_energy", "branch_point", "end"]


@pytest.mark.parametrize(
    ("kind", "over", "limits", "others"),
    [
        ("critical", "weight", (5, 12), ["--alpha", "90", "--modes", "2"]),
        ("lift-off", "alpha", (90, 70), ["--weight", "15"]),
        ("secondary", "weight", (15, 14), ["--alpha", "90"]),
        ("twist", "weight", (30, 29), ["--alpha", "90"]),
    ],
)
def test_curves_as_json_and_files(
    place: Path, kind: str, over: str, limits: tuple[int, int], others: list[str]
) -> None:
    import xarray as xr

    ends = ("--from", str(limits[0]), "--to", str(limits[1]))
    done = run("curve", kind, "--over", over, *ends, *others, "--json")
    assert done.exit_code == 0, done.output
    curves = json.loads(done.output)["curves"]
    for curve in curves:
        assert curve["kind"] == kind
        assert curve["converged"] is True
        assert curve["points"][0][over] == limits[0]
        assert curve["points"][-1][over] == limits[1]
    if kind == "critical":
        assert curves[0]["marks"][0]["weight"] == pytest.approx(8.766818193, abs=1e-8)
    with xr.open_dataset(place / "results/curve/curves.nc") as data:
        quantity = "twist" if kind == "twist" else "force"
        assert data[quantity].sizes["point"] == sum(len(curve["points"]) for curve in curves)


def test_twist_in_words_and_as_json() -> None:
    done = run("twist", "--weight", "15", "--alpha", "90")
    assert done.exit_code == 0, done.output
    assert "T₁ < 0 presses the rod to the wall at s = 0.5" in done.output
    data = json.loads(run("twist", "--weight", "5", "--alpha", "90", "--json").output)
    assert data["sense"] == 0
    assert data["again"] is None
    assert len(data["s"]) == 2


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["diagram", "--weight", "15", "--alpha", "90", "--ends", "clamped"], "ends = 'clamped'"),
        (["diagram", "--weight", "15", "--alpha", "90", "--ends", "clamped-glued"], "clamped, pinned, guided, free"),
        (["diagram", "--weight", "15", "--alpha", "90", "--until", "-5"], "until = -5.0"),
        (["diagram", "--weight", "15", "--alpha", "90", "--modes", "0"], "modes = 0"),
        (["diagram", "--weight", "15", "--alpha", "90", "--largest-step", "7"], "largest_step = 7.0"),
        (["diagram", "--weight", "15", "--alpha", "90", "--then", "alpha", "--to", "195"], "alpha = 195"),
        (["diagram", "--weight", "15", "--alpha", "90", "--twist", "1", "--ends", "clamped-free"], "takes no torque"),
        (["diagram", "--weight", "15", "--alpha", "90", "--on-top", "--ends", "free-guided"], "keeps the rod on top"),
        (["diagram", "--weight", "15", "--alpha", "90", "--turns", "1", "--ends", "clamped-free"], "unwind"),
        (["curve", "lift-off", "--over", "weight", "--from", "5", "--to", "5", "--alpha", "90"], "must differ"),
        (["curve", "lift-off", "--over", "alpha", "--from", "5", "--to", "195", "--weight", "15"], "alpha = 195"),
        (["curve", "secondary", "--over", "weight", "--from", "15", "--to", "20", "--alpha", "50"], "alpha = 50"),
        (["twist", "--weight", "15", "--alpha", "90", "--twist", "1"], "twist = 1.0"),
    ],
)
def test_bad_input_is_named(place: Path, arguments: list[str], message: str) -> None:
    done = run(*arguments)
    assert isinstance(done.exception, InputError), done.output
    assert message in str(done.exception)
    assert not (place / "results").exists()


def test_a_missing_option_is_named(place: Path) -> None:
    done = run("curve", "lift-off", "--over", "weight", "--from", "5", "--to", "6")
    assert done.exit_code == 2
    assert "Missing option '--alpha'" in done.output


def test_a_curve_that_cannot_start_leaves_no_files(place: Path) -> None:
    done = run("curve", "twist", "--over", "weight", "--from", "5", "--to", "6", "--alpha", "90")
    assert isinstance(done.exception, NotConvergedError)
    assert not (place / "results").exists()
