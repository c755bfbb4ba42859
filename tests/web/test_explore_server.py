"""The server of the explorer without a browser: who may use it, its headers, requests, its process and its end."""

from __future__ import annotations

import asyncio
import json
import multiprocessing
import os
import re
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import rodwell

pytest.importorskip("starlette", reason="needs the extra: pip install 'rodwell[explore]'")
testclient = pytest.importorskip("starlette.testclient", reason="needs httpx")

from starlette.websockets import WebSocketDisconnect  # noqa: E402

from rodwell.web import worker  # noqa: E402
from rodwell.web.app import FROM_REPORT, app, asset  # noqa: E402
from rodwell.web.desk import Desk, Job  # noqa: E402
from rodwell.web.serve import _listening, check_installed  # noqa: E402

TOKEN, PORT = "a-token", 8123
HOST = f"127.0.0.1:{PORT}"
HERE = f"http://{HOST}"
PAGES = Path(rodwell.__file__).parent / "web" / "assets"


class FakeDesk:
    """Answers each request with itself."""

    hello = json.dumps({"kind": "hello"})

    def __init__(self) -> None:
        self.waiting: list[Job] = []

    async def run(self) -> None:
        while True:
            await asyncio.sleep(0.01)
            while self.waiting:
                job = self.waiting.pop(0)
                await job.reply(json.dumps({"kind": job.request["kind"], "id": job.request.get("id"), "last": True}))

    def ask(self, job: Job) -> Job | None:
        self.waiting.append(job)
        return None

    def forget(self, client: int) -> None:
        self.gone = client


@pytest.fixture
def client() -> Iterator[Any]:
    with testclient.TestClient(app(FakeDesk(), TOKEN, lambda: PORT), base_url=HERE) as client:  # type: ignore[arg-type]
        yield client


@pytest.mark.parametrize(
    ("path", "headers"),
    [
        ("/wrong/", {}), ("/", {}), (f"/{TOKEN}x/", {}), (f"/x/{TOKEN}/", {}), ("/main.js", {}),
        (f"/{TOKEN}/", {"host": "example.com"}), (f"/{TOKEN}/", {"host": f"example.com:{PORT}"}),
        (f"/{TOKEN}/", {"host": "127.0.0.1:80"}), (f"/{TOKEN}/", {"host": f"127.0.0.1.evil.org:{PORT}"}),
        (f"/{TOKEN}/", {"origin": "http://example.com"}), (f"/{TOKEN}/", {"origin": "null"}),
        (f"/{TOKEN}/main.js", {"origin": f"https://127.0.0.1:{PORT}"}),
    ],
)  # fmt: skip
def test_others_are_refused(client: Any, path: str, headers: dict[str, str]) -> None:
    assert client.get(path, headers=headers).status_code == 403
    with (
        pytest.raises(WebSocketDisconnect),
        client.websocket_connect(
            path.replace(TOKEN + "/", TOKEN + "/talk", 1).replace("talkmain.js", "talk"),
            headers={"host": HOST, "origin": HERE, **headers},
        ),
    ):
        raise AssertionError("a connection was accepted")


def test_a_connection_without_origin_is_refused(client: Any) -> None:
    with pytest.raises(WebSocketDisconnect), client.websocket_connect(f"/{TOKEN}/talk", headers={"host": HOST}):
        raise AssertionError("a connection was accepted")


def test_the_page_is_served_with_a_strict_policy(client: Any) -> None:
    for name in ("", *(file.name for file in PAGES.iterdir()), *FROM_REPORT):
        answer = client.get(f"/{TOKEN}/{name}", headers={"origin": f"http://localhost:{PORT}"} if name else {})
        assert answer.status_code == 200, name
        policy = dict(part.strip().split(" ", 1) for part in answer.headers["content-security-policy"].split(";"))
        assert policy["default-src"] == "'none'"
        assert policy["script-src"] == policy["style-src"] == "'self'"
        assert policy["connect-src"] == f"'self' ws://127.0.0.1:{PORT} ws://localhost:{PORT}"
        assert policy["base-uri"] == policy["form-action"] == policy["frame-ancestors"] == "'none'"
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"
    assert client.get(f"/{TOKEN}/main.js").headers["content-type"].startswith("text/javascript")


