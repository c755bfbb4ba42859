"""How far two programs that solved the same states differ."""

from __future__ import annotations

from typing import Any

from rodwell.analysis.branch.verifying.verify import Verification
from rodwell.plots.style import INK, LIMIT, MODES, new_axes, parameters
from rodwell.quantities.text import plain, signed

SMALLEST = 1e-16
"""A difference of nothing is drawn here: there is no zero on a logarithmic axis."""

MARKS = ("o", "s", "^", "D", "v", "P")


def plot_verified(result: Verification, ax: Any = None) -> Any:
    """Draw the largest difference of each field between engine and ``solve_bvp``, state by state; return the axes."""
    ax = new_axes() if ax is None else ax
    for number, state in enumerate(result.states):
        names, values = list(state.differences), [max(size, SMALLEST) for size in state.differences.values()]
        colour, mark = MODES[number % len(MODES)], MARKS[number % len(MARKS)]
        ax.plot(values, names, mark, color=colour, mec=INK, ms=6, label=f"F = {signed(state.force, 7)} B/L²")
        ax.axvline(state.tolerance, color=colour, lw=1.2, ls=LIMIT)
    ax.set_xscale("log")
    ax.invert_yaxis()
    ax.set_xlabel("largest difference, relative to the field's largest value; dotted: up to here they agree")
    title = f"{parameters(result.branch.problem)};  asked for {plain(result.rtol)}"
    ax.set_title(title, loc="left", fontsize=8.5)
    ax.legend(loc="best", title="end force at s = 1, tension positive")
    return ax
