"""Stores of maps: whole or absent chunk by chunk, resumed, refused, self-describing."""

from __future__ import annotations

import itertools
import json
import math
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from maps import FLAT, OVER, POSIX, data, made

import rodwell
from rodwell.errors import InputError
from rodwell.store import chunked
from rodwell.store.staging import PREFIX
from rodwell.studies.maps import block, computing, question


def test_a_store_is_what_xarray_opens_and_says_what_it_holds(whole: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = xr.open_zarr(whole)
        where = xr.open_zarr(whole, group="jumps")
    assert found.value.dims == ("weight", "alpha")
    assert found.attrs["complete"] is True
    assert found.attrs["question"]["quantity"] == "critical"
    assert "tension positive" in found.attrs["convention"]
    assert "both ends clamped" in found.attrs["convention"]
    assert found.value.attrs["units"] == "B/L^2"
    assert found.outcome.attrs["flag_meanings"].split()[1] == "converged"
    load = rodwell.critical_loads(rodwell.Problem(20.0, 90.0), 1)[0]
    assert float(found.value.sel(weight=20.0, alpha=90.0)) == load.force
    assert float(found.error.sel(weight=20.0, alpha=90.0)) == load.error
    assert [file.name for file in whole.parent.iterdir()] == [whole.name], PREFIX
    at = where.load().where((where.outcome == 2) & (where.at_alpha == 90.0), drop=True)
    assert any(low <= 62.34181826 <= high for low, high in zip(at.low.values, at.high.values, strict=True))
    memory = rodwell.map(FLAT, "critical", over=OVER).dataset
    assert np.array_equal(memory.value.values, found.value.values)
    assert memory.value.attrs == {k: v for k, v in found.value.attrs.items() if k != "_FillValue"}


def test_broken_off_at_every_chunk_it_goes_on_and_ends_as_if_undisturbed(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, counted = tmp_path / "map.zarr", []
    keep = chunked.Kept.keep

    def interrupted(self: Any, chunk: Any, columns: Any) -> None:
        counted.append(chunk)
        if len(counted) % 2 == 0:
            raise KeyboardInterrupt
        keep(self, chunk, columns)

    monkeypatch.setattr(chunked.Kept, "keep", interrupted)
    for _ in range(20):
        try:
            made(out)
            break
        except KeyboardInterrupt:
            assert xr.open_zarr(out).attrs["complete"] is False
    assert data(out) == data(whole)
    done = len(counted)
    made(out)
    assert len(counted) == done, "a finished map is computed again"


class Breaking:
    """A group whose arrays are written to a number of times only."""

    def __init__(self, group: Any, left: list[int], name: str = "") -> None:
        self.group, self.left, self.name = group, left, name

    def __getitem__(self, key: Any) -> Any:
        return self.group[key] if self.name else Breaking(self.group[key], self.left, key)

    def __setitem__(self, region: Any, values: Any) -> None:
        if self.left[0] == 0:
            raise KeyboardInterrupt
        self.left[0] -= 1
        self.group[region] = values


def test_broken_off_within_a_chunk_what_counts_as_there_is_whole(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At any time, a cell with an outcome has the value that an undisturbed map has."""
    out, right = tmp_path / "map.zarr", xr.open_zarr(whole).load()
    init = chunked.Kept.__init__
    for count in (1, 5, 6, 9, 11, 13):
        left = [count]
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(
                chunked.Kept, "__init__", lambda self, group, *more, left=left: init(self, Breaking(group, left), *more)
            )
            with pytest.raises(KeyboardInterrupt):
                made(out)
        found = xr.open_zarr(out).load()
        there = found.outcome.values > 0
        for name in ("value", "error", "wavenumber"):
            assert np.array_equal(found[name].values[there], right[name].values[there])
    assert there.sum() > 0
    made(out)
    assert data(out) == data(whole)


@pytest.mark.parametrize("column", list(block.COLUMNS))
def test_a_chunk_without_one_of_its_columns_or_damaged_is_computed_again(
    whole: Path, tmp_path: Path, column: str
) -> None:
    out = tmp_path / "map.zarr"
    made(out, halvings=0)
    chunks = sorted((out / column / "c").rglob("*"))
    files = [file for file in chunks if file.is_file()]
    if not files:  # all fill: nothing is written
        return
    group = json.loads((out / "zarr.json").read_text())
    group["attributes"]["complete"] = False
    (out / "zarr.json").write_text(json.dumps(group))
    before = data(out)
    damaged = bytearray(files[0].read_bytes())
    damaged[len(damaged) // 2] ^= 0x10
    files[0].write_bytes(damaged)
    if column == "outcome":
        files[-1].write_bytes(b"")
        files[1].unlink()
    (files[0].parent / "0.abcdef.partial").write_bytes(b"killed")
    made(out, halvings=0)
    assert data(out) == before


def test_a_store_of_another_question_and_other_folders_are_refused(whole: Path, tmp_path: Path) -> None:
    before = data(whole)
    for over, more in ((OVER | {"alpha": "80..90 in 5"}, {}), (OVER, {"rtol": 1e-9}), (OVER, {"halvings": 2})):
        with pytest.raises(InputError, match="map of another question"):
            rodwell.map(FLAT, "critical", over=over, out=whole, **more)
    assert data(whole) == before
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match="is no map of rodwell"):
        made(mine)
    assert [file.name for file in mine.iterdir()] == ["notes.txt"]
    file = tmp_path / "file"
    file.write_text("mine")
    with pytest.raises(InputError, match="is no map of rodwell"):
        made(file)
    assert file.read_text() == "mine"


def test_a_store_is_refused_when_a_file_of_its_case_has_changed(tmp_path: Path) -> None:
    out, survey, other = tmp_path / "map.zarr", tmp_path / "survey.csv", tmp_path / "other.csv"
    stations = "MD [m],Inc [deg],Azi [deg]\n0,30,0\n30,33,0\n60,36,0\n"
    survey.write_text(stations, encoding="utf-8")
    other.write_text(stations.replace("36", "37"), encoding="utf-8")
    (tmp_path / "case.toml").write_text(
        """analysis.rtol = 1e-6
        rod = {outer_diameter = "5 in", inner_diameter = "3 in", material = "steel", length = "30 m"}
        hole = {diameter = "8.5 in", survey = "survey.csv", from = "15 m"}
        """,
        encoding="utf-8",
    )

    def asked(**over: Any) -> Any:
        over = {"hole.diameter": "8.5 in, 9 in"} | over
        return rodwell.map(tmp_path / "case.toml", "critical", over=over, out=out, halvings=0)

    first = asked()
    assert first.as_dict()["parameters"]["hole.diameter"]["unit"] == "in"
    assert first.question.rods.rtol == 1e-6
    assert np.array_equal(asked().values, first.values)
    survey.write_text(stations.replace("33", "43"), encoding="utf-8")
    with pytest.raises(InputError, match=r"since it was begun, survey\.csv changed"):
        asked()
    survey.write_text(stations, encoding="utf-8")
    assert np.array_equal(asked().values, first.values)
    varied = {"rod.length": "28..30 m in 2", "hole.survey": ["survey.csv", "other.csv"]}
    identity = question.asked(tmp_path / "case.toml", "critical", varied).identity
    assert sorted(identity["files"]) == [other.name, survey.name]


@POSIX
def test_two_runs_into_one_store_at_a_time(tmp_path: Path) -> None:
    out = tmp_path / "map.zarr"
    said = []

    def second(what: str, _done: float) -> None:
        if not said:
            said.append(what)
            with pytest.raises(InputError, match="is being written by another run"):
                made(out)

    made(out, progress=second)
    assert said
    assert made(out).complete


def test_object_stores(whole: Path) -> None:
    found = made("memory://maps/one.zarr")
    assert found.complete
    assert np.array_equal(found.values, xr.open_zarr(whole).value.values)
    assert made("memory://maps/one.zarr").complete
    with pytest.raises(InputError, match="another question"):
        rodwell.map(FLAT, "lift-off", over=OVER, out="memory://maps/one.zarr")
    with pytest.raises(InputError, match="cannot be opened"):
        made("nosuch://maps/one.zarr")


def test_without_the_extra_the_message_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rodwell.studies.maps.workers.find_spec", lambda _: None)
    for more in ({}, {"scheduler": "tcp://nowhere:1"}):
        with pytest.raises(InputError, match=r"pip install 'rodwell\[map\]'"):
            made(tmp_path / "map.zarr", **more) if not more else rodwell.map(FLAT, "critical", over=OVER, **more)
    assert rodwell.map(FLAT, "critical", over={"weight": [1.0, 2.0]}).complete, "needs the extra in memory"


@POSIX
def test_full_disk_and_read_only_folders_are_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = tmp_path / "map.zarr"
    keep = chunked.Kept.keep

    def full(self: Any, chunk: Any, columns: Any) -> None:
        if chunk != (0, 0):
            raise OSError(28, "No space left on device")
        keep(self, chunk, columns)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(chunked.Kept, "keep", full)
        with pytest.raises(InputError, match="No space left on device"):
            made(out)
    assert made(out).complete
    with pytest.raises(InputError, match="cannot be written"):
        made(Path("/proc/map.zarr"))


def test_edges_of_jumps_are_found_alike_whatever_their_order() -> None:
    assert [computing.jump_chunk(n) for n in (0, 10, 640, 10**6)] == [4, 4, 10, 512]
    assert list(itertools.islice(block.COLUMNS, 5, None)) == ["outcome"], "the column that makes a chunk count is last"
    assert math.isnan(block.COLUMNS["value"][1])
