"""Two wells by welleng and by torque-drag beside rodwell's soft string: where they differ, and why.

    pip install welleng torque-drag; python benchmarks/drag_peers.py
                                          prints a table and writes benchmarks/results/drag_peers.md

Well A builds from vertical to horizontal; the turn is at 60° all along and turns by 90°. Stations stand 30, 10, 3 and
1 m apart.

welleng's own functions are called as its class ``TorqueDrag`` calls them, course by course from the bit up; once as
they are, once with the sign of the build turned, which Johancsik (1984) has: tension presses the string to the inside
of a bend, on the high side of a build. Where nothing builds the sign does not matter.

torque-drag is called as it is, with a friction factor for each station: a single one it replaces by 0.24. Its density
makes the weight that the string has, since it knows no weight per length. It takes the weight of the course above a
station with the bend of the course below, and leaves out the course at the bit.
"""

from __future__ import annotations

import importlib.metadata
import platform
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import torque_drag
from welleng import torque_drag as welleng_drag

import rodwell
from rodwell.studies.drag.laws import STRAIGHT_LAW
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.run import run
from rodwell.studies.drag.well_case import Operation, Well

Path3 = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Measured depth in m, inclination and azimuth in degrees at every station."""

OUT = Path(__file__).parent / "results" / "drag_peers.md"
WEIGHT, FRICTION, RADIUS = 241.07826285, 0.25, 0.0635
KINDS = ("pull-out", "run-in", "rotate-off-bottom")


def well_a(spacing: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertical to 1000 m, 3°/30 m to 90° at 1900 m, horizontal to 3400 m: depth, inclination, azimuth."""
    md = stations(spacing, 1000.0, 1900.0, 3400.0)
    return md, np.interp(md, [0.0, 1000.0, 1900.0, 3400.0], [0.0, 0.0, 90.0, 90.0]), np.zeros(len(md))


def turn(spacing: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """At 60° all along; straight to 1000 m, turning by 90° to 1900 m, straight to 3400 m."""
    md = stations(spacing, 1000.0, 1900.0, 3400.0)
    return md, np.full(len(md), 60.0), np.interp(md, [0.0, 1000.0, 1900.0, 3400.0], [0.0, 0.0, 90.0, 90.0])


def stations(spacing: float, *more: float) -> np.ndarray:
    return np.unique(np.concatenate([np.arange(0.0, 3400.0 + 0.5 * spacing, spacing), [*more]]))


def by_welleng(path: Path3, sign: float) -> tuple[np.ndarray, float]:
    """Hook loads in N pulling out, running in and rotating, and torque in N m."""
    md, inclination, azimuth = path
    angle, bearing = np.radians(inclination), np.radians(azimuth)
    force, torque = np.zeros(3), 0.0
    for i in range(len(md) - 1, 0, -1):
        mean, bend = 0.5 * (angle[i] + angle[i - 1]), sign * (angle[i] - angle[i - 1])
        weight = WEIGHT * (md[i] - md[i - 1])
        normal = welleng_drag.force_normal(force, mean, bend, bearing[i] - bearing[i - 1], weight)
        force = force + np.array(welleng_drag.force_tension_delta(weight, mean, FRICTION, normal))
        torque += welleng_drag.torsion_delta(FRICTION, normal[2], RADIUS)
    return force, torque


def by_torque_drag(path: Path3) -> tuple[np.ndarray, float]:
    """The same by torque-drag."""
    columns = [np.diff(one, prepend=one[0]) for one in path]
    points = [
        {"md": md, "inc": inc, "azi": azi, "delta": dict(zip(("md", "inc", "azi"), changes, strict=True))}
        for md, inc, azi, *changes in zip(*path, *columns, strict=True)
    ]
    inch = 1.0 / 39.37  # as it has it
    area = np.pi / 4.0 * ((5.0 * inch) ** 2 - (4.276 * inch) ** 2)
    pipe = {"od": 5.0, "id": 4.276, "shoe": path[0][-1], "length": path[0][-1]}
    found = torque_drag.calc(
        points, {"pipe": pipe, "odAnn": 8.5}, {"rhof": 0.0, "rhod": WEIGHT / (9.81 * area) / 1000.0},
        fric=[FRICTION] * len(points), torque_calc=True,
    )  # fmt: skip
    loads = [1e3 * found.force[case][0] for case in ("hoisting", "lowering", "static")]
    return np.array(loads), 1e3 * found.torque["static"][0]


def by_rodwell(path: Path3) -> tuple[list[float], float]:
    """The same by the soft string of rodwell, without buckling."""
    survey = rodwell.Survey.of(*path)
    pipe = {"outer_diameter": "5 in", "inner_diameter": "4.276 in", "bending_stiffness": "1228241.4795 N m^2",
            "weight_per_length": f"{WEIGHT} N/m"}  # fmt: skip
    data = {"hole": {"diameter": "8.5 in", "friction": FRICTION}, "string": [pipe]}
    cutter = Cutter(Well.from_dict(data, survey=survey))
    found = [run(cutter, Operation(kind, kind, 3400.0), STRAIGHT_LAW) for kind in KINDS]
    return [one.force for one in found], found[-1].torque


PROGRAMS: dict[str, Callable[[Path3], tuple[Any, float]]] = {
    "welleng, as it is": lambda path: by_welleng(path, 1.0),
    "welleng, sign of the build turned": lambda path: by_welleng(path, -1.0),
    "torque-drag": by_torque_drag,
}


def main() -> None:
    rows = []
    for well, path in (("A", well_a), ("turn", turn)):
        for name, program in PROGRAMS.items():
            if well == "turn" and "sign" in name:
                continue
            for spacing in (30.0, 10.0, 3.0, 1.0):
                rows.append(row(well, name, f"{spacing:g} m", *program(path(spacing))))
        rows.append(row(well, "rodwell, soft string", "any" if well == "A" else "1 m", *by_rodwell(path(1.0))))
    head = ("well", "program", "stations", *(f"{kind} [kN]" for kind in KINDS), "torque [kN m]")
    lines = [f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *rows)]
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("welleng", "torque-drag"))
    note = (
        f"Hook loads without buckling; {versions}, Python {platform.python_version()}. Made by "
        "`python benchmarks/drag_peers.py`.\n\n"
    )
    OUT.write_text(note + "\n".join(lines) + "\n", encoding="utf-8")
    print(note + "\n".join(lines))


def row(well: str, name: str, spacing: str, forces: Any, torque: float) -> tuple[str, ...]:
    return (well, name, spacing, *(f"{f / 1e3:.3f}" for f in forces), f"{torque / 1e3:.4f}")


if __name__ == "__main__":
    main()
