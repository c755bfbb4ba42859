"""The explorer in a real browser: numbers, keys, addresses, pictures, and who it talks to."""

from __future__ import annotations

import contextlib
import json
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("uvicorn", reason="needs the extra: pip install 'rodwell[explore]'")

import uvicorn
from explorer import READY, SIZE, Opened, Server, go, moved, until, updates, values
from test_browser import WIDTHS, browser, chromium, seen, serious  # noqa: F401 - skips where no Chromium is

import rodwell
from rodwell.web.app import app
from rodwell.web.serve import _listening


def test_the_numbers_shown_are_those_of_the_library(page: Any) -> None:
    branch = rodwell.follow(rodwell.Problem(15.0), mode=1, until=-160.0)
    field = page.get_by_label("end compression −F at s = 1", exact=True)
    for load in (112.5, 119.25, 150.125):
        before = updates(page)
        field.fill(str(load))
        field.press("Enter")
        moved(page, before)
        state, shown = branch.at(-load), values(page)
        assert shown["force"] == pytest.approx(-load, rel=1e-12)
        assert shown["largest_push"] == pytest.approx(state.largest("contact_pressure").value, rel=1e-9)
        assert shown["largest_angle"] == pytest.approx(state.largest("xi2").value, rel=1e-9)
        assert shown["T2"] == pytest.approx(state.number("support_torque").value, rel=1e-9, abs=1e-12)
        text = page.inner_text("#values tr[data-name=largest_push] td >> nth=0")
        assert float(text.split()[0]) == pytest.approx(shown["largest_push"], rel=1e-5)
        assert page.evaluate("window.__rodwell.widest()") <= 1.001
    until(page, "document.getElementById('verdict').textContent.includes('the rod has left the wall')")


def test_keys_move_load_branch_and_special_point(page: Any) -> None:
    page.locator("h1").click()
    first = values(page)["load"]
    for key, factor in (("ArrowRight", 1.01), ("Shift+ArrowLeft", 0.9)):
        before = updates(page)
        page.keyboard.press(key)
        moved(page, before)
        first *= factor
        assert values(page)["load"] == pytest.approx(first, rel=1e-9)
    for key, state in (("2", {"branch": "mode 2"}), ("0", {"branch": "straight"}), ("1", {"branch": "mode 1"})):
        before = updates(page)
        page.keyboard.press(key)
        moved(page, before)
        assert page.evaluate("window.__rodwell.state.branch") == state["branch"]
    before = updates(page)
    page.keyboard.press("PageUp")  # from the middle of the branch
    moved(page, before)
    assert values(page)["force"] == pytest.approx(-123.173074384872, rel=1e-12)  # lift-off, as AUTO-07p has it
    assert "Lift-off of mode 1" in page.inner_text("#headline")
    page.keyboard.press("?")
    assert page.locator("#help").is_visible()
    page.keyboard.press("Escape")
    assert not page.locator("#help").is_visible()


def test_both_curves_have_one_cursor_and_the_rod_its_true_scale(page: Any) -> None:
    assert page.inner_text("#cursor") == "Point at a curve to read it."
    page.locator("#push").focus()
    page.keyboard.press("ArrowRight")
    assert page.inner_text("#cursor").startswith("s = ")
    push, side = (page.locator(f"#{name} line.at") for name in ("push", "side"))
    assert push.get_attribute("x1") == side.get_attribute("x1")
    enlarged = page.inner_text("#rod .scale")
    assert enlarged.startswith("× ")
    page.locator("#true-scale").check()
    assert page.inner_text("#rod .scale") == "true scale"
    until(page, "location.hash.includes('scale=true')")
    page.locator("#true-scale").uncheck()
    assert page.inner_text("#rod .scale") == enlarged


def test_branches_can_be_focused_clicked_and_tell_what_they_are(page: Any) -> None:
    labels = page.evaluate("[...document.querySelectorAll('#diagram path.hit')].map(p => p.getAttribute('aria-label'))")
    assert len(labels) == 5  # straight, three modes, a secondary branch
    assert all(page.evaluate("[...document.querySelectorAll('#diagram path.hit')].map(p => p.tabIndex === 0)"))
    assert any("branch 1, mode 1" in label and "lifts off at 123.173" in label for label in labels)
    before = updates(page)
    page.locator("#diagram [data-branch='mode 3']").focus()
    page.keyboard.press("Enter")
    moved(page, before)
    assert page.evaluate("window.__rodwell.state.branch") == "mode 3"
    assert values(page)["index"] == 2
    until(page, "document.getElementById('certificate').textContent.includes('passed')")


