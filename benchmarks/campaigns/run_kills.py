"""``rodwell run`` of a case and of a study survives kill -9 at random moments, seeded, resumable.

    python benchmarks/campaigns/run_kills.py [--kills 100] [--seed 25]

The command writes its results over those of another case, beside a file of the user's, and is killed after a random
part of the processor's time that an undisturbed run takes. Then the folder must hold all results of the one case or all
of the other, and the user's file; the next run must leave those of its own case and no hidden folder with anything in
it.
Results go to ``run_kills.json`` beside this file; a campaign that was broken off goes on where it ended
(``run_kills.part``). Needs a POSIX system.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import random
import shutil
import signal
import tempfile
import warnings
from collections import Counter
from datetime import date
from pathlib import Path
from typing import Any

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

import killing
from click.testing import CliRunner

import rodwell
from rodwell.cli.main import cli
from rodwell.store.staging import PART as LOCK_PART
from rodwell.store.staging import PREFIX

HERE = Path(__file__).parent
OUT, PART = HERE / "run_kills.json", HERE / "run_kills.part"

CASES = {
    "case": "[dimensionless]\nweight = {weight}\nalpha = 90\nclearance = 0.01\n[load]\nuntil = -130\n",
    "study": 'study = true\n[dimensionless]\nweight = [{weight}, 20]\nalpha = "60..90 in 3"\nclearance = 0.01\n',
}
FILES = {"case": "answer.json", "study": "study.json"}
"""Where the weight of the first case stands among the results."""

WHOSE = {"15": "results of the run before", "17": "results of this run"}


def run(out: Path, kind: str, weight: int) -> int:
    """Run the command in a process of its own; return its number."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of threads, of which there are none
        pid = os.fork()
    if pid == 0:
        code = 1
        try:
            case = out.parent / f"{kind}.toml"
            case.write_text(CASES[kind].format(weight=weight), encoding="utf-8")
            done = CliRunner().invoke(cli, ["run", str(case), "--out", str(out), "--quiet"])
            code = done.exit_code
        finally:
            os._exit(code)
    return pid


def ended(pid: int) -> int:
    return os.waitpid(pid, 0)[1]


def state(out: Path, kind: str, whole: dict[int, set[str]]) -> str:
    """Whose results stand there: "15", "17", or "mixed"; "lost" where the user's file is not there."""
    names = {entry.name for entry in out.iterdir()}
    if "notes.txt" not in names or (out / "notes.txt").read_text() != "mine":
        return "lost"
    try:
        text = (out / FILES[kind]).read_text(encoding="utf-8")
        json.loads(text)
        weight = next(w for w in whole if f'"weight": {w}' in text or f"weight = {w}" in text or f"[{w}" in text)
    except (OSError, ValueError, StopIteration):
        return "mixed"
    times = [file.stat().st_mtime for file in out.iterdir() if file.name != "notes.txt"]
    same = names - {"notes.txt"} == whole[weight] and max(times) - min(times) < 60.0
    return str(weight) if same else "mixed"


def trial(seed: int, whole: dict[str, dict[int, set[str]]], seconds: dict[str, float], bases: Path) -> dict[str, Any]:
    """One kill: when, what it left, and what the next run made of that."""
    draw = random.Random(seed)
    kind = draw.choice(list(CASES))
    after = round(draw.uniform(0.0, 1.1 * seconds[kind]), 3)
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "results"
        shutil.copytree(bases / kind, out)
        (out / "notes.txt").write_text("mine")
        pid = run(out, kind, 17)
        killing.wait_for(pid, after)
        os.kill(pid, signal.SIGKILL)
        ended(pid)
        left = state(out, kind, whole[kind])
        hidden = sum(entry.name.startswith(PREFIX) for entry in Path(folder).iterdir())
        code = ended(run(out, kind, 17))
        still = [entry for entry in Path(folder).rglob("*") if entry.name.startswith(PREFIX)]
        still = [entry for entry in still if not {file.name for file in entry.iterdir()} <= {LOCK_PART}]
        return {"seed": seed, "kind": kind, "after": after, "left": left, "hidden": hidden, "next_exit": code,
                "next": state(out, kind, whole[kind]), "hidden_next": len(still)}  # fmt: skip


def fault(one: dict[str, Any]) -> bool:
    """Whether a kill did harm."""
    return one["left"] not in ("15", "17") or one["next"] != "17" or one["hidden_next"] > 0 or one["next_exit"] != 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=25)
    given = parser.parse_args()
    done = [json.loads(line) for line in PART.read_text().splitlines()] if PART.exists() else []
    done = [one for one in done if one["seed"] // 1_000_000 == given.seed]
    with tempfile.TemporaryDirectory() as folder, PART.open("a") as part:
        bases, whole, seconds = Path(folder), {}, {}
        for kind in CASES:
            rodwell.answer(rodwell.Case.from_dict({"dimensionless": {"weight": 15, "alpha": 90, "clearance": 0.01}}))
            for weight in (17, 15):
                seconds[kind] = killing.taken_by(run(bases / kind, kind, weight))
                whole.setdefault(kind, {})[weight] = {entry.name for entry in (bases / kind).iterdir()}
        for number in range(len(done), given.kills):
            done.append(trial(given.seed * 1_000_000 + number, whole, seconds, bases))
            part.write(json.dumps(done[-1]) + "\n")
            part.flush()
    result = {
        "what": "kill -9 of rodwell run, of a case and of a study, at random moments of computing and writing",
        "seed": given.seed, "date": date.today().isoformat(), "rodwell": rodwell.__version__,
        "machine": f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}",
        "kills": len(done), "kinds": dict(Counter(one["kind"] for one in done)),
        "left": dict(Counter(f"{one['kind']}: {WHOSE.get(one['left'], one['left'])}" for one in done).most_common()),
        "hidden_folders_left": sum(one["hidden"] > 0 for one in done),
        "hidden_folders_after_the_next_run": sum(one["hidden_next"] > 0 for one in done),
        "faults": [one for one in done if fault(one)],
    }  # fmt: skip
    OUT.write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(json.dumps(result, indent=1))
    if not result["faults"]:
        PART.unlink()


if __name__ == "__main__":
    main()
