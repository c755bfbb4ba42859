"""The first run of all: a second process compiles the largest kernels while this one goes on.

Numba compiles a kernel when it is first called and keeps the machine code on disk. Only the very first run has to
compile everything; it takes turns in one process, so :func:`begin` starts another one for the kernels that are
needed last and take longest, and :func:`wait_for` fetches each of them when its turn has come. If there is no second
process (one processor, no permission, it died), everything is compiled here: the results are the same.
"""

from __future__ import annotations

import atexit
import os
import subprocess
import sys


class _Helper:
    """The other process: it prints the name of each kernel once its machine code lies on disk."""

    def __init__(self, module: str) -> None:
        self.ready: set[str] = set()
        self.process: subprocess.Popen[str] | None = subprocess.Popen(
            [sys.executable, "-m", module],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )

    def wait_for(self, name: str) -> None:
        while self.process is not None and name not in self.ready:
            line = self.process.stdout.readline() if self.process.stdout else ""
            if line:
                self.ready.add(line.strip())
            else:  # finished, or died: whatever is missing is compiled here
                self.end()

    def end(self) -> None:
        """End the process, if it still runs: what it has put on disk stays."""
        if self.process is not None:
            self.process.kill()
            with self.process:  # closes the pipe and waits
                self.process = None


_helper: _Helper | None = None


def begin(module: str) -> None:
    """Start ``python -m module``, which compiles kernels and prints the name of each; once per process.

    It starts only where a processor is free for it.
    """
    global _helper  # noqa: PLW0603 - one helper for the process
    if _helper is None and sys.executable and (os.cpu_count() or 1) > 1:
        try:
            _helper = _Helper(module)
        except OSError:  # no permission to start processes
            return
        atexit.register(_helper.end)


def wait_for(name: str) -> None:
    """Return when the other process, if there is one, has put kernel ``name`` on disk or has ended."""
    if _helper is not None:
        _helper.wait_for(name)
