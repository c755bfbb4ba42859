"""Curves in two parameters: where something happens, as a second parameter varies."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.family import TORSIONAL
from rodwell.errors import InputError, checked_number
from rodwell.faces import drawn
from rodwell.problem.checks import LIMITS, SMALLEST_CLEARANCE
from rodwell.problem.problem import Problem
from rodwell.problem.varying import (
    CURVATURES,
    FORCE,
    Along,
    Parameter,
    ParameterPath,
    checked_parameter,
    limits_of,
    varied,
    words_for,
)
from rodwell.problem.words import ends_text
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.names import UNITS
from rodwell.quantities.table import Variable

if TYPE_CHECKING:
    import xarray as xr

    from rodwell.faces import Axes

OVER = ("weight", "alpha", "clearance", "twist", *TORSIONAL, *CURVATURES)
"""Parameters over which curves can be traced."""

OF_THE_AXIS = ("alpha", *CURVATURES)
"""Those of them that an axis through points has already."""

DOUBLE_POINT, VEERING, SWITCH, TURN = "double_point", "veering", "switch", "turn"

Progress = Callable[[float], None]
"""Called with the part of the range that is done."""


@dataclass(frozen=True)
class CurvePoint:
    """A point of a curve.

    Attributes
    ----------
    x
        The parameter over which the curve runs.
    value, error
        The load (end force at s = 1 in B/L², tension positive) or twist (B/L), and the estimate of its error.
    s
        Places that touch last (lift-off), else empty.
    converged
        Whether all that was measured meets the tolerance.
    solution
        The state; None for the straight rod.
    x_error
        Estimate of the error of x, where the curve is so steep that x is solved for too; else 0.
    """

    x: float
    value: float
    error: float
    s: tuple[float, ...] = ()
    converged: bool = True
    solution: Solution | None = field(default=None, repr=False)
    x_error: float = 0.0


@dataclass(frozen=True)
class Mark:
    """Something special on a curve.

    Attributes
    ----------
    kind
        "double_point" (two critical loads are equal: modes switch), "veering" (two critical loads come closest without
        meeting), "switch" (two places lift off at once, and the curve goes on, at a corner, with the other one), or
        "turn" (the curve turns back in its parameter).
    x, x_error
        Where, and the estimate of its error.
    value, error
        The load or twist there, and the estimate of its error.
    note
        Which modes or places, and how close.
    """

    kind: str
    x: float
    x_error: float
    value: float
    error: float
    note: str = ""


@dataclass(frozen=True)
class Curve:
    """A load (or twist) as a function of another parameter, each point converged on its own.

    Attributes
    ----------
    kind
        "critical", "lift-off", "secondary" or "twist".
    name
        Which mode it belongs to.
    problem
        The problem, at the start.
    over
        Parameter over which it runs, or a path of one's own.
    points
        In order along the curve.
    marks
        Special points, in the same order.
    ended_because
        Why it ended, "end" if it reached the end of the range.
    """

    kind: str
    name: str
    problem: Problem
    over: Parameter
    points: tuple[CurvePoint, ...]
    marks: tuple[Mark, ...] = ()
    ended_because: str = "end"

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        return f"<Curve {self.kind}, {self.name}: {len(self)} points, {self.over} = {self.x[0]:.6g} … {self.x[-1]:.6g}>"

    @cached_property
    def x(self) -> FloatArray:
        """The parameter, (n,)."""
        return np.array([p.x for p in self.points])

    @cached_property
    def values(self) -> FloatArray:
        """The load or twist, (n,)."""
        return np.array([p.value for p in self.points])

    @cached_property
    def errors(self) -> FloatArray:
        """Error estimates of :attr:`values`, (n,)."""
        return np.array([p.error for p in self.points])

    @property
    def converged(self) -> bool:
        """Whether every point meets the tolerance."""
        return all(p.converged for p in self.points)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the curve on ``ax``, or on new axes of pyplot; return the axes."""
        return drawn(self, ax)

    @property
    def quantity(self) -> str:
        """What is plotted: "force" or "twist"."""
        return "twist" if self.kind == "twist" else "force"

    def as_dict(self) -> dict[str, Any]:
        """Return the curve as plain data, for JSON."""
        return {
            "kind": self.kind,
            "name": self.name,
            "over": str(self.over),
            "quantity": self.quantity,
            "convention": convention(self.problem, self.quantity),
            "converged": self.converged,
            "ended_because": self.ended_because,
            "points": [
                {
                    str(self.over): float(p.x),
                    self.quantity: float(p.value),
                    "error": float(p.error),
                    f"{self.over}_error": float(p.x_error),
                    "s": list(p.s),
                    "converged": bool(p.converged),
                    **({"at": self.over.at(p.x)} if isinstance(self.over, ParameterPath) else {}),
                }
                for p in self.points
            ],
            "marks": [
                {
                    "kind": m.kind,
                    str(self.over): float(m.x),
                    f"{self.over}_error": float(m.x_error),
                    self.quantity: float(m.value),
                    "error": float(m.error),
                    "note": m.note,
                }
                for m in self.marks
            ],
        }

    @cached_property
    def dataset(self) -> xr.Dataset:
        """The points as an xarray Dataset."""
        import xarray as xr  # noqa: PLC0415 - slow to import

        return xr.Dataset(dict(self.variables()), attrs=self.attributes())

    def variables(self) -> dict[str, Variable]:
        """Labelled arrays: dimensions, values, metadata."""
        unit = UNITS["force" if self.quantity == "force" else "moment"]
        text = [", ".join(f"{s:.9g}" for s in p.s) for p in self.points]
        about = {"long_name": convention(self.problem, self.quantity), "units": unit}
        if isinstance(self.over, ParameterPath):
            t = {"long_name": f"t on a path: {words_for(self.over)}"}
            over = {str(self.over): Variable(("point",), self.x, t)} | numbers_on(self.over, self.x)
        else:
            over = {self.over: Variable(("point",), self.x, {"long_name": LIMITS[self.over][2]})}
        return {
            **over,
            self.quantity: Variable(("point",), self.values, about),
            "error": Variable(("point",), self.errors, {"long_name": "error estimate", "units": unit}),
            "s": Variable(("point",), np.array(text, dtype=object), {"long_name": "places that lift off, s/L"}),
            "converged": Variable(
                ("point",),
                np.array([p.converged for p in self.points], dtype=np.int8),
                {"long_name": "1 if the point meets the tolerance"},
            ),
        }

    def attributes(self) -> dict[str, Any]:
        """What the arrays belong to."""
        return {
            "title": f"{self.kind} curve over {self.over}, {self.name}",
            **{k: getattr(self.problem, k) for k in ("weight", "alpha", "clearance", "poisson", "twist", "turns")},
            "on_top": int(self.problem.on_top),
            "outside": int(self.problem.outside),
            "floats": int(self.problem.floats),
            "ends": "-".join(self.problem.ends),
            **self.problem.attributes,
            "ended_because": self.ended_because,
        }


