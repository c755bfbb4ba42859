"""Pages in a real browser: at three widths, light and dark, printed, without WebGL, without JavaScript, and with axe.

Needs Chromium on the machine. Where none is found the tests are skipped; with ``RODWELL_NEEDS_BROWSER`` set, as the
gate does, they fail instead.
"""

from __future__ import annotations

import io
import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader

import rodwell
from rodwell.report.folders.case import write_results
from rodwell.report.pages.path import PAGE, write_path_page

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
SOFTWARE = ("--no-sandbox", "--enable-unsafe-swiftshader")
"""WebGL is drawn by the processor; the page itself in the way that Chromium chooses then, which costs the least."""

WIDTHS = (1440, 820, 390)

if CHROMIUM is None and not os.environ.get("RODWELL_NEEDS_BROWSER"):
    pytest.skip("no Chromium found: apt-get install chromium", allow_module_level=True)
sync_api = pytest.importorskip("playwright.sync_api", reason="needs playwright: pip install 'rodwell[test]'")

CASE = {
    "title": "Drill pipe, 30° from the vertical",
    "units": "field",
    "rod": {"pipe": "5 in 19.5 lb/ft drill pipe", "length": "100 ft", "grade": "S-135"},
    "hole": {"diameter": "8.5 in", "angle_from_vertical": "30 deg"},
    "mud": {"density": "10 lb/gal"},
    "load": {"applied": "-36000 lbf", "at": "bottom"},
    "analysis": {"modes": 2, "rtol": 1e-6},
    "report": {"client": "Example Oil", "project": "Well A-12", "author": "A. Engineer", "revision": "B"},
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("pages") / "case"
    write_results(rodwell.answer(rodwell.Case.from_dict(CASE)), out)
    return out


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    with sync_api.sync_playwright() as play:
        yield lambda *args: play.chromium.launch(executable_path=CHROMIUM, args=list(args))


@pytest.fixture(scope="module")
def browser(chromium: Any) -> Iterator[Any]:
    browser = chromium(*SOFTWARE)
    yield browser
    browser.close()


@pytest.fixture(scope="module")
def report(browser: Any, folder: Path) -> Iterator[Any]:
    """The report, opened once: to open it takes as long as most of what is tested."""
    page = browser.new_page()
    opened(page, folder / "report.html")
    yield page
    page.close()


@pytest.fixture
def page(report: Any) -> Any:
    """The report as a wide light screen shows it."""
    seen(report, "light", WIDTHS[0])
    return report


def opened(page: Any, file: Path) -> None:
    """Open a page, run its script and load its pictures; errors of scripts fail the test."""
    faults: list[str] = []
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.goto(file.as_uri())
    page.wait_for_load_state("load")
    assert faults == []


def seen(page: Any, scheme: str, width: int) -> None:
    """Show a page in another style and width, once it is drawn so."""
    page.emulate_media(color_scheme=scheme)
    page.set_viewport_size({"width": width, "height": 900})
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def serious(page: Any) -> list[tuple[str, str]]:
    """What axe finds that keeps people from using a page."""
    from axe_playwright_python.sync_playwright import Axe

    found = Axe().run(page).response["violations"]
    return [(v["id"], v["nodes"][0]["html"][:120]) for v in found if v["impact"] in ("serious", "critical")]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pages_fit_every_width_and_have_no_serious_fault(report: Any, scheme: str) -> None:
    for width in WIDTHS:
        seen(report, scheme, width)
        assert report.evaluate("document.documentElement.scrollWidth") <= width
        dark = report.evaluate("getComputedStyle(document.documentElement).backgroundColor")
        assert (dark == "rgb(18, 24, 30)") == (scheme == "dark")
        assert serious(report) == []
        # letters of a figure: 9.5 points of a drawing 7.2 inches wide are not smaller than 8 pixels
        drawn = "[...document.querySelectorAll('.drawn img')].map(i => i.getBoundingClientRect().width)"
        assert min(report.evaluate(drawn)) >= 7.2 * 72.0 * 8.0 / 9.5 * (0.75 if width > 820 else 1.0)


def test_one_slides_through_a_load_path(browser: Any, tmp_path: Path) -> None:
    path = rodwell.load_path(rodwell.Problem(15.0), until=-113.0, seeds=1)
    write_path_page(tmp_path / PAGE, path)
    page = browser.new_page()
    opened(page, tmp_path / PAGE)
    for scheme, width in (("light", 1440), ("dark", 390)):
        seen(page, scheme, width)
        page.locator("#at").focus()
        page.keyboard.press("Home")
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        assert page.inner_text("#now") == "loading, F = 0 B/L²: straight, stable"
        straight = page.locator(".stage").screenshot()
        page.keyboard.press("End")
        assert page.inner_text("#now") == "loading, F = −113 B/L²: sinusoidal, stable"
        assert page.locator(".stage").screenshot() != straight
        page.get_by_role("button", name="the straight rod buckles").click()
        assert page.inner_text("#now") == "loading, F = −111.2 B/L²: straight, stable"
        assert serious(page) == []
    page.close()


def test_landmarks_contents_and_links(page: Any, folder: Path) -> None:
    for landmark in ("header", "nav", "main", "footer"):
        assert page.locator(landmark).count() == 1
    targets = page.evaluate("[...document.querySelectorAll('nav a')].map(a => a.getAttribute('href'))")
    assert all(page.locator(target).count() == 1 for target in targets if target.startswith("#"))
    titles = page.evaluate("[...document.querySelectorAll('main > section:not(.front) > h2')].map(h => h.textContent)")
    assert [t for t in page.locator("nav li").all_text_contents() if t != "Verdict"] == titles
    files = page.evaluate("[...document.querySelectorAll('.files a')].map(a => a.getAttribute('href'))")
    assert set(files) == {file.name for file in folder.iterdir()} - {"report.html"}
    text = page.inner_text("header")
    assert all(word in text for word in CASE["report"].values())


def test_figures_are_dark_where_the_page_is(report: Any) -> None:
    """The background of the sketch, as the browser paints it."""
    from PIL import Image

    for scheme, light in (("light", True), ("dark", False)):
        seen(report, scheme, WIDTHS[0])
        corner = Image.open(io.BytesIO(report.locator(".case img").screenshot())).convert("L").getpixel((3, 3))
        assert (corner > 200) == light


def test_the_front_prints_on_one_sheet(page: Any) -> None:
    printed = io.BytesIO(page.pdf(format="Letter", prefer_css_page_size=False))
    sheets = [sheet.extract_text() for sheet in PdfReader(printed).pages]
    first, second, *_, last = (" ".join(sheet.split()) for sheet in sheets)
    assert "numerically converged" in first
    assert "Compression positive" in first
    assert "What the numbers mean" in second[:40]  # after the number of the sheet
    assert "Computed by rodwell" in last
    assert len(last) > 200  # no sheet for three lines
    heads = page.evaluate("[...document.querySelectorAll('main > section:not(.front) > h2')].map(h => h.textContent)")
    for sheet in sheets:
        lines = [line for line in sheet.splitlines() if line.strip()]
        assert lines[-1].strip() not in heads  # no heading at the foot of a sheet


def test_the_rod_is_turned_read_and_set_to_true_scale(page: Any) -> None:
    stage = page.locator(".rod-viewer .stage")
    stage.scroll_into_view_if_needed()
    assert "× " in page.inner_text(".rod-viewer .scale")
    before = stage.screenshot()
    stage.focus()
    page.keyboard.press("ArrowRight")
    turned = stage.screenshot()
    assert turned != before
    page.keyboard.press(".")
    assert "push" in page.inner_text(".rod-viewer .reading")
    page.keyboard.press("Home")
    page.get_by_label("true scale").check()
    assert page.inner_text(".rod-viewer .scale") == "true scale"
    box = stage.bounding_box()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    assert "lbf/ft" in page.inner_text(".rod-viewer .reading")  # under the pointer, on the rod


@pytest.fixture(scope="module")
def plain(chromium: Any) -> Iterator[Any]:
    """A browser without WebGL."""
    browser = chromium("--no-sandbox", "--disable-gpu", "--disable-3d-apis")
    yield browser
    browser.close()


@pytest.mark.parametrize("name", ["report.html", "rod-3d.html"])
@pytest.mark.parametrize("script", [True, False])
def test_a_still_picture_without_webgl_and_without_javascript(
    plain: Any, browser: Any, folder: Path, name: str, script: bool
) -> None:
    page = (plain if script else browser).new_page(java_script_enabled=script)
    page.goto((folder / name).as_uri())
    picture = page.locator(".rod-viewer img.still")
    assert picture.is_visible()
    assert picture.bounding_box()["height"] > 100.0
    page.close()
