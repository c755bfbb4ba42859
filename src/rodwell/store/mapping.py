"""``rodwell.map``: put a question to very many problems, and keep the answers as they come."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from rodwell.case.checks.rigid_wall import warn_if_it_gives_way
from rodwell.case.file import CaseText
from rodwell.errors import InputError, checked_whole
from rodwell.problem.problem import Problem
from rodwell.store.chunked import (
    COMPLETE,
    QUESTION,
    Kept,
    consolidate,
    make_columns,
    make_coordinate,
    make_subgroup,
    opened,
)
from rodwell.store.map_arrays import attributes, coordinates, of_columns, of_jumps
from rodwell.studies.maps import jumps
from rodwell.studies.maps.block import COLUMNS
from rodwell.studies.maps.computing import Progress, compute_cells, compute_jumps, jump_chunk, jump_region
from rodwell.studies.maps.memory import in_memory
from rodwell.studies.maps.question import Question, Samples, asked
from rodwell.studies.maps.result import Map
from rodwell.studies.maps.workers import Workers, team

MOST_HALVINGS = 40

MOST_IN_MEMORY = 10**7
"""Cells of a map that is kept nowhere."""

JUMPS = "jumps"
"""The group of a store that holds where the map jumps."""


def map(  # noqa: A001 - the public name is rodwell.map
    of: Problem | CaseText | str | Path | Mapping[str, Any],
    quantity: str = "lift-off",
    *,
    over: Mapping[str, Any],
    out: str | Path | None = None,
    workers: int | Workers = 1,
    scheduler: str | None = None,
    samples: int = 0,
    sampling: str = "sobol",
    seed: int = 0,
    load: float | None = None,
    rtol: float | None = None,
    halvings: int = jumps.HALVINGS,
    progress: Progress | None = None,
    started: Callable[[Workers], None] | None = None,
) -> Map:
    """Compute one number for very many problems, over up to four parameters.

    Parameters
    ----------
    of
        A problem; or a case, as the path of its file or the content of it. Ranges and distributions in a case file
        count as if they stood in ``over``.
    quantity
        "critical", "lift-off", "limit" (leaves the wall or loses its stability), "secondary", or at a load "contact",
        "contact-total", "shortening", "stress" (this one of a case with dimensions).
    over
        What varies, by name: "weight", "alpha", "clearance", "twist", "poisson", "torsion", "ends", "load" of a
        problem, "section.key" of a case. Values: a range, "5..200 in 40", "1..300 in 40 log"; a list or array; a
        distribution, "normal(100, 5)", "uniform(…)", "loguniform(…)", "triangular(…)". Those of a case have units.
    out
        Where the map is kept, a Zarr store: a folder, or the address of an object store. The same question again goes
        on where it was. None: in memory.
    workers
        How many processes: more than one start a local cluster of Dask (or a plain pool, where that is not installed).
    scheduler
        Address of a Dask scheduler, "tcp://host:8786", in place of ``workers``.
    samples, sampling, seed
        How many samples are drawn if a parameter has a distribution, how ("sobol" or "random"), and from which seed.
    load
        End force at s = 1 in B/L², tension positive, for numbers at a load of a problem.
    rtol
        Relative tolerance of every number of a problem; refused beside a case, which has ``analysis.rtol``.
    halvings
        How often the edges between cells are halved where mode, place or outcome jump; 0: jumps are not sought.
    progress, started
        Called with what is done, in words with the time left, and as a part; and once with the workers.

    Raises
    ------
    InputError
        For what cannot be used; if ``out`` holds a map of another question, or another run writes to it.
    ClusterLostError
        If the workers are gone; what was done is kept in ``out``.
    """
    question = asked(of, quantity, over, Samples(samples, sampling, seed), load=load, rtol=rtol)
    warn_if_it_gives_way(question.rods.given)
    halvings = checked_whole("halvings", halvings, 0, MOST_HALVINGS)
    tell = progress or (lambda _what, _done: None)
    if out is None and question.size > MOST_IN_MEMORY:
        raise InputError("out", None, f"must be given: {question.size} cells are too many for the memory")
    if out is not None:
        return _in_store(question, out, halvings, tell, lambda: team(workers, scheduler), started)
    with team(workers, scheduler) as found:
        if started is not None:
            started(found)
        return in_memory(question, found, tell, halvings)


def _in_store(question: Question, out: str | Path, halvings: int, tell: Progress, gathered: Any, started: Any) -> Map:
    identity = question.identity | {"halvings": halvings}
    with opened(out, identity, lambda group: _build(group, question, identity)) as group:
        cells = Kept(group, COLUMNS, question.region)
        if not group.attrs.get(COMPLETE):
            with gathered() as workers:
                if started is not None:
                    started(workers)
                compute_cells(question, cells, workers, tell)
                if halvings:
                    _jumps(question, out, group, cells, workers, tell, halvings)
            group.attrs[COMPLETE] = True
            consolidate(group)
        at = str(out)
        subgroup = group.get(JUMPS)
        located = None if subgroup is None else Kept(subgroup, jumps.columns(question), lambda _: ()).read
        return Map(question, cells.read, located, at)


def _jumps(
    question: Question, out: str | Path, group: Any, cells: Kept, workers: Workers, tell: Progress, halvings: int
) -> None:
    found = jumps.edges(question, cells.read())
    if not found:
        return
    size, columns = jump_chunk(len(found)), jumps.columns(question)

    def build(new: Any) -> None:
        make_columns(new, columns, (("jump",), (len(found),), (size,)), of_jumps(question))
        names = ", ".join(axis.name for axis in question.axes)
        new.attrs.update({"title": "Where the map jumps", "axes": names, COMPLETE: True})

    located = Kept(make_subgroup(out, group, JUMPS, build), columns, lambda k: jump_region(k, len(found)))
    compute_jumps(question, found, located, workers, tell, halvings)


def _build(group: Any, question: Question, identity: dict[str, Any]) -> None:
    """Arrays and coordinates of a map, none of its cells; the question last."""
    for name, one in coordinates(question).items():
        make_coordinate(group, name, one)
    make_columns(group, COLUMNS, (question.dims, question.shape, question.chunk_shape), of_columns(question))
    group.attrs.update({**attributes(question), COMPLETE: False, QUESTION: identity})
    consolidate(group)
