"""Stores of maps: whole or absent chunk by chunk, resumed, refused, self-describing; and the command for them."""

from __future__ import annotations

import itertools
import json
import math
import os
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from click.testing import CliRunner

import rodwell
from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.store import chunked
from rodwell.store.staging import PREFIX
from rodwell.studies.maps import block, computing, question

FLAT = rodwell.Problem(15.0, 90.0)
OVER = {"weight": "10..80 in 8", "alpha": "80..90 in 4"}
POSIX = pytest.mark.skipif(os.name == "nt", reason="locks and signals of POSIX")


def made(out: Path | str, **more: Any) -> Any:
    return rodwell.map(FLAT, "critical", over=OVER, out=out, **more)


def data(store: Path) -> dict[str, bytes]:
    """Every chunk of a store, byte by byte."""
    files = [file for file in store.rglob("*") if file.is_file() and "/c/" in file.as_posix()]
    return {file.relative_to(store).as_posix(): file.read_bytes() for file in files}


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("whole") / "map.zarr"
    made(out)
    return out


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


def run(*arguments: str) -> Any:
    return CliRunner().invoke(cli, ["map", *arguments])


def test_the_command(tmp_path: Path, whole: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    asked = ("--quantity", "critical", "--weight", "10..80 in 8", "--alpha", "80..90 in 4", "--out", "map.zarr")
    done = run(*asked)
    assert done.exit_code == 0, done.output
    assert "all cells: known to the tolerance" in done.output
    assert "32 cells (8 weight × 4 alpha)" in " ".join(done.output.split())
    assert data(tmp_path / "map.zarr") == data(whole)
    again = run(*asked, "--json")
    found = json.loads(again.stdout)
    assert found["outcomes"] == {"converged": {"cells": 32, "meaning": "known to the tolerance"}}
    assert found["least"]["at"] == {"weight": 80.0, "alpha": 90.0}
    assert found["parameters"]["alpha"] == {"meaning": "angle of the cylinder from the vertical", "unit": "degree"}
    assert (found["unit"], found["complete"], found["store"]) == ("B/L^2", True, "map.zarr")
    assert run(*asked, "--quiet", "--picture", "map.png").output == ""
    assert Path("map.png").read_bytes().startswith(b"\x89PNG")
    assert "must end in .png, .svg, .pdf" in str(run(*asked, "--picture", "map.bmp").exception)
    assert "cannot be written" in str(run(*asked, "--picture", "nowhere/map.png").exception)
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["map.png", "map.zarr"]


def test_the_command_with_a_case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = '[dimensionless]\nweight = "10..20 in 3"\nalpha = 90\nclearance = 0.01\n'
    Path("case.toml").write_text(text, encoding="utf-8")
    done = run("case.toml", "--quantity", "critical", "--vary", "dimensionless.alpha", "80, 90", "--out", "m.zarr")
    assert done.exit_code == 0, done.output
    found = xr.open_zarr("m.zarr").value
    assert float(found.sel({"dimensionless.weight": 10.0, "dimensionless.alpha": 90.0})) == pytest.approx(
        rodwell.critical_loads(rodwell.Problem(10.0, 90.0), 1)[0].force, rel=1e-12
    )


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (("--weight", "1, 2", "--alpha", "90", "--out", ""), "--out = '': is empty"),
        (("--weight", "1, 2", "--out", "x.zarr"), "Missing option '--alpha'"),
        (
            ("--weight", "1, 2", "--alpha", "90", "--vary", "a.b", "1, 2", "--out", "x.zarr"),
            "--vary = 'a.b': needs a case",
        ),
        (
            ("case.toml", "--vary", "dimensionless.alpha", "80, 90", "--rtol", "1e-9", "--out", "x.zarr"),
            "--rtol = 1e-09: belongs to a problem; a case has a key: set analysis.rtol",
        ),
        (("x.toml", "--weight", "1, 2", "--out", "x.zarr"), "--weight = '1, 2': belongs to a problem"),
        (
            ("--weight", "1, 2", "--alpha", "90", "--scheduler", "tcp://127.0.0.1:9", "--out", "x.zarr"),
            "--scheduler = 'tcp://127.0.0.1:9': does not answer",
        ),
        (("--weight", "1..2", "--alpha", "90", "--out", "x.zarr"), "--weight = '1..2': does not say how many values"),
        (("--weight", "1, 2", "--alpha", "90", "--out", "/proc/x.zarr"), "--out = '/proc/x.zarr': cannot be written"),
    ],
)
def test_wrong_use_of_the_command(
    arguments: tuple[str, ...], what: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("rodwell.studies.maps.workers.TIMEOUT", 0.5)
    Path("case.toml").write_text("[dimensionless]\nweight = 10\nalpha = 90\nclearance = 0.01\n", encoding="utf-8")
    done = run(*arguments)
    assert done.exit_code == 2 or isinstance(done.exception, InputError)
    assert what in done.output + str(done.exception)


@POSIX
def test_a_cluster_loses_a_worker_and_the_store_is_that_of_one_process(whole: Path, tmp_path: Path) -> None:
    """A worker is killed in the middle; SIGTERM then ends the client, and the same command goes on in one process."""
    out = tmp_path / "map.zarr"
    command = [sys.executable, "-m", "rodwell", "map", "--quantity", "critical", "--weight", "10..80 in 8", "--alpha",
               "80..90 in 4", "--out", str(out)]  # fmt: skip
    with subprocess.Popen([*command, "--workers", "2"], stderr=subprocess.PIPE, text=True) as client:
        killed = 0
        while client.poll() is None and not killed:
            time.sleep(0.05)
            for worker in _children(client.pid):
                if (out / "outcome" / "c").exists():
                    os.kill(worker, signal.SIGKILL)
                    killed += 1
                    break
        client.send_signal(signal.SIGTERM)
        said = client.communicate()[1]
    assert client.returncode in (143, 0), said
    assert "Traceback" not in said
    if client.returncode == 143:
        assert "what was done is kept" in said
    subprocess.run(command, check=True, capture_output=True)
    assert data(out) == data(whole)


def _children(pid: int) -> list[int]:
    """Processes below a process, its workers among them."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            stat = (entry / "stat").read_text() if entry.name.isdigit() else ""
            if stat and int(stat.rpartition(")")[2].split()[1]) == pid and "spawn" in (entry / "cmdline").read_text():
                found.append(int(entry.name))
        except OSError:
            continue
    return found


def test_edges_of_jumps_are_found_alike_whatever_their_order() -> None:
    assert [computing.jump_chunk(n) for n in (0, 10, 640, 10**6)] == [4, 4, 10, 512]
    assert list(itertools.islice(block.COLUMNS, 5, None)) == ["outcome"], "the column that makes a chunk count is last"
    assert math.isnan(block.COLUMNS["value"][1])
