"""Running a script of ``examples/gallery``."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

GALLERY = Path(__file__).resolve().parents[2] / "examples" / "gallery"


def run(name: str) -> Any:
    """The values that a script's ``main`` returns with its figure."""
    figure, values = runpy.run_path(str(GALLERY / f"{name}.py"))["main"]()
    assert figure.axes
    return values
