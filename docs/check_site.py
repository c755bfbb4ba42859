"""Check built pages: ``python docs/check_site.py FOLDER``.

Nothing may be loaded from a network, and no link between pages may be dead.
"""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path

LOADED = {"script", "img", "link", "iframe", "source", "video", "audio", "object", "embed"}
FAR = re.compile(r"(?:https?:)?//")
IN_STYLE = re.compile(r"""(?:url\(|@import\s|importScripts\()\s*["']?((?:https?:)?//[^"')\s]+)""")


class Page(HTMLParser):
    """Anchors, links and loaded files of one page."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take in one element."""
        values = dict(attrs)
        self.anchors |= {value for key in ("id", "name") if (value := values.get(key))}
        for target in (values.get("src"), values.get("href")):
            if target and tag in LOADED and FAR.match(target) and values.get("rel") != "canonical":
                self.loaded.append(target)
            elif target and not re.match(r"[a-z]+:|//", target):
                self.links.append(target)


def problems(site: Path) -> list[str]:
    """What is wrong, a line each."""
    pages = {file.resolve(): Page(file) for file in site.rglob("*.html")}
    out = []
    for file, page in pages.items():
        out += [f"{file.name} loads {target}" for target in page.loaded]
        if "_modules" in file.parts:  # listings of code: their links back are made by Sphinx
            continue
        for link in page.links:
            path, _, anchor = link.partition("#")
            target = (file.parent / path.partition("?")[0]).resolve() if path else file
            if not target.exists():
                out.append(f"{file.name}: no file {link}")
            elif anchor and target in pages and anchor not in pages[target].anchors:
                out.append(f"{file.name}: no place {link}")
    for file in [*site.rglob("*.css"), *site.rglob("*.js")]:
        text = file.read_text(encoding="utf-8", errors="replace")
        out += [f"{file.name} loads {target}" for target in IN_STYLE.findall(text)]
    return out if pages else [f"no pages in {site}"]


if __name__ == "__main__":
    found = problems(Path(sys.argv[1]))
    sys.exit("\n".join(found) if found else 0)
