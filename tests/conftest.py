"""Shared fixtures."""

from __future__ import annotations

import gc
import os

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")  # threads that wait for each other slow small systems; before NumPy loads

import pytest  # noqa: E402
from hypothesis import settings  # noqa: E402

import rodwell  # noqa: E402

settings.register_profile("rodwell", deadline=None, derandomize=True)  # tests do not time
settings.load_profile("rodwell")

gc.disable()  # while tests are collected, which leaves little behind: a quarter of that time went into looking for it


def pytest_collection_finish() -> None:
    """From here on garbage is collected, and what is there by now is not looked through again and again."""
    gc.freeze()
    gc.enable()


@pytest.fixture
def nothing_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """The folder of a case has one picture, of a byte, for tests of other things: drawing is most of a short run."""
    for half in ("draw_branches", "draw_rod"):
        monkeypatch.setattr(f"rodwell.report.folders.pictures.{half}", lambda *_: {"bifurcation": {"png": b"0"}})


@pytest.fixture(scope="session")
def fig3c() -> dict[int, rodwell.Branch]:
    """The first two branches of the paper's Fig. 3(c), w = 15, to F = −400."""
    problem = rodwell.Problem(15.0)
    return {mode: rodwell.follow(problem, mode, until=-400.0) for mode in (1, 2)}
