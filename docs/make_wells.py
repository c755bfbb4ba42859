"""What the pages on studies and surveys show, called by ``make_pages``: everything is computed here."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
from shown import table

import rodwell
from rodwell.analysis.loads.long_rod import HALF_WAVES, PipeString, critical_compression, lift_off_compression

COMMANDS = {
    "study": "run examples/study.toml",
    "load-study": "run examples/load-study.toml",
    "screen": "screen examples/well-survey.csv --case examples/well-string.toml --bit-force=-120kN",
}

PIPE = PipeString(1.2283e6, 241.13, 0.04445)
"""5 in × 4.276 in pipe in 10 lb/gal mud, 8.5 in hole."""


def pages(_: Path) -> dict[str, str]:
    """Return the tables by file name."""
    return {"local-length.md": length_table()}


def length_table() -> str:
    """Loads of local rods of several lengths."""
    rows = []
    for alpha in (90.0, 85.0, 60.0, 20.0, 1.0, 0.05):
        loads = [critical_compression(PIPE, alpha, n).compression for n in (10, HALF_WAVES, 2 * HALF_WAVES)]
        loads += [lift_off_compression(PIPE, alpha, n).compression for n in (12, 24)]
        cells = [f"{load.value / 1e3:.3f}" if load else "–" for load in loads]
        rows.append((f"{alpha:g}°", *cells))
    head = ("α", "buckles: 10 half waves", "20", "40", "leaves the wall: 12 half waves", "24")
    return table(head, rows)


def numbers() -> dict[str, str]:
    """Processor time for 500 stations, and what the table between exact loads costs."""
    case = rodwell.Case.read("examples/well-string.toml")
    md = np.linspace(0.0, 4990.0, 500)
    alpha = np.interp(md, [0.0, 600.0, 1500.0, 2500.0, 3600.0, 4990.0], [0.0, 0.0, 45.0, 60.0, 88.0, 91.0])
    start = time.process_time()
    found = rodwell.screen(case, rodwell.Survey.of(md, alpha), bit_force=-1e5)
    return {
        "screen_seconds": f"{time.process_time() - start:.1f}",
        "screen_critical": str(found.critical.solved),
        "screen_lift_off": str(found.lift_off.solved),
    }
