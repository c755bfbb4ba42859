"""The dashboard of the workers of a map: its address is told, and there is a page behind it while they compute."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from urllib.request import urlopen

import pytest
from click.testing import CliRunner

from rodwell.cli import mapping
from rodwell.cli.main import cli
from rodwell.studies.maps.workers import Workers

ASKED = ["map", "--quantity", "critical", "--weight", "10..80 in 8", "--alpha", "90"]


def test_the_address_of_the_dashboard_is_told_and_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pages = {}

    def looked(silent: bool) -> Callable[[Workers], None]:
        def started(workers: Workers) -> None:
            said(workers)
            with urlopen(workers.dashboard, timeout=60) as answer:
                pages[workers.dashboard] = answer.status, answer.read().decode()

        said = telling(silent)
        return started

    telling = mapping.telling
    monkeypatch.setattr(mapping, "telling", looked)
    done = CliRunner().invoke(cli, [*ASKED, "--workers", "2", "--out", str(tmp_path / "map.zarr")])
    assert done.exit_code == 0, done.output
    told = re.search(r"Dashboard of the 2 workers: (\S+)", done.stderr)
    assert told is not None, done.stderr
    status, page = pages[told[1]]
    assert status == 200
    assert "<title>Dask" in page


def test_one_worker_has_no_dashboard(tmp_path: Path) -> None:
    done = CliRunner().invoke(cli, [*ASKED, "--workers", "1", "--out", str(tmp_path / "map.zarr")])
    assert done.exit_code == 0, done.output
    assert "Dashboard" not in done.output
