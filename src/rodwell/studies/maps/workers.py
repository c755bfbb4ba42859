"""Where a map is computed: in this process, in a pool of processes, on a local or a distant cluster of Dask."""

from __future__ import annotations

import multiprocessing
import os
import re
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

from rodwell.errors import InputError, checked_whole
from rodwell.studies.maps.running import HereExecutor, check_workers

MOST_WORKERS = 1000

ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"), "1")
"""Environment of a worker: threads slow small banded systems, and workers share the processors already."""

QUIET = {"distributed.worker.profile.enabled": False, "distributed.admin.tick.interval": "1s"}
"""What Dask does beside the work, seldom: its profiler looks at every worker a hundred times a second otherwise."""

ADDRESS = re.compile(r"(?:(?:tcp|tls|ws|wss)://)?(?:[A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\]):\d{1,5}/?")
"""An address of a scheduler: host and port."""

TIMEOUT = 20.0
"""Seconds for which a scheduler is waited for."""


@dataclass(frozen=True)
class Workers:
    """Executors at work: the executor, how many workers it has, and where one can look at them ("": nowhere)."""

    executor: Executor
    count: int
    dashboard: str = ""


@contextmanager
def working(workers: int = 1, scheduler: str | None = None, *, dask: bool | None = None) -> Iterator[Workers]:
    """Yield workers: this process for one, else a local cluster, or that of a ``scheduler`` (an address).

    ``dask`` False takes a plain pool of processes for several, also where Dask is installed; None prefers Dask.

    Raises
    ------
    InputError
        If ``workers`` is out of range, a scheduler does not answer, or Dask is needed and not installed.
    """
    workers = checked_whole("workers", workers, 1, MOST_WORKERS)
    if scheduler is not None:
        needs_extra("scheduler", scheduler, "distributed")
        with _distant(scheduler) as found:
            yield found
    elif workers == 1:
        yield Workers(HereExecutor(), 1)
    elif dask is not False and find_spec("distributed") is not None:
        with _local(workers) as found:
            yield found
    else:
        with _in_one_thread(), ProcessPoolExecutor(workers, multiprocessing.get_context("spawn")) as pool:
            check_workers(pool)
            yield Workers(pool, workers)


def team(workers: int | Workers, scheduler: str | None = None) -> AbstractContextManager[Workers]:
    """A context of workers: those given, which stay, or new ones, see :func:`working`."""
    return nullcontext(workers) if isinstance(workers, Workers) else working(workers, scheduler)


def needs_extra(field: str, value: object, package: str) -> None:
    """Raise if a package of the extra is not installed."""
    if find_spec(package) is None:
        raise InputError(field, value, f"needs {package}, which is not installed: pip install 'rodwell[map]'")


@contextmanager
def _local(workers: int) -> Iterator[Workers]:
    import dask  # noqa: PLC0415
    from distributed import Client, LocalCluster  # noqa: PLC0415

    with _in_one_thread(), _quiet(), dask.config.set(QUIET):
        cluster = LocalCluster(
            n_workers=workers, threads_per_worker=1, processes=True, memory_limit="auto", dashboard_address=":0",
            env=ONE_THREAD, silence_logs=50,
        )  # fmt: skip
        with cluster, Client(cluster) as client:
            yield _of(client, workers)


@contextmanager
def _distant(address: str) -> Iterator[Workers]:
    from distributed import Client  # noqa: PLC0415

    if not ADDRESS.fullmatch(address):
        raise InputError("scheduler", address, 'is no address of a scheduler; write for example "tcp://host:8786"')
    try:
        client = Client(address, timeout=TIMEOUT)
    except Exception as error:  # Dask raises many kinds for what does not answer
        why = str(error) or "no answer"
        raise InputError("scheduler", address, f"does not answer ({why}); is it running, and its port open?") from None
    with client, _quiet():
        try:
            client.wait_for_workers(1, timeout=TIMEOUT)
        except TimeoutError:
            raise InputError("scheduler", address, "has no workers: start some with: dask worker ADDRESS") from None
        threads = sum(client.nthreads().values())
        yield _of(client, threads)


def _of(client: Any, count: int) -> Workers:
    executor = client.get_executor(pure=False)
    check_workers(executor)
    seen = client.dashboard_link if find_spec("bokeh") is not None else ""
    return Workers(executor, count, seen)


@contextmanager
def _in_one_thread() -> Iterator[None]:
    """Let processes that start now inherit the environment of a worker."""
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update({name: value for name, value in ONE_THREAD.items() if before[name] is None})
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep Dask's log lines about workers that come and go off the terminal: what matters comes as an exception."""
    import logging  # noqa: PLC0415

    logger = logging.getLogger("distributed")
    before = logger.level
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        logger.setLevel(before)
