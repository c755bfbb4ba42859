"""The command for stores of maps: what it writes, wrong use, and a cluster that loses a worker."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
import xarray as xr
from click.testing import CliRunner
from maps import POSIX, data

import rodwell
from rodwell.cli.main import cli
from rodwell.errors import InputError


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
