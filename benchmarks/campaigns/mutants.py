"""Whether the tests notice: a seeded sample of small changes of physics, numerics and units, each tested alone.

    pip install cosmic-ray
    python benchmarks/campaigns/mutants.py [--count 300] [--workers 1]

The changes are those of cosmic-ray: another operator, another number, a comparison that is another, a loop that is not
run, a decorator that is gone. Each is made in a copy of the tree, and the tests of the room it stands in, the quickest
first, run until one fails. What kernels are made of is changed and tested uncompiled (:mod:`interpreted`), with the
tests that take less than ``QUICK`` seconds so; all else as users have it. A change that no test noticed is told with
its line: it is to be explained, or a test to be written. Results go to ``mutants.json`` beside this file; a campaign
that was broken off goes on where it ended.
"""

from __future__ import annotations

import difflib
import functools
import inspect
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

import resumable
from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names

from rodwell.compiling.cache import sources

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
SEED, LINES, SUMMARY = 25, HERE / "mutants.jsonl", HERE / "mutants.json"

QUICK, TOGETHER, MOST, ALL = 5.0, 120.0, 30.0, 600.0
"""Seconds: of a test that is taken, of all that are taken, after which a test has failed, after which all have."""

LEFT_OUT = "_density.py", "_curved_density.py", "__init__.py"
"""Written by the program itself, and held against what writes them by a test; names alone."""

ROOMS = {
    "numerics/stretches": "numerics/test_stretches.py physics/test_off_wall.py analysis/test_load_path.py "
    "analysis/test_string_path.py analysis/test_bridging.py analysis/test_soft_wall.py",
    "numerics": "numerics validation/test_critical_loads.py validation/test_sections.py analysis/test_branches.py "
    "analysis/test_pressures.py analysis/test_curves.py",
    "physics/off_wall": "physics/test_off_wall.py numerics/test_stretches.py analysis/test_load_path.py",
    "physics/exact": "physics/test_exact.py physics/test_reduction.py analysis/test_certify.py",
    "physics": "physics validation/test_critical_loads.py validation/test_sections.py validation/test_tapers.py "
    "analysis/curved analysis/test_endless.py analysis/test_pressures.py",
    "quantities": "quantities case answers/test_answer.py report/test_report.py studies/test_screening.py",
}
"""Tests that look at a room, by the beginning of its path."""

Mutant = tuple[str, str, int]  # path in src/rodwell, operator, which of its occurrences


def every_mutant() -> list[Mutant]:
    """All changes that can be made."""
    found = []
    for room in ("physics", "numerics", "quantities"):
        for path in sorted((ROOT / "src" / "rodwell" / room).rglob("*.py")):
            if path.name in LEFT_OUT:
                continue
            nodes = list(ast_nodes(get_ast(path.read_text(encoding="utf-8"))))
            name = path.relative_to(ROOT / "src" / "rodwell").as_posix()
            for operator in sorted(operator_names()):
                made = _operator(operator)
                if made is not None:
                    count = sum(1 for node in nodes for _ in made.mutation_positions(node))
                    found += [(name, operator, k) for k in range(count)]
    return found


def _operator(name: str) -> Any:
    """An operator; none for those that want arguments, change nothing, or change what is written for readers of types.

    Annotations are not evaluated: ``X | None`` with another operator is the same program.
    """
    made = get_operator(name)
    return None if list(made.arguments()) or name.endswith(("NoOp", "_BitOr")) or "BitOr_" in name else made()


@functools.cache
def sample() -> list[Mutant]:
    """All mutants in a random order: the first of them are a sample."""
    mutants = every_mutant()
    random.Random(SEED).shuffle(mutants)
    return mutants


@functools.cache
def in_kernels() -> frozenset[str]:
    """Paths in src/rodwell of what machine code depends on: files behind modules with kernels, and behind models."""
    source = ROOT / "src" / "rodwell"
    files: set[Path] = set()
    for path in source.rglob("*.py"):
        if "rodwell.compiling.kernels import" in path.read_text(encoding="utf-8") or path.parent.name == "on_wall":
            files |= sources(".".join(("rodwell", *path.relative_to(source).with_suffix("").parts)))
    return frozenset(path.relative_to(source).as_posix() for path in files)


def tests_of(name: str) -> str:
    """The tests of the room of a file."""
    return next(tests for room, tests in ROOMS.items() if name.startswith(room))


@functools.cache
def _tree() -> Path:
    """A copy of what is tested, of this process; made once."""
    tree = Path(tempfile.mkdtemp(prefix="mutants-"))
    for name in ("src", "tests", "examples", "docs", "benchmarks"):
        ignored = shutil.ignore_patterns("__pycache__", "_build", "_generated", "jupyter_execute")
        shutil.copytree(ROOT / name, tree / name, ignore=ignored)
    for name in ("pyproject.toml", "README.md", "CHANGELOG.md", "CONTRIBUTING.md"):
        shutil.copy(ROOT / name, tree / name)
    return tree


