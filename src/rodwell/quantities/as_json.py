"""Data as JSON that every reader takes: JSON has no word for what is infinite or not a number."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

NOT_FINITE = "not_finite"
"""Entry that says which numbers are null because they are not finite, and why: their places, and a word for each."""


def as_json(data: Any, *, reasons: bool = False, compact: bool = False, **options: Any) -> str:
    """Data as JSON; a number that is not finite is null.

    ``reasons`` adds an entry "not_finite" to a dictionary that has such numbers: "branches.0.error": "infinite".
    ``compact`` leaves out spaces; ``options`` are those of :func:`json.dumps`.
    """
    options |= {"allow_nan": False} | ({"separators": (",", ":")} if compact else {})
    try:
        return json.dumps(data, **options)
    except ValueError:  # rare: so it is looked for only then
        more = {NOT_FINITE: dict(_not_finite(data))} if reasons and isinstance(data, dict) else {}
        plain = _with_nulls(data)
        return json.dumps(plain | more if more else plain, **options)


def _not_finite(value: Any, place: str = "") -> Iterator[tuple[str, str]]:
    if isinstance(value, float) and not math.isfinite(value):
        yield place[1:], "not a number" if math.isnan(value) else "infinite" if value > 0.0 else "minus infinite"
    elif isinstance(value, dict | list | tuple):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from _not_finite(item, f"{place}.{key}")


def _with_nulls(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _with_nulls(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_with_nulls(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
