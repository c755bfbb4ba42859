"""Shared fixtures, and removal of compiled kernels that are older than any kernel source."""

from __future__ import annotations

import os
from pathlib import Path

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")  # threads that wait for each other slow small systems; before NumPy loads

import pytest  # noqa: E402
from hypothesis import settings  # noqa: E402

import rodwell  # noqa: E402

settings.register_profile("rodwell", deadline=None, derandomize=True)  # tests do not time
settings.load_profile("rodwell")

SOURCE = Path(rodwell.__file__).parent


def _drop_stale_kernels() -> None:
    """Numba notices a change of a function's own file only, not of the compiled functions that it calls."""
    compiled = list(SOURCE.rglob("*.nbi")) + list(SOURCE.rglob("*.nbc"))
    newest = max(file.stat().st_mtime for file in SOURCE.rglob("*.py"))
    if compiled and min(file.stat().st_mtime for file in compiled) < newest:
        for file in compiled:
            file.unlink()


_drop_stale_kernels()


@pytest.fixture(scope="session")
def fig3c() -> dict[int, rodwell.Branch]:
    """The first two branches of the paper's Fig. 3(c), w = 15, to F = −400."""
    problem = rodwell.Problem(15.0)
    return {mode: rodwell.follow(problem, mode, until=-400.0) for mode in (1, 2)}
