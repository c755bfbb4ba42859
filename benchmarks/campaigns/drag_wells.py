"""Torque and drag of 1,000 random wells: none fails, all balance, bounds hold, stations added change nothing; seeded.

    python benchmarks/campaigns/drag_wells.py [--wells 1000] [--seed 23]

Every well is drawn from its own seed: a path of arcs in space, one to four sections of string, one to three of hole,
fluids, friction, block, and five operations of random kind; three in ten have a stiff string. Held against each other
are the work of the ends and that of gravity and friction; the hook loads by rule (history between early and late, where
a run of one kind is compared); the same well with a station added in the middle of every arc; the verdict and what
stands below it. Results go to ``drag_wells.json`` beside this file; a run that was broken off goes on where it ended
(``drag_wells.part``).
"""

from __future__ import annotations

import argparse
import json
import math
import platform
import traceback
from collections import Counter
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np

import rodwell
from rodwell.case.well.schema import KINDS_OF_OPERATION
from rodwell.studies.drag.drag import Drag, drag
from rodwell.studies.drag.plain import drag_dict
from rodwell.studies.drag.well_case import Well

HERE = Path(__file__).parent
OUT, PART = HERE / "drag_wells.json", HERE / "drag_wells.part"
BALANCE = 1e-8
OPERATIONS = 5
WALL_PULLS = {"soft": 1e-6, "stiff": 1e-2}
"""Part of the largest contact force that may be found as a pull: of a stiff string it varies along a piece by some."""

STIFF = 0.3
"""Share of the wells whose string is stiff."""


def random_survey(draw: np.random.Generator) -> rodwell.Survey:
    """Arcs between stations, vertical at the surface, up to 100° from the vertical, turning."""
    count = int(draw.integers(2, 30))
    md = np.concatenate([[0.0], np.cumsum(draw.uniform(20.0, 400.0, count))])
    target = draw.choice([0.0, 20.0, 50.0, 80.0, 90.0, 98.0])
    rate = draw.uniform(0.01, 0.2)
    inclination = np.clip(np.minimum(np.maximum(md - draw.uniform(0.0, 600.0), 0.0) * rate, target), 0.0, 100.0)
    inclination += draw.choice([0.0, 0.3]) * np.abs(draw.normal(0.0, 1.0, count + 1))
    azimuth = None if draw.random() < 0.4 else np.cumsum(draw.normal(0.0, 2.0, count + 1))
    return rodwell.Survey.of(md, inclination, azimuth)


def random_string(draw: np.random.Generator, reach: float) -> list[dict[str, Any]]:
    """Sections from the bit up; the last reaches to the surface."""
    out = []
    left = reach
    for _ in range(int(draw.integers(0, 4))):
        length = draw.uniform(0.02, 0.3) * reach
        if length < left:
            out.append(random_pipe(draw) | {"length": f"{length!r} m"})
            left -= length
    return [*out, random_pipe(draw)]


def random_pipe(draw: np.random.Generator) -> dict[str, Any]:
    outer = draw.uniform(0.025, 0.15)
    return {
        "outer_diameter": f"{outer!r} m", "inner_diameter": f"{outer * draw.uniform(0.3, 0.9)!r} m",
        "material": "steel", "yield_strength": "700 MPa",
    }  # fmt: skip


def random_hole(draw: np.random.Generator, end: float) -> dict[str, Any]:
    cuts = [0.0, *np.sort(draw.uniform(0.1, 0.9, int(draw.integers(0, 3)))) * end]
    sections = []
    for i, start in enumerate(cuts):
        part = {"from": f"{float(start)!r} m", "diameter": f"{float(draw.uniform(0.16, 0.35))!r} m",
                "friction": float(draw.choice([0.0, draw.uniform(0.05, 0.6)], p=[0.05, 0.95]))}  # fmt: skip
        if i + 1 < len(cuts):
            part["to"] = f"{float(cuts[i + 1])!r} m"
        sections.append(part)
    return {"section": sections}


