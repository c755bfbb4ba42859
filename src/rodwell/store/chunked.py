"""Maps as Zarr stores: chunk by chunk whole or absent, whenever the program that writes is killed.

A store is a Zarr group that ``xarray.open_zarr`` opens: coordinates, and an array for each column of a map. The column
``outcome`` of a chunk is written after the others, so a chunk is there when its outcome is; each file appears by one
rename, or one request of an object store, and bears a checksum. The group appears whole, with the question it answers.
"""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np

from rodwell.errors import InputError, printable
from rodwell.quantities.table import Variable
from rodwell.store.folder import appearing
from rodwell.studies.maps.block import Block
from rodwell.studies.maps.question import FILES
from rodwell.studies.maps.workers import needs_extra

if sys.platform != "win32":
    import fcntl

QUESTION, COMPLETE = "question", "complete"
"""Attributes of a store: what it answers, and whether every cell was computed."""

LAST = "outcome"
"""The column that is written last."""

MOST_IN_CHUNK = 1_000_000
"""Values of a coordinate in one chunk."""

LEVEL = 3
"""Of compression; more gains little."""


class Kept:
    """Columns that are kept in chunks: the cells of a map, or its jumps."""

    def __init__(self, group: Any, columns: Mapping[str, Any], region: Callable[[Any], tuple[slice, ...]]) -> None:
        self.group, self.columns, self.region = group, columns, region

    def missing(self, chunks: Iterator[Any]) -> list[Any]:
        """Those of the ``chunks`` that are not there, or damaged: an unreadable chunk counts as never written."""
        return [chunk for chunk in chunks if not self._whole(self.region(chunk))]

    def _whole(self, region: tuple[slice, ...]) -> bool:
        try:
            if not np.all(self.group[LAST][region]):
                return False
            for name in self.columns:
                self.group[name][region]
        except Exception:  # zarr and its codecs raise many kinds for what is no chunk
            return False
        return True

    def keep(self, chunk: Any, block: Block) -> None:
        """Write a chunk; ``outcome`` comes last."""
        region = self.region(chunk)
        shape = tuple(part.stop - part.start for part in region)
        for name in (*(name for name in self.columns if name != LAST), LAST):
            self.group[name][region] = block[name].reshape(shape)

    def read(self) -> Block:
        """All columns; what was not computed has outcome 0."""
        return {name: np.asarray(self.group[name][...]) for name in self.columns}


def local(out: str | Path) -> Path | None:
    """The path of a store on this machine's disks; None for that of an object store, "s3://bucket/name"."""
    return None if "://" in str(out) else Path(out)


@contextmanager
def opened(
    out: str | Path, question: Mapping[str, Any], build: Callable[[Any], None], field: str = "out"
) -> Iterator[Any]:
    """Yield the Zarr group of a store that answers ``question``: the one that is there, or a new one.

    ``build`` makes arrays and attributes in an empty group.

    Raises
    ------
    InputError
        If something else is there, a store of another question, or another run writes to it.
    """
    needs_extra(field, str(out), "zarr")
    import zarr  # noqa: PLC0415 - slow to import, and an extra

    path = local(out)
    try:
        if path is None:
            yield _distant(str(out), question, build, field)
            return
        if path.is_file() or (path.is_dir() and any(path.iterdir()) and not (path / "zarr.json").is_file()):
            raise _no_map(path, field)
        made = not path.exists() or (path.is_dir() and not any(path.iterdir()))
        if made:
            with appearing(path, field) as new:
                build(zarr.create_group(new))
        with _owned(path, field):
            if not made:
                _tidy(path)
            yield _checked(zarr.open_group(path, mode="r+", use_consolidated=False), path, question, field)
    except OSError as error:
        what = f"cannot be written ({error.strerror or error}); make room, or name another place"
        raise InputError(field, str(out), what) from None


def _distant(out: str, question: Mapping[str, Any], build: Callable[[Any], None], field: str) -> Any:
    """The group in an object store; one whose making was broken off is made anew, since its question comes last."""
    import zarr  # noqa: PLC0415

    try:
        group = zarr.open_group(out, mode="a", use_consolidated=False)
        if QUESTION not in group.attrs:
            build(zarr.create_group(out, overwrite=True))
    except (ImportError, ValueError) as error:
        raise InputError(field, out, f"cannot be opened: {error}") from None
    return _checked(zarr.open_group(out, mode="r+", use_consolidated=False), out, question, field)


