"""A map for a browser: cells to point at, further parameters to move, in one file without a network."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np

from rodwell.errors import InputError
from rodwell.plots.maps.figure import LABELS, NO_VALUE, axis_label, shown_numbers, value_label
from rodwell.plots.style import GREY, WARN
from rodwell.quantities.as_json import as_json
from rodwell.quantities.text import plain
from rodwell.report.pages.templates import HERE, template
from rodwell.studies.maps.axes import Axis
from rodwell.studies.maps.cells import IN_WORDS, OUTCOMES
from rodwell.studies.maps.jumps import MODE, OUTCOME, PLACE
from rodwell.studies.maps.result import Map
from rodwell.studies.maps.words import sentences, title

MOST_CELLS = 300_000
"""What a page of some megabytes carries."""

COLUMNS = ("value", "place", "half-waves", "error")
"""What can be shown, as in figures."""

JUMPS = {
    MODE: ("the mode changes", "circle"),
    PLACE: ("the place jumps", "diamond"),
    OUTCOME: ("another outcome", "square"),
}
"""Jumps that are marked, by kind: in words, and the mark, as in figures."""

_COLOURS = 64


def write_map_page(found: Map, file: Path) -> None:
    """Write a map over at least two parameters as a page that opens offline.

    Colours, or outcomes where there is no value; the cell under the pointer, or chosen by the arrow keys, is told with
    its error, outcome and reason. Of more than two parameters the others, and the two that are drawn, can be chosen.

    Raises
    ------
    InputError
        For a map over fewer parameters, or one of more cells than a page carries.
    """
    question = found.question
    if question.distributions or sum(axis.numbers is not None for axis in question.axes) < 2:
        raise InputError("file", str(file), "is a page for maps over two or more parameters with numbers: take .png")
    if question.size > MOST_CELLS:
        what = f"would hold {question.size} cells, of which a page carries {MOST_CELLS}: draw a figure, .png"
        raise InputError("file", str(file), what)
    numbers = {name: shown_numbers(found, name) for name in COLUMNS}
    reasons, which = np.unique(np.array([str(each) for each in found.cells["reason"].ravel()]), return_inverse=True)
    data = {
        "axes": [_axis(axis) for axis in question.axes],
        "columns": [
            {"name": name, "label": value_label(found, name).replace("\n", " "), "data": _packed(numbers[name], "<f8")}
            for name in COLUMNS
        ],
        "outcome": _packed(found.cells["outcome"], "u1"),
        "reason": _packed(which, "<u4"),
        "reasons": [str(reason) for reason in reasons],
        "outcomes": [IN_WORDS[number] for number in range(len(OUTCOMES))],
        "outcome_colours": [NO_VALUE.get(number, ("", GREY))[1] for number in range(len(OUTCOMES))],
        "colours": _palette(),
        "jumps": _jumps(found),
        "warn": WARN,
    }
    page = template("map.html.j2").render(
        title=question.title or title(found), given=_given(found),
        sentences=[*([title(found)] if question.title else []), *sentences(found)],
        data=as_json(data, compact=True).replace("</", "<\\/"),
        script=(HERE / "assets" / "map.js").read_text(encoding="utf-8"),
    )  # fmt: skip
    file.write_text(page, encoding="utf-8")


def _axis(axis: Axis) -> dict[str, Any]:
    numbers = None if axis.numbers is None else list(axis.numbers)
    return {
        "name": axis.name, "label": axis_label(axis), "log": axis.logarithmic,
        "numbers": numbers, "names": [str(value) for value in axis.values], "unit": axis.unit,
    }  # fmt: skip


def _packed(values: np.ndarray, kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode()


def _palette() -> list[str]:
    from matplotlib import colormaps  # noqa: PLC0415
    from matplotlib.colors import to_hex  # noqa: PLC0415

    return [to_hex(colormaps["viridis"](i / (_COLOURS - 1))) for i in range(_COLOURS)]


def _jumps(found: Map) -> list[dict[str, Any]]:
    """Where the map jumps: kind in words, and the place by the number of each parameter."""
    where = found.jumps
    if not where:
        return []
    names = [axis.name for axis in found.question.axes if axis.numbers is not None]
    return [
        {
            "kind": JUMPS[int(kind)][0],
            "mark": JUMPS[int(kind)][1],
            "at": {name: float(where[f"at_{name}"][i]) for name in names},
        }
        for i, kind in enumerate(where["outcome"])
    ]


def _given(found: Map) -> list[str]:
    """What is held, of a map of problems."""
    rods = found.question.rods
    if rods.folder is not None:
        return []
    held = {name: rods.given.get(name) for name in LABELS if name not in rods.names}
    said = [f"{LABELS[name]} = {plain(value)}" for name, value in held.items() if value is not None]
    return said if "ends" in rods.names else [*said, f"ends {rods.given['ends']}"]
