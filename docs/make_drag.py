"""Numbers and tables of the pages on torque and drag, called by ``make_pages``: everything is computed here."""

from __future__ import annotations

import json
import math
import time
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from shown import table

import rodwell
from rodwell.analysis.endless.local import LIMITS, local_state
from rodwell.case.keys import key_of_field
from rodwell.case.schema import StringInput
from rodwell.case.well import hole_sections
from rodwell.case.well import schema as well_schema
from rodwell.studies.drag.calibration import calibrate
from rodwell.studies.drag.laws import CHEN
from rodwell.studies.drag.measured import read_measured
from rodwell.studies.drag.road_map import road_map

ROOT = Path(__file__).resolve().parent.parent

COMMANDS = {
    "drag": "drag examples/wells/coiled-tubing.toml",
    "drag-study": "drag examples/wells/coiled-tubing-study.toml",
    "drag-horizontal": "drag examples/wells/horizontal.toml",
}

REFERENCE = {
    "pull-out": ("502594.800142", "502594.800142"),
    "run-in": ("222687.670017", "222668.1804"),
    "rotate-off-bottom": ("379205.932788", "379205.932788"),
    "slide": ("148639.036493", "146042.6008"),
}
"""Hook loads of well A in N, without buckling and with exact local states."""

SECTIONS = {
    "[hole]": well_schema.WellHole, "[[hole.section]]": hole_sections.HolePart, "[[string]]": StringInput,
    "[well]": well_schema.WellInput, "[[well.operation]]": well_schema.OperationInput,
    "[well.road_map]": well_schema.RoadMapInput,
}  # fmt: skip
OF_A_ROD = set(StringInput.model_fields) - {"name", "length", "joints", "joint_length"}


def pages(_: Path) -> dict[str, str]:
    """Return the tables by file name."""
    return {"well-keys.md": keys_table(), "drag-well-a.md": well_a_table(), "drag-contacts.md": _contacts(),
            "drag-lock-up.md": _lock_up(), "drag-friction.txt": _friction()}  # fmt: skip


def keys_table() -> str:
    """Keys of the file of a well, from the schema."""
    parts = []
    for title, model in SECTIONS.items():
        rows = []
        for name, field in model.model_fields.items():
            if name in ("section", "operation", "road_map") or (title == "[[string]]" and name in OF_A_ROD):
                continue
            key = key_of_field(title, field.alias or name, field)
            default = "required" if key.required else f"`{key.default}`" if key.default else ""
            limits = f" ({key.allowed})" if key.allowed else ""
            rows.append(
                (f"`{key.name}`", key.kind + limits, " ".join(f"`{e}`" for e in key.examples), default, key.meaning)
            )
        more = (
            "\n`[[string]]` takes the keys of [[rod]](first-case.md) too, but `ends`.\n"
            if title == "[[string]]"
            else ""
        )
        parts.append(f"**{title}**\n\n{table(('Key', 'Kind', 'Example', 'Default', 'Meaning'), rows)}{more}")
    return "\n".join(parts)


def well_a_table() -> str:
    """Well A: hook loads here, and by other programs."""
    found = rodwell.drag(rodwell.Well.read(ROOT / "examples" / "wells" / "horizontal.toml"))
    rows = []
    for one in found.operations:
        if one.operation.kind not in REFERENCE:
            continue
        straight, exact = one.compared["straight"].hook_load, one.compared["exact"].hook_load
        rows.append((one.operation.kind, f"{straight.value:.6f}", REFERENCE[one.operation.kind][0],
                     f"{exact.value:.4f}", REFERENCE[one.operation.kind][1]))  # fmt: skip
    return table(
        ("operation", "hook load without buckling [N]", "reference", "exact local states [N]", "reference"), rows
    )


def numbers() -> dict[str, str]:
    """What the text quotes."""
    campaign = json.loads((ROOT / "benchmarks" / "campaigns" / "drag_wells.json").read_text(encoding="utf-8"))
    return {
        "drag_early": f"{LIMITS.helix_lift_off.value:.4f}",
        "drag_equal": f"{LIMITS.sinusoidal_helix_equal_energy.value:.4f}",
        "drag_late": f"{LIMITS.sinusoidal_lift_off.value:.4f}",
        "drag_wells": f"{campaign['wells']:,}",
        "drag_operations": f"{sum(campaign['operations'].values()):,}",
        "drag_buckled": f"{campaign['buckled']:,}",
        "drag_faults": str(len(campaign["faults"])),
        "drag_balance": f"{campaign['largest_balance']:.0e}",
        **_speed(),
    }


