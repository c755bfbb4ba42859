"""Maps survive kill -9 of client, worker and scheduler at random moments, seeded, resumable.

    python benchmarks/campaigns/map_kills.py [--kills 100] [--seed 25]

A map of 128 lift-off loads, 8 chunks, and its jumps, is computed by a process alone or on a cluster of a scheduler and
two workers, and one of these processes is killed when the client has had a random part of the processor's time that it
has of an undisturbed map. Then

- every chunk of the store must be absent, or whole and that of an undisturbed run, byte for byte;
- the same question again must end the map, equal to the undisturbed one byte for byte in all chunks;
- and leave the chunks that were there as they were, file by file: what is computed again is what was in flight.

Where a worker is killed the map must end by itself. Results go to ``map_kills.json`` beside this file, to which more
kills of the same seed are added; a campaign that was broken off goes on where it ended (``map_kills.part``). Needs a
POSIX system and ``rodwell[map]``.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import random
import signal
import subprocess
import sys
import tempfile
import time
import warnings
from collections import Counter
from contextlib import contextmanager, suppress
from datetime import date
from pathlib import Path
from typing import Any

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

import killing

import rodwell

HERE = Path(__file__).parent
OUT, PART = HERE / "map_kills.json", HERE / "map_kills.part"
PORT = 28786
OVER = {"weight": "5..200 in 16", "alpha": "60..90 in 8"}
TARGETS = ("client alone", "client", "worker", "scheduler")
PATIENCE = 900.0
"""Seconds after which a run that has not ended counts as hanging, on a machine that has much else to do."""


def mapped(out: Path, scheduler: str | None) -> rodwell.Map:
    return rodwell.map(rodwell.Problem(15.0, 90.0), "lift-off", over=OVER, out=out, scheduler=scheduler)


def run(out: Path, scheduler: str | None) -> int:
    """Compute the map in a process of its own; return its number."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of threads, of which there are none yet
        pid = os.fork()
    if pid == 0:
        code = 1
        try:
            with Path(os.devnull).open("w") as nothing:
                os.dup2(nothing.fileno(), 2)
            mapped(out, scheduler)
            code = 0
        finally:
            os._exit(code)
    return pid


def ended(pid: int) -> int | None:
    """How a process ended; None if it does not."""
    until = time.monotonic() + PATIENCE
    try:
        while time.monotonic() < until:
            done, status = os.waitpid(pid, os.WNOHANG)
            if done:
                return status
            time.sleep(0.02)
    except KeyboardInterrupt:
        os.kill(pid, signal.SIGKILL)
        raise
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return None


class Cluster:
    """A scheduler and two workers, each a process that can be killed."""

    def __init__(self) -> None:
        self.address = f"tcp://127.0.0.1:{PORT}"
        self.processes: list[subprocess.Popen[bytes]] = []
        self.start()

    def start(self) -> None:
        place = tempfile.mkdtemp()
        home = {**os.environ, "PYTHONPATH": str(Path(rodwell.__file__).resolve().parents[1])}
        quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": place, "env": home}
        python = [sys.executable, "-m"]
        commands = (
            ("dask_scheduler", "--host", "127.0.0.1", "--port", str(PORT)),
            ("dask_worker", self.address, "--nworkers", "2", "--nthreads", "1", "--memory-limit", "0"),
        )
        self.processes = [
            subprocess.Popen([*python, f"distributed.cli.{name}", *options, "--no-dashboard"], **quiet)
            for name, *options in commands
        ]
        try:
            if ended(run(Path(place) / "warm.zarr", self.address)) != 0:
                raise RuntimeError("the cluster computes nothing")
        except BaseException:
            self.stop()
            raise

    def workers(self) -> list[int]:
        """Processes that compute: children of the one that watches over them."""
        parent, found = self.processes[1].pid, []
        for entry in Path("/proc").iterdir():
            with suppress(OSError, ValueError):
                line = (entry / "stat").read_text() if entry.name.isdigit() else ""
                child = line and int(line.rpartition(")")[2].split()[1]) == parent
                if child and "spawn" in (entry / "cmdline").read_bytes().decode():
                    found.append(int(entry.name))
        return found

    def stop(self) -> None:
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            with suppress(subprocess.TimeoutExpired):
                process.wait(20)
            process.kill()
            process.wait()


def files(store: Path) -> dict[str, Path]:
    """Chunks of a store."""
    return {f.relative_to(store).as_posix(): f for f in store.rglob("*") if f.is_file() and "/c/" in f.as_posix()}


def content(store: Path) -> dict[str, bytes]:
    return {name: file.read_bytes() for name, file in files(store).items() if not name.endswith(".partial")}


def mixed(left: dict[str, bytes], right: dict[str, bytes]) -> list[str]:
    """Chunks that count as there but are not those of the undisturbed run, with all their columns."""
    bad = [name for name, data in left.items() if name in right and data != right[name]]
    for name in left:
        if name.startswith("outcome/"):
            _, _, where = name.partition("/")
            columns = [other for other in right if other.partition("/")[2] == where and not other.startswith("jumps")]
            bad += [f"{other} is missing" for other in columns if other not in left]
    return bad


