"""Pictures of the explorer, taken in Chromium: docs/_static/explore.png, explore.webp. Run by hand, for the browser.

python docs/make_explore.py
"""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import sync_playwright

HERE = Path(__file__).parent
CASE = HERE.parent / "examples" / "drill-string.toml"
WIDTH, HEIGHT, SHOWN = 1440, 1010, 820
FRAMES, EACH = 20, 160  # pictures, and milliseconds for which each stands


def ready(page: Any, more: str = "true") -> None:
    """Wait until the page shows what it was asked for."""
    end = time.monotonic() + 120.0
    while not page.evaluate(f"Boolean(window.__rodwell && window.__rodwell.ready && {more})"):
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.05)


def main() -> None:
    """Take the pictures: at rest near lift-off, and while the load grows."""
    command = [sys.executable, "-m", "rodwell", "explore", str(CASE), "--no-browser"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert server.stdout is not None
    address = re.search(r"http\S+", server.stdout.readline())
    assert address is not None
    with sync_playwright() as play:
        chromium = next(filter(None, map(shutil.which, ("chromium", "google-chrome"))))
        flags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        browser = play.chromium.launch(executable_path=chromium, args=flags)
        page = browser.new_page(viewport={"width": WIDTH, "height": HEIGHT})
        page.goto(address[0])
        ready(page)
        verdict = "document.getElementById('verdict').textContent.startsWith('At ')"
        ready(page, verdict)
        page.screenshot(path=HERE / "_static" / "explore.png")
        field = page.locator("#load-control input[type=number]")
        frames = []
        for i in range(FRAMES):
            before = page.evaluate("window.__rodwell.updates")
            field.fill(f"{110.0 + 2.0 * i:.6g}")
            field.press("Enter")
            ready(page, f"window.__rodwell.updates > {before} && {verdict}")
            picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
            frames.append(picture.resize((SHOWN, SHOWN * HEIGHT // WIDTH), Image.Resampling.LANCZOS))
        browser.close()
    server.terminate()
    first, *others = frames
    there_and_back = [*others, *reversed(others)]
    out = HERE / "_static" / "explore.webp"
    first.save(out, save_all=True, append_images=there_and_back, duration=EACH, loop=0, quality=45, method=4)


if __name__ == "__main__":
    main()
