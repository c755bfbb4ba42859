"""The picture of the page on architecture: the packages from top to bottom as the contracts have them, and the data."""

from __future__ import annotations

import tomllib
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib as mpl
from make_howto import DPI
from matplotlib.patches import FancyBboxPatch

from rodwell.plots.style import GREY, INK, MODES, RC, new_axes

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "src" / "rodwell"

PURPOSE = {
    "cli": "commands; the only one that prints",
    "report": "reports (HTML, PDF), viewer, export",
    "plots": "figures",
    "store": "NetCDF, tables, glTF, STL, VTK",
    "studies": "the paper, recomputed",
    "practice": "case files, units, catalogue, formulas, verdicts",
    "analysis": "branches, diagrams, curves, fields, certificates",
    "problem": "the dimensionless problem",
    "physics": "energy, braid, closed forms; no solver",
    "numerics": "splines, Newton, continuation; no rod",
    "quantities": "names, units, scales, text",
    "compiling": "kernels, first run",
    "errors": "messages",
    "faces": "notebooks",
    "_version": "the version",
}

WAY = (
    ("practice", "case file → Case", 0),
    ("problem", "Problem", 0),
    ("analysis", "Family", 1),
    ("numerics", "State on two meshes", 1),
    ("analysis", "Branch, Solution, fields", 2),
    ("practice", "Answer, sentences", 2),
    ("plots", "figures, NetCDF", 2),
    ("report", "report.html", 2),
)
"""Where the data are, in order, with the column in which they are drawn."""

COLUMN = (10.2, 12.1, 14.4)
HEIGHT = 1.15


def pages(out: Path) -> dict[str, str]:
    """Draw the picture into ``out``."""
    with mpl.rc_context(RC):
        draw(out / "architecture.png")
    return {}


def layers() -> list[list[str]]:
    """Packages by layer from the top, from the contract that ``lint-imports`` checks."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contract = project["tool"]["importlinter"]["contracts"][0]
    return [layer.split(" | ") for layer in contract["layers"]]


def modules(package: str) -> int:
    """Number of modules in a package; 1 for a module."""
    folder = SOURCE / package
    return len([file for file in folder.rglob("*.py") if file.name != "__init__.py"]) if folder.is_dir() else 1


def draw(path: Path) -> None:
    """Boxes for packages, an arrow for the direction of imports, and the way of the data beside them."""
    ax = new_axes(size=(9.6, 6.6))
    ax.set_axis_off()
    rows: dict[str, float] = {}
    stack = layers()
    for i, layer in enumerate(stack):
        y = HEIGHT * (len(stack) - i)
        width = (8.8 - 0.25 * (len(layer) - 1)) / len(layer)
        for k, package in enumerate(layer):
            if package not in PURPOSE:
                raise RuntimeError(f"docs/make_architecture.py: package {package} is not described")
            rows[package] = y
            _box(ax, k * (width + 0.25), y, width, package)
    ax.annotate(
        "", (-0.5, HEIGHT + 0.2), (-0.5, HEIGHT * len(stack) + 0.7), arrowprops={"arrowstyle": "-|>", "color": GREY}
    )
    ax.text(
        -0.75,
        0.5 * HEIGHT * (len(stack) + 2),
        "imports go down only",
        rotation=90,
        va="center",
        ha="center",
        color=GREY,
    )
    _data(ax, rows)
    ax.set_xlim(-1.0, 15.9)
    ax.set_ylim(0.9, HEIGHT * len(stack) + 1.4)
    ax.figure.savefig(path, dpi=DPI)


def _box(ax: Any, x: float, y: float, width: float, package: str) -> None:
    ax.add_patch(FancyBboxPatch((x, y), width, 0.75, boxstyle="round,pad=0.06", fc="#eef3f8", ec=MODES[0], lw=1.0))
    count = modules(package)
    small = width < 5.0
    ax.text(x + 0.15, y + (0.55 if small else 0.375), package, va="center", fontweight="bold", color=INK, fontsize=9)
    if small:
        ax.text(x + 0.15, y + 0.2, PURPOSE[package], va="center", fontsize=7.5)
        return
    ax.text(x + 1.55, y + 0.375, PURPOSE[package], va="center", fontsize=8)
    if count > 1:
        ax.text(x + width - 0.1, y + 0.375, f"{count} modules", va="center", ha="right", fontsize=7.5, color=GREY)


def _data(ax: Any, rows: dict[str, float]) -> None:
    """The way of the data: text in the row of the package that holds it, arrows between."""
    places = [(COLUMN[side], rows[package] + 0.375) for package, _, side in WAY]
    for (x, y), (_, text, _) in zip(places, WAY, strict=True):
        box = {"boxstyle": "round,pad=0.3", "fc": "#fdf1e7", "ec": MODES[1], "lw": 0.9}
        ax.text(x, y, text, ha="center", va="center", fontsize=8, bbox=box, zorder=3)
    for start, end in pairwise(places):
        ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": MODES[1], "shrinkA": 11, "shrinkB": 11})
    ax.text(COLUMN[1], HEIGHT * len(layers()) + 0.95, "the way of the data", ha="center", color=MODES[1])
