"""One field along the rod."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.errors import unknown_name
from rodwell.plots.style import GREY, MODES, new_axes
from rodwell.plots.units import axis
from rodwell.quantities.forces import Forces
from rodwell.quantities.names import FIELDS, QUANTITIES
from rodwell.quantities.scales import Scales

PLACES = 601


def plot_field(solution: Solution, field: str, scales: Scales | None = None, ax: Any = None) -> Any:
    """Draw a field of the nomenclature along the rod in one state, labelled with its end force; return the axes.

    Raises
    ------
    InputError
        If there is no field of that name.
    """
    if field not in FIELDS:
        raise unknown_name("field", field, FIELDS)
    ax = new_axes() if ax is None else ax
    s = np.linspace(0.0, 1.0, PLACES)
    values = solution.fields(s)[field]
    quantity = QUANTITIES[field]
    fs, us = axis("z", scales, 1.0)
    fv, uv = axis(field, scales, float(np.max(np.abs(values))))
    said = Forces(scales, solution.problem.hung_weight)
    ax.plot(s * fs, values * fv, color=MODES[len(ax.lines) // 2 % len(MODES)], lw=1.6, label=said.label(solution.force))
    ax.axhline(0.0, color=GREY, lw=0.8)
    ax.set_xlim(0.0, fs)
    ax.set_xlabel(f"distance along the rod from s = 0  [{us}]")
    name = quantity.meaning.partition(":")[0].partition(",")[0]
    ax.set_ylabel(f"{name}\n{quantity.symbol}  [{uv}]" if uv else f"{name}, {quantity.symbol}")
    ax.legend(title=said.legend.replace("\n", " "))
    return ax