def random_operation(draw: np.random.Generator, end: float) -> dict[str, Any]:
    kind = str(draw.choice(KINDS_OF_OPERATION))
    out: dict[str, Any] = {"kind": kind, "bit_depth": f"{draw.uniform(0.05, 1.0) * end!r} m"}
    if kind in ("slide", "drill"):
        out["bit_force"] = f"{-(10.0 ** draw.uniform(2.0, 5.6))!r} N"
    if kind == "drill":
        out["bit_torque"] = f"{10.0 ** draw.uniform(1.0, 4.0)!r} N m"
    if kind in ("ream", "back-ream") or (kind == "drill" and draw.random() < 0.5):
        out |= {"speed": f"{float(draw.uniform(0.001, 0.5))!r} m/s", "rpm": float(draw.uniform(10.0, 200.0))}
    return out


def random_case(seed: int) -> tuple[dict[str, Any], rodwell.Survey]:
    """The file of a random well, and its survey."""
    draw = np.random.default_rng(seed)
    survey = random_survey(draw)
    end = float(survey.md[-1])
    data = {
        "hole": random_hole(draw, end),
        "string": random_string(draw, end),
        "well": {
            "block_weight": f"{float(draw.choice([0.0, 2e5]))!r} N",
            "contact": str(draw.choice(["exact", "correlation", "straight"], p=[0.7, 0.2, 0.1])),
            "state_rule": str(draw.choice(["history", "equal-energy", "early", "late"])),
            "operation": [random_operation(draw, end) for _ in range(OPERATIONS)],
        },
    }
    if draw.random() < 0.7:
        data["mud"] = {"density": f"{float(draw.uniform(800.0, 2000.0))!r} kg/m^3"}
    if draw.random() < STIFF:
        data["well"]["string"] = "stiff"
    return data, survey


def refined(survey: rodwell.Survey) -> rodwell.Survey:
    """The same path with a station in the middle of every arc."""
    angle = np.radians(survey.inclination)
    turn = np.zeros(len(survey)) if survey.azimuth is None else np.radians(survey.azimuth)
    t = np.stack([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)], axis=1)
    middle = t[:-1] + t[1:]
    middle /= np.linalg.norm(middle, axis=1)[:, None]
    md = np.empty(2 * len(survey) - 1)
    md[::2], md[1::2] = survey.md, 0.5 * (survey.md[:-1] + survey.md[1:])
    inclination, azimuth = np.empty(len(md)), np.empty(len(md))
    inclination[::2] = survey.inclination
    inclination[1::2] = np.degrees(np.arctan2(np.hypot(middle[:, 0], middle[:, 1]), middle[:, 2]))
    azimuth[::2] = np.degrees(turn)
    halves = np.degrees(np.arctan2(middle[:, 1], middle[:, 0]))
    azimuth[1::2] = halves + 360.0 * np.round((np.degrees(turn[:-1]) - halves) / 360.0)
    return rodwell.Survey.of(md, inclination, None if survey.azimuth is None else azimuth)


def faults(found: Drag, finer: Drag) -> list[str]:
    """What contradicts itself: nothing, if all is well."""
    out = []
    for one, again in zip(found.operations, finer.operations, strict=True):
        name = f"{one.operation.kind}"
        if one.balance is not None and not one.balance.value <= BALANCE:
            out.append(f"{name}: work does not balance, {one.balance.value:.1e}")
        if not np.all(np.isfinite(one.run.rows)):
            out.append(f"{name}: a number along the string is not finite")
        pulls = WALL_PULLS[found.well.settings.string] * np.max(np.abs(one.run.rows[:, 3]))
        if np.any(one.run.rows[:, 3] < -pulls):
            out.append(f"{name}: the wall pulls")
        early, late = (one.bounds[rule].hook_load for rule in ("early", "late"))
        mine = one.ends.hook_load
        if early and late and mine:
            room = 10.0 * (early.error + late.error + mine.error)
            if not min(early.value, late.value) - room <= mine.value <= max(early.value, late.value) + room:
                out.append(f"{name}: {mine.value:.3f} is outside of its bounds {early.value:.3f}, {late.value:.3f}")
        elif mine and not late:
            out.append(f"{name}: arrives although it locks up with the least contact")
        other = again.ends.hook_load
        if (mine is None) != (other is None):
            out.append(f"{name}: locks up or not by the stations")
        elif mine and other and abs(mine.value - other.value) > 10.0 * (mine.error + other.error) + 1e-9 * size(one):
            out.append(f"{name}: stations added change {mine.value!r} to {other.value!r}, errors {mine.error:.1e}")
    data = drag_dict(found)
    json.dumps(data, allow_nan=False)
    if data["verdict"] != "fails" and any(not one["possible"] for one in data["operations"]):
        out.append("the verdict is milder than an operation")
    return out