def test_the_first_page_is_light_and_asks_for_nothing_from_elsewhere() -> None:
    page = asset("index.html").decode()
    scripts = [file for file in PAGES.iterdir() if file.suffix == ".js"]
    total = sum(len(asset(name)) for name in ("index.html", "explore.css", *FROM_REPORT, *(f.name for f in scripts)))
    assert total <= 900_000
    for file in PAGES.iterdir():
        text = file.read_text(encoding="utf-8")
        assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)", text), file.name  # the name of SVG is no address
        for name in re.findall(r'from "\./([\w.]+)"', text):
            assert asset(name) is not None
    preloaded = re.findall(r'rel="modulepreload" href="([\w.]+)"', page)  # else they are read one after the other
    assert sorted([*preloaded, "main.js"]) == sorted(file.name for file in scripts)
    assert "<noscript>" in page
    assert "rodwell run" in page.split("<noscript>")[1].split("</noscript>")[0]
    assert not re.search(r"\son\w+=|style=|<style|<script>", page)  # the policy would refuse it


@pytest.mark.parametrize("name", ["../app.py", "..%2Fapp.py", "app.py", "nothing.js", "..\\app.py"])
def test_no_other_files_are_served(client: Any, name: str) -> None:
    assert client.get(f"/{TOKEN}/{name}").status_code in (403, 404)


def test_requests_are_answered_and_nonsense_is_told(client: Any) -> None:
    with client.websocket_connect(f"/{TOKEN}/talk", headers={"host": HOST, "origin": HERE}) as socket:
        assert socket.receive_json()["kind"] == "hello"
        for text in ("{", "[]", "3", '{"kind": 3}', '{"kind": "state", "inputs": []}', "x" * 30_000):
            socket.send_text(text)
            assert socket.receive_json() == {"kind": "failed", "message": "that is no request", "last": True}
        socket.send_json({"kind": "state", "id": 7})
        assert socket.receive_json() == {"kind": "state", "id": 7, "last": True}


@pytest.mark.parametrize(
    ("inputs", "cancelled", "told"), [({}, 0, 1), ({"dimensionless.weight": 16.0}, 0, 0), ({}, 1, 0)]
)
def test_what_is_being_computed_is_told_to_who_asks_for_it(inputs: dict[str, Any], cancelled: int, told: int) -> None:
    """A page asks while the case as it was given is computed: it waits for no more than it would otherwise."""
    ours, theirs = multiprocessing.Pipe()
    asked = {"kind": "diagram", "id": 7, "inputs": inputs, "until": None}

    class Computing:
        def explored(self, _: Any, __: Any, tell: Any) -> None:
            tell({"kind": "progress"})  # nobody has asked
            ours.send((1, asked))
            tell({"kind": "diagram"})

    assert worker._first(Computing(), theirs, SimpleNamespace(value=cancelled)) == [(1, asked)]  # type: ignore[arg-type]
    messages = [ours.recv() for _ in range(2) if ours.poll()]
    assert [(number, last, json.loads(text)) for number, last, text in messages] == (
        [(1, False, {"id": 7, "kind": "diagram"})] * told
    )


def test_without_the_extra_the_command_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    with pytest.raises(rodwell.InputError, match=r"uvicorn.*pip install 'rodwell\[explore\]'"):
        check_installed()


def test_a_port_that_is_taken_is_told() -> None:
    with _listening(0) as first:
        port = first.getsockname()[1]
        assert first.getsockname()[0] == "127.0.0.1"
        with pytest.raises(rodwell.InputError, match=f"--port = {port}: cannot be used"):
            _listening(port)


