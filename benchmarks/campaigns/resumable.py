"""Numbered trials on several processes, a line of JSON each, so that a campaign that was ended goes on where it was."""

from __future__ import annotations

import argparse
import datetime
import json
import os
import platform
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

Result = dict[str, Any]
Trial = Callable[[int], Result]


def machine() -> str:
    """Where a campaign ran, as its summary says it."""
    return f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}"


def finished(trial: Trial, count: int, lines: Path, workers: int, chunk: int) -> list[Result]:
    """Results of trials 0 to ``count`` − 1, in order: those in ``lines``, and the others, which are added to it."""
    found = {result["number"]: result for result in done(lines)}
    missing = [number for number in range(count) if number not in found]
    with lines.open("a", encoding="utf-8") as file:
        for result in _results(trial, missing, workers, chunk):
            found[result["number"]] = result
            file.write(json.dumps(result) + "\n")
            file.flush()
    return [found[number] for number in range(count)]


def campaign(
    about: str, trial: Trial, seed: int, lines: Path, summary: Path, told: Callable[[list[Result]], Result]
) -> tuple[list[Result], Result]:
    """Run a campaign from the command line; results, and the summary that is written: ``told`` says what is in it."""
    parser = argparse.ArgumentParser(description=about.splitlines()[0])
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--workers", type=int, default=1)
    given = parser.parse_args()
    results = finished(trial, given.count, lines, given.workers, 4)
    faults = [result for result in results if result["fault"]]
    data = {
        "campaign": summary.stem, "seed": seed, "count": given.count, "date": datetime.date.today().isoformat(),
        "machine": machine(), **told(results), "faults": len(faults), "faulty": faults[:50],
    }  # fmt: skip
    summary.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return results, data


def done(lines: Path) -> list[Result]:
    """Trials that have been finished."""
    return [json.loads(line) for line in lines.read_text(encoding="utf-8").splitlines()] if lines.exists() else []


def _results(trial: Trial, numbers: list[int], workers: int, chunk: int) -> Iterator[Result]:
    if workers == 1:
        yield from map(trial, numbers)
        return
    with ProcessPoolExecutor(workers) as pool:
        yield from pool.map(trial, numbers, chunksize=chunk)
