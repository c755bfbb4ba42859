"""Signs of forces that contradict what the force is called: questioned, taken where a word says that they are meant.

Tension is positive everywhere. Who writes "20 klbf" for the weight on bit means a push, and a rod in tension does not
buckle: the wrong sign is on the unsafe side, and nothing else would show it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rodwell.case.applied import AppliedLoad
from rodwell.errors import InputError
from rodwell.problem.problem import Problem
from rodwell.quantities.written import direction


def unsigned(text: str) -> str:
    """A force as it was written, without its sign."""
    return text.strip().replace("−", "-").lstrip("+-").strip()


def pulls(field: str, text: str, where: str) -> InputError:
    """The error for a pull where a push is usual, with how to write either."""
    return InputError(
        field,
        text,
        f'reads as tension{where}. Compression is negative: write "-{unsigned(text)}" for a push; '
        f'if a pull is meant, say so: "{unsigned(text)} tension"',
    )


def pushes(field: str, text: str, where: str) -> InputError:
    """The error for a push where a pull is usual, with how to write either."""
    return InputError(
        field,
        text,
        f'reads as compression{where}. Tension is positive: write "{unsigned(text)}" for a pull; '
        f'if a push is meant, say so: "{unsigned(text)} compression"',
    )


def check_loads(load: Mapping[str, Any], problem: Problem, applied: tuple[AppliedLoad, ...]) -> None:
    """Question loads that leave the whole rod in tension, where nothing can buckle without twist.

    ``load.until`` is no load that acts: it says how far branches are followed.

    Parameters
    ----------
    load
        [load] as it was written.
    problem, applied
        The rod, and its effective end forces at s = 1 in B/L², tension positive.

    Raises
    ------
    InputError
        For ``load.applied``, with how to write a push and how to say that a pull is meant.
    """
    given = load.get("applied")
    written = given if isinstance(given, list | tuple) else [given]
    for text, one in zip(written, applied, strict=False):
        if problem.twist != 0.0 or not isinstance(text, str) or direction(text)[1] or one.given <= 0.0:
            continue
        if one.force > 0.0 and one.force - problem.hung_weight > 0.0:
            raise pulls("load.applied", text, " all along the rod, where nothing buckles")
