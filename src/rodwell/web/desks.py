"""Two desks: what is on the wall is answered at once, while the other follows a load path, which takes seconds."""

from __future__ import annotations

import asyncio
import contextlib

from rodwell.web.desk import Desk, Job
from rodwell.web.worker import Start


class Desks:
    """Hands requests for the load path to a process of their own, which begins with the first of them.

    Parameters
    ----------
    start
        The case, as :class:`rodwell.web.given.Given` takes it.
    """

    def __init__(self, start: Start) -> None:
        self._start = start
        self._desks = [Desk(start)]
        self._news = asyncio.Event()

    @property
    def hello(self) -> str:
        """What a page is told first."""
        return self._desks[0].hello

    @property
    def process_ids(self) -> list[int | None]:
        """Of the processes that compute."""
        return [desk.process_id for desk in self._desks]

    def ready(self) -> None:
        """Wait until the first is ready; errors as of :meth:`Desk.ready`."""
        self._desks[0].ready()

    def ask(self, job: Job) -> Job | None:
        """Take a request; return the one that it takes the place of, if that has not been begun."""
        second = bool(job.request.get("path"))
        if second and len(self._desks) == 1:
            self._desks.append(Desk(self._start))
            self._news.set()
        for desk in self._desks:
            desk.outdate(job)
        return self._desks[second].ask(job)

    def forget(self, client: int) -> None:
        """A client has gone: what it asked for is no longer wanted."""
        for desk in self._desks:
            desk.forget(client)

    async def run(self) -> None:
        """Hand on requests until cancelled."""
        tasks: list[asyncio.Task[None]] = []
        try:
            while True:
                tasks += [asyncio.create_task(desk.run()) for desk in self._desks[len(tasks) :]]
                self._news.clear()
                await self._news.wait()
        finally:
            for task in tasks:
                task.cancel()
            for task in tasks:
                with contextlib.suppress(asyncio.CancelledError):
                    await task

    def stop(self) -> None:
        """End the processes."""
        for desk in self._desks:
            desk.stop()
