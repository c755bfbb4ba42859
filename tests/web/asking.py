"""Asking an engine of the explorer as the server does."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from rodwell.quantities.as_json import as_json
from rodwell.web.engine import Engine

EXAMPLES = Path(__file__).parents[2] / "examples"
FIELD = EXAMPLES / "field-drill-pipe.toml"


def never() -> None:
    """No request is cancelled."""


def ask(engine: Engine, kind: str, **what: Any) -> dict[str, Any]:
    out: list[dict[str, Any]] = []
    engine.answer({"kind": kind, "id": 1, "inputs": {}, **what}, out.append, never)
    assert [message.get("last", False) for message in out] == [False] * (len(out) - 1) + [True]
    assert json.loads(as_json(out[-1])) == json.loads(json.dumps(out[-1]))  # plain data, nothing that is not finite
    return out[-1]
