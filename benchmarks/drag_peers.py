"""Well A by welleng's torque and drag beside rodwell's soft string: where they differ, and why.

    pip install welleng; python benchmarks/drag_peers.py     prints a table and writes benchmarks/results/drag_peers.md

welleng's own functions are called as its class ``TorqueDrag`` calls them, course by course from the bit up, for the
same well with stations 30, 10, 3 and 1 m apart; once as they are, once with the sign of the build turned, which
Johancsik (1984) has: tension presses the string to the inside of a bend, on the high side of a build.
"""

from __future__ import annotations

import importlib.metadata
import platform
from pathlib import Path

import numpy as np
from welleng import torque_drag

import rodwell
from rodwell.studies.drag.laws import STRAIGHT_LAW
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.run import run
from rodwell.studies.drag.well_case import Operation, Well

OUT = Path(__file__).parent / "results" / "drag_peers.md"
WEIGHT, FRICTION, RADIUS = 241.07826285, 0.25, 0.0635
KINDS = ("pull-out", "run-in", "rotate-off-bottom")


def well_a(spacing: float) -> tuple[np.ndarray, np.ndarray]:
    """Vertical to 1000 m, 3°/30 m to 90° at 1900 m, horizontal to 3400 m."""
    md = np.unique(np.concatenate([np.arange(0.0, 3400.0 + 0.5 * spacing, spacing), [1000.0, 1900.0, 3400.0]]))
    return md, np.interp(md, [0.0, 1000.0, 1900.0, 3400.0], [0.0, 0.0, 90.0, 90.0])


def by_welleng(spacing: float, sign: float) -> tuple[np.ndarray, float]:
    """Hook loads in N pulling out, running in and rotating, and torque in N m."""
    md, inclination = well_a(spacing)
    angle = np.radians(inclination)
    force, torque = np.zeros(3), 0.0
    for i in range(len(md) - 1, 0, -1):
        mean, bend = 0.5 * (angle[i] + angle[i - 1]), sign * (angle[i] - angle[i - 1])
        weight = WEIGHT * (md[i] - md[i - 1])
        normal = torque_drag.force_normal(force, mean, bend, 0.0, weight)
        force = force + np.array(torque_drag.force_tension_delta(weight, mean, FRICTION, normal))
        torque += torque_drag.torsion_delta(FRICTION, normal[2], RADIUS)
    return force, torque


def by_rodwell() -> tuple[list[float], float]:
    """The same by the soft string of rodwell, without buckling."""
    md, inclination = well_a(30.0)
    survey = rodwell.Survey.of(md, inclination)
    pipe = {"outer_diameter": "5 in", "inner_diameter": "4.276 in", "bending_stiffness": "1228241.4795 N m^2",
            "weight_per_length": f"{WEIGHT} N/m"}  # fmt: skip
    data = {"hole": {"diameter": "8.5 in", "friction": FRICTION}, "string": [pipe]}
    cutter = Cutter(Well.from_dict(data, survey=survey))
    found = [run(cutter, Operation(kind, kind, 3400.0), STRAIGHT_LAW) for kind in KINDS]
    return [one.force for one in found], found[-1].torque


def main() -> None:
    rows = []
    for name, sign in (("welleng, as it is", 1.0), ("welleng, sign of the build turned", -1.0)):
        for spacing in (30.0, 10.0, 3.0, 1.0):
            forces, torque = by_welleng(spacing, sign)
            rows.append((name, f"{spacing:g} m", *(f"{f / 1e3:.3f}" for f in forces), f"{torque / 1e3:.4f}"))
    forces, torque = by_rodwell()
    rows.append(("rodwell, soft string", "any", *(f"{f / 1e3:.3f}" for f in forces), f"{torque / 1e3:.4f}"))
    head = ("program", "stations", *(f"{kind} [kN]" for kind in KINDS), "torque [kN m]")
    lines = [f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows)]
    version = importlib.metadata.version("welleng")
    note = (
        f"Well A, hook loads without buckling; welleng {version}, Python {platform.python_version()}. Made by "
        "`python benchmarks/drag_peers.py`.\n\n"
    )
    OUT.write_text(note + "\n".join(lines) + "\n", encoding="utf-8")
    print(note + "\n".join(lines))


if __name__ == "__main__":
    main()
