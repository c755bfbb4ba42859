"""Computing a map: chunks that are missing, then the jumps between cells; what a dead worker lost is tried again."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Protocol

import numpy as np

from rodwell.studies.maps import jumps
from rodwell.studies.maps.axes import Axis
from rodwell.studies.maps.block import Block, as_block, computed_block
from rodwell.studies.maps.cells import FAILED, Found
from rodwell.studies.maps.question import Question
from rodwell.studies.maps.rods import Rods
from rodwell.studies.maps.running import each
from rodwell.studies.maps.workers import Workers

Progress = Callable[[str, float], None]

Alone = tuple[list[tuple[Any, ...]], Callable[[int, Exception], Block]]
"""Arguments for each part of a piece by itself, and what stands for a part that fails even so."""

DIED = "the process that computed it died: {}"


class Keeper(Protocol):
    """What keeps chunks: a store, or the memory."""

    def missing(self, chunks: Iterator[Any]) -> list[Any]:
        """Those of the chunks that are not there."""

    def keep(self, chunk: Any, block: Block) -> None:
        """Keep a chunk, whole or not at all."""

    def read(self) -> Block:
        """All columns."""


def compute_cells(question: Question, keeper: Keeper, workers: Workers, tell: Progress) -> None:
    """Compute all chunks that are missing, and keep each as it is done.

    Raises
    ------
    ClusterLostError
        If the workers are gone; what was done is kept.
    """
    missing = keeper.missing(question.chunks())
    pieces = ((chunk, (question.rods, question.cells(chunk))) for chunk in missing)
    said = _Said(len(missing), question.chunk_counts, "chunks of cells", tell)
    for chunk, block in _blocks(computed_block, pieces, _cell_alone, workers):
        keeper.keep(chunk, block)
        said.one_more()


def compute_jumps(
    question: Question, found: Sequence[jumps.Edge], keeper: Keeper, workers: Workers, tell: Progress, halvings: int
) -> None:
    """Locate the jumps on all edges, as :func:`compute_cells` does."""
    size = jump_chunk(len(found))
    missing = keeper.missing(iter(range(-(-len(found) // size))))
    pieces = ((k, (question.rods, question.axes, list(found[k * size : (k + 1) * size]), halvings)) for k in missing)
    said = _Said(len(missing), (-(-len(found) // size),), "chunks of jumps", tell)
    for chunk, block in _blocks(jumps.located_block, pieces, _jump_alone, workers):
        keeper.keep(chunk, block)
        said.one_more()


def jump_chunk(count: int) -> int:
    """Jumps in a chunk."""
    return min(max(count // jumps.CHUNKS, jumps.SMALLEST), jumps.LARGEST)


def jump_region(chunk: int, count: int) -> tuple[slice]:
    """Where the jumps of a chunk lie among ``count`` of them."""
    size = jump_chunk(count)
    return (slice(chunk * size, min((chunk + 1) * size, count)),)


class _Said:
    """Progress in words, with the time left at the rate of this run."""

    def __init__(self, todo: int, counts: Sequence[int], what: str, tell: Progress) -> None:
        self.todo, self.all, self.what, self.tell = todo, int(np.prod(counts)), what, tell
        self.done, self.start = 0, time.monotonic()
        self._say("")

    def one_more(self) -> None:
        self.done += 1
        left = (time.monotonic() - self.start) / self.done * (self.todo - self.done)
        self._say(f", {time_text(left)} left" if self.done < self.todo else "")

    def _say(self, more: str) -> None:
        there = self.all - self.todo + self.done
        self.tell(f"{there} of {self.all} {self.what}{more}", there / max(self.all, 1))


def time_text(seconds: float) -> str:
    """A time in the largest unit of which it has two."""
    for size, unit in ((86400.0, "d"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} s"


def _blocks(
    function: Callable[..., Block],
    pieces: Iterable[tuple[Any, tuple[Any, ...]]],
    alone: Callable[..., Alone],
    workers: Workers,
) -> Iterator[tuple[Any, Block]]:
    """Chunks as they are done; of one that was lost (a worker died over and over) each part is tried alone."""
    given: dict[Any, tuple[Any, ...]] = {}

    def noted() -> Iterator[tuple[Any, tuple[Any, ...]]]:
        for key, arguments in pieces:
            given[key] = arguments
            yield key, arguments

    lost = []
    for key, result in each(function, noted(), workers.executor, workers.count):
        arguments = given.pop(key)
        if isinstance(result, Exception):
            lost.append((key, arguments))
        else:
            yield key, result
    for key, arguments in lost:
        parts, instead = alone(*arguments)
        tried = dict(each(function, enumerate(parts), workers.executor, workers.count))
        one_by_one = [instead(i, tried[i]) if isinstance(tried[i], Exception) else tried[i] for i in range(len(parts))]
        yield key, {name: np.concatenate([block[name] for block in one_by_one]) for name in one_by_one[0]}


def _cell_alone(rods: Rods, cells: Sequence[Any]) -> Alone:
    """Arguments for each cell by itself, and what stands for one that fails even so."""
    return [(rods, [cell]) for cell in cells], lambda _, error: as_block([Found(FAILED, reason=DIED.format(error))])


def _jump_alone(rods: Rods, axes: Sequence[Axis], chunk: Sequence[jumps.Edge], halvings: int) -> Alone:
    def instead(i: int, _error: Exception) -> Block:
        return {name: np.array([value]) for name, value in jumps.lost_row(axes, chunk[i]).items()}

    return [(rods, axes, [edge], halvings) for edge in chunk], instead
