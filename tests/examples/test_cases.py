"""Case files that are shipped: each meets its tolerance."""

from __future__ import annotations

from pathlib import Path

import pytest

import rodwell
from rodwell.studies.sweep.study import is_study

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
CASES = sorted(
    path for path in EXAMPLES.glob("*.toml") if not is_study(path) and "[packer]" not in path.read_text("utf-8")
)


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_every_number_of_an_example_meets_its_tolerance(path: Path) -> None:
    found = rodwell.answer(rodwell.Case.read(path))
    missed = [f.name for f in found.key_numbers.values() if f.error > found.case.rtol * f.scale]
    assert not missed
    assert found.converged
