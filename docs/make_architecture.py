"""The picture of the page on architecture: rooms as the contracts have them, and the way of the data through them.

Nothing imports what stands above it. Rooms of one layer stand side by side; a room that a contract divides shows the
rooms inside, in the same way.
"""

from __future__ import annotations

import tomllib
from collections.abc import Container
from dataclasses import dataclass
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.patches import FancyBboxPatch
from shown import DPI

from rodwell.plots.style import GREY, INK, MODES, RC, new_axes

ROOT = Path(__file__).resolve().parent.parent

PURPOSE = {
    "cli": "commands; the only one that prints",
    "web": "the live page: server, engine's process, scripts",
    "report": "",
    "report/folders": "what is written: folders of results, export",
    "report/pages": "how it looks: page, PDF, viewer, notebook",
    "report/reports": "what is said: front and sections",
    "plots": "figures; they compute nothing",
    "store": "files: NetCDF, JSON, XLSX, glTF",
    "studies": "",
    "studies/sweep": "lists and\nranges in\na case file",
    "studies/packer": "tubing:\nchanges\nof length",
    "studies/well": "a well,\nstation by\nstation",
    "studies/drag": "torque\nand drag\nof a well",
    "studies/audit": "formulas\nbeside\nexact loads",
    "studies/paper": "every\nnumber,\nrecomputed",
    "studies/maps": "one number\nof many\nproblems",
    "answers": "",
    "answers/data": "as tables and plain data",
    "answers/words": "what it means, in sentences",
    "answers/result": "what is computed for a case; strength",
    "answers/comparison": "formulas beside exact loads",
    "strength": "stress and strength of rod, cylinder and supports",
    "analysis": "",
    "analysis/curves": "loads in two\nparameters",
    "analysis/proof": "ball\narithmetic",
    "analysis/path": "load paths\nwith snaps",
    "analysis/loads": "sensitivities, twist, long rods",
    "analysis/branch": "solutions, branches, diagrams",
    "analysis/space": "frames, surfaces, scene",
    "analysis/state": "one equilibrium: fields, certificate",
    "analysis/straight": "critical loads\nand modes",
    "analysis/off_wall": "partial\ncontact",
    "analysis/endless": "the rod\nwithout ends",
    "analysis/discrete": "families, first meshes, measures",
    "case": "what the user has:\nfile, units, catalogue;\nchecked and made\ndimensionless",
    "survey": "surveys and centre lines of holes, smooth axes",
    "formulas": "formulas of practice, each with source and validity",
    "problem": "the dimensionless problem",
    "physics": "no solver",
    "physics/on_wall": "energy,\nfields,\ncontact,\nframes",
    "physics/off_wall": "two\nlateral\nfields,\nlinear",
    "physics/exact": "closed\nforms of\nloads and\ncoils",
    "numerics": "no rod",
    "numerics/continuation": "steps,\nevents",
    "numerics/stretches": "in contact\nand free",
    "numerics/equilibria": "Newton, two meshes",
    "numerics/splines": "spaces, assembly",
    "quantities": "what a number is: name, unit, scale, error, text",
    "compiling": "kernels, and how they are kept",
    "faces": "hooks of results",
    "errors": "messages",
    "_version": "its number",
}

WAY = (
    ("case", "Case", 0),
    ("problem", "Problem", 0),
    ("analysis/discrete", "Family", 1),
    ("numerics/splines", "Discretisation", 1),
    ("numerics/equilibria", "State on two meshes", 2),
    ("numerics/continuation", "Trace", 2),
    ("analysis/state", "Equilibrium", 2),
    ("analysis/branch", "Solution, Branch", 2),
    ("answers/result", "Answer", 2),
    ("answers/words", "sentences", 2),
    ("answers/data", "tables, plain data", 2),
    ("plots", "figures, files", 2),
    ("report/pages", "page, PDF", 2),
    ("cli", "summary", 2),
)
"""Where the data are, in order: room, what it holds of them, and the column in which that is drawn."""

COLUMNS = 10.5, 11.85, 13.9
WIDTH, GAP, PAD = 9.6, 0.16, 0.14
ROW, BETWEEN, INSET, LINE = 0.44, 0.2, 0.13, 0.21
SHARES = {"analysis": 2.5, "numerics": 1.7, "physics": 1.15, "analysis/curves": 1.65}
"""Widths of rooms that stand side by side, where they are not equal."""

