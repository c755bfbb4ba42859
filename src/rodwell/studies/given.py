"""How every parameter study begins: a file, what varies in it, and the grid of its points."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from rodwell.case.case import CaseError
from rodwell.case.file import CaseText, printable_data, read_case
from rodwell.errors import InputError
from rodwell.studies.varied import Varied

Given = str | Path | CaseText | Mapping[str, Any]
"""Path of a file, the file read, or its content as a dictionary."""


def read_given(given: Given, name: str, what: str) -> CaseText:
    """Return a file as it was read; a dictionary stands for one that was not written.

    Raises
    ------
    InputError
        If it cannot be read, or is none of these; ``name`` is that of the argument, ``what`` what it is the path of.
    """
    if isinstance(given, CaseText):
        return given
    if isinstance(given, Mapping):
        return CaseText(printable_data(given), "", "study", "study", Path.cwd())
    if not isinstance(given, str | Path):
        raise InputError(name, given, f"must be the path of {what}, or its content as a dictionary")
    return read_case(given)


def what_varies(
    read: CaseText,
    check_declared: Callable[[Mapping[str, Any]], None] | None,
    varied_inputs: Callable[[Mapping[str, Any]], tuple[Varied, ...]],
    example: str,
) -> tuple[Varied, ...]:
    """Return the inputs of a file that vary, one or two.

    ``check_declared`` refuses lists in a file that does not say that it is a study; None for a dictionary, where they
    are meant. ``example`` is a range, for those who have none.

    Raises
    ------
    CaseError
        If none varies, or one cannot.
    """
    try:
        if check_declared is not None:
            check_declared(read.data)
        varied = varied_inputs(read.data)
    except InputError as error:
        raise CaseError(read.source, [(error.field, error.value, error.reason)]) from None
    if not varied:
        what = f"has no input that varies: give one a list, or a range{example}"
        raise CaseError(read.source, [("study", None, what)])
    return varied


def grid_of(varied: tuple[Varied, ...]) -> list[tuple[int, ...]]:
    """All points, by the number of each input's value; the last input varies fastest."""
    return list(itertools.product(*(range(len(v.values)) for v in varied)))


def in_words(varied: tuple[Varied, ...], at: tuple[int, ...]) -> str:
    """The varied inputs of a point in words."""
    return ", ".join(f"{v.called} {v.text(i)}" for v, i in zip(varied, at, strict=True))
