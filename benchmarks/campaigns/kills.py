"""Runs that are killed leave results whole: kill -9 at random moments and at every kind of step, seeded, resumable.

    python benchmarks/campaigns/kills.py [--kills 100] [--seed 18]

A process writes a results folder of 19 files, all of one generation, over an older one, and is killed: at a step (the
n-th time that it makes, moves, links or removes something) or after a random time. Then the folder must hold the files
of one generation, and the files of the user's that stood in it; what a next run does before it computes must leave no
hidden folder with anything in it (an empty one, of a process killed in its very first or last steps, stays for a day).
Where the folder holds folders of the user's, files are moved one by one: there it is counted how often the killed run
left a mixture, and the next run must have ended it. Results go to ``kills.json`` beside this file; a campaign that was
broken off goes on where it ended (``kills.part``). Needs a POSIX system.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import random
import shutil
import signal
import sys
import tempfile
import time
import warnings
from collections import Counter
from datetime import date
from pathlib import Path
from typing import Any

import rodwell
from rodwell.store.folder import check_writable, whole_folder
from rodwell.store.staging import PART as LOCK_PART
from rodwell.store.staging import PREFIX

HERE = Path(__file__).parent
OUT, PART = HERE / "kills.json", HERE / "kills.part"

FILES = [f"result-{number:02d}.txt" for number in range(19)]
"""As many as a case has."""

STEPS = {"open", "os.mkdir", "os.rename", "os.link", "os.remove", "os.rmdir", "ctypes.dlsym"}
"""Audit events that count as steps; the last comes just before two folders change places."""

OWN = {"none": (), "file": ("notes.txt",), "folder": ("notes.txt", "mine/deep.txt")}
"""What the user has in the folder, besides results of an earlier run."""

LONGEST = 0.08
"""Seconds after which at the latest a run is killed that is not killed at a step; it writes several times meanwhile."""


def prepared(place: Path, kind: str) -> Path:
    """A folder for results: absent, or with older results and what the user has in it."""
    out = place / "results"
    if kind != "absent":
        out.mkdir()
        for name in FILES:
            (out / name).write_text("0", encoding="utf-8")
        for name in OWN[kind]:
            (out / name).parent.mkdir(exist_ok=True)
            (out / name).write_text("mine", encoding="utf-8")
    return out


def killed(out: Path, at: int | None = None, after: float | None = None) -> int:
    """Write results in a process that dies at a step, or after a time; return how many steps it made (0: it died)."""
    reading, writing = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of threads, which the child does not use
        pid = os.fork()
    if pid == 0:
        try:
            os.close(reading)
            os.write(writing, str(_write(out, at, endless=after is not None)).encode())
        finally:
            os._exit(0)
    os.close(writing)
    if after is not None:
        time.sleep(after)
        os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    with os.fdopen(reading) as pipe:
        return int(pipe.read() or 0)


def _write(out: Path, at: int | None, endless: bool) -> int:
    """Write a generation, or one after the other; die at step ``at``."""
    count = 0

    def step(event: str, _arguments: tuple[object, ...]) -> None:
        nonlocal count
        if event in STEPS:
            count += 1
            if count == at:
                os.kill(os.getpid(), signal.SIGKILL)

    sys.addaudithook(step)
    generation = 1
    while generation == 1 or endless:
        with whole_folder(out) as folder:
            for name in FILES:
                (folder / name).write_text(str(generation), encoding="utf-8")
        generation += 1
    return count


def state(out: Path, kind: str) -> str:
    """Whether results are whole, "absent", or "mixed"; "lost" where something of the user's is not there."""
    own = OWN.get(kind, ())
    if any(not (out / name).is_file() or (out / name).read_text(encoding="utf-8") != "mine" for name in own):
        return "lost"
    if not out.exists():
        return "absent"
    texts = {(out / name).read_text(encoding="utf-8") if (out / name).is_file() else None for name in FILES}
    return "whole" if len(texts) == 1 and None not in texts else "mixed"


def trial(seed: int) -> dict[str, Any]:
    """One kill: where, what it left, and what the next run made of that."""
    draw = random.Random(seed)
    kind = draw.choice(["absent", *OWN])
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        out = prepared(place, kind)
        if draw.random() < 0.3:
            how = {"after": round(draw.uniform(0.0, LONGEST), 4)}
        else:
            how = {"at": draw.randint(1, steps(kind))}
        killed(out, **how)
        left = state(out, kind)
        hidden = sum(entry.name.startswith(PREFIX) for entry in place.iterdir())
        check_writable(out)
        after = state(out, kind)
        still = [entry for entry in place.rglob("*") if entry.name.startswith(PREFIX)]
        empty = [entry for entry in still if {file.name for file in entry.iterdir()} <= {LOCK_PART}]
    return {"seed": seed, "kind": kind, **how, "left": left, "hidden": hidden, "next": after,
            "hidden_next": len(still) - len(empty), "empty_next": len(empty)}  # fmt: skip


_steps: dict[str, int] = {}


def steps(kind: str) -> int:
    """Steps of a run that is not killed."""
    if kind not in _steps:
        place = Path(tempfile.mkdtemp())
        _steps[kind] = killed(prepared(place, kind))
        shutil.rmtree(place)
    return _steps[kind]


def fault(one: dict[str, Any]) -> bool:
    """Whether a kill did harm: a mixture is none where the user has folders, if the next run ends it."""
    allowed = {"absent": {"absent", "whole"}, "folder": {"whole", "mixed"}}.get(one["kind"], {"whole"})
    ends = allowed - {"mixed"}
    return one["left"] not in allowed or one["next"] not in ends or one["hidden_next"] > 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=18)
    given = parser.parse_args()
    done = [json.loads(line) for line in PART.read_text().splitlines()] if PART.exists() else []
    done = [one for one in done if one["seed"] // 1_000_000 == given.seed]
    with PART.open("a") as part:
        for number in range(len(done), given.kills):
            done.append(trial(given.seed * 1_000_000 + number))
            part.write(json.dumps(done[-1]) + "\n")
            part.flush()
    result = {
        "what": "kill -9 of a process that writes a results folder, at random steps and moments",
        "seed": given.seed, "date": date.today().isoformat(), "rodwell": rodwell.__version__,
        "machine": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
        "kills": len(done), "steps_of_a_run": {kind: steps(kind) for kind in ("absent", *OWN)},
        "left_by_kind": dict(Counter(f"{one['kind']}: {one['left']}" for one in done).most_common()),
        "hidden_folders_left": sum(one["hidden"] > 0 for one in done),
        "hidden_folders_after_the_next_run": sum(one["hidden_next"] + one["empty_next"] > 0 for one in done),
        "of_these_empty_ones_that_stay_for_a_day": sum(one["empty_next"] > 0 for one in done),
        "after_the_next_run": dict(Counter(one["next"] for one in done).most_common()),
        "faults": [one for one in done if fault(one)],
    }  # fmt: skip
    OUT.write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PART.unlink()
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
