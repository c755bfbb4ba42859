"""A map as users hold it: its columns, what came of its cells, where it jumps."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.errors import InputError, NotConvergedError
from rodwell.faces import Shown, drawn, face, plain
from rodwell.quantities.value import Value
from rodwell.studies.maps import jumps
from rodwell.studies.maps.block import Block
from rodwell.studies.maps.cells import IMPOSSIBLE, IN_WORDS, MISSES_TOLERANCE, OUTCOMES, WITH_VALUE
from rodwell.studies.maps.question import Question

if TYPE_CHECKING:
    import xarray as xr

    from rodwell.faces import Axes


class Map(Shown):
    """One number of many problems: what :func:`rodwell.map` returns.

    Attributes
    ----------
    question
        What was asked: the number, the rods, the grid.
    path
        Where it is kept; None in memory.
    """

    def __init__(
        self, question: Question, cells: Callable[[], Block], found: Callable[[], Block] | None, path: str | None
    ) -> None:
        self.question, self.path = question, path
        self._read_cells, self._read_jumps = cells, found

    def __repr__(self) -> str:
        sizes = " × ".join(f"{name} {n}" for name, n in zip(self.question.dims, self.question.shape, strict=True))
        return f"<Map of {self.question.rods.quantity}: {sizes}>"

    @cached_property
    def cells(self) -> Block:
        """Columns by name, each in the shape of the grid: value, error, place, wavenumber, reason, outcome."""
        return self._read_cells()

    @property
    def values(self) -> np.ndarray:
        """The numbers asked for in ``unit``; NaN where there is none."""
        return self.cells["value"]

    @property
    def errors(self) -> np.ndarray:
        """Error estimates of ``values``."""
        return self.cells["error"]

    @property
    def unit(self) -> str:
        """Unit of the values: of B and L, or SI where the rods have dimensions."""
        return self.question.unit

    @cached_property
    def jumps(self) -> Block:
        """Where mode, place or outcome jump along the lines of the grid, (n,) each: see the store's group ``jumps``."""
        found = {} if self._read_jumps is None else self._read_jumps()
        if not found:
            return {}
        real = np.isin(found["outcome"], (jumps.PLACE, jumps.MODE, jumps.OUTCOME))
        return {name: column[real] for name, column in found.items()}

    @property
    def counts(self) -> dict[str, int]:
        """How many cells came to which outcome; outcomes that came to none are left out."""
        numbers = np.bincount(self.cells["outcome"].ravel(), minlength=len(OUTCOMES))
        return {name: int(number) for name, number in zip(OUTCOMES, numbers, strict=True) if number}

    @property
    def missed(self) -> int:
        """How many cells have a value that misses the tolerance."""
        return int(np.count_nonzero(self.cells["outcome"] == MISSES_TOLERANCE))

    @property
    def complete(self) -> bool:
        """Whether every cell was computed."""
        return bool(np.all(self.cells["outcome"]))

    @property
    def extremes(self) -> tuple[tuple[Value, dict[str, Any]], ...]:
        """Least and largest value, each with the parameters of its cell; empty where no cell has a value."""
        known = np.isin(self.cells["outcome"], WITH_VALUE)
        if not known.any():
            return ()
        out = []
        for number, choose in ((np.inf, np.argmin), (-np.inf, np.argmax)):
            at = np.unravel_index(int(choose(np.where(known, self.values, number))), self.values.shape)
            out.append((Value(float(self.values[at]), float(self.errors[at])), self.parameters(at)))
        return tuple(out)

    def refuse_gaps(self) -> None:
        """Raise if a cell has no value: what is made of a whole map would not say where it is silent.

        Raises
        ------
        InputError
            If the values of the first such cell make no problem, with its parameters and the reason.
        NotConvergedError
            If it has no value otherwise.
        """
        outcomes = self.cells["outcome"]
        gaps = np.argwhere(~np.isin(outcomes, WITH_VALUE))
        if not gaps.size:
            return
        at = tuple(gaps[0])
        where = ", ".join(f"{name} = {value}" for name, value in self.parameters(at).items())
        reason = self.cells["reason"][at] or IN_WORDS[int(outcomes[at])]
        why = f"{len(gaps)} of {outcomes.size} cells have no value; at {where}: {reason}"
        if outcomes[at] == IMPOSSIBLE:
            raise InputError("over", None, why)
        raise NotConvergedError(why)

    def parameters(self, at: Any) -> dict[str, Any]:
        """The parameters of a cell, by name: numbers in the units of the axes, or names."""
        axes = self.question.axes
        out: dict[str, Any] = {
            axis.name: (axis.values if axis.numbers is None else axis.numbers)[i]
            for axis, i in zip(axes, at, strict=False)
        }
        if self.question.distributions:
            row = self.question.drawn[at[-1]]
            out |= {one.name: float(x) for one, x in zip(self.question.distributions, row, strict=True)}
        return out

    @property
    def dataset(self) -> xr.Dataset:
        """The map as an xarray Dataset; that of a store reads chunks when they are asked for."""
        return face("dataset")(self)  # type: ignore[no-any-return]

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw a map over two parameters as contours, over one as a curve, of samples as their distribution.

        ``ax`` as for :meth:`rodwell.Branch.plot`; ``options``: ``show`` ("value", "place",
        "half-waves", "error"), ``at``, which holds further parameters, and ``load``, which tells safe and unsafe apart.
        """
        return drawn(self, ax, **options)

    def as_dict(self) -> dict[str, Any]:
        """Return what was asked and what came of it as plain data, for JSON; the numbers are in the store."""
        return plain(self)
