"""A map as plain data, for JSON: what was asked and what came of it; the numbers are in the store."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.quantities.value import Value
from rodwell.studies.maps import jumps
from rodwell.studies.maps.axes import Axis, Distribution, about_parameter
from rodwell.studies.maps.cells import IN_WORDS, OUTCOMES
from rodwell.studies.maps.result import Map

MOST_REASONS = 20
"""Different reasons that are listed."""


def map_dict(result: Map) -> dict[str, Any]:
    """Return what was asked, how many cells came to what, extremes and jumps."""
    question = result.question
    parameters: tuple[Axis | Distribution, ...] = (*question.axes, *question.distributions)
    return {
        "quantity": question.rods.quantity,
        "meaning": question.rods.number.label,
        "unit": result.unit,
        "convention": "end forces at s = 1, tension positive; places in L from s = 0",
        "rtol": question.rods.rtol,
        "parameters": {one.name: _parameter(one) for one in parameters},
        "dims": list(question.dims),
        "shape": list(question.shape),
        "cells": question.size,
        "outcomes": {name: {"cells": n, "meaning": meaning(name)} for name, n in result.counts.items()},
        "reasons": [{"reason": reason, "cells": n, "first": at} for reason, n, at in reasons(result)],
        **{name: extreme(pair) for name, pair in zip(("least", "largest"), result.extremes, strict=False)},
        "jumps": {kind: n for kind, n in counted_jumps(result).items() if n},
        "complete": result.complete,
        "store": result.path,
    }


def _parameter(one: Axis | Distribution) -> dict[str, str]:
    about = about_parameter(one.name, one.unit)
    return {"meaning": about["long_name"], "unit": about["units"]}


def meaning(outcome: str) -> str:
    """An outcome in words."""
    return IN_WORDS[OUTCOMES.index(outcome)]


def extreme(pair: tuple[Value, dict[str, Any]]) -> dict[str, Any]:
    """A number, its error and the cell in which it was found."""
    value, at = pair
    return {"value": value.value, "error": value.error, "at": at}


def reasons(result: Map) -> list[tuple[str, int, dict[str, Any]]]:
    """Different reasons for missing numbers, the most frequent first: how many cells, and the first of them."""
    texts = result.cells["reason"].astype(object).ravel()
    told = np.flatnonzero(np.array([bool(text) for text in texts], dtype=bool))
    if not told.size:
        return []
    names, first, counts = np.unique(texts[told].astype(str), return_index=True, return_counts=True)
    order = np.argsort(-counts, kind="stable")[:MOST_REASONS]
    shape = result.question.shape
    places = [np.unravel_index(int(told[first[i]]), shape) for i in order]
    return [(str(names[i]), int(counts[i]), result.parameters(at)) for i, at in zip(order, places, strict=True)]


def counted_jumps(result: Map) -> dict[str, int]:
    """How many jumps of which kind were located."""
    kinds = result.jumps.get("outcome", np.empty(0, dtype=int))
    return {name: int(np.count_nonzero(kinds == number)) for number, name in enumerate(jumps.KINDS)}
