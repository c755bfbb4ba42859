"""The server on this machine: a port, a token, and its end."""

from __future__ import annotations

import contextlib
import secrets
import signal
import socket
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import TYPE_CHECKING

from rodwell.errors import InputError
from rodwell.web.worker import Start

if TYPE_CHECKING:
    from uvicorn import Server

ADDRESS = "127.0.0.1"
"""This machine only."""


def serve(start: Start, port: int, opened: Callable[[str], None]) -> None:
    """Serve the explorer until Ctrl-C.

    Parameters
    ----------
    start
        The case.
    port
        Port to listen on; 0: any that is free.
    opened
        Called with the address of the page once it can be opened.

    Raises
    ------
    InputError
        If the case cannot be used, the port is taken, or the extra ``rodwell[explore]`` is not installed.
    """
    from rodwell.web.desks import Desks  # noqa: PLC0415 - after the extra was asked for

    listening = _listening(port)
    desk = Desks(start)  # its process begins while this one imports
    try:
        import uvicorn  # noqa: PLC0415

        from rodwell.web.app import app  # noqa: PLC0415

        number = int(listening.getsockname()[1])
        token = secrets.token_urlsafe(18)
        config = uvicorn.Config(
            app(desk, token, lambda: number), log_level="error", access_log=False, server_header=False,
            ws="websockets-sansio", ws_max_size=100_000, ws_per_message_deflate=False,  # it never leaves the machine
            lifespan="on", timeout_graceful_shutdown=1,
        )  # fmt: skip
        desk.ready()
        opened(f"http://{ADDRESS}:{number}/{token}/")
        server = uvicorn.Server(config)
        with _hung_up(server):
            server.run(sockets=[listening])
    finally:
        desk.stop()
        listening.close()


def check_installed() -> None:
    """Raise if the extra is not installed."""
    for name in ("starlette", "uvicorn", "websockets"):
        if find_spec(name) is None:  # importing them waits until the engine's process has begun
            what = f"needs {name}, which is not installed: pip install 'rodwell[explore]'"
            raise InputError("rodwell explore", None, what)


@contextlib.contextmanager
def _hung_up(server: Server) -> Iterator[None]:
    """A terminal that is closed ends the server as Ctrl-C does: what it breaks off otherwise is told as errors."""
    hang_up = getattr(signal, "SIGHUP", None)  # Windows has none
    if hang_up is None or signal.getsignal(hang_up) == signal.SIG_IGN:
        yield
        return
    heard = False

    def hear(*_: object) -> None:
        nonlocal heard
        heard = server.should_exit = True

    before = signal.signal(hang_up, hear)
    try:
        yield
    finally:
        signal.signal(hang_up, before)
    if heard:
        signal.raise_signal(hang_up)  # the command ends by it


def _listening(port: int) -> socket.socket:
    out = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        out.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        out.bind((ADDRESS, port))
        out.listen(64)
    except OSError as error:
        out.close()
        raise InputError(
            "--port", port, f"cannot be used ({error.strerror}): leave it out to take a free one"
        ) from None
    return out
