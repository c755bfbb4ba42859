"""Templates of pages, and content that stands inside them: what is written opens offline."""

from __future__ import annotations

import base64
from functools import cache
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
_TYPES = {"svg": "image/svg+xml", "png": "image/png", "jpeg": "image/jpeg"}


@cache
def template(name: str) -> Any:
    """Return the Jinja template ``name`` of this folder; values are escaped as HTML."""
    import jinja2  # noqa: PLC0415

    environment = jinja2.Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    return environment.from_string((HERE / name).read_text(encoding="utf-8"))


def embedded(kind: str, content: bytes) -> str:
    """A picture ("svg" or "png") as a data address: nothing is loaded from elsewhere."""
    return f"data:{_TYPES[kind]};base64,{base64.b64encode(content).decode()}"
