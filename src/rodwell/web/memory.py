"""Memory that is not in use is given back to the machine."""

from __future__ import annotations

import contextlib
import ctypes
import gc
import sys
from collections.abc import Callable
from functools import cache


def give_back() -> None:
    """Give back to the machine what nothing refers to any more.

    Branches and their states refer to each other: left to itself, Python keeps hundreds of them. And what Python frees
    the C library keeps, in pieces between what is in use: a hundred megabytes after some minutes.
    """
    gc.collect()
    _trim()()


@cache
def _trim() -> Callable[[], object]:
    """What the GNU C library has for that; other libraries have nothing, or do it by themselves."""
    if sys.platform == "linux":
        with contextlib.suppress(OSError, AttributeError):
            trim = ctypes.CDLL("libc.so.6").malloc_trim
            return lambda: trim(0)
    return lambda: None
