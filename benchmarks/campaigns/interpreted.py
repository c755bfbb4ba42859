"""Kernels as plain Python: what LLVM's vectors compute, NumPy computes, and nothing is compiled.

A plug-in for pytest (``-p interpreted``, loaded before rodwell), for what looks at many slightly different kernels: a
changed line of a kernel costs a minute of compilation, and here none. Tests take up to a hundred times as long, so

- ``INTERPRETED=no`` leaves the kernels compiled, for changes of what no kernel is made of;
- ``MOST_SECONDS`` of the processor may go by in a test before it fails;
- ``SECONDS_OUT`` names a file to which what each test took, and its outcome, is written; in a file of tests most of
  which fail or take too long, the others are given less time then.
"""

from __future__ import annotations

import inspect
import os
import signal
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

if os.environ.get("INTERPRETED") != "no":
    os.environ["NUMBA_DISABLE_JIT"] = "1"

import numba
import numba.extending
import numpy as np
import pytest

numba.core.config.reload_config()  # where Numba was there before


def _flat(array: Any) -> Any:
    """The numbers of a contiguous array, to read and to write."""
    flat = array.view()
    flat.shape = (array.size,)
    return flat


class _Rows:
    """A formula's first argument: ``rows[i]`` are its i-th numbers, at places side by side."""

    def __init__(self, rows: Any, count: int) -> None:
        self.flat, self.count = _flat(rows), count

    def __getitem__(self, i: int) -> Any:
        return self.flat[i * self.count : (i + 1) * self.count]


def _apply(intrinsic: Callable[..., Any]) -> Callable[..., Any]:
    formula_of = inspect.getclosurevars(intrinsic).nonlocals["formula_of"]

    def apply(model: Any, tag: Any, rows: Any, uniforms: Any, out: Any) -> None:
        formula = formula_of(type(model) if hasattr(model, "_fields") else numba.typeof(model))
        count, to = len(tag), _flat(out)
        results = [np.array(x, dtype=float) for x in formula(_Rows(rows, count), *map(_flat, uniforms))]
        for i, result in enumerate(results):
            to[i * count : (i + 1) * count] = result

    return apply


def _dots(model, local_tag, count_tag, table, row, step, c, start, out, at):  # type: ignore[no-untyped-def]
    local, fields, count = len(local_tag), len(model), len(count_tag)
    rows = _flat(table).reshape(-1, local)[row : row + step * (count - 1) + 1 : step]
    _flat(out)[at : at + count] = rows @ c[start : start + fields * (local - 1) + 1 : fields]


def _congruence(model, tags, table, start, terms, e, f, product):  # type: ignore[no-untyped-def]
    local, points = map(len, tags)
    size = 3 * len(model)
    basis = _flat(table)[start * 3 * local :][: points * 3 * local].reshape(points, 3, local)
    rows = _flat(terms)[: (2 + size * (2 + size)) * points].reshape(-1, points)
    hessian = rows[2 + 2 * size :].reshape(size, size, points)[3 * e : 3 * e + 3, 3 * f : 3 * f + 3]
    left = np.einsum("dkq,qkb->qdb", hessian, basis)
    product[:local] = basis.reshape(-1, local).T @ left.reshape(-1, local)
    for i in range(2):  # gradient, mixed derivatives
        first = 2 + i * size + 3 * f
        product[local + i] = np.einsum("dq,qda->a", rows[first : first + 3], basis)


def _add_element(tags, product, start, gradient, mixed, band):  # type: ignore[no-untyped-def]
    local = len(tags[0])
    gradient[start : start + local] += product[local]
    mixed[start : start + local] += product[local + 1]
    for b in range(local):
        band[start + b, : local - b] += product[b, b:]


def _subtract(out, at, scale, x, start, count):  # type: ignore[no-untyped-def]
    _flat(out)[at : at + count] -= scale * _flat(x)[start : start + count]


TWINS = {"dots": _dots, "congruence": _congruence, "add_element": _add_element, "subtract": _subtract}
"""What is called instead of the functions of these names in ``numerics/splines/products``."""


def _intrinsic(function: Callable[..., Any]) -> Callable[..., Any]:
    return _apply(function) if function.__name__ == "apply" else TWINS[function.__name__]


if os.environ.get("INTERPRETED") != "no":
    numba.extending.intrinsic = _intrinsic

MOST_SECONDS = float(os.environ.get("MOST_SECONDS", "0"))
"""Of a test with what it makes first; 0: as many as it takes."""

MOST_FAILED, LESS = 4, 0.2
"""Tests that fail, or take too long, before the rest of their file has so much less time, if more fail than pass."""

_outcomes: dict[str, str] = {}
_passed: Counter[Path] = Counter()
_failed: Counter[Path] = Counter()


class TooLongError(BaseException):
    """A test has taken all the time that it was given; nobody but pytest should catch it, Hypothesis above all."""


def _rung(*_: object) -> None:
    raise TooLongError(f"more than {MOST_SECONDS:g} s")


if MOST_SECONDS and hasattr(signal, "SIGPROF"):
    signal.signal(signal.SIGPROF, _rung)


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: Any) -> Iterator[None]:
    """Write what a test took."""
    start = time.process_time()
    yield
    if "SECONDS_OUT" in os.environ:
        with Path(os.environ["SECONDS_OUT"]).open("a", encoding="utf-8") as file:
            outcome = _outcomes.pop(item.nodeid, "passed")
            file.write(f"{time.process_time() - start:.3f} {outcome} {item.nodeid}\n")
        {"passed": _passed, "failed": _failed}.get(outcome, Counter())[item.path] += 1


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: Any) -> Iterator[None]:
    """Keep how a test ended."""
    report = (yield).get_result()  # type: ignore[misc]
    if report.outcome != "passed":
        _outcomes[item.nodeid] = report.outcome


@pytest.hookimpl(hookwrapper=True)
def _limited(item: Any) -> Iterator[None]:
    slow = "SECONDS_OUT" in os.environ and _failed[item.path] >= max(MOST_FAILED, _passed[item.path])
    signal.setitimer(signal.ITIMER_PROF, MOST_SECONDS * (LESS if slow else 1.0))
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)


if MOST_SECONDS:
    pytest_runtest_setup = pytest_runtest_call = _limited
