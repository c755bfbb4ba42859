"""The server's side of the page: files, one connection for requests, and who may use either."""

from __future__ import annotations

import asyncio
import contextlib
import json
import secrets
from collections.abc import AsyncIterator, Callable
from functools import cache
from importlib import resources
from typing import Any

from starlette.applications import Starlette
from starlette.requests import HTTPConnection, Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from rodwell.web.desk import Job
from rodwell.web.desks import Desks

LARGEST_REQUEST = 20_000
"""Characters of a request."""

TYPES = {"html": "text/html", "js": "text/javascript", "css": "text/css", "txt": "text/plain", "svg": "image/svg+xml"}

FROM_REPORT = ("three.min.js", "parts.js", "viewer.js", "viewer.css", "LICENSE-three.txt")
"""What the page shares with reports: three.js and the rod in its cylinder."""


def app(desk: Desks, token: str, port: Callable[[], int]) -> Starlette:
    """Return the application.

    Parameters
    ----------
    desk
        Takes the requests.
    token
        First part of every path: who does not know it gets nothing.
    port
        Returns the port that the server listens on.
    """

    async def page(request: Request) -> Response:
        name = request.path_params.get("name") or "index.html"
        content = asset(name)
        if content is None:
            return PlainTextResponse("not found", 404)
        kind = TYPES[name.rpartition(".")[2]]
        return Response(content, media_type=kind, headers={"Cache-Control": "no-store"})

    async def talk(socket: WebSocket) -> None:
        await socket.accept()
        await conversation(socket, desk)

    @contextlib.asynccontextmanager
    async def running(_app: Starlette) -> AsyncIterator[None]:
        task = asyncio.create_task(desk.run())
        yield
        task.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await task

    routes = [
        Route(f"/{token}/", page),
        WebSocketRoute(f"/{token}/talk", talk),
        Route(f"/{token}/{{name}}", page),
    ]
    inner = Starlette(routes=routes, lifespan=running)
    inner.add_middleware(Guard, token=token, port=port)
    return inner


async def conversation(socket: WebSocket, desk: Desks) -> None:
    """Requests of one page, and the answers to them."""
    client = id(socket)

    async def reply(text: str) -> None:
        with contextlib.suppress(RuntimeError, WebSocketDisconnect):  # it has gone
            await socket.send_text(text)

    await reply(desk.hello)
    try:
        while True:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                break
            request = _request(message.get("text") or "")  # a page sends no bytes
            if request is None:
                await reply(json.dumps({"kind": "failed", "message": "that is no request", "last": True}))
                continue
            replaced = desk.ask(Job(client, request, reply))
            if replaced is not None:
                await reply(json.dumps({"kind": "cancelled", "id": replaced.request.get("id"), "last": True}))
    except (WebSocketDisconnect, RuntimeError):
        pass
    finally:
        desk.forget(client)


def _request(text: str) -> dict[str, Any] | None:
    """A request as the page sends it; None for anything else, which goes no farther than here."""
    try:
        request = json.loads(text, parse_constant=_refused) if len(text) <= LARGEST_REQUEST else None
        json.dumps(request, ensure_ascii=False).encode()  # halves of characters, which no answer could name
    except (ValueError, RecursionError):
        return None
    if not isinstance(request, dict) or not isinstance(request.get("kind"), str):
        return None
    return request if isinstance(request.get("inputs", {}), dict) else None


def _refused(name: str) -> float:
    """JSON has no NaN and no Infinity, though Python reads them."""
    raise ValueError(name)


@cache
def asset(name: str) -> bytes | None:
    """Content of a file of the page; None if there is none of that name."""
    package = "rodwell.report.pages" if name in FROM_REPORT else "rodwell.web"
    if name.rpartition(".")[2] not in TYPES or "/" in name or "\\" in name:
        return None
    file = resources.files(package) / "assets" / name
    return file.read_bytes() if file.is_file() else None


class Guard:
    """Who may use the server: a page of this server, by its address on this machine, with the token; others get 403."""

    def __init__(self, inner: ASGIApp, token: str, port: Callable[[], int]) -> None:
        self.app, self._token, self._port = inner, token, port

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, or refuse."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        if not self._allowed(HTTPConnection(scope)):
            if scope["type"] == "websocket":
                await receive()
                await send({"type": "websocket.close", "code": 1008})  # before it is accepted: 403
            else:
                await PlainTextResponse("forbidden", 403)(scope, receive, send)
            return

        async def with_headers(message: Any) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", []), *self._headers()]
            await send(message)

        await self.app(scope, receive, with_headers)

    def _allowed(self, connection: HTTPConnection) -> bool:
        hosts = {f"{name}:{self._port()}" for name in ("127.0.0.1", "localhost")}
        origin: str | None = connection.headers.get("origin")
        if connection.headers.get("host") not in hosts:
            return False
        if origin is None and connection.scope["type"] == "websocket":  # browsers always say it
            return False
        if origin is not None and origin not in {f"http://{host}" for host in hosts}:
            return False
        first = connection.scope["path"].split("/")[1]
        return secrets.compare_digest(first.encode(), self._token.encode())

    def _headers(self) -> list[tuple[bytes, bytes]]:
        talk = " ".join(f"ws://{name}:{self._port()}" for name in ("127.0.0.1", "localhost"))
        policy = (
            f"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
            f"connect-src 'self' {talk}; "
            "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        )
        headers = {
            "Content-Security-Policy": policy,
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Cross-Origin-Opener-Policy": "same-origin",
            "Cross-Origin-Resource-Policy": "same-origin",
        }
        return [(name.lower().encode(), value.encode()) for name, value in headers.items()]
