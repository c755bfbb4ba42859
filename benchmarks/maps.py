"""Maps beside a plain loop: rate, processor time, memory of a worker, size of a store.

    python benchmarks/maps.py [--rounds 12] [--cells 128]
    python benchmarks/maps.py --memory 100000    cells of one worker, in about half an hour

In each round the same random problems are computed by a plain loop on a pool of two processes and by ``rodwell.map`` on
a cluster of Dask with two workers, one after the other; both stand ready before. The loop does what a cell does: it
follows the branch to lift-off and judges whether the load is known to the tolerance; a loop that does not judge is
measured beside. On a machine that others use too, only the ratios within a round and the processor times mean
something: their medians are told. Writes ``results/maps.md``.
"""

from __future__ import annotations

import argparse
import datetime
import itertools
import math
import multiprocessing
import os
import platform
import shutil
import statistics
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

import numpy as np
import psutil  # of Dask
import zarr
from zarr.testing.store import LatencyStore

import rodwell
from rodwell.quantities.value import Value
from rodwell.store.chunked import Kept, opened
from rodwell.store.mapping import _build
from rodwell.studies.maps import computing
from rodwell.studies.maps.block import COLUMNS, as_block, computed_block
from rodwell.studies.maps.cells import Found
from rodwell.studies.maps.question import asked
from rodwell.studies.maps.workers import Workers, working

OUT = Path(__file__).parent / "results" / "maps.md"
MEMORY = OUT.with_stem("maps_memory")
FLAT = rodwell.Problem(15.0, 90.0)
PIECE = 8
"""Problems that the loop gives out at a time."""


def judged(pairs: list[tuple[float, float]]) -> list[tuple[float, float, bool]]:
    out = []
    for weight, alpha in pairs:
        branch = rodwell.follow(rodwell.Problem(weight, alpha))
        lift = branch.lift_off
        assert lift is not None
        out.append((lift.force, lift.error, branch.meets_tolerance(lift)))
    return out


def bare(pairs: list[tuple[float, float]]) -> list[float]:
    return [rodwell.follow(rodwell.Problem(*pair)).lift_off.force for pair in pairs]  # type: ignore[union-attr]


def used(_: Any = None) -> tuple[int, float, float]:
    """Number, processor time in s and memory in MB of the process that calls."""
    me = psutil.Process()
    spent = me.cpu_times()
    return me.pid, spent.user + spent.system, me.memory_info().rss / 1e6


def of_all(submit: Any, count: int) -> dict[int, tuple[float, float]]:
    """The same of all workers of an executor, by number."""
    found: dict[int, tuple[float, float]] = {}
    while len(found) < count:
        jobs = [submit(used) for _ in range(4 * count)]
        found |= {pid: (spent, size) for pid, spent, size in (job.result() for job in jobs)}
    return found


def spent(found: dict[int, tuple[float, float]]) -> float:
    return sum(cpu for cpu, _ in found.values())


