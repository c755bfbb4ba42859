"""Moments to kill a process at: after so much of the processor's time, whatever else the machine has to do."""

from __future__ import annotations

import math
import os
import time
from pathlib import Path


def wait_for(pid: int, seconds: float) -> float:
    """Wait until a child has had so much of the processor, or has ended; how much it had."""
    while True:
        state, *numbers = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        taken = (int(numbers[10]) + int(numbers[11])) / os.sysconf("SC_CLK_TCK")  # as user and in the system
        if state == "Z" or taken >= seconds:
            return taken
        time.sleep(0.002)


def taken_by(pid: int) -> float:
    """Seconds of the processor that a child takes; it has ended then."""
    taken = wait_for(pid, math.inf)
    os.waitpid(pid, 0)
    return taken
