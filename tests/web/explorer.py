"""The command `rodwell explore`, running, and its page in a browser: waiting in it, and going to another state."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from typing import Any

SIZE = {"width": 1000, "height": 700}
"""Of the page where its layout does not matter: what is drawn by the processor costs by the pixel."""

COMMAND = [sys.executable, "-m", "rodwell", "explore", "--no-browser"]


class Server:
    """The command, running."""

    def __init__(self, *more: str) -> None:
        self.running = subprocess.Popen([*COMMAND, *more], stdout=subprocess.PIPE, text=True, env={**os.environ})
        assert self.running.stdout is not None
        found = re.search(r"http://127\.0\.0\.1:(\d+)/\S+", self.running.stdout.readline())
        assert found is not None
        self.address, self.port = found[0], found[1]

    def end(self) -> None:
        self.running.terminate()
        self.running.communicate(timeout=30)


def until(page: Any, script: str, limit: float = 60.0) -> None:
    """Wait in the page until a script is not false: each look from outside would cost more than what is waited for.

    The page's policy forbids what Playwright would do for that.
    """
    waiting = f"""new Promise((done) => {{
        const end = performance.now() + {1e3 * limit};
        const look = () => ({script}) ? done(true) : performance.now() > end ? done(false) : setTimeout(look, 20);
        look();
    }})"""
    if not page.evaluate(waiting):
        raise AssertionError(f"{script} is still false: {page.evaluate('window.__rodwell')}")


READY = "window.__rodwell && window.__rodwell.ready"
Opened = Callable[..., Any]


def go(page: Any, hash_: str) -> None:
    """Give the page another address, which stands there whole once the state is shown."""
    page.bring_to_front()
    until(page, "location.hash.includes('load=')")
    before = updates(page)
    page.goto(page.url.partition("#")[0] + hash_)
    moved(page, before)
    until(page, "location.hash.includes('load=')")


def values(page: Any) -> dict[str, Any]:
    until(page, READY)
    return page.evaluate("window.__rodwell.values")


def moved(page: Any, before: int) -> None:
    until(page, f"{READY} && window.__rodwell.updates > {before}")


def updates(page: Any) -> int:
    return page.evaluate("window.__rodwell.updates")
