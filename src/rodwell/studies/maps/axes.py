"""The parameters of a map: ranges, also logarithmic, lists, and distributions from which samples are drawn."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.text import minus
from rodwell.quantities.written import number_and_rest
from rodwell.studies.ranges import LONGEST_RANGE, RANGE, in_unit, read_range, tidy

MOST_VALUES = 100_000
"""Values that one parameter may take."""

LOG = re.compile(r"\s+log\s*\Z")
"""What makes a range logarithmic."""

LONGEST_LIST = 100_000
"""Characters that a list as text may have."""

_CALL = re.compile(r"\s*([a-z_]+)\s*\((.*)\)\s*")
_BETWEEN = re.compile(r"\s*;\s*|,\s+")

SYMBOLS = {
    "weight": ("weight γ = mg L³/B", "1"),
    "alpha": ("angle of the cylinder from the vertical", "degree"),
    "clearance": ("clearance Δ/L", "1"),
    "twist": ("end twisting moment T₁", "B/L"),
    "poisson": ("Poisson's ratio", "1"),
    "torsion": ("torsional stiffness C/B", "1"),
    "load": ("end force at s = 1, tension positive", "B/L^2"),
    "ends": ("end conditions at s = 0 and s = 1", "1"),
}
"""Name and unit of the parameters of a problem; those of a case have its key and their own unit."""

ALLOWED = (
    'write a range, "5..200 in 40" or "1..300 in 40 log", a list, "5, 10, 20", or a distribution, "normal(100, 5)", '
    '"uniform(5, 200)", "loguniform(1, 300)", "triangular(5, 20, 50)"'
)


@dataclass(frozen=True)
class Axis:
    """A parameter that takes given values.

    Attributes
    ----------
    name
        Of the problem ("weight") or the case ("rod.length").
    values
        What problem or case gets, one after the other: numbers, texts with a unit, or names.
    numbers
        The values as numbers in ``unit``; None where they are names (end conditions).
    unit
        That of the numbers, "" for plain numbers.
    logarithmic
        Whether values in between are sought in the logarithm.
    """

    name: str
    values: tuple[Any, ...]
    numbers: tuple[float, ...] | None
    unit: str = ""
    logarithmic: bool = False

    def value(self, number: float) -> Any:
        """What problem or case gets for a number in the unit of this axis."""
        return f"{number!r} {self.unit}" if self.unit else number


@dataclass(frozen=True)
class Distribution:
    """A parameter that is drawn at random.

    Attributes
    ----------
    name
        As for :class:`Axis`.
    kind
        A key of :data:`KINDS`.
    arguments
        Its numbers, in ``unit``.
    unit
        "" for plain numbers.
    """

    name: str
    kind: str
    arguments: tuple[float, ...]
    unit: str = ""

    @property
    def text(self) -> str:
        """As it is written."""
        numbers = ", ".join(f"{number:g}" for number in self.arguments)
        return minus(f"{self.kind}({numbers}){f' {self.unit}' if self.unit else ''}")

    def at(self, share: FloatArray) -> FloatArray:
        """Values below which given shares of all draws lie, (n,); the inverse of the distribution."""
        return np.asarray(KINDS[self.kind].inverse(share, *self.arguments))


@dataclass(frozen=True)
class Kind:
    """A kind of distribution: its arguments in words, which arguments it allows, and its inverse."""

    arguments: tuple[str, ...]
    allowed: str
    allows: Callable[..., bool]
    inverse: Callable[..., Any]


def _normal(share: FloatArray, mean: float, deviation: float) -> Any:
    from scipy.special import ndtri  # noqa: PLC0415

    return mean + deviation * ndtri(share)


def _triangular(share: FloatArray, low: float, likeliest: float, high: float) -> Any:
    turn = (likeliest - low) / (high - low)
    rising = low + np.sqrt(share * (high - low) * (likeliest - low))
    return np.where(share < turn, rising, high - np.sqrt((1.0 - share) * (high - low) * (high - likeliest)))


KINDS: dict[str, Kind] = {
    "uniform": Kind(("least", "largest"), "least below largest", lambda a, b: a < b, lambda u, a, b: a + (b - a) * u),
    "loguniform": Kind(("least", "largest"), "0 < least < largest", lambda a, b: 0.0 < a < b,
                       lambda u, a, b: np.exp(np.log(a) + np.log(b / a) * u)),
    "normal": Kind(("mean", "standard deviation"), "a deviation above 0", lambda _, b: b > 0.0, _normal),
    "triangular": Kind(("least", "likeliest", "largest"), "least ≤ likeliest ≤ largest, not all equal",
                       lambda a, b, c: a <= b <= c and a < c, _triangular),
}  # fmt: skip
"""Distributions by name."""


def read(name: str, given: Any) -> Axis | Distribution | None:
    """Read what is given for a parameter; None for a single value, which does not vary.

    Raises
    ------
    InputError
        Naming the parameter, for what cannot be read.
    """
    if isinstance(given, str):
        return _from_text(name, given)
    if isinstance(given, Sequence | np.ndarray):
        return _from_list(name, list(given))
    return None


def about_parameter(name: str, unit: str) -> dict[str, str]:
    """What a parameter is and the unit of its values, for files: ``unit``, or that of a parameter of a problem."""
    label, own = SYMBOLS.get(name, (name, "1"))
    return {"long_name": label, "units": unit or own}


def varies(text: str) -> bool:
    """Whether a text of a case file is meant as a range or a distribution."""
    if len(text) > LONGEST_RANGE:
        return False
    call = _CALL.fullmatch(text)
    return (call is not None and call[1] in KINDS) or RANGE.fullmatch(LOG.sub("", text)) is not None


def _from_text(name: str, text: str) -> Axis | Distribution | None:
    if len(text) > LONGEST_LIST:
        raise InputError(name, text, f"is too long; {ALLOWED}")
    call = _CALL.fullmatch(text) if len(text) <= LONGEST_RANGE else None
    if call is not None and (call[1] in KINDS or re.match(r"\s*[-+−.\d]", call[2])):
        return _distribution(name, text, call[1], call[2])
    if ".." in text and len(text) <= LONGEST_RANGE and re.search(r"\sin\s", text):
        return _range(name, text)
    if ".." in text and number_and_rest(text.partition("..")[0]) is not None:
        raise InputError(name, text, f"does not say how many values; {ALLOWED}")
    parts = _BETWEEN.split(text.strip().removeprefix("[").removesuffix("]"))
    return _from_list(name, [part.strip().strip("\"'") for part in parts]) if len(parts) > 1 else None


def _range(name: str, text: str) -> Axis:
    logarithmic = LOG.search(text) is not None
    read = read_range(name, LOG.sub("", text), text, MOST_VALUES, ALLOWED)
    first, last = read.first, read.last
    if logarithmic and not (first > 0.0 and last > 0.0):
        raise InputError(name, text, "is logarithmic: both ends must be above 0")
    spaced = np.geomspace(first, last, read.count) if logarithmic else np.linspace(first, last, read.count)
    numbers = tuple(tidy(float(number)) for number in spaced)
    axis = Axis(name, (), numbers, read.unit, logarithmic)
    return Axis(name, tuple(axis.value(number) for number in numbers), numbers, read.unit, logarithmic)


def _from_list(name: str, given: list[Any]) -> Axis:
    if not 2 <= len(given) <= MOST_VALUES or any(isinstance(one, bool | list | tuple | dict) for one in given):
        raise InputError(name, given, f"must hold from 2 to {MOST_VALUES} single values; {ALLOWED}")
    if all(isinstance(one, int | float | np.number) for one in given):
        numbers = tuple(float(one) for one in given)
        if not all(map(math.isfinite, numbers)):
            raise InputError(name, given, "must hold finite numbers")
        return Axis(name, numbers, numbers)
    read_parts = [number_and_rest(one) if isinstance(one, str) else None for one in given]
    parts = [part for part in read_parts if part is not None]
    if len(parts) < len(given):
        return Axis(name, tuple(given), None)  # names, such as end conditions; what is wrong with one a cell will say
    unit = parts[0][1]
    try:
        numbers = tuple(in_unit(part[1] or unit, unit, part[0]) for part in parts)
    except ValueError as error:
        raise InputError(name, given, f"{error}; {ALLOWED}") from None
    axis = Axis(name, (), numbers, unit)
    return Axis(name, tuple(axis.value(number) for number in numbers), numbers, unit)


def _distribution(name: str, text: str, kind: str, inside: str) -> Distribution:
    if kind not in KINDS:
        raise InputError(name, text, f"{kind!r} is no distribution; there are {', '.join(KINDS)}")
    needs, parts = KINDS[kind], [number_and_rest(part) for part in _BETWEEN.split(inside)]
    known = [part for part in parts if part is not None]
    what = f"needs {len(needs.arguments)} numbers, {', '.join(needs.arguments)}, with blanks after the commas"
    if len(known) != len(parts) or len(known) != len(needs.arguments):
        raise InputError(
            name, text, f'{what}: for example "{kind}({", ".join(["5", "10", "20"][: len(needs.arguments)])})"'
        )
    unit = known[-1][1]
    try:
        numbers = tuple(in_unit(part[1] or unit, unit, part[0]) for part in known)
    except ValueError as error:
        raise InputError(name, text, str(error)) from None
    if not all(map(math.isfinite, numbers)) or not needs.allows(*numbers):
        raise InputError(name, text, f"needs {needs.allowed}")
    return Distribution(name, kind, numbers, unit)


def drawn(distributions: Sequence[Distribution], count: int, sampling: str, seed: int) -> FloatArray:
    """Draw ``count`` samples of all distributions together, independent of each other, (count, distributions).

    ``sampling`` is "sobol", a Sobol sequence, which fills the range evenly, moved round by a random shift, or "random".
    """
    generator = np.random.default_rng(seed)
    if sampling == "random":
        shares = generator.random((count, len(distributions)))
    else:
        from scipy.stats import qmc  # noqa: PLC0415 - slow to import

        points = qmc.Sobol(len(distributions), scramble=False).random_base2(math.ceil(math.log2(max(count, 2))))
        shares = (points[:count] + generator.random(len(distributions))) % 1.0  # turned round, so that seeds differ
    shares = np.clip(shares, 1e-15, 1.0 - 1e-15)
    return np.column_stack([one.at(shares[:, i]) for i, one in enumerate(distributions)])
