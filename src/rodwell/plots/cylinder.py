"""Moments in the cylinder along its length, and shapes with their torque as in the paper's Fig. 4."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.solution import Solution
from rodwell.plots.extent import drawn_places, shown_part, straight_beyond
from rodwell.plots.style import GREY, MODES, SIZE, new_axes, parameters
from rodwell.plots.units import axis
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales

PLACES = 601


def plot_cylinder_moments(state: Solution, scales: Scales | None = None, ax: Any = None) -> Any:
    """Draw T₂, μ and λ cos η, (59), along the cylinder in one state; return the axes."""
    ax = new_axes() if ax is None else ax
    part = shown_part([state])
    f = state.fields(drawn_places([state], part))
    curves = {"T2": "twisting, T₂", "mu": "bending, μ (about d₁)", "cylinder_M3": "bending, λ cos η (about u₂)"}
    fz, uz = axis("z", scales, part)
    fm, um = axis("T2", scales, max(float(np.max(np.abs(f[name]))) for name in curves))
    said = Forces(scales, state.problem.hung_weight)
    for number, (name, label) in enumerate(curves.items(), start=2):
        ax.plot(f["z"] * fz, f[name] * fm, color=MODES[number], lw=1.6, label=label)
    ax.axhline(0.0, color=GREY, lw=0.8)
    ax.set_xlim(0.0, float(f["z"][-1]) * fz)
    ax.set_xlabel(f"distance along the cylinder from s = 0{straight_beyond(part)}  [{uz}]")
    ax.set_ylabel(f"moment in the cylinder  [{um}]")
    title = f"{said.legend}\n{said.label(state.force)}"
    ax.set_title(parameters(state.problem, scales), loc="left", fontsize=8.5)
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), title=title)
    return ax


def plot_shapes(states: Branch | Sequence[Solution], scales: Scales | None = None) -> Any:
    """Draw y and T₂ along the rod in several states (Fig. 4), the first and last thick; return the upper axes."""
    chosen = list(states)
    fs, us = axis("z", scales, 1.0)
    said = Forces(scales, chosen[0].problem.hung_weight)
    upper = new_axes(size=(SIZE[0], 6.2), nrows=2, index=1)
    lower = upper.figure.add_subplot(2, 1, 2, sharex=upper)
    s = np.linspace(0.0, 1.0, PLACES)
    fields = [state.fields(s) for state in chosen]
    colors = mpl.colormaps["viridis"](np.linspace(0.85, 0.22, len(chosen)))
    for ax, name, label in ((upper, "y", "around the wall, y"), (lower, "T2", "twisting moment\nin the cylinder, T₂")):
        factor, unit = axis(name, scales, max(float(np.max(np.abs(f[name]))) for f in fields))
        for i, (f, color, state) in enumerate(zip(fields, colors, chosen, strict=True)):
            thick = i in (0, len(chosen) - 1)
            text = said.label(state.force)
            ax.plot(s * fs, f[name] * factor, color=color, lw=2.6 if thick else 1.1, label=text)
        ax.axhline(0.0, color=GREY, lw=0.8)
        ax.set_ylabel(f"{label}  [{unit}]")
    lower.set_xlabel(f"distance along the rod from s = 0  [{us}]")
    upper.set_xlim(0.0, fs)
    upper.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), title=said.legend)
    return upper
