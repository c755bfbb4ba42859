"""Tables in text: which character separates the cells is found out from the header and the line below it."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence

from rodwell.errors import InputError
from rodwell.survey.reading.header import Asked, Sighting, sighted
from rodwell.survey.reading.names import SPELT, words_of
from rodwell.survey.reading.numbers import is_number
from rodwell.survey.reading.tables import LONGEST_NAME, MOST_COLUMNS, Declared, RawTable, Row

SEPARATORS = ("\t", ";", ",", "|", " ", "  ")
"""One blank: cells stand apart by any white space. Two blanks: names of columns hold single ones."""

COMMENTS = ("#", "!", "//")
HEAD_LINES = 300
"""Lines, not counting empty ones and comments, among which the header must stand."""

MOST_JOINED = 6
"""Lines that one cell in quotes may run over."""

Line = tuple[int, str]


def text_table(name: str, text: str, asked: Asked) -> RawTable:
    """The table of a text, split into cells by the separator under which most of its header is understood.

    Raises
    ------
    InputError
        If there is nothing in it, or a line cannot be split.
    """
    numbered = list(enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"), start=1))
    comments = [(number, line.lstrip(" \t#!/")) for number, line in numbered if _is_comment(line)]
    plain = list(_joined([(number, line) for number, line in numbered if line.strip() and not _is_comment(line)]))
    empty = InputError("survey", name, "is empty: the first line names the columns, for example MD [m],Inc [deg]")
    if not plain:
        raise empty
    head = plain[:HEAD_LINES]
    separator, sighting = _separator(name, head, asked)
    if sighting is None or not sighting.complete:  # the header may stand in a comment
        mixed = sorted([*comments[:HEAD_LINES], *head])
        other, seen = _separator(name, mixed, asked)
        if seen is not None and seen.complete:
            separator, plain = other, sorted([*comments[:HEAD_LINES], *plain])
    rows = list(_rows(name, plain, separator))
    if not rows:
        raise empty
    above = [*comments[:HEAD_LINES], *head[: 0 if sighting is None else sighting.index]]
    return RawTable(name, rows, separator=separator, declared=declared(sorted(above)))


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith(COMMENTS)


def _joined(lines: Sequence[Line]) -> Iterator[Line]:
    """Lines, where a cell in quotes that runs over several of them is one."""
    i = 0
    while i < len(lines):
        number, line = lines[i]
        last = i
        if line.count('"') % 2 and any(mark + '"' in "," + line for mark in ',;\t|"'):
            for k in range(i + 1, min(i + MOST_JOINED, len(lines))):
                if lines[k][1].count('"') % 2:
                    last = k
                    break
        yield number, "\n".join(text for _, text in lines[i : last + 1])
        i = last + 1


def _separator(name: str, lines: Sequence[Line], asked: Asked) -> tuple[str, Sighting | None]:
    """The separator under which the header is most complete and has as many cells as the line below it."""
    best: tuple[tuple[bool, bool, int], str, Sighting | None] = ((False, False, -1), ",", None)
    for separator in SEPARATORS:
        try:
            rows = list(_rows(name, lines, separator))
        except InputError:  # quotes that make sense with another separator
            continue
        seen = sighted(rows, asked)
        if seen is not None:
            score = (seen.complete, _fits(rows, seen), seen.count)
            if score > best[0]:
                best = (score, separator, seen)
    if best[2] is None:
        counts = {separator: sum(line.count(separator) for _, line in lines[:20]) for separator in SEPARATORS[:4]}
        most = max(counts, key=lambda separator: counts[separator])
        return (most if counts[most] else " "), None
    return best[1], best[2]


def _fits(rows: Sequence[Row], seen: Sighting) -> bool:
    """Whether the first line of numbers below the header has as many cells as the header."""
    for _, cells in rows[seen.index + seen.depth : seen.index + seen.depth + 5]:
        if sum(is_number(cell) for cell in cells) >= 2:
            return len(cells) == len(seen.names)
    return False


def _rows(name: str, lines: Sequence[Line], separator: str) -> Iterator[Row]:
    for number, line in lines:
        if separator.strip() and line.count(separator) > MOST_COLUMNS:
            raise InputError(f"{name}, line {number}", None, f"has more than {MOST_COLUMNS} cells")
        try:
            cells = _blank_separated(line, separator) if separator in "  " else _separated(line, separator)
        except csv.Error as error:
            raise InputError(f"{name}, line {number}", None, f"is not CSV: {error}") from None
        if len(cells) > MOST_COLUMNS:
            raise InputError(f"{name}, line {number}", None, f"has more than {MOST_COLUMNS} cells")
        if any(cell.strip() for cell in cells):
            yield number, list(cells)


def _separated(line: str, separator: str) -> list[str]:
    """Cells of a line; a line that is quoted as a whole is split once more."""
    if '"' not in line:
        return line.split(separator)
    cells = next(csv.reader([line], delimiter=separator), [])
    if len(cells) == 1 and separator in cells[0]:
        cells = next(csv.reader([cells[0]], delimiter=separator), [])
    return cells


def _blank_separated(line: str, separator: str) -> list[str]:
    """Cells that stand apart by white space; what stands in brackets belongs to the name before it."""
    line = line.strip()
    if len(line) > 1 and line[0] == line[-1] == '"' and line.count('"') == 2:
        line = line[1:-1]
    words = line.split(None, MOST_COLUMNS + 1)
    if '"' in line:
        return [c for c in next(csv.reader([" ".join(words)], delimiter=" ", skipinitialspace=True), []) if c]
    if separator == "  " and words and not is_number(words[0]):
        return [part.strip() for part in line.replace("\t", "  ").split("  ") if part.strip()]
    cells: list[str] = []
    open_ = False
    for word in words:
        if cells and (open_ or word[0] in "(["):
            cells[-1] += " " + word
            open_ = word[-1] not in ")]" and len(cells[-1]) < LONGEST_NAME
        else:
            cells.append(word)
    return cells


def declared(lines: Sequence[Line]) -> Declared:
    """What lines above a table, and comments, say of it: "# WELL NAME: A-1", "# DEPTH (Z, TVD) GIVEN IN m-UNITS"."""
    well, depth, angle = "", set(), set()
    for _, line in lines:
        if len(line) > LONGEST_NAME:
            continue
        words = words_of(line)
        for mark in ":;,\t":
            name, found, rest = line.partition(mark)
            if found and words_of(name) in (["well"], ["well", "name"], ["wellbore"], ["wellbore", "name"]):
                well = well or rest.strip(' ";,\t')
        if "depth" in words and ("unit" in words or "units" in words):
            depth |= {SPELT["md"][word] for word in words if word in SPELT["md"]}
        if "angles" in words or "angle" in words:
            angle |= {SPELT["azimuth"][word] for word in words if word in SPELT["azimuth"]}
    return Declared(well[:60], depth.pop() if len(depth) == 1 else "", angle.pop() if len(angle) == 1 else "")
