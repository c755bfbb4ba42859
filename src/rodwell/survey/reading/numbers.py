"""Numbers in cells: decimal points and commas, separators of thousands, and what stands for a missing value."""

from __future__ import annotations

import re
from collections.abc import Iterable

from rodwell.errors import InputError
from rodwell.survey.reading.tables import Cell, shown

LONGEST_NUMBER = 60

NO_VALUE = frozenset({"", "-", "--", "---", "–", "—", "nan", "null", "(null)", "n/a", "na", "#n/a", "none", "nil", "nd",
                      "?", "*", "."})  # fmt: skip
"""Texts that stand for a missing value, in lower case."""

CUSTOMS = frozenset({999.0, 999.25, 9999.0, 9999.25, 99999.0, 99999.25, 999999.0, 999999.25})
"""Sizes of numbers that stand for one: negative, or for an angle with either sign."""

_PLAIN = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?")
_BLANKS = re.compile(r"(?<=[0-9])[ \u00a0\u2009\u202f'’](?=[0-9]{3}(?![0-9]))")


def is_number(cell: Cell) -> bool:
    """Whether a cell holds a number, in whatever spelling."""
    if isinstance(cell, float):
        return True
    text = _clean(cell)
    return 0 < len(text) <= LONGEST_NUMBER and bool(_PLAIN.fullmatch(text.replace(",", ".", 1)) or spelling(text))


def _clean(text: str) -> str:
    """Without blanks around, a true minus, a degree sign, and blanks or apostrophes between thousands."""
    text = text.strip()
    if len(text) > LONGEST_NUMBER or text.isdecimal():
        return text
    return _BLANKS.sub("", text.replace("−", "-").rstrip("°").strip())


def is_missing(cell: Cell, kind: str, null: float | None) -> bool:
    """Whether a cell stands for a missing value of ``kind``; ``null`` is what the file itself says."""
    if isinstance(cell, str):
        text = cell.strip().lower()
        if text in NO_VALUE:
            return True
        if "9" not in text and null is None:
            return False
        text = _clean(text).replace(",", ".")
        if not _PLAIN.fullmatch(text):
            return False
        value = float(text)
    else:
        value = cell
    if value != value or value == null:  # noqa: PLR0124 - NaN
        return True
    return abs(value) in CUSTOMS and (value < 0.0 or kind in ("inclination", "azimuth"))


def spelling(text: str) -> str:
    """What a number says about its spelling: "point", "comma" (the decimal mark), "either", "" (nothing).

    "1,234" and "1.234" may be 1234 or 1.234.
    """
    body = text.lstrip("+-").lower().partition("e")[0]
    if not body or any(c not in "0123456789.," for c in body):
        return ""
    dot, comma = body.rfind("."), body.rfind(",")
    if dot >= 0 and comma >= 0:
        whole, mark = (body[:dot], ",") if dot > comma else (body[:comma], ".")
        return ("point" if dot > comma else "comma") if _grouped(whole, mark) else ""
    mark, own, other = (".", "point", "comma") if dot >= 0 else (",", "comma", "point")
    if mark not in body:
        return ""
    if body.count(mark) > 1:
        return other if _grouped(body, mark) else ""
    whole, _, part = body.partition(mark)
    return "either" if len(part) == 3 and 1 <= len(whole) <= 3 and whole.strip("0") else own


def _grouped(text: str, mark: str) -> bool:
    parts = text.split(mark)
    return 1 <= len(parts[0]) <= 3 and all(len(part) == 3 for part in parts[1:]) and all(p.isdecimal() for p in parts)


Found = tuple[str, str, Cell]
"""Where a cell stands, the name of its column, and the cell."""


def decimal_mark(cells: Iterable[tuple[str, Found]], asked: str | None) -> str:
    """The decimal mark of a table, "." or ",", from its cells, each with the meaning of its column.

    Raises
    ------
    InputError
        If cells contradict each other, or a number could be two and nothing says which.
    """
    if asked is not None:
        if asked not in ("point", "comma"):
            raise InputError("--decimal", asked, "must be point or comma")
        return "," if asked == "comma" else "."
    seen: dict[str, Found] = {}
    for kind, found in cells:
        if isinstance(found[2], str) and ("." in found[2] or "," in found[2]):
            text = _clean(found[2])
            said = spelling(text)
            if said == "either" and "." in text:
                said = "point" if kind in ("inclination", "azimuth") else "dot"
            seen.setdefault(said, found)
    remedy = "give --decimal point or --decimal comma (Python: decimal=), or write it without marks between thousands"
    if "point" in seen and "comma" in seen:
        (where, column, cell), (other, _, second) = seen["comma"], seen["point"]
        raise InputError(f"{where}, {column}", shown(cell), f"has a decimal comma, but {shown(second)} ({other}) has "
                         f"a decimal point, not a comma: write all numbers alike")  # fmt: skip
    if "comma" in seen:
        if "dot" in seen:
            where, column, cell = seen["dot"]
            raise InputError(f"{where}, {column}", shown(cell), f"may be a number with a point between thousands, "
                             f"since other numbers have decimal commas; {remedy}")  # fmt: skip
        return ","
    if "either" in seen and "point" not in seen:
        where, column, cell = seen["either"]
        raise InputError(f"{where}, {column}", shown(cell), f"may have a decimal comma, or a comma between thousands; "
                         f"{remedy}")  # fmt: skip
    return "."


def number(cell: Cell, mark: str) -> float | None:
    """The number in a cell, whose decimal mark is ``mark``; None if it is none."""
    if isinstance(cell, float):
        return cell
    text = _clean(cell)
    if len(text) > LONGEST_NUMBER:
        return None
    if text.lower().lstrip("+-") in ("inf", "infinity"):
        return float(text)
    if "," in text or mark == ",":
        other = "." if mark == "," else ","
        whole, point, part = text.partition(mark)
        if other in whole and not _grouped(whole.lstrip("+-"), other):
            return None
        text = whole.replace(other, "") + (("." + part) if point else "")
    return float(text) if _PLAIN.fullmatch(text) else None
