"""Errors that users see. Each says what is wrong, what is allowed, and what to do."""

from __future__ import annotations

import difflib
import math
import operator
import unicodedata
import warnings
from collections.abc import Iterable

LONGEST_VALUE, LONGEST_REASON = 200, 5000
"""Characters of a name or value, and of what is wrong with it, in a message: a file can hold keys of any length."""

JOINERS = "\u200c\u200d"
"""Characters without width that some scripts need within words."""


class RodwellError(Exception):
    """Base of all errors that rodwell raises on purpose."""


class InputError(RodwellError):
    """An input that cannot be used.

    Parameters
    ----------
    field
        Name of the input, as the user wrote it.
    value
        What was given.
    reason
        Why it cannot be used: what is allowed, and what to do.
    """

    def __init__(self, field: str, value: object, reason: str) -> None:
        self.field, self.value, self.reason = field, value, reason
        given = "" if value is None else f" = {_short(value)}"
        why = "\n".join(printable(line) for line in _cut(reason, LONGEST_REASON).split("\n"))
        super().__init__(f"{printable(_cut(field, LONGEST_VALUE))}{given}: {why}")

    @property
    def problem(self) -> str:
        """The old name of ``reason``: a problem is a :class:`rodwell.Problem`."""
        warnings.warn("InputError.problem is now InputError.reason", DeprecationWarning, stacklevel=2)
        return self.reason


def printable(text: str) -> str:
    r"""Return text that is harmless wherever it is shown: what cannot be printed is replaced by its escape.

    A terminal's escape sequences, NUL and other control characters, marks that turn the direction of writing, and
    halves of characters become visible, ``\x1b``; line breaks and tabs become spaces. Text that is printable stays as
    it is, so that nothing changes the second time.
    """
    if text.isprintable():
        return text
    return "".join(_printable(character) for character in text)


def _printable(character: str) -> str:
    if character.isprintable() or character in JOINERS or unicodedata.category(character) == "Zs":
        return character
    return " " if character.isspace() else character.encode("unicode_escape").decode("ascii")


def _short(value: object) -> str:
    """A value as it would be written, cut where it is very long."""
    text = "a very long number" if isinstance(value, int) and abs(value) >= 10**40 else repr(value)
    return _cut(text, LONGEST_VALUE)


def _cut(text: str, most: int) -> str:
    return text if len(text) <= most else text[: most - 1] + "…"


def checked_number(field: str, value: object, low: float, high: float, allowed: str) -> float:
    """Return ``value`` as a float in [low, high], or raise an InputError that says what is ``allowed``."""
    if isinstance(value, bool) or not hasattr(value, "__float__"):
        raise InputError(field, value, f"must be a number: {allowed}")
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(field, value, f"must be a number: {allowed}") from None
    if not math.isfinite(number):
        raise InputError(field, value, f"must be finite: {allowed}")
    if not low <= number <= high:
        raise InputError(field, value, f"must be {allowed}")
    return number


def checked_whole(field: str, value: object, low: int, high: int) -> int:
    """Return ``value`` as an int in [low, high], or raise an InputError."""
    allowed = f"must be a whole number from {low} to {high}"
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise InputError(field, value, allowed)
    number = operator.index(value)
    if not low <= number <= high:
        raise InputError(field, value, allowed)
    return number


def unknown_name(field: str, name: object, known: Iterable[str]) -> InputError:
    """The error for a name that is not among those ``known``: the nearest one if there is one, else all."""
    names = list(known)
    near = difflib.get_close_matches(str(name), names, n=1)
    return InputError(field, name, f"did you mean {near[0]!r}?" if near else f"must be one of {', '.join(names)}")


class NotConvergedError(RodwellError):
    """A result that could not be computed to the tolerance asked for, with the reason."""


class InputWarning(UserWarning):
    """An input that is taken as it stands, but is rarely meant so: the message says what may have been meant."""


class CacheWarning(UserWarning):
    """Compiled kernels could not be read from disk, or not be kept there: that costs time; results are the same."""
