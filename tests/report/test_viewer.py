"""The page to turn and zoom: complete in itself, and the scene in it that of the solution."""

from __future__ import annotations

import base64
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rodwell
from rodwell.analysis.space.scene import drawn, scene
from rodwell.quantities.text import plain
from rodwell.report.pages.viewer import view, viewer, write_viewer

NEEDED = {"src", "href", "data", "poster", "action"}


class Parts(HTMLParser):
    """Addresses that a page loads, its scripts, and the data among them."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.loaded: list[str] = []
        self.scripts: list[str] = []
        self.data: list[Any] = []
        self.kind: str | None = None
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.loaded += [value or "" for name, value in attrs if name in NEEDED]
        self.kind = (dict(attrs).get("type") or "script") if tag == "script" else None

    def handle_data(self, text: str) -> None:
        if self.kind == "application/json":
            self.data.append(json.loads(text))
        elif self.kind == "script":
            self.scripts.append(text)

    def handle_endtag(self, tag: str) -> None:
        self.kind = None


@pytest.fixture(scope="module")
def state() -> rodwell.Solution:
    return rodwell.follow(rodwell.Problem(15, alpha=60, twist=2.0)).lift_off.solution


@pytest.fixture(scope="module")
def page(state: rodwell.Solution, tmp_path_factory: pytest.TempPathFactory) -> str:
    path: Path = tmp_path_factory.mktemp("page") / "rod.html"
    write_viewer(path, view(state, rod=state.geometry(101, radial_scale=None)), "A <rod>")
    return path.read_text(encoding="utf-8")


def decode(part: dict[str, Any]) -> np.ndarray:
    q = np.frombuffer(base64.b64decode(part["positions"]), "<u2").reshape(-1, 3)
    low, high = np.array(part["low"]), np.array(part["high"])
    return low + q / 65535.0 * (high - low)


def test_page_needs_nothing_from_elsewhere(page: str) -> None:
    parts = Parts(page)
    assert parts.loaded == []
    assert len(parts.scripts) == 3
    assert "three.js authors" in parts.scripts[0]
    assert "Permission is hereby granted" in parts.scripts[0]  # the licence goes where the code goes
    assert not re.search(r"https?://(?!www\.w3\.org/1999/xhtml)", "".join(parts.scripts))
    assert "A &lt;rod&gt;" in page
    assert len(page) < 1_200_000


def test_scene_in_the_page_is_that_of_the_solution(page: str, state: rodwell.Solution) -> None:
    (data,) = Parts(page).data
    rod = state.geometry(101, radial_scale=None)
    middle = np.array([0.5 * rod.centreline[-1, 2], 0.0, 0.0])
    parts = scene(rod, 16)
    assert [part["name"] for part in data["parts"]] == [part.name for part in parts]
    for shown, part in zip(data["parts"], parts, strict=True):
        points = part.mesh.vertices[:, [2, 0, 1]] - middle
        assert np.abs(decode(shown) - points).max() < 1e-5
        triangles = np.frombuffer(base64.b64decode(shown["triangles"]), "<u4").reshape(-1, 3)
        assert np.array_equal(triangles, part.mesh.triangles)
    colours = np.frombuffer(base64.b64decode(data["parts"][0]["colours"]), np.uint8).reshape(-1, 3) / 255.0
    assert np.abs(colours - parts[0].colour).max() < 0.003
    assert data["parts"][-1]["opacity"] < 1.0
    down = np.radians(60.0)  # gravity: down along the cylinder, and to its bottom
    assert data["gravity"] == pytest.approx([-np.cos(down), -np.sin(down), 0.0], abs=1e-6)
    assert max(abs(x) for line in data["lines"] for x in line["points"][0]) < 1.0


def test_colour_bar(state: rodwell.Solution) -> None:
    pressure = state.geometry(321).fields["contact_pressure"]
    markup = viewer(view(state, rod=state.geometry(321))).markup
    assert plain(pressure.min()) in markup
    assert "B/L³ contact pressure p" in markup
    outside = rodwell.follow(rodwell.Problem(15, on_top=True, outside=True), 2).lift_off.solution
    rod = drawn(outside, None)
    markup = viewer(view(outside, rod=rod)).markup
    most = rod.fields["contact_pressure"].max()
    assert f'class="bar">{plain(most)} <i' in markup  # pressed most: p > 0 outside
    scales = rodwell.Case.from_dict(
        {
            "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
            "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
        }
    ).scales
    assert "N/m push on the wall" in viewer(view(state, scales, rod)).markup  # engineers count the push
    assert "rod radius drawn 50 mm" in view(state, scales).caption


def test_report_turns_and_prints(tmp_path: Path) -> None:
    from rodwell.report.folders.case import write_results
    from rodwell.report.reports.files import FILES

    case = rodwell.Case.from_dict({"dimensionless": {"weight": 15}, "analysis": {"modes": 1, "rtol": 1e-6}})
    write_results(rodwell.answer(case), tmp_path)
    assert all((tmp_path / name).exists() for name in FILES if not name.startswith("load-path"))
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    parts = Parts(page)
    assert parts.loaded
    beside = {file.name for file in tmp_path.iterdir()}
    assert all(address.startswith(("data:image/", "#")) or address in beside for address in parts.loaded)
    assert '<img class="still" src="data:image/png' in page  # what prints
    assert len(parts.data) == 1
    assert len(page) < 2_000_000


@pytest.mark.parametrize("outside", [False, True])
def test_nothing_is_drawn_beyond_the_wall(outside: bool) -> None:
    """Rings and material lines stand out from the rod, and are flattened where it touches the wall."""
    problem = rodwell.Problem(15, on_top=outside, outside=outside)
    lift = rodwell.follow(problem, 2 if outside else 1).lift_off
    assert lift is not None
    rod = drawn(lift.solution, None)
    assert rod.lift_off
    for part in scene(rod, 16):
        away = np.hypot(part.mesh.vertices[:, 0], part.mesh.vertices[:, 1])
        if outside:
            assert away.min() >= rod.wall_radius * (1.0 - 1e-9)
        else:
            assert away.max() <= rod.wall_radius * (1.0 + 1e-9)


def test_the_picture_says_its_scale_and_what_stands_under_the_pointer(state: rodwell.Solution) -> None:
    rod = state.geometry(101, radial_scale=None)
    seen = view(state, rod=rod)
    assert f"× {plain(rod.radial_scale, 3)} across the axis" in viewer(seen).markup
    assert "true scale" in viewer(seen).markup
    along = seen.data["along"]
    assert len(along["points"]) == len(along["says"]) == 101
    push = -state.fields(np.array([0.5]))["contact_pressure"][0]
    assert f"push {plain(push, 3)} B/L³" in along["says"][50]
    assert 'data-show="true-scale"' in viewer(seen).markup
    assert 'data-show="true-scale"' not in viewer(view(state, rod=state.geometry(101))).markup  # it is that already
