"""The process in which the engine runs: it takes one request after the other, and ends when its parent does."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING, Any

from rodwell.compiling.garbage import collect_seldom
from rodwell.errors import RodwellError
from rodwell.quantities.as_json import as_json

if TYPE_CHECKING:
    from rodwell.web.engine import Engine

Start = tuple[dict[str, Any] | None, str, str]
"""Content of the case file or None, the folder of its files, its name for messages."""


def work(pipe: Connection, cancelled: Any, start: Start) -> None:
    """Answer requests from a pipe until it closes.

    A request is a pair (number, dictionary). An answer is (number, last, text), text being JSON; the first, with number
    0, says what is explored, or why it cannot be; the second, with the same, that there is an engine to compute.

    Parameters
    ----------
    pipe
        To the server.
    cancelled
        Shared whole number: the request of that number is no longer wanted.
    start
        The case.
    """
    collect_seldom()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to the whole group: the server ends this process
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    from rodwell.web.given import Given  # noqa: PLC0415 - the watch above comes first

    try:
        given = Given(*start)
    except RodwellError as error:
        pipe.send((0, True, as_json({"kind": "failed", "message": str(error)})))
        return
    pipe.send((0, True, as_json(given.hello(), compact=True)))
    from rodwell.web.engine import Cancelled, Engine  # noqa: PLC0415 - slow: the page is loaded meanwhile
    from rodwell.web.memory import give_back  # noqa: PLC0415 - with the engine

    engine = Engine(given)
    pipe.send((0, True, ""))
    asked = _first(engine, pipe, cancelled)
    while True:
        try:
            number, request = asked.pop() if asked else pipe.recv()
        except (EOFError, OSError):
            return

        def send(message: dict[str, Any], number: int = number, request: dict[str, Any] = request) -> None:
            text = as_json({"id": request.get("id"), **message}, compact=True)
            pipe.send((number, bool(message.get("last")), text))

        def check(number: int = number) -> None:
            if cancelled.value >= number:
                raise Cancelled

        try:
            check()
            engine.answer(request, send, check)
        except Cancelled:
            send({"kind": "cancelled", "last": True})
        except RodwellError as error:
            send({"kind": "failed", "of": request.get("kind"), "message": str(error), "last": True})
        except (ArithmeticError, AssertionError, KeyError, LookupError, TypeError, ValueError) as error:
            cause = error.__cause__ or error
            what = f"{type(cause).__name__}: {cause}"
            send({"kind": "failed", "of": request.get("kind"), "message": f"not computed: {what}", "last": True})
        if request.get("kind") == "diagram":
            give_back()


def _first(engine: Engine, pipe: Connection, cancelled: Any) -> list[tuple[int, dict[str, Any]]]:
    """Compute what the page asks for first; return what it has asked for meanwhile.

    Where that is what is being computed, it is told what there is already.
    """
    from rodwell.web.engine import Cancelled, as_given  # noqa: PLC0415 - with the engine

    asked: list[tuple[int, dict[str, Any]]] = []

    def look() -> None:
        if not asked and pipe.poll():
            asked.append(pipe.recv())

    def tell(message: dict[str, Any]) -> None:
        look()
        for number, request in asked:
            if cancelled.value >= number:
                raise Cancelled
            if as_given(request):
                pipe.send((number, False, as_json({"id": request.get("id"), **message}, compact=True)))

    with contextlib.suppress(RodwellError, Cancelled, EOFError, OSError):  # what fails is told when it is asked for
        look()
        if not asked or as_given(asked[0][1]):
            engine.explored({}, lambda: None, tell)
    return asked


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
