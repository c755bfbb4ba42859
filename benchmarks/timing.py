"""How long a piece of work takes: the least of several runs, since other work on the machine only ever adds."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence

Clock = Callable[[], float]


def best(work: Callable[[], object], times: int, clock: Clock = time.process_time) -> float:
    """Least time in seconds of several runs: of the processor in this process; ``time.perf_counter``: on the wall."""
    return min(_once(work, clock) for _ in range(times))


def least(works: Sequence[Callable[[], object]], seconds: float, clock: Clock = time.perf_counter) -> list[float]:
    """Least time in seconds of each of several pieces of work, done in turn for about ``seconds``, to be compared."""
    found = [math.inf] * len(works)
    until = time.perf_counter() + seconds
    while time.perf_counter() < until:
        found = [min(so_far, _once(work, clock)) for so_far, work in zip(found, works, strict=True)]
    return found


def _once(work: Callable[[], object], clock: Clock) -> float:
    start = clock()
    work()
    return clock() - start