def _tested(tests: list[str], *, interpreted: bool, more: dict[str, str], stop: bool = True) -> tuple[str, str]:
    """Run tests in the copy; ``passed``, ``failed`` or ``too long``, and the end of what they say."""
    tree = _tree()
    environment = os.environ | {"PYTHONPATH": f"{tree / 'src'}{os.pathsep}{tree / 'benchmarks' / 'campaigns'}"}
    environment |= {"OPENBLAS_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1"} | more
    environment["INTERPRETED"] = "yes" if interpreted else "no"
    if not interpreted:
        environment["NUMBA_CACHE_DIR"] = str(tree / "kernels")
    command = [sys.executable, "-m", "pytest", "-q", "-n", "0", "-p", "interpreted", "-p", "no:cacheprovider"]
    try:
        run = subprocess.run(
            [*command, *(["-x"] if stop else []), *tests],
            cwd=tree, env=environment, capture_output=True, text=True, timeout=ALL if stop else None, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return "too long", ""
    return "passed" if run.returncode == 0 else "failed", "\n".join(run.stdout.splitlines()[-3:])


@functools.cache
def quick(tests: str, *, interpreted: bool) -> tuple[str, ...]:
    """Those of ``tests`` that pass as things stand and are quick, the quickest first, as many as run in TOGETHER."""
    kept = HERE / "mutants_tests.part"
    known = json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else {}
    key = f"{'interpreted' if interpreted else 'compiled'}: {tests}"
    if key not in known:
        named = [f"tests/{name}" for name in tests.split()]
        if not interpreted:  # what is compiled first is not counted
            _tested(named, interpreted=False, more={}, stop=False)
        with tempfile.NamedTemporaryFile() as file:
            more = {"SECONDS_OUT": file.name, "MOST_SECONDS": str(QUICK)}
            _tested(named, interpreted=interpreted, more=more, stop=False)
            rows = [line.split(" ", 2) for line in Path(file.name).read_text(encoding="utf-8").splitlines()]
        known[key] = sorted((float(seconds), name) for seconds, outcome, name in rows if outcome == "passed")
        kept.write_text(json.dumps(known), encoding="utf-8")
    taken, total = [], 0.0
    for seconds, name in known[key]:
        total += seconds
        if total > TOGETHER:
            break
        taken.append(name)
    return tuple(taken)


def trial(number: int) -> resumable.Result:
    """Make one change, test it, take it back."""
    name, operator, occurrence = sample()[number]
    path = _tree() / "src" / "rodwell" / name
    before = (ROOT / "src" / "rodwell" / name).read_text(encoding="utf-8")
    after = mutate_code(before, _operator(operator), occurrence)
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0)
    change = [line for line in lines if line[:1] in "+-" and line[:3] not in ("+++", "---")]
    known: resumable.Result = {
        "number": number, "file": name, "operator": operator.rpartition("/")[2], "change": change, "fault": None,
    }  # fmt: skip
    try:
        compile(after, name, "exec")
    except SyntaxError:
        return known | {"outcome": "no program"}
    interpreted = name in in_kernels() and Path(name).name not in ("lanes.py", "products.py")
    tests = quick(tests_of(name), interpreted=interpreted)
    try:
        path.write_text(after, encoding="utf-8")
        outcome, said = _tested(list(tests), interpreted=interpreted, more={"MOST_SECONDS": str(MOST)})
    finally:
        path.write_text(before, encoding="utf-8")
    return known | {
        "interpreted": interpreted,
        "tests": len(tests),
        "outcome": "survived" if outcome == "passed" else "killed",
        "how": said if outcome == "failed" else outcome,
    }


def told(results: list[resumable.Result]) -> resumable.Result:
    """What the summary says."""
    outcomes = Counter(result["outcome"] for result in results)
    told_of = "number", "file", "operator", "change"
    survived = [{key: one[key] for key in told_of} for one in results if one["outcome"] == "survived"]
    programs = len(results) - outcomes["no program"]
    return {
        "what": inspect.cleandoc(__doc__ or "").splitlines()[0], "changes that can be made": len(sample()),
        "no program": outcomes["no program"], "killed": outcomes["killed"], "survived": outcomes["survived"],
        "share killed": round(outcomes["killed"] / programs, 4), "survivors": survived,
    }  # fmt: skip


if __name__ == "__main__":
    _, summary = resumable.campaign(__doc__ or "", trial, SEED, LINES, SUMMARY, told)
    print(json.dumps({k: v for k, v in summary.items() if k != "survivors"}, indent=1))
