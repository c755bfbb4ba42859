"""Engines and pages for the tests of the explorer, and where these find the browser of the tests of pages.

Fixtures of pages take ``browser`` from the module that asks for them: it is skipped where no Chromium is.
"""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "report"))

from asking import FIELD
from explorer import READY, SIZE, Opened, Server, go, until

from rodwell.web.engine import Engine
from rodwell.web.given import Given


@pytest.fixture(scope="module")
def plain() -> Engine:
    return Engine(Given(None))


@pytest.fixture(scope="module")
def field() -> Engine:
    return Engine(Given(tomllib.loads(FIELD.read_text(encoding="utf-8"))))


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    running = Server()
    yield running
    running.end()


@pytest.fixture(scope="module")
def faults() -> list[str]:
    """Errors of the pages, and what they asked of other places."""
    return []


@pytest.fixture(scope="module")
def opened(browser: Any, server: Server, faults: list[str]) -> Opened:
    """Opens a page anew."""

    def open_(hash_: str = "") -> Any:
        page = browser.new_page(viewport=SIZE)
        page.on("console", lambda message: faults.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: faults.append(str(error)))

        def asked(request: Any) -> None:
            if not request.url.startswith((server.address, "data:", "blob:")):
                faults.append(request.url)

        page.on("request", asked)
        page.goto(server.address + hash_)
        page.bring_to_front()  # pages in the background are given no frames
        until(page, READY)
        return page

    return open_


@pytest.fixture(scope="module")
def shared(opened: Opened) -> Iterator[Any]:
    """One page for all tests: to open one takes as long as most of what is tested."""
    page = opened()
    yield page
    page.close()


@pytest.fixture
def page(shared: Any, faults: list[str]) -> Iterator[Any]:
    """The page as it begins; fails the test for errors, and for requests to other places."""
    go(shared, "#")
    yield shared
    assert faults == []
