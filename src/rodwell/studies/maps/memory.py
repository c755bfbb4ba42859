"""Maps that are kept nowhere: computed by the same pieces, and held in memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from rodwell.studies.maps import jumps
from rodwell.studies.maps.block import COLUMNS, Block
from rodwell.studies.maps.computing import Progress, compute_cells, compute_jumps, jump_region
from rodwell.studies.maps.question import Question
from rodwell.studies.maps.result import Map
from rodwell.studies.maps.workers import Workers


class Memory:
    """Keeps a map in memory."""

    def __init__(
        self, columns: dict[str, tuple[str, Any, str]], shape: Sequence[int], region: Callable[..., Any]
    ) -> None:
        kinds = {name: (object if kind == "string" else kind, fill) for name, (kind, fill, _) in columns.items()}
        self.columns: Block = {name: np.full(shape, fill, dtype=kind) for name, (kind, fill) in kinds.items()}
        self.region = region

    def missing(self, chunks: Iterator[Any]) -> list[Any]:
        """Those of the chunks that are not there."""
        return [chunk for chunk in chunks if not np.all(self.columns["outcome"][self.region(chunk)])]

    def keep(self, chunk: Any, block: Block) -> None:
        """Keep a chunk."""
        region = self.region(chunk)
        for name, column in self.columns.items():
            column[region] = block[name].reshape(column[region].shape)

    def read(self) -> Block:
        """All columns."""
        return self.columns


def in_memory(question: Question, workers: Workers, tell: Progress | None = None, halvings: int = 0) -> Map:
    """Compute a map, and where it jumps if edges are to be halved.

    Raises
    ------
    ClusterLostError
        If the workers are gone.
    """
    tell = tell or (lambda _what, _done: None)
    cells = Memory(COLUMNS, question.shape, question.region)
    compute_cells(question, cells, workers, tell)
    found = jumps.edges(question, cells.read()) if halvings else []
    located = Memory(jumps.columns(question), (len(found),), lambda k: jump_region(k, len(found)))
    compute_jumps(question, found, located, workers, tell, halvings)
    return Map(question, cells.read, located.read, None)
