"""Fixtures of the tests of stores."""

from __future__ import annotations

from pathlib import Path

import pytest
from maps import made


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("whole") / "map.zarr"
    made(out)
    return out
