"""What varies along a branch or a curve: one number of a problem, or several along a path of one's own."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from rodwell.errors import InputError, checked_number, unknown_name
from rodwell.problem.checks import LIMITS
from rodwell.problem.problem import Problem

FORCE = "force"
"""The end force, which a problem does not hold."""

NUMBERS = (FORCE, "weight", "alpha", "clearance", "twist", "poisson", "torsion", "build", "walk")
"""What may vary, by name: F, γ, α in degrees, Δ/L, T₁, ν, C/B, curvatures of the hole in 1/L."""

CURVATURES = ("build", "walk")
"""Those of them in which loads can be followed, but no branch."""

PLACES = tuple(0.5 * (1.0 - math.cos(math.pi * (k + 0.25) / 8.5)) for k in range(9))
"""Where on a path it is looked at what holds all along it, as parts of its range: at no round place."""

SAME = 1e-9
"""Relative difference of numbers up to which a state lies on a path."""

Along = Mapping[str, Callable[[float], float] | tuple[float, float]] | Callable[[float], Mapping[str, float]]


@dataclass(frozen=True, eq=False)
class ParameterPath:
    """A path of one's own in the space of parameters, along which a branch or a curve can be followed.

    Parameters
    ----------
    numbers
        The numbers that vary, as smooth functions of t: a mapping from their names to functions, each of which may be
        two numbers, from the one to the other in a straight line; or one function that returns all of them by name.
        Names are "weight", "alpha" (degrees), "clearance", "twist", "poisson", "torsion", of curves "build" and "walk"
        (1/L), and of branches "force", the end force at s = 1 in B/L², tension positive. What is not named stays
        constant.
    limits
        The first t, at which the state to start from lies, and the last.
    name
        What t is called.

    Raises
    ------
    InputError
        If something of this is missing or not of this kind.
    """

    numbers: Along
    limits: tuple[float, float] = (0.0, 1.0)
    name: str = "t"

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name or self.name in NUMBERS:
            raise InputError("name", self.name, f"must be a text of its own, none of {', '.join(NUMBERS)}")
        if not isinstance(self.limits, tuple | list) or len(self.limits) != 2:
            raise InputError("limits", self.limits, "must be two numbers, the first and the last t")
        first, last = (checked_number("limits", t, -1e12, 1e12, "two finite numbers") for t in self.limits)
        if first == last:
            raise InputError("limits", self.limits, "must differ: the first and the last t")
        object.__setattr__(self, "limits", (first, last))
        if isinstance(self.numbers, Mapping):
            for name, along in self.numbers.items():
                if not (callable(along) or (isinstance(along, tuple | list) and len(along) == 2)):
                    raise InputError(str(name), along, "must be a function of t, or two numbers: from and to")
        elif not callable(self.numbers):
            raise InputError("parameter", self.numbers, "must be a name, a mapping of functions of t, or one function")
        for name in self.names:
            if name not in NUMBERS:
                raise unknown_name("parameter", name, NUMBERS)

    def __str__(self) -> str:
        return self.name

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the numbers on the path."""
        found = self.numbers if isinstance(self.numbers, Mapping) else self.at(self.limits[0])
        if not found:
            raise InputError("parameter", self.numbers, "must name at least one number that varies")
        return tuple(map(str, found))

    def at(self, t: float) -> dict[str, float]:
        """Return the numbers at ``t``, by name."""
        if not isinstance(self.numbers, Mapping):
            found = self.numbers(t)
            if not isinstance(found, Mapping) or ("names" in self.__dict__ and set(found) != set(self.names)):
                raise InputError("parameter", found, f"must be the same numbers by name at every t, also at {t:g}")
            given = dict(found)
        else:
            given = {name: self._one(along, t) for name, along in self.numbers.items()}
        finite = f"a finite number at every t, also at {self.name} = {t:g}"
        return {name: checked_number(name, value, -1e300, 1e300, finite) for name, value in given.items()}

    def _one(self, along: Callable[[float], float] | tuple[float, float], t: float) -> float:
        if callable(along):
            return along(t)
        first, last = self.limits
        share = (t - first) / (last - first)
        return along[0] if share == 0.0 else along[1] if share == 1.0 else along[0] + share * (along[1] - along[0])

    def problem(self, problem: Problem, t: float) -> Problem:
        """Return a problem with its numbers as they are at ``t``."""
        numbers = self.at(t)
        numbers.pop(FORCE, None)
        try:
            return problem.but(**numbers)
        except InputError as error:
            raise InputError(
                error.field, numbers.get(error.field), f"{error.reason} (at {self.name} = {t:g})"
            ) from None

    def force(self, t: float, otherwise: float) -> float:
        """Return the end force at ``t``: ``otherwise`` where the path leaves it alone."""
        return self.at(t).get(FORCE, otherwise)

    def misses(self, problem: Problem, force: float, t: float) -> str:
        """What at ``t`` differs from a problem and an end force, in words; empty if nothing does."""
        here = {FORCE: force} | {name: getattr(problem, name) for name in self.names if name != FORCE}
        return ", ".join(
            f"{name} = {value:.10g} at {self.name} = {t:g}, {here[name]} there"
            for name, value in self.at(t).items()
            if here[name] is None or abs(value - here[name]) > SAME * max(abs(value), abs(here[name]))
        )


Parameter = str | ParameterPath
"""What varies: the name of a number, or a path."""


def checked_parameter(parameter: Parameter | Along, known: Iterable[str]) -> Parameter:
    """Return a name that is among those ``known``, or a path, or raise."""
    if isinstance(parameter, ParameterPath):
        return parameter
    if isinstance(parameter, str):
        names = tuple(known)
        if parameter not in names:
            raise unknown_name("parameter", parameter, names)
        return parameter
    return ParameterPath(parameter)


def varied(problem: Problem, parameter: Parameter, value: float) -> Problem:
    """Return a problem with a parameter at a value."""
    if isinstance(parameter, ParameterPath):
        return parameter.problem(problem, value)
    return problem if parameter == FORCE else problem.but(**{parameter: value})


def words_for(parameter: Parameter) -> str:
    """What varies, in words."""
    return " and ".join(parameter.names) if isinstance(parameter, ParameterPath) else parameter


def limits_of(parameter: Parameter) -> tuple[float, float]:
    """Lowest and highest value of a parameter other than the force."""
    if isinstance(parameter, ParameterPath):
        first, last = sorted(parameter.limits)
        return first, last
    return LIMITS[parameter][:2]


def throughout(problem: Problem, *parameters: Parameter) -> tuple[Problem, ...]:
    """Problems that have what a problem has for any value of parameters: all of its symmetries, and no others."""
    found: tuple[Problem, ...] = (problem,)
    for parameter in parameters:
        if isinstance(parameter, ParameterPath):
            first, last = parameter.limits
            places = [first + share * (last - first) for share in PLACES]
            found = tuple(parameter.problem(one, t) for one in found for t in places)
        elif parameter in ELSEWHERE:
            found = tuple(one.but(**{parameter: ELSEWHERE[parameter]}) for one in found)
    return found


ELSEWHERE = {"weight": 1.0, "alpha": 40.0, "twist": 1.0, "build": 0.1, "walk": 0.1}
"""Values at which a problem has no more symmetry than at any other; on the other parameters none depends."""
