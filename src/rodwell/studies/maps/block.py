"""Blocks of cells: the pieces in which a map is computed, travels and is kept."""

from __future__ import annotations

import gc
from collections.abc import Sequence
from typing import Any

import numpy as np

from rodwell.errors import InputError, NotConvergedError
from rodwell.studies.maps.cells import (
    CONVERGED,
    FAILED,
    IMPOSSIBLE,
    NOT_DEFINED,
    WITH_VALUE,
    Found,
    MappedRod,
    NoSuchNumber,
)
from rodwell.studies.maps.rods import Rods

Block = dict[str, np.ndarray]
"""Columns by name, (n,) each."""

COLUMNS: dict[str, tuple[str, Any, str]] = {
    "value": ("f8", np.nan, "the number that was asked for"),
    "error": ("f8", np.nan, "estimate of its error, in the same unit"),
    "place": ("f8", np.nan, "s/L where it is reached, or happens; the first of several"),
    "wavenumber": ("f8", np.nan, "of the first buckling mode in rad/L: half waves times π; 0: straight at its load"),
    "reason": ("string", "", "why there is no value, or what is amiss with it"),
    "outcome": ("u1", 0, "what came of the cell"),
}
"""Type of the values, what stands where nothing was computed, and meaning. The last column is written last: where it
is, the others are."""

TIDY_AFTER = 1000
"""Cells after which memory is tidied: that takes as long as some cells."""

LONGEST_REASON = 300
"""Characters of a reason."""


def computed_block(rods: Rods, cells: Sequence[Sequence[Any]]) -> Block:
    """Compute cells, given by the values of their parameters; nothing that happens to one of them ends it."""
    block = as_block([computed_cell(rods, values) for values in cells])
    _tidied(len(cells))
    return block


def _tidied(more: int) -> None:
    """Let go of what ended branches hold in circles, before it piles up.

    Python by itself looks for it so seldom that a process grows by 8 MB with every thousand branches.
    """
    global _untidied  # noqa: PLW0603 - of the process, like the memory
    _untidied += more
    if _untidied >= TIDY_AFTER:
        gc.collect()
        _untidied = 0


_untidied = 0


def as_block(found: Sequence[Found]) -> Block:
    """Results as columns."""
    rows = [(f.value.value, f.value.error, f.place, f.wavenumber, f.reason[:LONGEST_REASON], f.outcome) for f in found]
    columns = list(zip(*rows, strict=True)) if rows else [()] * len(COLUMNS)
    kinds = [object if kind == "string" else kind for kind, _, _ in COLUMNS.values()]
    return {name: np.array(column, dtype=kind) for name, column, kind in zip(COLUMNS, columns, kinds, strict=True)}


def computed_cell(rods: Rods, values: Sequence[Any]) -> Found:
    """Compute one cell, a second time with shorter steps where that may help."""
    try:
        rod = MappedRod(rods.case(values))
    except InputError as error:
        return Found(IMPOSSIBLE, reason=str(error))
    except Exception as error:
        return Found(FAILED, reason=f"{type(error).__name__}: {error}")
    first = _attempt(rods, rod)
    if first.outcome == CONVERGED or first.outcome not in (*WITH_VALUE, FAILED):
        return _scaled(rods, rod, first)
    second = _attempt(rods, rod.finer())
    better = second if second.outcome == CONVERGED or first.outcome == FAILED else first
    return _scaled(rods, rod, better)


def _attempt(rods: Rods, rod: MappedRod) -> Found:
    try:
        return rods.number.of(rod)
    except NoSuchNumber as outcome:
        return outcome.found
    except InputError as error:  # the problem is one, but does not have this number
        return Found(NOT_DEFINED, reason=str(error))
    except NotConvergedError as error:
        return Found(FAILED, reason=str(error))
    except Exception as error:  # what nobody foresaw must not end a map of a million cells
        return Found(FAILED, reason=f"{type(error).__name__}: {error}")


def _scaled(rods: Rods, rod: MappedRod, found: Found) -> Found:
    """The value in SI units where the case has dimensions; stress has them already."""
    scales, dimension = rod.case.scales, rods.number.dimension
    if scales is None or dimension == "stress":
        return found
    factor = scales.factor(dimension)
    return Found(found.outcome, found.value.times(factor), found.place, found.wavenumber, found.reason)
