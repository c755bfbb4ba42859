"""Running many pieces of work on an executor: a bounded number at a time, and none that is lost ends the rest.

Executors have the interface of :mod:`concurrent.futures`: this process itself, a pool of processes, or a cluster.
"""

from __future__ import annotations

import concurrent.futures
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError, Executor, Future
from typing import Any

from rodwell._version import __version__
from rodwell.errors import InputError, RodwellError

IN_FLIGHT = 3
"""Pieces per worker that are given out at a time: enough that none waits, few enough that little is lost."""


class ClusterLostError(RodwellError):
    """The cluster no longer answers; what was done before is kept."""


class HereExecutor(Executor):
    """An executor that computes in this process, at once."""

    def submit(self, fn: Callable[..., Any], /, *arguments: Any, **options: Any) -> Future[Any]:
        """Compute, and return what came of it."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*arguments, **options))
        except Exception as error:
            future.set_exception(error)
        return future


def each(
    function: Callable[..., Any],
    pieces: Iterable[tuple[Any, tuple[Any, ...]]],
    executor: Executor,
    workers: int,
) -> Iterator[tuple[Any, Any]]:
    """Yield key and result of each piece as it is done; the result of one that failed is its exception.

    ``pieces`` are pairs of a key and the arguments of ``function``.

    Raises
    ------
    ClusterLostError
        If the executor takes no work any more.
    """
    ahead = iter(pieces)
    flying: dict[Future[Any], Any] = {}
    try:
        while True:
            while len(flying) < max(1, IN_FLIGHT * workers if workers > 1 else 1):
                piece = next(ahead, None)
                if piece is None:
                    break
                flying[_given_out(executor, function, piece[1])] = piece[0]
            if not flying:
                return
            done, _ = concurrent.futures.wait(flying, return_when=concurrent.futures.FIRST_COMPLETED)
            for future in done:
                yield flying.pop(future), _result(future)
    finally:
        for future in flying:
            future.cancel()


def _given_out(executor: Executor, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Future[Any]:
    try:
        return executor.submit(function, *arguments)
    except Exception as error:  # a closed client, a scheduler that has gone, a broken pool
        raise ClusterLostError(f"the workers take no more work ({type(error).__name__}: {error})") from None


def _result(future: Future[Any]) -> Any:
    try:
        return future.result()
    except CancelledError:
        raise ClusterLostError("the scheduler no longer answers") from None
    except concurrent.futures.BrokenExecutor as error:
        raise ClusterLostError(f"a worker died ({error})") from None
    except Exception as error:
        return error


def version() -> str:
    """The version of rodwell where this is called."""
    return __version__


def check_workers(executor: Executor) -> None:
    """Refuse workers that have no rodwell, or another one: every cell would fail, or the map be of two programs.

    Raises
    ------
    InputError
        Saying what they have.
    """
    try:
        there = executor.submit(version).result(timeout=120)
    except (ImportError, AttributeError) as error:
        raise InputError("scheduler", None, f"its workers have no rodwell that could compute maps ({error})") from None
    except Exception as error:
        raise ClusterLostError(f"the workers do not answer ({type(error).__name__}: {error})") from None
    if there != __version__:
        raise InputError("scheduler", None, f"its workers have rodwell {there}, here it is {__version__}")
