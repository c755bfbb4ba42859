"""JSON without numbers that JSON does not have."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import pytest

from rodwell.quantities.as_json import as_json

SOURCE = Path(__file__).resolve().parents[2] / "src" / "rodwell"

OTHERWISE = {
    "quantities/as_json.py": "is the one that does it",
    "analysis/endless/tabulate.py": "refuses what is not finite",
    "case/first_case.py": "texts",
    "problem/problem.py": "texts of inputs, which are finite",
    "store/restart.py": "read back by itself, to the last bit",
    "store/staging.py": "names of files",
    "studies/maps/question.py": "axes, which are finite",
    "web/app.py": "texts",
    "web/desk.py": "texts",
    "web/engine.py": "keys of what has been computed",
    "web/inputs.py": "texts",
}
"""Files that write JSON by themselves, and why they may."""


def strict(text: str) -> object:
    """What a reader makes of JSON that knows the standard only."""
    return json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))


def test_what_is_not_finite_is_null_and_says_why() -> None:
    data = {"load": -124.6, "branches": [{"error": math.inf}, (1.0, math.nan)], "least": -math.inf}
    nulls = {"load": -124.6, "branches": [{"error": None}, [1.0, None]], "least": None}
    assert strict(as_json(data)) == nulls
    reasons = {"branches.0.error": "infinite", "branches.1.1": "not a number", "least": "minus infinite"}
    assert strict(as_json(data, reasons=True, indent=2)) == nulls | {"not_finite": reasons}
    assert strict(as_json([math.nan], reasons=True)) == [None]


def test_what_is_finite_is_as_it_was() -> None:
    data = {"load": -124.6, "errors": [1e-300, 0.0]}
    assert as_json(data, reasons=True) == json.dumps(data)
    assert as_json(data, compact=True) == '{"load":-124.6,"errors":[1e-300,0.0]}'


def test_all_json_is_written_so() -> None:
    writers = {
        path.relative_to(SOURCE).as_posix()
        for path in SOURCE.rglob("*.py")
        if re.search(r"\bjson\.dumps?\(|\bimport dumps?\b.*json", path.read_text("utf-8"))
    }
    assert writers == set(OTHERWISE)
