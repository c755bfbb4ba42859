"""How often processes of rodwell look for cycles among objects."""

from __future__ import annotations

import gc
import signal
import sys
import threading
from typing import Any

import pytest

from rodwell.cli.main import main
from rodwell.compiling.garbage import COLLECT_AFTER
from rodwell.web import worker


class Closed:
    """A pipe of which nobody reads."""

    def send(self, _: object) -> None:
        raise BrokenPipeError


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, ...]]:
    """What Python is asked for, which these tests leave alone."""
    asked: list[tuple[int, ...]] = []
    monkeypatch.setattr(gc, "set_threshold", lambda *numbers: asked.append(numbers))
    return asked


def test_a_command_looks_seldom(asked: list[tuple[int, ...]], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["rodwell", "--version"])
    main()
    assert asked == [(COLLECT_AFTER, 10, 10)]


def test_the_process_of_the_explorer_looks_as_seldom(
    asked: list[tuple[int, ...]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    monkeypatch.setattr(threading.Thread, "start", lambda _: None)
    pipe: Any = Closed()
    with pytest.raises(BrokenPipeError):
        worker.work(pipe, None, (None, ".", ""))
    assert asked == [(COLLECT_AFTER, 10, 10)]
