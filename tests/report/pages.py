"""A page taken apart, for tests of what it says and whether it is well formed."""

from __future__ import annotations

from html.parser import HTMLParser

from rodwell.quantities.written import number_and_rest

EMPTY = {"meta", "img", "input", "br", "link"}


def number_of(text: str) -> float:
    """The number that a cell begins with, as the pages write it: −1 234.5, 6 × 10⁻¹²."""
    read = number_and_rest(text.strip("\u2007\u2008 ").replace("\u00a0", " "))
    assert read is not None, text
    return read[0]


class Page(HTMLParser):
    """A page taken apart: tags that do not close, ids, rows of tables, text; spaces that do not break are spaces."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.faults: list[str] = []
        self.ids: list[str] = []
        self.tables: list[list[list[str]]] = []
        self.words: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.ids += [value or "" for name, value in attrs if name == "id"]
        if tag not in EMPTY:
            self.open.append(tag)
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("td", "th"):
            self.tables[-1][-1].append("")

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.faults.append(tag)

    def handle_data(self, text: str) -> None:
        text = text.replace("\u00a0", " ")
        if not {"script", "style"} & set(self.open):
            self.words.append(text)
        if "td" in self.open or "th" in self.open:
            self.tables[-1][-1][-1] += text
