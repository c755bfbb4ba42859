"""The page of a map: it holds the map's own numbers, and tells the cell that one points at."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rodwell
from rodwell.errors import InputError
from rodwell.report.pages import map as pages
from rodwell.report.pages.map import write_map_page
from rodwell.studies.maps.result import Map

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
OVER = {"weight": [5.0, 20.0, 60.0], "alpha": [30.0, 90.0], "clearance": [0.005, 0.02]}


@pytest.fixture(scope="module")
def found() -> Map:
    return rodwell.map(rodwell.Problem(15.0), quantity="critical", over=OVER, workers=1)


def data_of(file: Path) -> dict[str, Any]:
    page = file.read_text(encoding="utf-8")
    assert not re.findall(r'(?:src|href)="(?!data:|#)', page)  # nothing is loaded from elsewhere
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)[1])


def test_the_page_holds_the_numbers_of_the_map(found: Map, tmp_path: Path) -> None:
    write_map_page(found, tmp_path / "map.html")
    data = data_of(tmp_path / "map.html")
    assert [axis["name"] for axis in data["axes"]] == list(OVER)
    columns = {
        c["name"]: np.frombuffer(base64.b64decode(c["data"])).reshape(found.values.shape) for c in data["columns"]
    }
    assert np.array_equal(columns["value"], -found.values)  # loads are drawn as compression
    assert np.array_equal(columns["error"], found.errors)
    assert "compression" in data["columns"][0]["label"]
    value = rodwell.critical_loads(rodwell.Problem(20.0, 90.0, clearance=0.02), 1)[0].force
    assert columns["value"][1, 1, 1] == pytest.approx(-value, rel=1e-12)


def test_what_no_page_can_show_is_refused(found: Map, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    line = rodwell.map(rodwell.Problem(15.0), quantity="critical", over={"weight": [5.0, 9.0]}, workers=1)
    with pytest.raises(InputError, match="two or more parameters"):
        write_map_page(line, tmp_path / "map.html")
    monkeypatch.setattr(pages, "MOST_CELLS", 11)
    with pytest.raises(InputError, match="would hold 12 cells"):
        write_map_page(found, tmp_path / "map.html")
    assert not any(tmp_path.iterdir())


@pytest.mark.skipif(CHROMIUM is None and not os.environ.get("RODWELL_NEEDS_BROWSER"), reason="no Chromium found")
def test_a_cell_is_told_by_keys_and_pointer(found: Map, tmp_path: Path) -> None:
    sync_api = pytest.importorskip("playwright.sync_api", reason="needs playwright: pip install 'rodwell[test]'")
    from axe_playwright_python.sync_playwright import Axe

    write_map_page(found, tmp_path / "map.html")
    with sync_api.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 390, "height": 900}, color_scheme="dark")
        faults: list[str] = []
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto((tmp_path / "map.html").as_uri())
        page.focus("#map")
        for key in ("ArrowRight", "ArrowRight", "ArrowUp"):
            page.keyboard.press(key)
        told = page.inner_text("#cell")
        assert told.startswith("weight 20, alpha 90, clearance 0.005: ")
        shown = float(re.search(r": ([\d.]+) ±", told)[1])
        assert shown == pytest.approx(-found.values[1, 1, 0], rel=1e-9)
        page.get_by_role("slider", name="clearance").press("ArrowRight")
        assert page.inner_text("#cell").startswith("weight 20, alpha 90, clearance 0.02: ")
        page.get_by_label("across").select_option("2")  # clearance across: weight is then moved
        assert page.evaluate("window.__map.x") == 2
        box = page.locator("#map").bounding_box()
        page.mouse.move(box["x"] + 0.45 * box["width"], box["y"] + 0.3 * box["height"])
        assert "weight" in page.inner_text("#cell")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        found_faults = Axe().run(page).response["violations"]
        assert [v["id"] for v in found_faults if v["impact"] in ("serious", "critical")] == []
        assert faults == []
        browser.close()
