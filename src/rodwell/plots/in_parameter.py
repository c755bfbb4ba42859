"""A branch in any parameter, against any number of its states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.functionals import Number, value_of
from rodwell.analysis.discrete.measures import MEASURES, measured
from rodwell.plots.bifurcation import MARKERS
from rodwell.plots.ordinates import telling
from rodwell.plots.style import INK, MODES, new_axes
from rodwell.problem.varying import Parameter, ParameterPath, words_for
from rodwell.quantities.names import QUANTITIES, UNITS

PARAMETERS = {
    "force": "end force F at s = 1, tension positive  [B/L²]",
    "weight": "weight γ  [B/L³]",
    "alpha": "inclination α against the vertical  [degrees]",
    "clearance": "clearance Δ  [L]",
    "twist": "end twisting moment T₁ at s = 1  [B/L]",
    "poisson": "Poisson's ratio ν",
    "torsion": "torsional stiffness C  [B]",
}
"""Labels of what varies along a branch."""


def parameter_label(parameter: Parameter, labels: Mapping[str, str] = PARAMETERS) -> str:
    """Label of what varies along a branch or a curve."""
    if isinstance(parameter, ParameterPath):
        return f"{parameter}, along a path: {words_for(parameter)}"
    return labels[parameter]


def plot_in_parameter(branch: Branch, ax: Any = None, ordinate: Number | None = None) -> Any:
    """Draw a number of the states of a branch against its parameter, units B = L = 1; return the axes.

    Stable parts (under dead loads, for a rod kept on the wall) are thick, unstable ones thin and dashed; special points
    are marked, those of users by name.
    """
    ax = new_axes() if ax is None else ax
    which = telling([branch]) if ordinate is None else ordinate
    x, y = branch.values, branch.numbers(which)
    color = MODES[len(ax.lines) % len(MODES)]
    stable = branch.stability_index[1:] == 0
    starts = np.flatnonzero(np.diff(stable.astype(int), prepend=-1))
    for start, stop in zip(starts, [*starts[1:], len(stable)], strict=True):
        part, solid = slice(start, stop + 1), stable[start]
        ax.plot(x[part], y[part], color=color, lw=2.2 if solid else 1.0, ls="-" if solid else (0, (5, 2)))
    seen: set[str] = set()
    for point in branch.special_points:
        if point.kind == "end":
            continue
        marker, name = MARKERS.get(point.kind, ("*", point.kind))
        label = None if name in seen else name
        seen.add(name)
        place = point.value, value_of(point.solution, which)
        ax.plot(*place, marker, color="white", mec=INK, ms=6, zorder=5, label=label)
    ax.set_xlabel(parameter_label(branch.parameter))
    ax.set_ylabel(_label(which))
    if seen:
        ax.legend(loc="best")
    return ax


def _label(which: Number) -> str:
    """Name, symbol and unit of a measured number; the name of a function."""
    if callable(which):
        return str(getattr(which, "__name__", "number")).replace("_", " ")
    quantity = QUANTITIES[MEASURES[measured(which)]]
    unit = UNITS[quantity.dimension]
    name = quantity.meaning.partition(":")[0].partition(",")[0]
    return f"{name}\n{quantity.symbol}" + (f"  [{unit}]" if unit not in ("", "1") else "")