def _contacts() -> str:
    rows = []
    for beta in (2.0, 2.5, 2.8, 3.0, 3.5, 4.0, 6.0, 10.0):
        cells = [f"{beta:g}"]
        for name, low, high in (("sinusoidal", 2.0, LIMITS.sinusoidal_lift_off.value),
                                ("helical", LIMITS.helix_lift_off.value, math.inf)):  # fmt: skip
            inside = low <= beta <= high
            cells.append(f"{local_state(beta, name).contact_mean:.4f}" if inside else "–")
        cells.append(f"{1.0 + beta**2 / 4.0:.4f}" if beta >= CHEN else "1")
        rows.append(tuple(cells))
    return table(("β", "sinusoidal n/q", "helical n/q", "by correlation"), rows)


def _friction() -> str:
    """Friction factors from the measurements of the example."""
    well = rodwell.Well.read(ROOT / "examples" / "wells" / "extended-reach.toml")
    name = "examples/wells/extended-reach-hookloads.csv"
    found = calibrate(well, read_measured(ROOT / name, well))
    lines = [f"$ rodwell drag examples/wells/extended-reach.toml --calibrate {name}"]
    lines += [
        f"friction factor of {part}: {value.value:.4g} ± {value.error:.2g} (standard error)"
        for part, value in zip(found.names, found.friction, strict=True)
    ]
    return "\n".join(lines) + "\n"


def _lock_up() -> str:
    def total(switch: float) -> float:
        sine = quad(lambda b: 1.0 / local_state(float(b), "sinusoidal").contact_mean, 2.0, switch)[0]
        helix = quad(lambda x: 1.0 / (x * x * local_state(1.0 / float(x), "helical").contact_mean), 1e-9, 1.0 / switch)[
            0
        ]
        return 2.0 + float(sine) + float(helix)

    values = {
        "exact, helix early": total(LIMITS.helix_lift_off.value),
        "exact, helix from equal energy": total(LIMITS.sinusoidal_helix_equal_energy.value),
        "exact, helix late": total(LIMITS.sinusoidal_lift_off.value),
        "n = q + rP²/4B from β = 2√2": CHEN + 2.0 * (0.5 * math.pi - math.atan(math.sqrt(2.0))),
        "n = rP²/4B alone from β = 2√2": 3.0 * math.sqrt(2.0),
        "n = q + rP²/4B from β = 0": math.pi,
    }
    return table(("contact", "Λ"), [(name, f"{value:.4f}") for name, value in values.items()])


def _speed() -> dict[str, str]:
    """Processor time in a well of 5,000 stations."""
    count = 5000
    md = np.linspace(0.0, 4000.0, count)
    inclination = np.abs(np.interp(md, [0.0, 1000.0, 1900.0, 4000.0], [0.0, 0.0, 90.0, 90.0]) + 0.3 * np.sin(md / 37.0))
    azimuth = np.cumsum(np.random.default_rng(1).normal(0.0, 0.02, count))
    survey = rodwell.Survey.of(md, inclination, azimuth)
    pipe = {"pipe": "5 in 19.5 lb/ft drill pipe"}
    operations = [
        {"kind": "pull-out"}, {"kind": "run-in"}, {"kind": "rotate-off-bottom"},
        {"kind": "slide", "bit_force": "-120 kN"}, {"kind": "drill", "bit_force": "-50 kN", "bit_torque": "3 kN m"},
        {"kind": "back-ream", "speed": "300 m/h", "rpm": 100},
    ]  # fmt: skip
    hole = {"diameter": "8.5 in", "friction": 0.25}
    asked = {"depths": 100, "friction": [0.2, 0.3, 0.4]}
    well = rodwell.Well.from_dict({"hole": hole, "string": [pipe], "well": {"operation": operations}}, survey=survey)
    rodwell.drag(well)
    start = time.process_time()
    rodwell.drag(well)
    middle = time.process_time()
    road_map(rodwell.Well.from_dict({"hole": hole, "string": [pipe], "well": {"road_map": asked}}, survey=survey))
    return {"drag_six": f"{middle - start:.1f}", "drag_map": f"{time.process_time() - middle:.1f}"}
