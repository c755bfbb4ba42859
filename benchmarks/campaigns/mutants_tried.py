"""Tests of a changed program: a copy of the tree, the tests of each room that are quick, and which of them go first."""

from __future__ import annotations

import functools
import importlib
import json
import os
import re
import resource
import shutil
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import resumable

from rodwell.compiling.cache import sources

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
SOURCE = ROOT / "src" / "rodwell"

READ_IN = "numba.extending scipy.integrate scipy.interpolate scipy.linalg scipy.optimize scipy.special mpmath sympy"
for _package in f"{READ_IN} hypothesis.strategies xarray pint pydantic flint".split():
    importlib.import_module(_package)

QUICK, TOGETHER, MOST, ALL = 5.0, 40.0, 30.0, 600.0
"""Seconds of the processor: of a test that is taken, of all, after which a test has failed, after which all have."""

COMPILED = "numerics/splines/lanes.py", "numerics/splines/products.py"
"""They write machine code: nothing is left of them where nothing is compiled."""

COMPILING = 10.0
"""How many times longer tests may take that compile."""

ROOMS = {
    "numerics/splines/lanes": "numerics/test_lanes.py",
    "numerics/splines/products": "numerics/test_lanes.py",
    "numerics/stretches": "numerics/test_stretches.py physics/test_off_wall.py analysis/path/test_load_path.py "
    "analysis/path/test_other_load_paths.py analysis/path/test_snapping.py analysis/path/test_string_path.py "
    "analysis/path/test_bridging.py analysis/path/test_soft_wall.py",
    "numerics": "numerics validation/test_critical_loads.py validation/test_sections.py "
    "analysis/branch/test_branches.py analysis/branch/test_branch_points.py analysis/test_pressures.py "
    "analysis/curves/test_curves.py",
    "physics/on_wall/endless": "analysis/endless/test_endless.py physics/test_curved.py",
    "physics/off_wall": "physics/test_off_wall.py numerics/test_stretches.py analysis/path/test_load_path.py "
    "analysis/path/test_other_load_paths.py analysis/path/test_snapping.py",
    "physics/exact": "physics/test_exact.py physics/test_reduction.py analysis/proof validation/test_without_wall.py "
    "validation/test_touching.py",
    "physics": "physics validation/test_critical_loads.py validation/test_sections.py",
    "quantities": "quantities case answers/test_answer.py report/test_report.py studies/test_screening.py",
}
"""Tests that look at a room, by the beginning of its path."""


@functools.cache
def in_kernels() -> frozenset[str]:
    """Paths in src/rodwell of what machine code depends on: files behind modules with kernels, and behind models."""
    files: set[Path] = set()
    for path in SOURCE.rglob("*.py"):
        if "rodwell.compiling.kernels import" in path.read_text(encoding="utf-8") or path.parent.name == "on_wall":
            files |= sources(".".join(("rodwell", *path.relative_to(SOURCE).with_suffix("").parts)))
    return frozenset(path.relative_to(SOURCE).as_posix() for path in files)


def tests_of(name: str) -> str:
    """The tests of the room of a file."""
    return next(tests for room, tests in ROOMS.items() if name.startswith(room))


@functools.cache
def _tree() -> Path:
    """A copy of what is tested, of this process; made once."""
    tree = Path(tempfile.mkdtemp(prefix="mutants-"))
    for name in ("src", "tests", "examples", "docs", "benchmarks"):
        ignored = shutil.ignore_patterns("*.pyc", "_build", "_generated", "jupyter_execute")  # but machine code
        shutil.copytree(ROOT / name, tree / name, ignore=ignored)
    for name in ("pyproject.toml", "README.md", "CHANGELOG.md", "CONTRIBUTING.md"):
        shutil.copy(ROOT / name, tree / name)
    return tree


