"""Errors that users see. Each says what is wrong, what is allowed, and what to do."""

from __future__ import annotations


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
    problem
        What is allowed, and what to do.
    """

    def __init__(self, field: str, value: object, problem: str) -> None:
        self.field, self.value, self.problem = field, value, problem
        given = "" if value is None else f" = {value!r}"
        super().__init__(f"{field}{given}: {problem}")


class NotConvergedError(RodwellError):
    """A result that could not be computed to the tolerance asked for, with the reason."""