def trial(seed: int, whole: dict[str, bytes], seconds: dict[bool, float], cluster: Cluster) -> dict[str, Any]:
    """One kill: whom, when, what it left, and what the next run made of it."""
    draw = random.Random(seed)
    target = draw.choice(TARGETS)
    alone = target == "client alone"
    after = round(draw.uniform(0.0, seconds[alone]), 3)
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "map.zarr"
        address = None if alone else cluster.address
        pid = run(out, address)
        killing.wait_for(pid, after)
        victims = {"worker": cluster.workers(), "scheduler": [cluster.processes[0].pid]}.get(target, [pid])
        if victims:
            with suppress(ProcessLookupError):
                os.kill(draw.choice(victims), signal.SIGKILL)
        status = ended(pid)
        if target == "scheduler":
            cluster.stop()
            cluster.start()
        left = content(out) if out.exists() else {}
        before = {name: file.stat().st_mtime_ns for name, file in files(out).items()} if out.exists() else {}
        kept = [name for name in left if name.startswith("outcome/")]
        again = ended(run(out, address))
        there, now = content(out), files(out)
        touched = [name for name in before for _ in [0] if name.partition("/")[2] in {k.partition("/")[2] for k in kept}
                   and not name.endswith(".partial") and now[name].stat().st_mtime_ns != before[name]]  # fmt: skip
        hidden = [entry.name for entry in Path(folder).iterdir() if entry.name != "map.zarr"]
        part = [name for name in now if name.endswith(".partial")]
    return {
        "seed": seed,
        "target": target,
        "after": after,
        "seconds": [seconds[True], seconds[False]],
        "hangs": status is None,
        "ended_by_itself": status == 0,
        "chunks_left": len(kept),
        "mixed": mixed(left, whole),
        "next_run": again,
        "equal": there == whole,
        "done_again": touched,
        "hidden": hidden,
        "partial": part,
    }


def fault(one: dict[str, Any]) -> bool:
    """Whether a kill did harm."""
    alive = one["target"] == "worker" and not one["ended_by_itself"]
    bad = one["mixed"] or one["done_again"] or one["partial"] or not one["equal"] or one["next_run"] != 0
    return bool(bad or alive or one["hangs"])


@contextmanager
def undisturbed() -> Any:
    """Chunks of a map that nothing disturbs."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "map.zarr"
        ended(run(out, None))
        yield content(out)


def timed(scheduler: str | None) -> float:
    """Seconds of the processor that the client of an undisturbed map takes."""
    with tempfile.TemporaryDirectory() as folder:
        return killing.taken_by(run(Path(folder) / "map.zarr", scheduler))


def killed(done: list[dict[str, Any]], numbers: range, seed: int) -> None:
    """Kill until there are as many trials as wanted."""
    rodwell.map(rodwell.Problem(15.0, 90.0), "lift-off", over={"weight": [15.0, 16.0]})  # kernels, for all that follow
    cluster = Cluster()
    try:
        with undisturbed() as whole, PART.open("a") as part:
            known = done[-1].get("seconds") if done else None
            alone, shared = known or (timed(None), timed(cluster.address))
            seconds = {True: alone, False: shared}
            for number in numbers[len(done) :]:
                done.append(trial(seed + number, whole, seconds, cluster))
                part.write(json.dumps(done[-1]) + "\n")
                part.flush()
    finally:
        cluster.stop()


def counted(done: list[dict[str, Any]]) -> dict[str, Any]:
    """Numbers of the summary that add up from one run of the campaign to the next."""
    return {
        "targets": dict(Counter(one["target"] for one in done).most_common()),
        "chunks_left_by_the_kill": dict(sorted(Counter(str(one["chunks_left"]) for one in done).items())),
        "maps_that_ended_although_a_worker_was_killed": sum(
            one["target"] == "worker" and one["ended_by_itself"] for one in done
        ),
        "equal_to_the_undisturbed_map_after_the_next_run": sum(one["equal"] for one in done),
        "chunks_done_again_although_they_were_there": sum(len(one["done_again"]) for one in done),
        "hidden_folders_after_the_next_run": sum(bool(one["hidden"]) for one in done),
    }


def summed(numbers: dict[str, Any], before: dict[str, Any]) -> dict[str, Any]:
    """Counts with those of an earlier run."""
    return {
        key: summed(value, before.get(key, {})) | {k: n for k, n in before.get(key, {}).items() if k not in value}
        if isinstance(value, dict)
        else value + before.get(key, 0)
        for key, value in numbers.items()
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=25)
    given = parser.parse_args()
    stored = json.loads(OUT.read_text(encoding="utf-8")) if OUT.exists() else {}
    before = stored if stored.get("seed") == given.seed and not stored["faults"] else {}
    numbers, seed = range(before.get("kills", 0), given.kills), given.seed * 1_000_000
    done = [json.loads(line) for line in PART.read_text().splitlines()] if PART.exists() else []
    done = [one for one in done if one["seed"] - seed in numbers]
    if len(done) < len(numbers):
        killed(done, numbers, seed)
    result = {
        "what": "kill -9 of client, worker or scheduler at random moments of a map of 128 lift-off loads",
        "seed": given.seed, "date": date.today().isoformat(), "rodwell": rodwell.__version__,
        "machine": f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}",
        "kills": len(done) + before.get("kills", 0), **summed(counted(done), before),
        "faults": [one for one in done if fault(one)],
    }  # fmt: skip
    OUT.write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(json.dumps(result, indent=1))
    if not result["faults"]:
        PART.unlink()


if __name__ == "__main__":
    main()