def numbers_on(path: ParameterPath, places: FloatArray) -> dict[str, Variable]:
    """Labelled arrays of the numbers on a path at each t of ``places`` (n,), but for the end force."""
    numbers = [path.at(float(t)) for t in places]
    return {
        name: Variable(("point",), np.array([at[name] for at in numbers]), {"long_name": LIMITS[name][2]})
        for name in path.names
        if name != FORCE
    }


def convention(problem: Problem, quantity: str) -> str:
    """Sign, unit, end and end conditions of what a curve shows."""
    what = (
        "end force at s = 1 in B/L², tension positive"
        if quantity == "force"
        else "end twisting moment T₁ at s = 1 in B/L, a dead load"
    )
    return f"{what}; {ends_text(problem)}"


def checked_range(
    problem: Problem, over: Parameter | Along, limits: Sequence[float], allowed: Sequence[str] = OVER
) -> tuple[Parameter, float, float]:
    """Return a parameter, and start and end of a range of it that the problem allows, or raise."""
    over = over if isinstance(over, str) else checked_parameter(over, allowed)
    for name in over.names if isinstance(over, ParameterPath) else (over,):
        if name not in allowed:
            raise InputError("over", name, f"must be one of {', '.join(allowed)}")
        if problem.axis and name in OF_THE_AXIS:
            others = ", ".join(one for one in allowed if one not in OF_THE_AXIS)
            raise InputError("over", name, f"is that of the axis, which is given by points: must be one of {others}")
    if len(limits) != 2:
        raise InputError("range", list(limits), "must be two numbers, start and end")
    low, high = limits_of(over)
    low = SMALLEST_CLEARANCE if over == "clearance" else low
    text = f"on the path, from {low:g} to {high:g}" if isinstance(over, ParameterPath) else LIMITS[over][2]
    start, end = (checked_number(str(over), value, low, high, text) for value in limits)
    if start == end:
        raise InputError("range", list(limits), "start and end must differ")
    for value in (start, end):
        varied(problem, over, value)
    return over, start, end
