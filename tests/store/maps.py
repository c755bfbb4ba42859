"""A map that is made in a moment, for tests of stores: its problem, its grid, and its chunks byte by byte."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

import rodwell

FLAT = rodwell.Problem(15.0, 90.0)
OVER = {"weight": "10..80 in 8", "alpha": "80..90 in 4"}
POSIX = pytest.mark.skipif(os.name == "nt", reason="locks and signals of POSIX")


def made(out: Path | str, **more: Any) -> Any:
    return rodwell.map(FLAT, "critical", over=OVER, out=out, **more)


def data(store: Path) -> dict[str, bytes]:
    """Every chunk of a store, byte by byte."""
    files = [file for file in store.rglob("*") if file.is_file() and "/c/" in file.as_posix()]
    return {file.relative_to(store).as_posix(): file.read_bytes() for file in files}