def test_the_address_holds_the_state_and_back_works(page: Any, opened: Opened) -> None:
    for act in (lambda: page.keyboard.press("2"), lambda: page.keyboard.press("Shift+ArrowRight")):
        before = updates(page)
        page.locator("h1").click()
        act()
        moved(page, before)
    time.sleep(0.3)
    state, shown = page.evaluate("window.__rodwell.state"), values(page)
    other = opened("#" + page.url.partition("#")[2])
    assert other.evaluate("window.__rodwell.state") == state
    assert values(other) == shown
    other.close()
    page.bring_to_front()
    before = updates(page)
    page.go_back()
    moved(page, before)
    assert page.evaluate("window.__rodwell.state.load") != state["load"]
    assert page.evaluate("window.__rodwell.state.branch") == "mode 2"


@pytest.mark.parametrize("wrong", ["#load=much", "#nothing=1", "#ends=glued-glued", "#modes=99", "#%ff%00=%"])
def test_an_address_that_cannot_be_read_gives_one_message_and_the_beginning(page: Any, wrong: str) -> None:
    go(page, wrong)
    assert page.inner_text("#message").startswith("The address could not be read: ")
    assert page.evaluate("window.__rodwell.state.inputs['dimensionless.weight']") == 15
    assert values(page)["load"] == 118.4
    page.keyboard.press("2")
    until(page, "document.getElementById('message').hidden")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_serious_fault_at_any_width(page: Any, scheme: str) -> None:
    for width in WIDTHS:
        seen(page, scheme, width)
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        dark = page.evaluate("getComputedStyle(document.documentElement).backgroundColor")
        assert (dark == "rgb(18, 24, 30)") == (scheme == "dark")
        assert serious(page) == []
    page.set_viewport_size(SIZE)
    page.emulate_media(color_scheme="light")


def test_files_are_saved(page: Any) -> None:
    for name, start in (("toml", b"title = "), ("csv", b"s [L]"), ("page", b"<!doctype html>")):
        with page.expect_download() as saved:
            page.locator(f"[data-save={name}]").click()
        content = saved.value.path().read_bytes()
        assert content.startswith(start)
    assert b"<script src" not in content
    assert b"data:image/png;base64" in content
    for name, start in (("svg", b"<svg"), ("png", b"\x89PNG")):
        with page.expect_download() as saved:
            page.locator(f"[data-diagram={name}]").click()
        content = saved.value.path().read_bytes()
        assert content.startswith(start)
        if name == "svg":  # stands alone: colours and dashes are its own
            assert b'stroke-dasharray="5px, 3px"' in content
            assert "end compression −F at s = 1".encode() in content
    assert len(content) > 10_000


class SilentDesk:
    """Greets, and answers nothing."""

    ends = "clamped-clamped"
    hello = json.dumps({"kind": "hello", "version": "0", "title": "A rod", "controls": [], "ends": ends,
                        "all_ends": [ends], "modes": 1, "most_modes": 1, "sections": None})  # fmt: skip

    async def run(self) -> None:
        """Nothing to do."""

    def ask(self, job: Any) -> None:
        """Take a request."""

    def forget(self, client: int) -> None:
        """Nothing to forget."""


@contextlib.contextmanager
def served(port: int) -> Iterator[int]:
    """A server in this process; its port."""
    listening = _listening(port)
    port = listening.getsockname()[1]
    config = uvicorn.Config(app(SilentDesk(), "token", lambda: port), log_level="critical", lifespan="on")  # type: ignore[arg-type]
    config.timeout_graceful_shutdown = 1
    running = uvicorn.Server(config)
    thread = threading.Thread(target=running.run, kwargs={"sockets": [listening]})
    thread.start()
    yield port
    running.should_exit = True
    thread.join(30.0)
    listening.close()


def test_a_server_that_is_gone_is_told_and_found_again(browser: Any) -> None:  # noqa: F811
    page = browser.new_page(viewport=SIZE)
    with served(0) as port:
        page.goto(f"http://127.0.0.1:{port}/token/")
        until(page, "document.getElementById('title').textContent === 'A rod'")
        assert not page.locator("#banner").is_visible()
    until(page, "!document.getElementById('banner').hidden", 10.0)
    assert "server is gone" in page.inner_text("#banner")
    with served(port):
        until(page, "document.getElementById('banner').hidden", 10.0)
        page.close()


def test_without_javascript_a_sentence(browser: Any, server: Server) -> None:  # noqa: F811
    page = browser.new_page(java_script_enabled=False)
    page.goto(server.address)
    assert "rodwell run case.toml" in page.inner_text("noscript")
    page.close()


def test_without_webgl_a_still_picture(chromium: Any, server: Server) -> None:  # noqa: F811
    plain = chromium("--no-sandbox", "--disable-gpu", "--disable-3d-apis")
    page = plain.new_page()
    page.goto(server.address)
    until(page, READY)
    until(page, "!document.querySelector('#rod .still').hidden")
    assert page.locator("#rod .still").bounding_box()["height"] > 100.0
    assert page.evaluate("window.__rodwell.values.load") == 118.4
    plain.close()
