"""The folder for compiled kernels that NUMBA_CACHE_DIR names."""

from __future__ import annotations

from pathlib import Path

import numba
import pytest

from rodwell.compiling import cache
from rodwell.compiling.kernels import kernel
from rodwell.errors import CacheWarning


def tripled(x):
    return 3.0 * x


def halved(x):
    return 0.5 * x


@pytest.fixture(autouse=True)
def _not_told_yet(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "_told", set())


def test_a_named_folder_that_cannot_be_used_is_told_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numba.config, "CACHE_DIR", "/dev/null/kernels")
    with pytest.warns(CacheWarning, match="NUMBA_CACHE_DIR names /dev/null/kernels, where no folder can be") as told:
        compiled, _again = kernel(tripled), kernel(halved)
    assert len(told) == 1
    assert compiled(2.0) == 6.0


def test_a_named_folder_that_can_be_used_is_not_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, recwarn: pytest.WarningsRecorder
) -> None:
    folder = tmp_path / "kernels"
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(folder))
    kernel(tripled)
    assert folder.is_dir()
    assert not recwarn.list