def size(one: Any) -> float:
    """Weights and forces of an operation in N."""
    return float(np.sum(one.run.pieces.table[:, 0] * one.run.pieces.table[:, 6])) + abs(one.operation.bit_force)


def computed(seed: int) -> dict[str, Any]:
    """What came of one well."""
    data, survey = random_case(seed)
    try:
        found = drag(Well.from_dict(data, survey=survey))
        finer = drag(Well.from_dict(data, survey=refined(survey)))
    except rodwell.InputError as error:
        return {"seed": seed, "refused": str(error), "faults": []}
    except Exception:  # what the campaign is there to find
        return {"seed": seed, "faults": [traceback.format_exc(limit=4)]}
    errors = [one.ends.hook_load.error / max(size(one), 1.0) for one in found.operations if one.ends.hook_load]
    return {
        "seed": seed, "string": data["well"].get("string", "soft"),
        "verdicts": [one.operation.kind + (": locks up" if one.locked else "") for one in found.operations],
        "buckled": sum(bool(one.run.buckled) for one in found.operations),
        "differ": sum(_apart(one) for one in found.operations),
        "balance": max((one.balance.value for one in found.operations if one.balance), default=0.0),
        "error": max(errors, default=0.0), "faults": faults(found, finer),
    }  # fmt: skip


def _apart(one: Any) -> bool:
    early, late = (one.bounds[rule].hook_load for rule in ("early", "late"))
    return bool(early and late and abs(early.value - late.value) > early.error + late.error)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--wells", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=23)
    given = parser.parse_args()
    done = [json.loads(line) for line in PART.read_text().splitlines()] if PART.exists() else []
    done = [one for one in done if one["seed"] // 1_000_000 == given.seed]
    with PART.open("a") as part:
        for number in range(len(done), given.wells):
            one = computed(given.seed * 1_000_000 + number)
            done.append(one)
            part.write(json.dumps(one) + "\n")
            part.flush()
    ran = [one for one in done if "error" in one]
    kinds = Counter(kind for one in ran for kind in one["verdicts"])
    result = {
        "what": "torque and drag of random wells: exceptions, balance of work, bounds, stations added",
        "seed": given.seed, "date": date.today().isoformat(), "rodwell": rodwell.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}",
        "wells": len(done), "stiff": sum(one["string"] == "stiff" for one in ran),
        "refused": [one for one in done if "refused" in one],
        "operations": dict(kinds.most_common()), "buckled": sum(one["buckled"] for one in ran),
        "where_two_states_differ": sum(one["differ"] for one in ran),
        "largest_balance": max((one["balance"] for one in ran), default=math.nan),
        "largest_error_of_all_weights": {
            string: max((one["error"] for one in ran if one["string"] == string), default=math.nan)
            for string in ("soft", "stiff")
        },
        "faults": [one for one in done if one["faults"]],
    }  # fmt: skip
    OUT.write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PART.unlink()
    shown = ("wells", "stiff", "operations", "buckled", "where_two_states_differ", "largest_balance", "faults")
    print(json.dumps({key: result[key] for key in shown}, indent=1))


if __name__ == "__main__":
    main()
