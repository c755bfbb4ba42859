"""How long the first run of all takes, when nothing is compiled yet: this tree beside another one, in turns.

    git worktree add --detach ../before REVISION
    python benchmarks/first_run.py ../before [TURNS]    prints a table and writes benchmarks/results/first_run.md

Each command starts with a folder for kernels of its own, which is empty. Processor time is that of the command and of
the second process that compiles beside it; on a machine with other work, trust the ratios more than the times.
"""

from __future__ import annotations

import os
import resource
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
TURNS = 3

COMMANDS = (
    "diagram --weight 15 --alpha 90",
    "critical --weight 15 --alpha 60",
    "liftoff --weight 15 --alpha 60",
    "run examples/drill-string.toml",
)
"""What is measured, as one types it behind ``rodwell``."""


def _used() -> float:
    """Processor time of all children that have ended, and theirs."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def first_run(root: Path, command: str) -> tuple[float, float]:
    """Seconds of the processors, and on the wall, of a command of the sources in ``root`` with nothing compiled."""
    with tempfile.TemporaryDirectory() as work:
        environment = os.environ | {"PYTHONPATH": str(root / "src"), "NUMBA_CACHE_DIR": work}
        words = [str(HERE.parent / word) if word.startswith("examples/") else word for word in shlex.split(command)]
        if words[0] in ("diagram", "run"):  # writes a folder
            words += ["--out", str(Path(work) / "results")]
        used, start = _used(), time.perf_counter()
        subprocess.run(
            [sys.executable, "-m", "rodwell", *words], env=environment, cwd=work, check=True, capture_output=True
        )
        return _used() - used, time.perf_counter() - start


def main() -> int:
    if len(sys.argv) not in (2, 3) or not (Path(sys.argv[1]) / "src" / "rodwell").is_dir():
        print(__doc__)
        return 2
    other, turns = Path(sys.argv[1]).resolve(), int(sys.argv[2]) if len(sys.argv) > 2 else TURNS
    revision = subprocess.run(
        ["git", "-C", str(other), "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False
    ).stdout.strip()
    rows = [
        f"First runs of this version beside {revision or 'another one'}, {turns} turns, {time.strftime('%Y-%m-%d')}: "
        "seconds of the processors, and on the wall; the least, and the median of the ratios.",
        "",
        "| command | before | now | ratio | before, wall | now, wall | ratio |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    for command in COMMANDS:
        pairs = [[first_run(tree, command) for tree in (other, HERE.parent)] for _ in range(turns)]
        cells = []
        for k in range(2):  # processors, wall
            before, now = ([pair[tree][k] for pair in pairs] for tree in range(2))
            ratio = statistics.median(b / a for a, b in zip(before, now, strict=True))
            cells += [f"{min(before):.1f}", f"{min(now):.1f}", f"{ratio:.2f}"]
        rows.append(f"| `{command}` | {' | '.join(cells)} |")
        print(rows[-1], flush=True)
    (HERE / "results" / "first_run.md").write_text("\n".join(rows) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
