"""Parts of a load path as plain data, for JSON."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from rodwell.errors import RodwellError


def found_or_why(values: Sequence[float], found: Callable[[float], list[dict[str, Any]]]) -> list[dict[str, Any]]:
    """What is found at values of what is controlled, in order, or why nothing is."""
    out = []
    for value in values:
        try:
            out += found(value)
        except RodwellError as error:
            out.append({"force": value, "reached": False, "why": str(error)})
    return out
