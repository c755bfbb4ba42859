"""Between pages and the engine: the newest request wins, older ones are cancelled, a process that hangs is replaced."""

from __future__ import annotations

import asyncio
import json
import multiprocessing
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from rodwell.errors import InputError, RodwellError
from rodwell.web.worker import Start, work

ORDER = ("follow", "diagram", "path", "snap", "state", "verdict", "details", "copy", "file")
"""What is answered first."""

PATIENCE = 5.0
"""Seconds after which a process that was told to leave off, and did not, is replaced."""

LONGEST_START = 300.0
"""Seconds that the process may take to begin."""

Reply = Callable[[str], Awaitable[None]]
Request = dict[str, Any]


@dataclass(frozen=True)
class Job:
    """A request, who asked, and to whom the answer goes."""

    client: int
    request: Request
    reply: Reply

    @property
    def slot(self) -> tuple[int, str]:
        """What a newer request takes the place of: the same client's of the same kind."""
        return self.client, str(self.request.get("kind"))


class Desk:
    """Takes requests and hands them to one process, one after the other.

    Parameters
    ----------
    start
        The case, as :class:`rodwell.web.given.Given` takes it.
    """

    def __init__(self, start: Start) -> None:
        self._start = start
        self._spawn = multiprocessing.get_context("spawn")  # a fork would inherit threads and sockets
        self._cancelled = self._spawn.Value("q", 0, lock=False)
        self._number = 0
        self._waiting: dict[tuple[int, str], Job] = {}
        self._running: Job | None = None
        self._told: float | None = None
        self._news = asyncio.Event()
        self.hello = ""
        self._begin()

    def _begin(self) -> None:
        self._pipe, theirs = self._spawn.Pipe()
        self._process = self._spawn.Process(
            target=work, args=(theirs, self._cancelled, self._start), name="rodwell-engine", daemon=True
        )
        self._process.start()
        theirs.close()
        self._awake: float | None = None  # since when it is known to compute, not to be importing what computes

    @property
    def process_id(self) -> int | None:
        """Of the engine's process."""
        return self._process.pid

    def ready(self) -> None:
        """Wait until the engine is ready.

        Raises
        ------
        InputError
            If the case cannot be used.
        RodwellError
            If the process did not begin.
        """
        if not self._pipe.poll(LONGEST_START):
            raise RodwellError("the process that computes did not begin")
        try:
            _, _, self.hello = self._pipe.recv()
        except EOFError:
            raise RodwellError("the process that computes ended as it began") from None
        said = json.loads(self.hello)
        if said["kind"] == "failed":
            raise CaseRefusedError(said["message"])

    def ask(self, job: Job) -> Job | None:
        """Take a request; return the one that it takes the place of, if that has not been begun."""
        replaced = self._waiting.pop(job.slot, None)
        self._waiting[job.slot] = job
        self.outdate(job)
        self._news.set()
        return replaced

    def outdate(self, job: Job) -> None:
        """Leave off what is of no use any more now that a request has come, to this desk or to another."""
        running = self._running
        if running is not None and running.client == job.client and self._outdated(running, job):
            self.leave_off()

    @staticmethod
    def _outdated(running: Job, newer: Job) -> bool:
        """Whether what runs is of no use any more: other inputs are shown, or another diagram is wanted."""
        same = all(running.request.get(name) == newer.request.get(name) for name in ("inputs", "until"))
        return not same

    def leave_off(self) -> None:
        """Tell the engine that what it computes is no longer wanted."""
        self._cancelled.value = self._number
        self._told = self._told or time.monotonic()

    def forget(self, client: int) -> None:
        """A client has gone: what it asked for is no longer wanted."""
        self._waiting = {slot: job for slot, job in self._waiting.items() if slot[0] != client}
        if self._running is not None and self._running.client == client:
            self.leave_off()

    async def run(self) -> None:
        """Hand on requests until cancelled."""
        while True:
            await self._news.wait()
            self._news.clear()
            while self._waiting:
                slot = min(self._waiting, key=lambda slot: ORDER.index(slot[1]) if slot[1] in ORDER else 0)
                self._running = self._waiting.pop(slot)
                try:
                    await self._answer(self._running)
                finally:
                    self._running, self._told = None, None

    async def _answer(self, job: Job) -> None:
        self._number += 1
        number = self._number
        try:
            self._pipe.send((number, job.request))
            last = False
            while not last:
                message = await asyncio.to_thread(self._message)
                if message is None:
                    told, awake = self._told, self._awake
                    if told is not None and awake is not None and time.monotonic() - max(told, awake) > PATIENCE:
                        raise EOFError
                    continue
                got, last, text = message
                self._awake = self._awake or time.monotonic()
                last = last and got == number  # the first messages say that there is a case, and then an engine
                if got == number:
                    await job.reply(text)
        except (EOFError, OSError):
            failed = {"kind": "failed", "of": job.request.get("kind"), "id": job.request.get("id"),
                      "message": "the computation ended; it is started anew, change an input to go on"}  # fmt: skip
            if self._told is not None:
                failed = {"kind": "cancelled", "id": job.request.get("id")}
            await job.reply(json.dumps(failed | {"last": True}))
            await asyncio.to_thread(self._anew)

    def _message(self) -> tuple[int, bool, str] | None:
        """The next message of the process; None where none comes in a while."""
        return self._pipe.recv() if self._pipe.poll(0.25) else None

    def _anew(self) -> None:
        self.stop()
        self._begin()
        self.ready()

    def stop(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.join(5.0)
        self._pipe.close()


class CaseRefusedError(InputError):
    """A case that the engine could not use, with its message as it is."""

    def __init__(self, message: str) -> None:
        super().__init__("case", None, message)
        self.args = (message,)
