"""What may be sent to the explorer, for ``fuzz.py`` and the tests: addresses, paths, messages, requests."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from typing import Any

from hypothesis import strategies as st

from rodwell.web.engine import ASKED, Engine
from rodwell.web.given import Given

NAMES = st.sampled_from(
    [
        *("load", "until", "branch", "which", "special", "y", "path", "scale", "ends", "modes", "sections", "x", ""),
        *("dimensionless.weight", "dimensionless.alpha", "load.twist", "__proto__", "constructor", "toString"),
    ]
)
PARTS = st.sampled_from(
    [
        *("1", "-1", "0", "118.4", "1e308", "1e999", "NaN", "Infinity", "0x10", "1,5", "", " ", "%", "%ff", "%00", "+"),
        *("mode 1", "straight", "load path", "true", "followed", "clamped-clamped", "0.5:1:1,0.5:2:1", "none", "../"),
        *("&", "=", "#", "?", "<script>", "\u202e", "٣", "null", "[]", "{}", "9" * 400),
    ]
)
TEXTS = st.lists(PARTS | st.text(max_size=5), max_size=4).map("".join)
HASHES = st.one_of(
    TEXTS.map(lambda text: f"#{text}"),
    st.lists(st.tuples(NAMES, TEXTS), max_size=6).map(lambda pairs: "#" + "&".join(f"{a}={b}" for a, b in pairs)),
    st.lists(st.tuples(NAMES, PARTS), max_size=3).map(lambda pairs: "#" + "&".join(f"{a}={b}" for a, b in pairs)),
)
"""Ends of addresses, which hold the state of the page."""

VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 10**20) | st.floats(allow_nan=False, allow_infinity=False) | TEXTS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXTS, inner, max_size=3),
    max_leaves=4,
)
INPUTS = st.dictionaries(
    st.sampled_from(["ends", "modes", "sections", "x", "load.twist"]), VALUES, min_size=1, max_size=2
)
REQUESTS = st.fixed_dictionaries(
    {"kind": st.sampled_from([*ASKED, *ASKED, "follow", "nothing"]) | TEXTS},
    optional={
        "inputs": st.just({}) | st.just({}) | INPUTS.filter(lambda inputs: inputs.get("modes") is not True),
        "load": st.sampled_from([118.0, 60.0]) | VALUES, "branch": st.sampled_from(["mode 1", "straight"]) | VALUES,
        "which": st.just(0) | VALUES, "special": st.just(0) | VALUES,
        "suffix": st.sampled_from(["toml", "csv"]) | VALUES,
        "from": VALUES | st.fixed_dictionaries({"load": VALUES, "branch": VALUES, "inputs": VALUES}), "known": VALUES,
    },
)  # fmt: skip
"""What a page may ask the engine, and what no page would."""

NESTED = st.integers(1, 30_000).map("[".__mul__)
MESSAGES = TEXTS | st.binary(max_size=20) | VALUES.map(json.dumps) | REQUESTS.map(json.dumps) | NESTED
"""What may come through the connection."""


@cache
def engine() -> Engine:
    """One with the diagram of the case as it is given."""
    out = Engine(Given(None))
    out.answer({"kind": "diagram", "inputs": {}}, lambda _: None, lambda: None)
    return out


def requests(request: dict[str, Any]) -> None:
    """A request is answered with a message, the last, or refused in words."""
    messages: list[dict[str, Any]] = []
    inputs = request.get("inputs")
    if inputs and "modes" not in inputs and "x" not in inputs:
        return  # diagrams take too long: what moves is refused or computed, and the tests of inputs have that
    engine().answer(request, messages.append, lambda: None)
    assert [bool(message.get("last")) for message in messages] == [False] * (len(messages) - 1) + [True]
    json.dumps(messages[-1], allow_nan=False)


TARGETS: dict[str, tuple[Callable[[Any], None], Any]] = {"explorer": (requests, REQUESTS)}
