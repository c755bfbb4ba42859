"""Where the header of a table is, and which column is which."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rodwell.errors import InputError
from rodwell.survey.reading.names import CERTAIN, SPELT, UNDERSTOOD, Meaning, meaning
from rodwell.survey.reading.numbers import is_number
from rodwell.survey.reading.tables import LONGEST_NAME, MOST_COLUMNS, Cell, RawTable, Row, listed, shown

CALLED = {"md": "measured depth", "inclination": "inclination", "azimuth": "azimuth", "force": "force", "well": "well"}
NEEDED = ("md", "inclination")
MOST_HEADER_ROWS = 3
LAST_HEADER = 300

MOST_LOOKED_AT = 5_000
"""Cells among which a header is sought."""

NORTHS: tuple[set[str], ...] = ({"grid", "gn"}, {"true", "tn", "geographic"}, set(), {"magnetic", "mag", "mn"})
"""Norths to count azimuths from, the preferred ones first; how a hole bends is the same from each of them."""

Asked = Mapping[str, str]
"""Columns that the user named, by meaning: text of the header, number from 1, or "none"."""


@dataclass(frozen=True)
class Sighting:
    """A row, or a few rows together, that may be the header: index of the first, how many, the names, what is in it."""

    index: int
    depth: int
    names: list[Cell]
    count: int
    complete: bool


@dataclass(frozen=True)
class Header:
    """Columns by meaning, units as written, names; columns left aside, and what must be told of the choice."""

    index: int
    depth: int
    names: list[Cell]
    columns: dict[str, int]
    units: dict[str, str]
    ignored: tuple[str, ...]
    notes: tuple[str, ...]


def checked_asked(asked: Mapping[str, str | int] | None) -> Asked:
    """Columns that the user named, checked.

    Raises
    ------
    InputError
        If one is for something that a survey has not.
    """
    out = {}
    for kind, name in (asked or {}).items():
        if kind not in CALLED:
            allowed = ", ".join(CALLED)
            raise InputError("--column", f"{kind}={name}", f'names the column of one of {allowed}: md="Depth (m)"')
        text = str(name).strip()
        if not text or (kind in NEEDED and text.lower() == "none"):
            raise InputError("--column", f"{kind}={name}", "must name a column by its header, or its number from 1")
        out[kind] = text
    return out


def _matches(text: str, names: Sequence[Cell]) -> list[int]:
    """Columns that a text of the user means."""
    if text.isdecimal() and len(text) < 6:
        return [int(text) - 1] if 0 < int(text) <= len(names) else []
    wanted = " ".join(text.lower().split())
    return [i for i, cell in enumerate(names) if isinstance(cell, str) and " ".join(cell.lower().split()) == wanted]


def sighted(rows: Sequence[Row], asked: Asked) -> Sighting | None:
    """The first rows that name depth and inclination; otherwise those in which most is understood; None without any."""
    best: Sighting | None = None
    looked_at = 0
    by_number = all(asked.get(kind, "").isdecimal() for kind in NEEDED)
    for i in range(min(len(rows), LAST_HEADER)):
        cells = rows[i][1]
        if len(cells) > MOST_COLUMNS:
            continue
        if by_number and all(at and is_number(cells[at[0]]) for at in (_matches(asked[k], cells) for k in NEEDED)):
            return Sighting(i, 0, [f"column {k + 1}" for k in range(len(cells))], 2, True)
        for depth in range(1, MOST_HEADER_ROWS + 1):
            if i + depth > len(rows) or any(is_number(cell) for cell in rows[i + depth - 1][1]):
                break
            names = _together(rows[i : i + depth])
            looked_at += len(names)
            if looked_at > MOST_LOOKED_AT:
                return best
            kinds = {found.kind: found.sure for found in map(meaning, names) if found.sure}
            for found in map(meaning, names):
                kinds[found.kind] = max(kinds.get(found.kind, 0), found.sure)
            named = {kind for kind, text in asked.items() if not text.isdecimal() and _matches(text, names)}
            complete = all(kinds.get(k, 0) >= UNDERSTOOD or k in named or asked.get(k, "").isdecimal() for k in NEEDED)
            complete = complete and (any(kinds.get(k, 0) >= UNDERSTOOD or k in named for k in NEEDED))
            seen = Sighting(i, depth, names, len(kinds.keys() - {""}) + len(named), complete)
            if complete:
                return seen
            if seen.count > (best.count if best else 0):
                best = seen
    return best


def _together(rows: Sequence[Row]) -> list[Cell]:
    """Names that run over several rows, put together column by column."""
    if len(rows) == 1:
        return rows[0][1]
    width = max(len(cells) for _, cells in rows)
    columns = [[cells[k] for _, cells in rows if k < len(cells)] for k in range(width)]
    return [" ".join(part for cell in column if (part := str(cell)[:LONGEST_NAME].strip())) for column in columns]


def find_header(table: RawTable, asked: Asked) -> Header:
    """Find the header of a table and choose the columns.

    Raises
    ------
    InputError
        If depth or inclination is not among them, or one that looks like an azimuth is not understood: with the columns
        found and how to name them.
    """
    if table.fixed:
        names = table.rows[0][1]
        seen: Sighting | None = Sighting(0, 1, names, 0, True)
    else:
        seen = sighted(table.rows, asked)
    if seen is None:
        number, cells = table.rows[0]
        what = (
            "no column of measured depth or inclination is found: the first line names the columns, for example "
            "MD [m],Inc [deg]; of a file without names give their numbers: --column md=1 --column inclination=2"
        )
        raise InputError(table.at(number), listed(cells), what)
    meanings = [_meaning(cell, table.also.get(i, "")) for i, cell in enumerate(seen.names)]
    at = table.at(table.rows[seen.index][0])
    columns, notes = {}, []
    for kind in CALLED:
        if kind in asked:
            if asked[kind].lower() != "none":
                columns[kind] = _asked_column(at, kind, asked[kind], seen.names)
            continue
        taken = set(columns.values())
        found = {i: m for i, m in enumerate(meanings) if m.kind == kind and i not in taken}
        choice, note = _choice(at, kind, found, seen.names)
        notes += note
        if choice is not None:
            columns[kind] = choice
    units = {kind: meanings[i].unit if meanings[i].kind == kind else _any_unit(kind, seen.names[i])
             for kind, i in columns.items()}  # fmt: skip
    ignored = tuple(shown(c) for i, c in enumerate(seen.names) if i not in columns.values() and str(c).strip())
    return Header(seen.index, seen.depth, seen.names, columns, units, ignored, tuple(notes))


def _meaning(cell: Cell, also: str) -> Meaning:
    """Meaning of a column from its name, or else from what describes it."""
    found = meaning(cell)
    if found.sure >= UNDERSTOOD or not also:
        return found
    other = meaning(also)
    useful = other.sure >= UNDERSTOOD and other.kind in ("md", "inclination", "azimuth")
    return Meaning(other.kind, UNDERSTOOD, _any_unit(other.kind, cell), other.words) if useful else found


def _any_unit(kind: str, name: Cell) -> str:
    """Unit in the name of a column that the user named: what stands in its last brackets, if it is a unit."""
    text = str(name)
    inner = text[max(text.rfind("("), text.rfind("[")) + 1 :].strip(" )].").lower()
    return inner if inner in SPELT[kind] else ""


def _asked_column(at: str, kind: str, text: str, names: list[Cell]) -> int:
    found = _matches(text, names)
    if len(found) != 1:
        how = "no column" if not found else "more than one column"
        what = f"names {how}; columns found: {listed(names)}; name one by its header, or its number from 1"
        raise InputError(f"{at}, --column", f"{kind}={text}", what)
    return found[0]


def how_to_name(kind: str, name: Cell, leave: bool = True) -> str:
    """How a column is named, or left aside."""
    text = shown(name)
    how = f'--column {kind}="{text}" (Python: columns={{"{kind}": "{text}"}})'
    return f"{how}, or leave it aside with --column {kind}=none" if leave and kind not in NEEDED else how


def _choice(at: str, kind: str, found: dict[int, Meaning], names: list[Cell]) -> tuple[int | None, list[str]]:
    """The column of one meaning among those that may be it, with what must be told; None if there is none."""
    word = CALLED[kind]
    sure = max((m.sure for m in found.values()), default=0)
    if sure < UNDERSTOOD:
        unclear = [names[i] for i in found]
        if kind in NEEDED or (unclear and kind == "azimuth"):
            like = f"; {listed(unclear)} looks like one and is not understood" if unclear else ""
            example = how_to_name(kind, unclear[0] if unclear else "NAME")
            what = f"no column of {word}{like}; columns found: {listed(names)}; name it: {example}"
            raise InputError(at, listed(unclear) or None, what)
        return None, [f'Column "{shown(name)}" is left aside: name it if it is the effective axial force, '
                      f"--column {kind}=…" for name in unclear]  # fmt: skip
    best = [i for i, m in found.items() if m.sure == sure]
    notes = []
    if len(best) > 1:
        best = _preferred(kind, {i: found[i] for i in best})
        if len(best) > 1:
            what = f"is a second column for {kind}: leave only one, or name it: {how_to_name(kind, names[best[0]])}"
            raise InputError(at, shown(names[best[1]]), what)
    others = [names[i] for i in found if i != best[0]]
    if sure < CERTAIN or others:
        beside = f"; {listed(others)} {'is' if len(others) == 1 else 'are'} left aside" if others else ""
        notes.append(f'Column "{shown(names[best[0]])}" is taken as the {word}{beside}.')
    return best[0], notes


def _preferred(kind: str, found: dict[int, Meaning]) -> list[int]:
    """Of several columns of one meaning those that may stay: of azimuths by north, of depths in two units the first."""
    if kind == "azimuth":
        rank = {i: next((k for k, north in enumerate(NORTHS) if north & set(m.words)), 2) for i, m in found.items()}
        return [i for i in found if rank[i] == min(rank.values())]
    units = [SPELT[kind].get(m.unit, "") for m in found.values()]
    return list(found)[:1] if all(units) and len(set(units)) == len(units) else list(found)
