"""How often Python looks for cycles among the objects of a process: seldom in those that begin with long imports."""

from __future__ import annotations

import gc
from collections.abc import Callable
from functools import wraps
from typing import Any

COLLECT_AFTER = 50_000
"""Objects more than before after which Python looks for cycles among them. Imports make that many and leave no cycles:
with Python's own number, 700, a tenth of a short command is spent looking."""


def collect_seldom() -> None:
    """Let this process look for cycles after so many objects only."""
    gc.set_threshold(COLLECT_AFTER, 10, 10)


def without_collecting(compiling: Callable[..., Any]) -> Callable[..., Any]:
    """Compile with Python's cyclic collector at rest: it would go over the compiler's many objects again and again.

    That is a tenth of the time. What is left to collect is small, and is collected when the kernel is done.
    """

    @wraps(compiling)
    def at_once(*arguments: Any, **options: Any) -> Any:
        collecting = gc.isenabled()
        gc.disable()
        try:
            return compiling(*arguments, **options)
        finally:
            if collecting:
                gc.enable()

    return at_once
