"""The explorer's page off the wall: no number for other inputs than those displayed while an input is dragged there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("uvicorn", reason="needs the extra: pip install 'rodwell[explore]'")

from explorer import READY, Opened, until
from test_browser import browser, chromium  # noqa: F401 - skips where no Chromium is

import rodwell
from rodwell.analysis.path.elsewhere import follow_contact

LOAD = 140.0

WATCH = """() => {
    window.seen = [];
    const field = document.querySelector("#controls input[type=number]"), now = document.getElementById("now");
    const look = () => {
        const known = window.__rodwell.values, row = document.querySelector("#values [data-name=energy]");
        seen.push([Number(field.value), known && known.energy, row && row.cells[1].textContent, now.textContent]);
        requestAnimationFrame(look);
    };
    look();
}"""
DRAG = """async ([to, steps]) => {
    const slider = document.querySelector("#controls input[type=range]"), from = Number(slider.value);
    for (let k = 1; k <= steps; k++) {
        slider.value = from + (to - from) * k / steps;
        slider.dispatchEvent(new Event("input"));
        await new Promise((done) => setTimeout(done, 150));
    }
    slider.dispatchEvent(new Event("change"));
}"""


@pytest.fixture(scope="module")
def page(opened: Opened, faults: list[str]) -> Iterator[Any]:
    """The page with a rod off the wall."""
    page = opened(f"#path=followed&load={LOAD:g}")
    until(page, f"{READY} && document.getElementById('now').textContent.includes('load path')")
    yield page
    page.close()
    assert faults == []


def test_the_state_off_the_wall_follows_the_slider_with_its_own_numbers(page: Any) -> None:
    page.evaluate(WATCH)
    page.evaluate(DRAG, [15.3, 6])
    until(page, f"{READY} && !document.body.classList.contains('updating')")
    seen = page.evaluate("window.seen")
    pairs = {(weight, energy) for weight, energy, _, _ in seen if energy is not None}
    assert len(pairs) > 2  # the one before, the last, and some on the way
    assert all((energy is None) == (text == "…") for _, energy, text, _ in seen)
    assert all("load path" in now for _, energy, _, now in seen if energy is not None)
    rod = rodwell.Problem(weight=15.0)
    start = rodwell.load_path(rod, until=-LOAD).at(-LOAD)[0].state
    for weight, energy in pairs:
        state = start if weight == rod.weight else follow_contact(start, rod.but(weight=weight))
        assert energy == pytest.approx(state.energy.value, rel=1e-9), weight


def test_a_state_that_gives_way_is_said_to_and_shows_nothing(page: Any) -> None:
    """At this weight the rod has snapped: the load path of the new inputs shows what holds."""
    page.evaluate(WATCH)
    page.evaluate(DRAG, [12.0, 1])
    verdict = "document.getElementById('verdict').textContent"
    until(page, f"{verdict}.includes('was not followed to these inputs')")
    assert "% of the way" in page.evaluate(verdict)
    until(page, f"{READY} && document.getElementById('now').textContent.includes('load path')", 120.0)
    assert "helix" in page.evaluate(verdict)
    seen = page.evaluate("window.seen")
    wrong = [one for one in seen if one[0] == 12.0 and one[1] is not None and "load path" in one[3]]
    helix = page.evaluate("window.__rodwell.values.energy")
    assert {energy for _, energy, _, _ in wrong} == {helix}