def _no_map(out: str | Path, field: str) -> InputError:
    return InputError(field, str(out), "is no map of rodwell; name another place")


def _checked(group: Any, out: str | Path, question: Mapping[str, Any], field: str) -> Any:
    there = group.attrs.get(QUESTION)
    if not isinstance(there, Mapping):
        raise _no_map(out, field)
    differs = [key for key in question if there.get(key) != question[key]]
    if differs == [FILES]:
        known: Mapping[str, str] = there.get(FILES) or {}
        changed = ", ".join(printable(name) for name, digest in question[FILES].items() if known.get(name) != digest)
        raise InputError(
            field, str(out),
            f"holds a map of another question: since it was begun, {changed} changed, a file that its case names; "
            "name another place, or put the file back as it was",
        )  # fmt: skip
    if differs:
        key = "over" if "over" in differs else differs[0]
        raise InputError(
            field, str(out),
            f"holds a map of another question: its {key} is {there.get(key)!r}, here it is {question[key]!r}; "
            "name another place, or ask the same question to go on with it",
        )  # fmt: skip
    return group


@contextmanager
def _owned(path: Path, field: str) -> Iterator[None]:
    """Hold the store of a folder for this run; the operating system lets go when the run ends in whatever way."""
    if sys.platform == "win32":
        yield
        return
    stays = path / LAST  # not the store itself, which is locked for the moment in which the jumps' group appears
    folder = os.open(stays if stays.is_dir() else path, os.O_RDONLY)
    try:
        try:
            fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(field, str(path), "is being written by another run; wait for it, or end it") from None
        except OSError:  # a file system without locks: chunks of two runs are the same, and each appears whole
            pass
        yield
    finally:
        os.close(folder)


def _tidy(path: Path) -> None:
    """Remove what a killed run left half written: names that Zarr gives files before their rename."""
    for part in path.rglob("*.partial"):
        with suppress(OSError):
            part.unlink()


def consolidate(group: Any) -> None:
    """Put the descriptions of all arrays into one file, where xarray looks for them."""
    import zarr  # noqa: PLC0415

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that other readers may not know of them: these read the arrays' own
        zarr.consolidate_metadata(group.store)


def make_columns(
    group: Any,
    columns: Mapping[str, Any],
    grid: tuple[Sequence[str], Sequence[int], Sequence[int]],
    attributes: Mapping[str, Mapping[str, Any]],
) -> None:
    """Make an array for each column, filled with what stands where nothing was computed.

    ``grid`` is the names of the dimensions, the shape of the array and that of its chunks.
    """
    from zarr.codecs import Crc32cCodec, ZstdCodec  # noqa: PLC0415

    dims, shape, chunks = grid
    for name, (kind, fill, _) in columns.items():
        group.create_array(
            name, shape=tuple(shape), chunks=tuple(chunks), dtype=kind, fill_value=fill, dimension_names=tuple(dims),
            compressors=[ZstdCodec(level=LEVEL), Crc32cCodec()], attributes=dict(attributes[name]),
        )  # fmt: skip


def make_coordinate(group: Any, name: str, values: Variable) -> None:
    """Make a coordinate, written as it is."""
    array = np.asarray(values.values)
    kind: Any = array.dtype
    if array.dtype.kind in "OU":
        kind, array = "string", array.astype(object)
    made = group.create_array(
        name, shape=array.shape, chunks=(max(1, min(len(array), MOST_IN_CHUNK)),), dtype=kind,
        dimension_names=values.dims, attributes=values.attrs,
    )  # fmt: skip
    made[...] = array


def make_subgroup(out: str | Path, group: Any, name: str, build: Callable[[Any], None], field: str = "out") -> Any:
    """The group ``name`` in a store: the one that is there, or a new one that appears whole."""
    import zarr  # noqa: PLC0415

    path = local(out)
    if path is None:
        if name not in group or COMPLETE not in group[name].attrs:
            build(group.create_group(name, overwrite=True))
    elif not (path / name).exists():
        with appearing(path / name, field, home=path.parent) as new:
            build(zarr.create_group(new))
    return zarr.open_group(group.store, path=name, mode="r+", use_consolidated=False)
