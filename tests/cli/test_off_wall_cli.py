"""Branches that leave the wall, as files and on the terminal: diagrams, states in space, branches kept in files."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np
import pytest
from click.testing import CliRunner

import rodwell
from rodwell.cli.main import cli
from rodwell.errors import InputError, NotConvergedError

DIAGRAM = ("diagram", "--weight", "15", "--alpha", "90", "--modes", "1", "--no-secondary", "--off-wall")
CASE = """
title = "a rod"
[dimensionless]
weight = 15
alpha = 90
clearance = 0.01
"""


def run(*arguments: str) -> Any:
    return CliRunner().invoke(cli, arguments)


@pytest.fixture(scope="module")
def branch() -> rodwell.Branch:
    return rodwell.follow(rodwell.Problem(15.0, 90.0), 1, until=-126.0, off_wall=True)


def test_a_diagram_with_its_files(tmp_path: Path) -> None:
    done = run(*DIAGRAM, "--until", "-126", "--out", str(tmp_path / "out"))
    assert done.exit_code == 0, done.output
    assert "off the wall: " in done.output
    assert "a gap opens" in done.output
    assert "−124.191186" in done.output
    assert "ended:" not in done.output
    with (tmp_path / "out" / "off-wall.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert rows[0][1] == "end force at s = 1, tension positive [B/L^2]"
    assert float(rows[-1][1]) == pytest.approx(-126.0, rel=1e-12)
    with h5netcdf.File(tmp_path / "out" / "branches.nc", "r") as file:
        group = file["off_wall_1"]
        assert group.attrs["states_left_out"] == 0
        kinds = [kind.decode() if isinstance(kind, bytes) else kind for kind in group.variables["special_kind"][...]]
        assert kinds == ["gap_opens", "end"]
        assert group.variables["force"].shape == (len(rows) - 1,)


def test_a_diagram_as_json(tmp_path: Path) -> None:
    done = run(*DIAGRAM, "--until", "-126", "--out", str(tmp_path / "out"), "--json")
    assert done.exit_code == 0, done.output
    (found,) = json.loads(done.output)["branches"]
    assert found["reached_end"]
    assert found["off_wall"]["converged"]
    assert [point["kind"] for point in found["off_wall"]["special_points"]] == ["gap_opens", "end"]


def test_what_leaves_a_branch_off_the_wall_is_said_to_be_left(tmp_path: Path) -> None:
    """Mode 2 loses more stability at −153.822, off the wall."""
    two = ("diagram", "--weight", "15", "--alpha", "90", "--modes", "2", "--off-wall")
    done = run(*two, "--until", "-155", "--out", str(tmp_path / "out"), "--json")
    assert done.exit_code == 0, done.output
    data = json.loads(done.output)
    assert "mode 2 at F = -153.8222" in " ".join(data["unexplored"])
    assert data["branches"][1]["off_wall"]["special_points"][-2]["kind"] == "branch_point"


def test_a_state_off_the_wall_in_space(tmp_path: Path) -> None:
    case = tmp_path / "case.toml"
    case.write_text(CASE, encoding="utf-8")
    target = tmp_path / "rod.csv"
    done = run("export", str(case), "--at", "-125.41829806", "--off-wall", "--to", str(target))
    assert done.exit_code == 0, done.output
    assert "stable" in done.output
    lines = [line for line in target.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    gap = [float(row[next(name for name in row if name.startswith("gap"))]) for row in rows]
    assert max(gap) == pytest.approx(8.077165e-5, rel=1e-4)
    again = run("export", str(case), "--at", "-180", "--off-wall", "--to", str(target))
    assert isinstance(again.exception, InputError | NotConvergedError)
    assert "off the wall" in str(again.exception)


def test_a_branch_kept_in_a_file(branch: rodwell.Branch, tmp_path: Path) -> None:
    assert branch.beyond is not None
    file = rodwell.save_branch(branch, tmp_path / "branch.nc")
    again = rodwell.load_branch(file)
    assert again.beyond is not None
    assert np.array_equal(again.beyond.force, branch.beyond.force)
    assert again.ended_because == branch.ended_because


def test_its_arrays(branch: rodwell.Branch) -> None:
    assert branch.beyond is not None
    data = branch.beyond.dataset(places=21)
    assert data.sizes["state"] == len(branch.beyond)
    assert data["special_force"].values[0] == pytest.approx(-124.1911865, abs=1e-7)
    assert data["certificate"].values.max() < 1e-7


def test_notebooks_show_it(branch: rodwell.Branch) -> None:
    assert "off the wall: a gap opens" in branch._repr_html_()


def test_its_picture(branch: rodwell.Branch) -> None:
    """The line goes on off the wall from where it lifts off, in both mirror images; the names of states stand by it."""
    from matplotlib.figure import Figure

    ax = branch.plot(Figure().add_subplot(), ordinate="omega2_at_1")
    assert branch.beyond is not None
    ends = [line.get_xydata() for line in ax.lines if len(line.get_xydata()) > 2]
    farthest = [points[-1] for points in ends if points[-1][0] == pytest.approx(126.0, rel=1e-9)]
    value = float(branch.beyond.numbers("omega2_at_1")[-1])
    assert sorted(float(y) for _, y in farthest) == pytest.approx(sorted([value, -value]), rel=1e-9)
    assert "off the wall (thin: unstable)" in [text.get_text() for text in ax.get_legend().get_texts()]
