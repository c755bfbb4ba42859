"""The files of a results folder, and which tests need POSIX."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

POSIX = pytest.mark.skipif(os.name == "nt", reason="locks and kills of POSIX")


def texts(folder: Path) -> dict[str, str]:
    return {
        str(file.relative_to(folder)): file.read_text(encoding="utf-8") for file in folder.rglob("*") if file.is_file()
    }
