"""How numbers are written by the commands that take a problem: signs, exponents, thousands, as everywhere else."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner
from rich.cells import cell_len
from written import violations

from rodwell.cli.main import cli

LINES = (
    "critical --weight 15 --alpha 60 --modes 2",
    "critical --weight 0 --alpha 0 --twist 5 --modes 1",
    "critical --weight 15 --alpha 60 --build 0.1 --modes 1",
    "critical --weight 15 --alpha 90 --sections 0.6:1:1,0.4:0.3:0.5 --modes 1",
    "liftoff --weight 15 --alpha 60",
    "twist --weight 15 --alpha 90",
    "sensitivity --weight 15 --alpha 90",
    "certify --weight 15 --alpha 90 --modes 2",
    "certify --weight 15000 --alpha 90 --modes 1 --clearance 1e-4",
    "modes --weight 15 --table 3",
    "diagram --weight 15 --alpha 90 --until -124 --modes 1 --out drawn",
    "curve critical --alpha 90 --over weight --from 1 --to 3 --out drawn",
)


@pytest.mark.parametrize("line", LINES)
def test_numbers_are_written_as_everywhere(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(cli, line.split(), env={"COLUMNS": "60"}, catch_exceptions=False)
    assert done.exit_code == 0
    assert violations(done.output.splitlines()) == []
    prose = [text for text in done.output.splitlines() if not text.startswith(" ")]
    assert max(cell_len(text) for text in prose) <= 60
