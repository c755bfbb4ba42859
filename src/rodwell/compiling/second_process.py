"""The first run of all: a second process compiles the largest kernels while this one goes on.

Numba compiles a kernel when it is first called and keeps the machine code on disk. Only the very first run has to
compile everything; it takes turns in one process, so :func:`begin` starts another one for the kernels that are
needed last and take longest, and :func:`wait_for` fetches each of them when its turn has come. Where it would have to
wait, this process compiles meanwhile what it needs soon itself. If there is no second process (one processor, no
permission, it died), everything is compiled here: the results are the same.
"""

from __future__ import annotations

import atexit
import os
import select
import subprocess
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress

LINE = 4096
"""Most bytes that are read at once: far more than all names take."""


class _Helper:
    """The other process: it prints the name of each kernel once its machine code lies on disk."""

    def __init__(self, module: str, meanwhile: Sequence[Callable[[], object]]) -> None:
        self.said = b""
        self.meanwhile = list(meanwhile)
        self.process: subprocess.Popen[bytes] | None = subprocess.Popen(
            [sys.executable, "-m", module],
            bufsize=0,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )

    @property
    def ready(self) -> list[str]:
        """Names that have been printed."""
        return self.said.decode().split()

    def wait_for(self, name: str) -> None:
        while self.process is not None and name not in self.ready:
            if not self.meanwhile or self._speaks():
                self._listen()
            else:
                self.meanwhile.pop(0)()

    def _speaks(self) -> bool:
        """Whether something can be read at once."""
        pipe = self.process.stdout if self.process else None
        with suppress(OSError, ValueError):  # a system that cannot tell
            return pipe is not None and bool(select.select([pipe], [], [], 0.0)[0])
        return False

    def _listen(self) -> None:
        """Read what the process prints next."""
        said = self.process.stdout.read(LINE) if self.process and self.process.stdout else b""
        self.said += said or b""
        if not said:  # finished, or died: whatever is missing is compiled here
            self.end()

    def end(self) -> None:
        """End the process, if it still runs: what it has put on disk stays."""
        if self.process is not None:
            self.process.kill()
            with self.process:  # closes the pipe and waits
                self.process = None


_helper: _Helper | None = None


def begin(module: str, meanwhile: Sequence[Callable[[], object]] = ()) -> None:
    """Start ``python -m module``, which compiles kernels and prints the name of each; once per process.

    It starts only where a processor is free for it. What is to be done ``meanwhile`` is done in this process, once, as
    soon as it would have to wait.
    """
    global _helper  # noqa: PLW0603 - one helper for the process
    if _helper is None and sys.executable and (os.cpu_count() or 1) > 1:
        try:
            _helper = _Helper(module, meanwhile)
        except OSError:  # no permission to start processes
            return
        atexit.register(_helper.end)


def wait_for(name: str) -> None:
    """Return when the other process, if there is one, has put kernel ``name`` on disk or has ended."""
    if _helper is not None:
        _helper.wait_for(name)
