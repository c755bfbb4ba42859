"""How far formulas for endless pipe in a build section are from exact loads: a map over build rate and length.

    python benchmarks/curved_formulas.py      writes benchmarks/results/curved_formulas.json; ten seconds

The first critical load of a pipe with both ends clamped, in an arc that is horizontal at its mid-length. The
compression is that in the middle, which lies lowest and bears most. Documentation draws the map from the file.
"""

from __future__ import annotations

import datetime
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from campaigns.resumable import machine

from rodwell import Problem, critical_loads

HERE = Path(__file__).parent
OUT = HERE / "results" / "curved_formulas.json"

STIFFNESS, WEIGHT, CLEARANCE = 1.188378e6, 241.0, 0.04445
"""B in N·m², w in N/m, Δ in m of the 5 in drill pipe in mud, in a hole of 8.5 in, of the pages on torque and drag."""

RATES = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0])
"""Build rates in degrees per 30 m."""

LENGTHS = np.geomspace(12.0, 240.0, 20)
MOST_TURN = 75.0
"""Degrees by which the hole may turn along the pipe: beyond, its ends are steep, and no formula is meant for it."""


def problem_of(rate: float, length: float) -> Problem:
    """The pipe of a length in m at a build rate in degrees per 30 m."""
    weight = WEIGHT * length**3 / STIFFNESS
    return Problem(weight, 90.0, clearance=CLEARANCE / length, build=math.radians(rate) / 30.0 * length)


def sag(rate: float, length: float) -> float:
    """How far the middle of the arc in which the pipe lies is below its ends, in m."""
    half, radius = math.radians(rate) * length / 60.0, length / max(problem_of(rate, length).build, 1e-300)
    return 0.0 if rate == 0.0 else (radius + CLEARANCE) * (1.0 - math.cos(half * radius / (radius + CLEARANCE)))


def main() -> None:
    """Compute the map and write it."""
    force, error = np.full((2, RATES.size, LENGTHS.size), np.nan)
    for i, rate in enumerate(RATES):
        for j, length in enumerate(LENGTHS):
            if rate * length / 30.0 <= MOST_TURN:
                mode = critical_loads(problem_of(rate, length), 1)[0]
                unit = STIFFNESS / length**2
                force[i, j], error[i, j] = -mode.force * unit + WEIGHT * sag(rate, length), mode.error * unit
    known = np.isfinite(force)
    data: dict[str, Any] = {
        "benchmark": "curved_formulas", "date": datetime.date.today().isoformat(), "machine": machine(),
        "stiffness": STIFFNESS, "weight": WEIGHT, "clearance": CLEARANCE, "unit": "N, N·m², N/m, m, degrees per 30 m",
        "ends": "clamped-clamped", "rates": RATES.tolist(), "lengths": LENGTHS.tolist(),
        "compression": _listed(force), "largest_relative_error": float(np.max(error[known] / force[known])),
    }  # fmt: skip
    OUT.write_text(json.dumps(data, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"{int(np.sum(known))} loads, largest relative error {data['largest_relative_error']:.1e}: {OUT}")


def _listed(values: np.ndarray) -> list[list[float | None]]:
    """Rows of numbers to a tenth of a newton, None where there is none."""
    return [[None if math.isnan(v) else round(v, 1) for v in row] for row in values.tolist()]


if __name__ == "__main__":
    main()
