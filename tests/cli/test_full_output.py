"""Standard output that cannot be written, as on a full disk: what is lost is said, where results are, and the code."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

FULL = Path("/dev/full")

pytestmark = pytest.mark.skipif(not FULL.exists(), reason="no device that is always full")

STRING = ("--weight", "15", "--alpha", "90", "--sections", "0.5:1,0.5:1:-1")
"""A string whose load needs no compiled kernels."""


def told(*arguments: str, buffered: bool) -> str:
    """What the command says on standard error with a full standard output; it ends with 1."""
    with FULL.open("w") as full:
        command = [sys.executable, *([] if buffered else ["-u"]), "-m", "rodwell", *arguments]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1
    return done.stderr


@pytest.mark.parametrize("buffered", [True, False])
def test_what_is_lost_is_said_once(buffered: bool) -> None:
    assert told("--version", buffered=buffered) == (
        "rodwell: error: standard output could not be written (No space left on device): what it was to say is lost; "
        "no files were written\n"
    )


def test_results_that_are_there_are_named(tmp_path: Path) -> None:
    out = tmp_path / "numbers"
    text = told("critical", *STRING, "--out", str(out), buffered=True)
    assert text.endswith(f"what it was to say is lost; results are in {out}\n")
    assert (out / "critical.json").exists()