ROOM, INNER, DATA = "#e3edf7", "#ffffff", "#fdf1e7"


@dataclass(frozen=True)
class Box:
    """A room as it is drawn: its lower left corner, width and height."""

    room: str
    x: float
    y: float
    width: float
    height: float


def pages(out: Path) -> dict[str, str]:
    """Draw the picture into ``out``."""
    with mpl.rc_context(RC):
        draw(out / "architecture.png")
    return {}


def layers() -> dict[str, list[list[str]]]:
    """Rooms by layer from the top, of the house ("") and of each room that a contract divides.

    Taken from the contracts that ``lint-imports`` checks: layers, and rooms that do not know each other.

    Raises
    ------
    RuntimeError
        If a room is not described here, or one that is described or on the way of the data is in no contract.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    out: dict[str, list[list[str]]] = {}
    for contract in project["tool"]["importlinter"]["contracts"]:
        if contract["type"] == "layers":
            (container,) = contract["containers"]
            inside = _path(container)
            out[inside] = [
                [f"{inside}/{room}".lstrip("/") for room in layer.split(" | ")] for layer in contract["layers"]
            ]
        elif contract["type"] == "independence":
            rooms = [_path(module) for module in contract["modules"]]
            out[rooms[0].rpartition("/")[0]] = [rooms]
    known = {room for stack in out.values() for layer in stack for room in layer}
    for room in sorted(known ^ set(PURPOSE)) + [room for room, _, _ in WAY if room not in known]:
        what = "not described" if room in known else "described, but in no contract"
        raise RuntimeError(f"docs/make_architecture.py: room {room} is {what}")
    return out


def _path(module: str) -> str:
    return module.replace(".", "/").removeprefix("rodwell").lstrip("/")


def placed(stacks: dict[str, list[list[str]]]) -> list[Box]:
    """Boxes of all rooms, the outer before those inside them."""

    def height(room: str) -> float:
        if room not in stacks:
            lines = PURPOSE[room].count("\n") + 1
            return ROW if lines == 1 or "/" not in room else ROW + LINE * lines + 0.05
        return ROW + sum(max(map(height, layer)) + 0.08 for layer in stacks[room]) + 0.06

    def place(stack: list[list[str]], x: float, top: float, width: float, between: float, least: float) -> None:
        for layer in stack:
            gap = GAP if between == BETWEEN else 0.5 * GAP
            shares = [SHARES.get(room, 1.0) for room in layer]
            unit, tallest, at = (width - gap * (len(layer) - 1)) / sum(shares), max(least, *map(height, layer)), x
            for room, share in zip(layer, shares, strict=True):
                out.append(Box(room, at, top - tallest, unit * share, tallest))
                if room in stacks:
                    rest = tallest - ROW - 0.06 if len(stacks[room]) == 1 else 0.0
                    place(stacks[room], at + PAD, top - ROW, unit * share - 2 * PAD, 0.08, max(rest - 0.08, 0.0))
                at += unit * share + gap
            top -= tallest + between

    out: list[Box] = []
    place(stacks[""], 0.0, 0.0, WIDTH, BETWEEN, 0.0)
    return out


def draw(path: Path) -> None:
    """Boxes for rooms, an arrow for the direction of imports, and the way of the data beside them."""
    stacks = layers()
    boxes = placed(stacks)
    bottom = min(box.y for box in boxes)
    left, right, low, high = -0.85, COLUMNS[-1] + 1.25, bottom - 0.2, 0.62
    inch = 0.62
    ax = new_axes(size=((right - left) * inch, (high - low) * inch))
    ax.set_axis_off()
    ax.set_xlim(left, right)
    ax.set_ylim(low, high)
    texts = _rooms(ax, boxes, stacks)
    ax.annotate("", (-0.32, bottom), (-0.32, 0.0), arrowprops={"arrowstyle": "-|>", "color": GREY})
    ax.text(-0.6, 0.5 * bottom, "imports go down only", rotation=90, va="center", ha="center", color=GREY, fontsize=9)
    texts += _data(ax, {box.room: box for box in boxes})
    ax.figure.canvas.draw()
    _check(texts, ax.transData.inverted())
    ax.figure.savefig(path, dpi=DPI)


def _check(texts: list[tuple[Any, Box]], to_data: Any) -> None:
    """Raise if a text is larger than the box that holds it, or runs into another text in it."""
    extents: dict[Box, list[Any]] = {}
    for text, box in texts:
        extents.setdefault(box, []).append(text.get_window_extent().transformed(to_data))
    for box, found in extents.items():
        large = any(one.x1 > box.x + box.width or one.y0 < box.y for one in found)
        if large or any(one.overlaps(other) for one, other in combinations(found, 2)):
            raise RuntimeError(f"docs/make_architecture.py: what is said of {box.room} does not fit in its box")


def _rooms(ax: Any, boxes: list[Box], divided: Container[str]) -> list[tuple[Any, Box]]:
    """Draw rooms with their names, and their purposes beside or below; return texts with the boxes that hold them.

    Purposes beside the names of rooms that begin at the same place begin at the same place too.
    """
    out, column = [], dict[float, float]()
    renderer = ax.figure.canvas.get_renderer()
    ax.figure.canvas.draw()  # the extent of a text is known after that
    for box in boxes:
        look = {"fc": INNER, "lw": 0.7} if "/" in box.room else {"fc": ROOM, "lw": 1.0}
        style = "round,pad=0,rounding_size=0.09"
        ax.add_patch(FancyBboxPatch((box.x, box.y), box.width, box.height, boxstyle=style, ec=MODES[0], **look))
        name, y = box.room.rpartition("/")[2], _first_row(box)
        text = ax.text(box.x + INSET, y, name, va="center", fontweight="bold", color=INK, fontsize=8.6)
        out.append((text, box))
        end = text.get_window_extent(renderer).transformed(ax.transData.inverted()).x1
        if PURPOSE[box.room] and "\n" not in PURPOSE[box.room]:
            column[box.x] = max(column.get(box.x, 0.0), end + 1.3 * INSET)
    for box in boxes:
        first, *more = PURPOSE[box.room].split("\n")
        if not more:
            out.append((ax.text(column.get(box.x, box.x), _first_row(box), first, va="center", fontsize=7.8), box))
            continue
        for i, line in enumerate((first, *more)):
            at = box.x + INSET, _first_row(box) - 0.36 - LINE * i
            out.append((ax.text(*at, line, va="baseline", fontsize=7.4), box))
    return out


def _first_row(box: Box) -> float:
    return box.y + box.height - 0.5 * ROW


def _data(ax: Any, boxes: dict[str, Box]) -> list[tuple[Any, Box]]:
    """The way of the data: what there is of them, numbered, in the row of the room that holds it; arrows between."""
    orange, out, stations = MODES[1], [], []
    for i, (room, what, column) in enumerate(WAY):
        box, at = boxes[room], (COLUMNS[column], _first_row(boxes[room]))
        label = {"boxstyle": "round,pad=0.28", "fc": DATA, "ec": orange, "lw": 0.9}
        text = f"{i + 1}  {what}"
        stations.append((at, ax.text(*at, text, ha="center", va="center", fontsize=8, bbox=label, zorder=3)))
        dot = {"boxstyle": "circle,pad=0.18", "fc": DATA, "ec": orange, "lw": 0.8}
        place = box.x + box.width - 0.24, at[1]
        out.append((ax.text(*place, f"{i + 1}", ha="center", va="center", fontsize=6.6, bbox=dot), box))
    arrow = {"arrowstyle": "-|>", "color": orange, "shrinkA": 0, "shrinkB": 1}
    ax.figure.canvas.draw()  # labels have their frames after that
    for (start, one), (end, other) in pairwise(stations):
        frames = {"patchA": one.get_bbox_patch(), "patchB": other.get_bbox_patch()}
        ax.annotate("", end, start, arrowprops=arrow | frames)
    (x, y), first = stations[0]
    ax.text(x, y + 0.62, "case file", ha="center", va="center", fontsize=8, color=orange)
    ax.annotate("", (x, y), (x, y + 0.5), arrowprops=arrow | {"patchB": first.get_bbox_patch()})
    ax.text(COLUMNS[-1], 0.32, "the way of the data", ha="center", va="center", color=orange, fontsize=9)
    return out