def run_tests(tests: list[str], name: str, *, longest: float, seconds: Path | None = None) -> tuple[str, str]:
    """Run tests of a file in the copy; ``passed``, ``failed`` or ``too long``, and the end of what they say.

    With ``seconds``, a file to write what each test took to, all tests are run, whatever fails. The clock is that of
    the processor: a machine that has other things to do is no reason to fail. The tests run in a fork of this process,
    which has read in whatever they need but rodwell: half of what most changes take would be that.
    """
    _tree()
    with tempfile.TemporaryDirectory() as folder:
        said = Path(folder) / "said"
        more = {"INTERPRETED": "yes" if interpreted(name) else "no", "OPENBLAS_NUM_THREADS": "1"}
        more["MOST_SECONDS"] = str(longest * (COMPILING if name in COMPILED else 1.0))
        more |= {"NUMBA_CACHE_DIR": folder} if name in COMPILED else {}
        more |= {"SECONDS_OUT": str(seconds)} if seconds else {}
        pid = os.fork()
        if pid == 0:
            try:
                _in_fork(tests, more, said, stop=seconds is None)
            finally:
                os._exit(70)
        code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        told = "\n".join(said.read_text(encoding="utf-8", errors="replace").splitlines()[-3:])
    if code == -signal.SIGXCPU:
        return "too long", ""
    return "passed" if code == 0 else "failed", told


def _in_fork(tests: list[str], more: dict[str, str], said: Path, *, stop: bool) -> None:
    """Run tests in the copy with its own rodwell, and end this process with what pytest returns."""
    for number in 1, 2:
        os.dup2(os.open(said, os.O_WRONLY | os.O_CREAT | os.O_APPEND), number)
    os.chdir(_tree())
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ.update(more)
    sys.dont_write_bytecode = False
    for known in [known for known in sys.modules if known.partition(".")[0] == "rodwell"]:
        del sys.modules[known]
    sys.path[:0] = [str(_tree() / "src"), str(_tree() / "benchmarks" / "campaigns")]
    os.environ["PYTHONPATH"] = os.pathsep.join(sys.path[:2])
    if stop:
        resource.setrlimit(resource.RLIMIT_CPU, (int(ALL), int(ALL) + 5))
    options = ["-q", "-n", "0", "-p", "interpreted", "-p", "no:cacheprovider"]
    os._exit(pytest.main([*options, "-W", "ignore::pytest.PytestAssertRewriteWarning", *(["-x"] * stop), *tests]))


def interpreted(name: str) -> bool:
    """Whether a file is tested with uncompiled kernels."""
    return name in in_kernels() and name not in COMPILED


@functools.cache
def quick(tests: str, name: str) -> dict[str, float]:
    """Those of ``tests`` that pass as things stand and are quick, and their seconds."""
    kept = HERE / "mutants_tests.part"
    known = json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else {}
    key = f"{'interpreted' if interpreted(name) else 'compiled'}: {tests}"
    if key not in known:
        with tempfile.NamedTemporaryFile() as file:
            run_tests([f"tests/{one}" for one in tests.split()], name, longest=QUICK, seconds=Path(file.name))
            rows = [line.split(" ", 2) for line in Path(file.name).read_text(encoding="utf-8").splitlines()]
        known[key] = {test: float(seconds) for seconds, outcome, test in rows if outcome == "passed"}
        kept.write_text(json.dumps(known), encoding="utf-8")
    return dict(known[key])


def chosen(name: str, before: list[resumable.Result]) -> list[str]:
    """Quick tests of the room of a file, as many as run in TOGETHER: first those that noticed most in it."""
    tests = quick(tests_of(name), name)
    by = Counter(_noticed(one) for one in before if one["file"] == name)
    taken, total = [], 0.0
    for test in sorted(tests, key=lambda one: (-by[one], tests[one])):
        total += tests[test]
        if total > TOGETHER:
            break
        taken.append(test)
    return taken


def _noticed(one: resumable.Result) -> str:
    """The test that noticed a change; empty where none did, or where it is not told."""
    found = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", one.get("how") or "", re.MULTILINE)
    return found[1] if found else ""


@contextmanager
def changed(name: str, text: str) -> Iterator[None]:
    """Let a file of the copy hold another text for a while."""
    try:
        _put(name, text)
        yield
    finally:
        _put(name, (SOURCE / name).read_text(encoding="utf-8"))


def _put(name: str, text: str) -> None:
    """Write a file, and forget what it was compiled to: that may be as long, and as old to the second."""
    path = _tree() / "src" / "rodwell" / name
    path.write_text(text, encoding="utf-8")
    for compiled in path.parent.glob(f"__pycache__/{path.stem}.*.pyc"):
        compiled.unlink()