def test_the_newest_request_wins_and_a_process_that_ends_is_replaced() -> None:
    """With the real engine: of many diagrams the last one is answered, each once; a killed process is replaced."""

    async def trial() -> tuple[list[dict[str, Any]], dict[str, Any]]:
        desk = Desk((None, ".", "case"))
        try:
            desk.ready()
            task = asyncio.create_task(desk.run())
            heard: list[dict[str, Any]] = []
            news = asyncio.Event()

            async def reply(text: str) -> None:
                heard.append(json.loads(text))
                news.set()

            async def until(number: int) -> dict[str, Any]:
                while True:
                    for message in heard:
                        if message.get("id") == number and message.get("last"):
                            return message
                    news.clear()
                    await asyncio.wait_for(news.wait(), 120.0)

            def diagram(number: int) -> None:
                inputs = {"dimensionless.weight": 20.0 + number, "modes": 6}
                replaced = desk.ask(Job(1, {"kind": "diagram", "id": number, "inputs": inputs}, reply))
                if replaced is not None:
                    heard.append({"id": replaced.request["id"], "kind": "cancelled", "last": True})

            diagram(0)
            while desk._running is None:
                await asyncio.sleep(0.0)
            diagram(11)  # while the other runs, which ends it
            assert (await until(0))["kind"] == "cancelled"
            assert (await until(11))["kind"] == "diagram"
            for number in range(1, 9):
                diagram(number)
                await asyncio.sleep(0.02)
            last = await until(8)
            assert last["kind"] == "diagram"
            assert desk.process_id is not None
            os.kill(desk.process_id, signal.SIGKILL)
            diagram(9)
            told = await until(9)
            diagram(10)
            again = await until(10)
            assert again["kind"] == "diagram"
            task.cancel()
            return heard, told
        finally:
            desk.stop()

    heard, told = asyncio.run(trial())
    kinds = {number: [m["kind"] for m in heard if m.get("id") == number and m.get("last")] for number in range(12)}
    assert all(len(kind) == 1 for kind in kinds.values())  # each is answered once
    assert told["kind"] == "failed"
    assert "started anew" in told["message"]


def _children(process: int) -> list[int]:
    found = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process)], capture_output=True, text=True, check=False)
    return [int(pid) for pid in found.stdout.split()]


def _alive(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(sys.platform != "linux", reason="looks at processes as Linux shows them")
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 0), (signal.SIGHUP, 129), (signal.SIGKILL, -9)])
def test_the_command_prints_one_line_and_leaves_no_process(number: signal.Signals, code: int) -> None:
    """Ctrl-C, a terminal that is closed, and the hardest end of all."""
    command = [sys.executable, "-m", "rodwell", "explore", "--no-browser"]
    running = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert running.stdout is not None
        line = running.stdout.readline()
        address = re.fullmatch(r"rodwell explore: (http://127\.0\.0\.1:\d+/)([\w-]{20,})/   \(Ctrl-C ends it\)\n", line)
        assert address is not None, line
        with urllib.request.urlopen(f"{address[1]}{address[2]}/", timeout=20) as page:
            assert b"rodwell" in page.read()
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(f"{address[1]}wrong/", timeout=20)
        children = _children(running.pid)
        assert children
        running.send_signal(number)
        out, errors = running.communicate(timeout=30)
        assert (running.returncode, out) == (code, "")
        if number != signal.SIGKILL:
            by = "" if number == signal.SIGINT else "rodwell: ended by SIGHUP; nothing was written"
            assert errors.strip() == by
    finally:
        running.kill()
        running.communicate()
    end = time.monotonic() + 20.0
    while any(map(_alive, children)) and time.monotonic() < end:
        time.sleep(0.05)
    assert not any(map(_alive, children))


def test_a_case_that_cannot_be_used_is_told_before_anything_is_served(tmp_path: Path) -> None:
    case = tmp_path / "case.toml"
    case.write_text('[rod]\nlength = "30"\n', encoding="utf-8")
    command = [sys.executable, "-m", "rodwell", "explore", str(case), "--no-browser"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert "case.toml" in done.stderr
    assert "rod.length = '30': " in done.stderr
