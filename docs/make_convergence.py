"""The page on convergence: observed orders, and error estimates beside true errors.

``make_pages`` calls :func:`pages`; ``convergence_runs`` measures.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import numpy as np
from convergence_runs import DEGREES, LOAD_MESHES, SHARES, estimates, lift_offs, loads, orders, state_meshes, theory
from shown import DPI, table

from rodwell.analysis.discrete.choices import DEGREE
from rodwell.plots.style import GREY, INK, MODES, RC, new_axes


def pages(out: Path) -> dict[str, str]:
    """Draw the figures into ``out``; return the tables."""
    with mpl.rc_context(RC):
        draw_orders(out / "convergence-orders.png")
        draw_estimates(out / "convergence-estimates.png")
    return {"convergence-orders.md": orders_table(), "convergence-estimates.md": estimates_table()}


def draw_orders(path: Path) -> None:
    """Errors over the number of elements, with lines of the promised slope."""
    left = new_axes(size=(9.6, 4.4))
    left.set_subplotspec(left.figure.add_gridspec(1, 3)[0])
    axes = [left, *(left.figure.add_subplot(1, 3, i) for i in (2, 3))]
    titles = ("y in H²", "contact pressure p, largest over s", "critical load")
    for k, (ax, title) in enumerate(zip(axes, titles, strict=True)):
        for color, degree in zip(MODES, DEGREES, strict=False):
            meshes = np.array(LOAD_MESHES[degree], dtype=float) if k == 2 else state_meshes(degree).astype(float)
            error = orders()[degree][k]
            ax.loglog(meshes, error, "o", color=color, ms=4, label=f"degree {degree}: order {theory(degree)[k]}")
            ax.loglog(meshes, error[-1] * (meshes / meshes[-1]) ** -theory(degree)[k], color=color, lw=0.9)
        ax.set_title(title, loc="left", fontsize=9.5)
        ax.set_xlabel("elements")
        ax.set_ylim(1e-15, 1.0)
        ax.legend(loc="upper right" if k == 2 else "lower left", fontsize=7.5)
        ax.set_xticks([10, 20, 40, 80, 160], ["10", "20", "40", "80", "160"])
        ax.minorticks_off()
    axes[0].set_ylabel("relative error")
    left.figure.savefig(path, dpi=DPI)


def draw_estimates(path: Path) -> None:
    """True error over estimate, each number of each state a dot."""
    found = estimates()
    ax = new_axes(size=(7.2, 5.2))
    line = np.array([1e-16, 1.0])
    ax.fill_between(line, line, 1.0, color="#fdecea", lw=0.0)
    ax.loglog(line, line, color=INK, lw=0.9)
    for color, share in zip((MODES[0], MODES[2], MODES[4], MODES[1]), SHARES, strict=True):
        part = found.share == share
        label = "states, first mesh of the program" if share == 1.0 else f"states, {share:g} of its elements"
        ax.plot(found.claimed[part], np.maximum(found.true[part], 1e-16), ".", color=color, ms=4, label=label)
    for (claimed, true), marker, color, label in (
        (lift_offs(), "^", INK, "lift-off loads, located"),
        (loads(), "x", GREY, "critical loads, roots of (77)"),
    ):
        ax.plot(claimed, np.maximum(true, 1e-16), marker, color=color, ms=4, label=label)
    ax.set_xlim(1e-13, 1.0)
    ax.set_ylim(1e-16, 1.0)
    ax.text(2e-13, 3e-2, "true error above the estimate", color="#b3261e", fontsize=8.5)
    ax.set_xlabel("error estimate, relative to the scale of the number")
    ax.set_ylabel("true error, likewise")
    ax.legend(loc="lower right", fontsize=8.0)
    ax.figure.savefig(path, dpi=DPI)


def orders_table() -> str:
    """Observed orders beside those that theory promises."""
    rows = []
    for degree, errors in orders().items():
        cells = [f"{a:.2f} ({b})" for a, b in zip(errors.slopes(degree), theory(degree), strict=True)]
        if degree == DEGREE:
            cells[2] = "round-off from 14 elements on"
        rows.append((str(degree), *cells))
    return table(("Degree of the splines", "y in H²", "contact pressure", "critical load"), rows)


def estimates_table() -> str:
    """How often, and by how much, the true error is above the estimate."""
    found, rows = estimates(), []
    for share in SHARES:
        rows.append((f"{share:g}", *_cover(found.claimed[found.share == share], found.ratio[found.share == share])))
    small = found.claimed < 1e-4
    rows.append(("any, estimates below 1e-4 only", *_cover(found.claimed[small], found.ratio[small])))
    for name, (claimed, true) in (("lift-off loads", lift_offs()), ("critical loads", loads())):
        rows.append((name, *_cover(claimed, true / claimed)))
    head = (
        "Elements, share of the program's",
        "Numbers",
        "Median estimate",
        "True error within it",
        "Largest true/estimate",
    )
    return table(head, rows)


def _cover(claimed: np.ndarray, ratio: np.ndarray) -> tuple[str, str, str, str]:
    covered = f"{100.0 * np.mean(ratio <= 1.0):.1f} %"
    return str(ratio.size), f"{np.median(claimed):.0e}".replace("-", "−"), covered, f"{ratio.max():.2f}"
