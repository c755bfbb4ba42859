"""The page that the explorer saves, opened from disk: what it shows, and nothing that does nothing there."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("uvicorn", reason="needs the extra: pip install 'rodwell[explore]'")

from explorer import go
from test_browser import browser, chromium  # noqa: F401 - skips where no Chromium is


def test_it_shows_the_state_with_its_scale_and_colours_without_server_or_script(
    page: Any,
    browser: Any,  # noqa: F811
    tmp_path: Path,
) -> None:
    go(page, "#load=118&branch=mode 1")
    with page.expect_download() as saved:
        page.locator("[data-save=page]").click()
    saved.value.save_as(tmp_path / "page.html")
    asked: list[str] = []
    alone = browser.new_page(java_script_enabled=False)
    alone.on("request", lambda request: asked.append(request.url))
    alone.goto((tmp_path / "page.html").as_uri())
    assert [url for url in asked if not url.startswith("data:")] == [(tmp_path / "page.html").as_uri()]
    text = alone.inner_text("body")
    for wanted in ("buckles at", "111.233", "118 B/L²: mode 1, stable", "across the axis", "contact pressure"):
        assert wanted in text
    assert alone.inner_text("#bar-first") == page.inner_text("#bar-first")
    assert alone.inner_text("#values") == page.inner_text("#values")
    for idle in ("Save", "Copy as", "Point at a curve", "Sections"):
        assert idle not in text
    assert alone.locator("button, input, select, script[src]").count() == 0
    alone.close()
    page.bring_to_front()
