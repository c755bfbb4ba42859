"""Stability diagrams: loads against another parameter."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rodwell.analysis.curves.curve import Curve
from rodwell.plots.in_parameter import parameter_label
from rodwell.plots.style import INK, WARN, bends, marked, new_axes
from rodwell.problem.varying import ParameterPath
from rodwell.quantities.text import plain

AXES = {
    "weight": "weight γ = mg L³/B",
    "alpha": "inclination α from the vertical  [°]",
    "clearance": "clearance Δ/L",
    "twist": "end twisting moment T₁  [B/L]",
    "poisson": "Poisson's ratio ν",
    "torsion": "torsional stiffness C/B",
    "build": "curvature of the hole, build  [1/L]",
    "walk": "curvature of the hole, walk  [1/L]",
}

MARKERS = {
    "double_point": ("x", "modes switch"),
    "veering": ("+", "closest approach"),
    "switch": ("o", "touching place switches"),
    "turn": ("s", "curve turns back"),
    "cusp": ("v", "cusp: two folds become one"),
    "isola_centre": ("D", "a closed loop shrinks to a point"),
    "reconnection": ("P", "two branches meet and part"),
}


def plot_curves(curves: Sequence[Curve], ax: Any = None) -> Any:
    """Draw curves in two parameters; loads as compression −F at s = 1, twist as it is. Returns the axes."""
    ax = new_axes() if ax is None else ax
    first = curves[0]
    sign = -1.0 if first.quantity == "force" else 1.0
    seen = set()
    for i, curve in enumerate(curves):
        ax.plot(curve.x, sign * curve.values, lw=1.8, label=f"{curve.kind}, {curve.name}", **marked(i))
        for mark in curve.marks:
            marker = MARKERS[mark.kind][0]
            face = WARN if marker == "o" else INK
            ax.plot(mark.x, sign * mark.value, marker, color=face, mec=INK, ms=6, zorder=5)
            seen.add(mark.kind)
    for kind, (marker, text) in MARKERS.items():
        if kind in seen:
            ax.plot([], [], marker, color=WARN if marker == "o" else INK, mec=INK, ms=6, ls="none", label=text)
    ax.set_xlabel(parameter_label(first.over, AXES))
    label = "end compression −F at s = 1  [B/L²]" if first.quantity == "force" else "second lift-off at T₁  [B/L]"
    ax.set_ylabel(label)
    ax.set_title(_title(first), loc="left", fontsize=9.5)
    ax.margins(x=0.01)
    ax.legend(loc="best")
    return ax


def _title(curve: Curve) -> str:
    problem = curve.problem
    fixed = {
        "weight": f"γ = {plain(problem.weight, 6)}",
        "alpha": f"α = {plain(problem.alpha)}°",
        "clearance": f"Δ/L = {plain(problem.clearance)}",
        **bends(problem),
    }
    over = curve.over
    varies = over.names if isinstance(over, ParameterPath) else (over,)
    parts = [text for name, text in fixed.items() if name not in varies]
    return ",  ".join([*parts, "-".join(problem.ends), *(["on top"] if problem.on_top else [])])
