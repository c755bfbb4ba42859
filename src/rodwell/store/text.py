"""Data as JSON text files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any


def write_json(data: dict[str, Any], path: Path, *, finite: bool = False) -> None:
    """Write data as JSON, indented; with ``finite``, NaN and infinities are refused (ValueError)."""
    text = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=not finite)
    path.write_text(text + "\n", encoding="utf-8")
