"""Tables on the terminal: nothing is broken that must not be, and nothing is wider than the terminal."""

from __future__ import annotations

import io
import re

import pytest
from click.testing import CliRunner
from rich.cells import cell_len
from rich.console import Console

from rodwell.cli.listing import print_listing
from rodwell.cli.main import cli

ROWS = [
    "[bold]against the first critical load[/bold]",
    ("Euler", "43.064 kN", "−65.4 %", "below"),
    ("He–Kyllingstad, sinusoidal, in a hole that is curved", "88.649 kN", "−28.9 %", "for a rod without any weight"),
]


@pytest.mark.parametrize("width", [60, 80, 100, 140])
@pytest.mark.parametrize("notes", [False, True])
def test_listing_fits_and_keeps_cells_whole(width: int, notes: bool) -> None:
    out = io.StringIO()
    rows = [row if isinstance(row, str) or notes else row[:3] for row in ROWS]
    head = ["formula", ">load", ">error", *(["remark"] if notes else [])]
    print_listing(Console(file=out, width=width, highlight=False), head, rows, notes=notes)
    lines = [line.rstrip() for line in out.getvalue().splitlines()]
    assert max(cell_len(line) for line in lines) <= width
    for row in ROWS:
        cells = ["against the first critical load"] if isinstance(row, str) else row[:3]
        assert all(any(cell in line for line in lines) for cell in cells)
    ends = {line.index("kN") for line in lines if "kN" in line}
    assert len(ends) == 1  # loads stand below each other
    both = any("He–Kyllingstad" in line and "88.649 kN" in line for line in lines)
    assert both == (width >= (102 if notes else 72))  # label, two cells, remark: on one line where there is room
    if notes:
        words = re.findall(r"\b(?:for|a rod|without|any|weight)\b", " ".join(lines))
        assert " ".join(words) == "for a rod without any weight"


@pytest.mark.parametrize("notes", [False, True])
def test_where_there_is_no_room_no_number_is_cut(notes: bool) -> None:
    out = io.StringIO()
    rows = [row if isinstance(row, str) or notes else row[:3] for row in ROWS]
    console = Console(file=out, width=20, highlight=False)
    print_listing(console, ["formula", ">load", ">error", *(["remark"] if notes else [])], rows, notes=notes)
    assert all(cell in out.getvalue() for row in ROWS[1:] for cell in row[1:3])
    assert "…" not in out.getvalue()
    assert console.width == 20


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("modes --weight 15", "next at γ = 62.34181826"),  # (78), n = 2, m = 4
        ("critical --weight 15 --alpha 90 --modes 1", "(tension positive), both ends clamped"),
        ("liftoff --weight 15 --alpha 90", "(tension positive), both ends clamped"),
    ],
)
def test_prose_is_broken_between_words(line: str, words: str) -> None:
    done = CliRunner().invoke(cli, line.split(), env={"COLUMNS": "60"})
    lines = done.output.splitlines()
    assert max(cell_len(text) for text in lines if "±" not in text) <= 60
    assert words in " ".join(text.strip() for text in lines)
