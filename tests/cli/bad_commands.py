"""Cases and exit codes of the tests of commands that go wrong."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

GOOD = "[dimensionless]\nweight = 16.5\n\n[analysis]\nmodes = 1\nrtol = 1e-4\noff_wall = false\n"
BEYOND_RANGE = "[load]\nuntil = -65.0\n\n" + GOOD.replace("16.5", "16.5\nclearance = 0.3")

INPUT_ERROR, COMPUTATION_ERROR, TOLERANCE_MISSED, INTERRUPTED = 2, 1, 3, 130

Run = Callable[..., tuple[int, str, str]]


def entries(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))
