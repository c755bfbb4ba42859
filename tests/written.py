"""How numbers are written wherever a person reads them, and what a page says: for tests that read pages."""

from __future__ import annotations

import html
import json
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

VIOLATIONS = {
    "an exponent": re.compile(r"(?<![\w#])\d+(?:\.\d+)?e[−+-]?\d"),
    "a hyphen for a minus": re.compile(r"(?<![\w.,–-])-\d"),
    "thousands together": re.compile(r"(?<![\d.\u202f])\d{5,}(?!\d*[\w/-])"),
    "N m": re.compile(r"N m\b"),
    "deg": re.compile(r"\d\s?deg\b|\[deg\]"),
    "a raised fraction": re.compile(r"\^[¼⅓½]"),
    "N_real": re.compile(r"N_real"),
    "no number": re.compile(r"(?<![\w])(?:nan|inf)(?![\w])"),
    "an article": re.compile(r"\ba (?:angle|end|inclin)"),
}
OF_SYSTEM = {
    "field": re.compile(r"\d\s?(?:[kM]?N|N/m|m|mm|[kMG]?Pa|N·m)(?![\w·/.])"),
    "si": re.compile(r"\d\s?(?:lbf|psi|ft|in)(?![\w·/.])"),
    "mm": re.compile(r"\d\s?(?:lbf|psi|ft|in|m)(?![\w·/.])"),
}
"""Units of other systems."""


def said(item: Any) -> Iterator[str]:
    """Every text of a report, the user's own words aside."""
    if isinstance(item, str):
        yield item.replace("\u00a0", " ")
    elif isinstance(item, dict):
        own = item.get("kind") == "grid" and item["head"][0] == "Key of the case file"
        for key, value in item.items():
            if not own and key not in ("title", "subtitle", "about", "files", "footer"):
                yield from said(value)
    elif isinstance(item, list | tuple):
        for value in item:
            yield from said(value)


def violations(texts: Iterable[str]) -> list[tuple[str, str]]:
    return [(name, text) for text in texts for name, rule in VIOLATIONS.items() if rule.search(text)]


def of_page(page: Path) -> list[str]:
    """Every text of a report that stands as a page, without what is written as the user wrote it."""
    whole = page.read_text(encoding="utf-8")
    data = [
        json.loads(found) for found in re.findall(r'(?s)<script type="application/json"[^>]*>(.*?)</script>', whole)
    ]
    text = re.sub(r"(?s)<(script|style|svg|header)\b.*?</\1>", "", whole)
    text = re.sub(r"(?s)<table\b(?:(?!</table>).)*?(?:Key of the case file|as given).*?</table>", "", text)
    shown = [html.unescape(part).replace("\u00a0", " ").strip() for part in re.split(r"<[^>]*>", text)]
    return shown + [one for one in said(data) if " " in one and "gradient(" not in one]  # what its scripts say
