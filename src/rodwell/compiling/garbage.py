"""How often Python looks for cycles among the objects of a process: seldom in those that begin with long imports."""

from __future__ import annotations

import gc

COLLECT_AFTER = 50_000
"""Objects more than before after which Python looks for cycles among them. Imports make that many and leave no cycles:
with Python's own number, 700, a tenth of a short command is spent looking."""


def collect_seldom() -> None:
    """Let this process look for cycles after so many objects only."""
    gc.set_threshold(COLLECT_AFTER, 10, 10)
