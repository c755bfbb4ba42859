"""No verdict of ``rodwell screen`` is milder than its own lines: 1,000 random wells, seeded, resumable.

    python benchmarks/campaigns/screen_verdicts.py [--wells 1000] [--seed 18]

Every well is drawn from its own seed, screened, and its headline is held against what its own numbers say: the stations
past their exact loads, within the error of these, above He–Kyllingstad where the hole drops, and without an exact load.
The rule is written down here once more, from the numbers of ``screening.json`` alone; of bends beside a station, which
count as at the station where they hold the pipe less, it is held that they make no utilisation milder. Results go to
``screen_verdicts.json`` beside this file; a run that was broken off goes on where it ended (``screen_verdicts.part``).
"""

from __future__ import annotations

import argparse
import json
import math
import platform
from collections import Counter
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np

import rodwell
from rodwell.studies.well.plain import screening_dict

HERE = Path(__file__).parent
OUT, PART = HERE / "screen_verdicts.json", HERE / "screen_verdicts.part"
ENDS = ("clamped-clamped", "pinned-pinned", "pinned-clamped", "clamped-pinned", "guided-clamped")


def random_well(seed: int) -> dict[str, Any]:
    """Screen a random string in a random well under a random force; the plain data of what was found."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(2, 25))
    md = np.concatenate([[0.0], np.cumsum(draw.uniform(5.0, 250.0, count - 1))])
    knots = np.sort(draw.uniform(0.0, md[-1], 3))
    turns = draw.choice([0.0, 5.0, 30.0, 60.0, 90.0, 100.0], 3) + draw.uniform(-3.0, 3.0, 3)
    inclination = np.clip(np.interp(md, knots, turns), 0.0, 110.0)
    azimuth = None if draw.random() < 0.5 else np.cumsum(draw.normal(0.0, 3.0, count)) % 360.0
    outer = draw.uniform(0.03, 0.2)
    inner = outer * draw.uniform(0.5, 0.95)
    stiffness = 206e9 * math.pi / 64.0 * (outer**4 - inner**4)
    weight = 7850.0 * 9.81 * math.pi / 4.0 * (outer**2 - inner**2) * draw.uniform(0.7, 1.0)
    clearance = outer * draw.uniform(0.1, 1.5)
    case = rodwell.Case.from_dict(
        {
            "rod": {
                "length": "200 m", "bending_stiffness": f"{stiffness!r} N m^2",
                "weight_per_length": f"{weight!r} N/m", "ends": str(draw.choice(ENDS)),
            },
            "hole": {"clearance": f"{clearance!r} m", "angle_from_vertical": "90 deg"},
        }
    )  # fmt: skip
    scale = 2.0 * math.sqrt(stiffness * weight / clearance)
    kind = draw.integers(0, 4)
    if kind == 0:
        forces = scale * draw.normal(0.0, 0.8, count)
        survey = rodwell.Survey.of(md, inclination, azimuth, forces)
        return screening_dict(rodwell.screen(case, survey))
    survey = rodwell.Survey.of(md, inclination, azimuth)
    if kind == 1:
        return screening_dict(rodwell.screen(case, survey))
    if kind == 2:
        hook = weight * float(survey.tvd[-1]) - scale * draw.uniform(-0.5, 2.0)
        return screening_dict(rodwell.screen(case, survey, hook_force=hook, signs_meant=True))
    return screening_dict(rodwell.screen(case, survey, bit_force=-scale * draw.uniform(-0.2, 2.0), signs_meant=True))


def said(headline: str) -> int:
    """How bad the headline is: 0 no word of buckling or none, 1 cannot be judged, 2 close, 3 expected, 4 buckles."""
    if headline.startswith("The string buckles or comes so close"):
        return 2
    if headline.startswith("The string buckles:"):
        return 4
    if headline.startswith("Expect the string to buckle"):
        return 3
    return 1 if headline.startswith("Not every station can be judged") else 0


def shown(data: dict[str, Any]) -> int:
    """How bad the worst of what is printed is, from the numbers alone."""
    if data["compression"] is None:
        return 0
    worst, curved = 0, data["formulas"]
    for i, force in enumerate(data["compression"]):
        if force <= 0.0:
            continue
        exact, lift = data["critical_compression"][i], data["lift_off_compression"][i]
        error, bent = data["critical_error"][i], data["critical_compression_in_build"][i]
        if bent is not None:
            exact, lift, error = bent, None, data["critical_error_in_build"][i]
            # a bend that counts less beside the station counts as there: the load may be lower than in its own bend
            exact = min(exact, force / data["utilisation"][i])
        if any(limit is not None and force > limit for limit in (exact, lift)):
            return 4
        if exact is None:
            worst = max(worst, 1)
        elif force >= exact - error:
            worst = max(worst, 2)
        bend, straight = curved["he_kyllingstad"][i], curved["dawson_paslay"][i]
        if bent is None and bend < 0.99 * straight and force > bend:
            worst = max(worst, 3)
    return worst


def own_bend_is_raised(data: dict[str, Any], i: int) -> bool:
    """Whether a station's utilisation is lower than by the load in its own bend, which bends beside it only lower."""
    if data["compression"] is None or data["critical_compression_in_build"][i] is None:
        return False
    own = max(data["compression"][i], 0.0) / data["critical_compression_in_build"][i]
    return bool(data["utilisation"][i] < own * (1.0 - 1e-12))


def faults(data: dict[str, Any]) -> list[str]:
    """What is milder than what stands below it: nothing, if all is well."""
    headline, lines = data["summary"][0], data["summary"]
    out = []
    if said(headline) != shown(data):
        out.append(f"headline says {said(headline)}, the numbers {shown(data)}: {headline}")
    if any(own_bend_is_raised(data, i) for i in range(len(data["measured_depth"]))):
        out.append("a utilisation is milder than by the load in the station's own bend")
    if max(said(line) for line in lines) > said(headline):
        out.append(f"a line is worse than the headline: {headline}")
    mild = "does not buckle" in headline
    if mild and any("buckl" in text for text in data["remarks"].values() if "past" in text or "expect" in text):
        out.append(f"a remark is worse than the headline: {headline}")
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--wells", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=18)
    given = parser.parse_args()
    done = [json.loads(line) for line in PART.read_text().splitlines()] if PART.exists() else []
    done = [one for one in done if one["seed"] // 1_000_000 == given.seed]
    with PART.open("a") as part:
        for number in range(len(done), given.wells):
            seed = given.seed * 1_000_000 + number
            data = random_well(seed)
            one = {"seed": seed, "verdict": data["verdict"], "stations": len(data["measured_depth"]),
                   "faults": faults(data)}  # fmt: skip
            done.append(one)
            part.write(json.dumps(one) + "\n")
            part.flush()
    result = {
        "what": "verdicts of rodwell screen against their own lines and numbers, random wells",
        "seed": given.seed, "date": date.today().isoformat(), "rodwell": rodwell.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}",
        "wells": len(done), "stations": sum(one["stations"] for one in done),
        "verdicts": dict(Counter(one["verdict"] for one in done).most_common()),
        "milder_than_their_lines": [one for one in done if one["faults"]],
    }  # fmt: skip
    OUT.write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PART.unlink()
    print(json.dumps({key: result[key] for key in ("wells", "verdicts", "milder_than_their_lines")}, indent=1))


if __name__ == "__main__":
    main()