def one_round(pool: Any, team: Workers, single: Workers, count: int, seed: int) -> dict[str, float]:
    draw = np.random.default_rng(seed)
    weights, alphas = np.sort(draw.uniform(5.0, 200.0, count // 8)), np.sort(draw.uniform(30.0, 90.0, 8))
    pairs = list(itertools.product(weights.tolist(), alphas.tolist()))
    pieces = [pairs[i : i + PIECE] for i in range(0, len(pairs), PIECE)]
    out: dict[str, float] = {}
    for name, function in (("loop", judged), ("bare", bare)):
        before, start = spent(of_all(pool.submit, 2)), time.perf_counter()
        list(pool.map(function, pieces))
        out[name] = len(pairs) / (time.perf_counter() - start)
        out[f"{name} cpu"] = (spent(of_all(pool.submit, 2)) - before) / len(pairs)
    for name, workers in (("map", team), ("one", single)):
        with tempfile.TemporaryDirectory() as folder:
            cpu, here = spent(of_all(workers.executor.submit, workers.count)), time.process_time()
            start = time.perf_counter()
            over = {"weight": weights, "alpha": alphas}
            rodwell.map(FLAT, "lift-off", over=over, halvings=0, workers=workers, out=Path(folder) / "map.zarr")
            out[name] = len(pairs) / (time.perf_counter() - start)
            here = time.process_time() - here
            out[f"{name} cpu"] = (spent(of_all(workers.executor.submit, workers.count)) - cpu) / len(pairs)
            out[f"{name} client"] = here / len(pairs)
    return out


def store_size(shape: tuple[int, ...], cells: int) -> tuple[float, float, int]:
    """Bytes a cell, seconds of the writing process a chunk, and files of a store with ``cells`` cells of real data."""
    side = [np.linspace(0.01, 0.01 + 1e-7 * n, n) + 0.001 * i for i, n in enumerate(shape)]
    over: dict[str, Any] = dict(zip(("clearance", "poisson"), side, strict=True))
    over["clearance"], over["poisson"] = np.linspace(0.01, 0.02, shape[0]), np.linspace(0.1, 0.4, shape[1])
    question = asked(FLAT, "critical", over)
    sample = computed_block(question.rods, question.cells((0, 0))[:64])
    folder = Path(tempfile.mkdtemp())
    with opened(
        folder / "m.zarr", question.identity, lambda group: _build(group, question, question.identity)
    ) as group:
        kept, done, start = Kept(group, COLUMNS, question.region), 0, time.process_time()
        rng = np.random.default_rng(0)
        chunks = list(itertools.islice(question.chunks(), max(1, cells // math.prod(question.chunk_shape))))
        for chunk in chunks:
            size = math.prod(part.stop - part.start for part in question.region(chunk))
            block = {name: np.resize(column, size) for name, column in sample.items()}
            for name in ("value", "error", "place", "wavenumber"):  # digits of their own, as real ones have
                block[name] = rng.normal(size=size)
            kept.keep(chunk, block)
            done += size
        seconds = (time.process_time() - start) / len(chunks)
    files = [file for file in (folder / "m.zarr").rglob("*") if file.is_file()]
    total = sum(file.stat().st_size for file in files)
    shutil.rmtree(folder)
    return total / done, seconds, len(files)


class Few(Kept):
    """Keeps the first chunks of a map only."""

    def missing(self, chunks: Any) -> list[Any]:
        return list(itertools.islice(chunks, 60))


def ready(rods: Any, cells: Any) -> Any:
    """A block of cells that costs nothing."""
    return as_block([Found(1, Value(-123.0 + 1e-3 * i, 1e-9), 0.5, 6.28) for i in range(len(cells))])


def chunks_a_second(latency: float) -> float:
    """Chunks of 4096 cells a second that scheduler and client get through if cells cost nothing, with real stores.

    ``latency``: seconds that each file of an object store takes, simulated; 0: a folder.
    """
    over = {"clearance": np.linspace(0.01, 0.02, 1024), "poisson": np.linspace(0.1, 0.4, 1024)}
    question = asked(FLAT, "critical", over)
    folder = Path(tempfile.mkdtemp())
    with working(2) as team, opened(folder / "m.zarr", {}, lambda group: _build(group, question, {})) as group:
        far = zarr.open_group(LatencyStore(group.store, set_latency=latency), mode="r+") if latency else group
        before, computing.computed_block = computing.computed_block, ready
        start = time.perf_counter()
        try:
            computing.compute_cells(question, Few(far, COLUMNS, question.region), team, lambda _what, _done: None)
        finally:
            computing.computed_block = before
        rate = 60 / (time.perf_counter() - start)
    shutil.rmtree(folder)
    return rate


def write_memory(cells: int) -> None:
    """Memory of a worker that computes a map, ten times on the way."""
    over = {"weight": np.linspace(5.0, 200.0, cells // 100), "alpha": np.linspace(30.0, 90.0, 100)}
    rows, each = [], cells // 1000
    with working(1) as single:
        for part in range(10):
            some = over | {"weight": over["weight"][part * each : (part + 1) * each]}
            rodwell.map(FLAT, "lift-off", over=some, halvings=0, workers=single)
            (size,) = (size for _, size in of_all(single.executor.submit, 1).values())
            rows.append(f"| {(part + 1) * each * 100:,} | {size:.0f} |")
            print(rows[-1], flush=True)
    head = f"`python benchmarks/maps.py --memory {cells}`, {datetime.date.today().isoformat()}, {platform.machine()}, "
    head += f"Python {platform.python_version()}: one worker, lift-off loads (γ 5 to 200, α 30° to 90°)."
    MEMORY.write_text("\n".join([head, "", "| Cells | Memory, MB |", "| --- | --- |", *rows, ""]), encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--rounds", type=int, default=12)
    parser.add_argument("--cells", type=int, default=128)
    parser.add_argument("--memory", type=int, help="Look at the memory of a worker while it computes so many cells.")
    given = parser.parse_args()
    if given.memory:
        write_memory(given.memory)
        return
    judged([(15.0, 90.0)])
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool, working(2) as team, working(1) as single:
        list(pool.map(judged, [[(15.0, 90.0)]] * 16))
        one_round(pool, team, single, 64, 0)
        rounds = [one_round(pool, team, single, given.cells, 1 + i) for i in range(given.rounds)]

    def median(of: Any) -> str:
        values = sorted(of(one) for one in rounds)
        return f"{statistics.median(values):.3f} ({values[0]:.3f} to {values[-1]:.3f})"

    whole = {n: store_size((n, n), 40_000) for n in (400, 1000, 10_000)}
    lines = [
        f"`python benchmarks/maps.py`, {datetime.date.today().isoformat()}, rodwell {rodwell.__version__}, "
        f"{platform.machine()}, {os.cpu_count()} cores shared with other work, Python {platform.python_version()}. "
        f"{given.rounds} rounds of {given.cells} lift-off loads (γ 5 to 200, α 30° to 90°); median, least, largest.",
        "", "| | |", "| --- | --- |",
        f"| rate on 2 workers / rate of the loop on 2 processes | {median(lambda r: r['map'] / r['loop'])} |",
        f"| the same beside a loop that does not judge the tolerance | {median(lambda r: r['map'] / r['bare'])} |",
        f"| processor time a cell of the workers / of the loop | {median(lambda r: r['map cpu'] / r['loop cpu'])} |",
        "| processor time a cell of client, scheduler and workers / of the loop | "
        f"{median(lambda r: (r['map cpu'] + r['map client']) / r['loop cpu'])} |",
        f"| rate on 2 workers / twice that of one process | {median(lambda r: r['map'] / r['one'] / 2.0)} |",
        f"| lift-off loads a minute, 2 workers | {median(lambda r: 60.0 * r['map'])} |",
        f"| processor time a cell, ms: loop | {median(lambda r: 1e3 * r['loop cpu'])} |",
        f"| … loop that does not judge | {median(lambda r: 1e3 * r['bare cpu'])} |",
        f"| … workers | {median(lambda r: 1e3 * r['map cpu'])} |",
        f"| … client and scheduler | {median(lambda r: 1e3 * r['map client'])} |",
        "", "Stores, with digits that do not compress:", "",
        "| Cells of the map | Cells a chunk | Bytes a cell | Writing a chunk, s of processor time |",
        "| --- | --- | --- | --- |",
        *(f"| {n * n:.0e} | {min(n * n // 256, 4096)} | {size:.1f} | {seconds:.3f} |"
          for n, (size, seconds, _) in whole.items()),
        "", "Chunks of 4096 cells a second through scheduler and client, cells that cost nothing:", "",
        "| Store | Chunks a second |", "| --- | --- |",
        *(f"| {name} | {chunks_a_second(latency):.1f} |" for name, latency in
          (("folder", 0.0), ("object store, 20 ms a file (simulated)", 0.02), ("… 100 ms", 0.1))),
        "",
    ]  # fmt: skip
    OUT.write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
