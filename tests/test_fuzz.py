"""A sample of ``benchmarks/fuzz.py``: texts that nobody foresaw are read, or refused with an InputError."""

from __future__ import annotations

from typing import Any

import pytest
from programs import ROOT, loaded


def _fuzz() -> Any:
    return loaded(ROOT / "benchmarks" / "fuzz.py")


FUZZ = _fuzz()


@pytest.mark.parametrize("target", list(FUZZ.TARGETS))
def test_texts_that_nobody_foresaw(target: str) -> None:
    found = FUZZ.fuzzed(target, 60, 11)
    assert not found["fault"]
    assert found["read"] + found["refused"] > 0


def test_what_is_neither_read_nor_refused_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(FUZZ.TARGETS, "axes", (lambda text: 1 / (len(str(text)) - 3), FUZZ.TEXTS))
    assert "ZeroDivisionError" in FUZZ.fuzzed("axes", 400, 1)["fault"]
