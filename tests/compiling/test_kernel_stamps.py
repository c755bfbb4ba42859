"""What the stamp of machine code covers: every file behind a kernel and behind the models it is compiled for."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from numba.core.dispatcher import Dispatcher

from rodwell.analysis.discrete import first_run
from rodwell.compiling import cache
from rodwell.physics.on_wall.model import RodOnCylinder

WITH_KERNELS = (
    *("numerics/splines/basis", "numerics/splines/held", "numerics/splines/assembly", "numerics/splines/banded"),
    *("numerics/equilibria/newton", "numerics/equilibria/maxima"),
    *("numerics/equilibria/two_meshes", "numerics/continuation/prediction", "numerics/continuation/softest"),
    "analysis/discrete/measures",
    "studies/drag/march",
)


class Theirs(NamedTuple):
    """A model of somebody else."""

    y: int = 0


def imports(path: Path) -> Iterator[str]:
    """Modules that a file imports, read with Python's parser."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: a relative import is not seen by the stamp"
            yield from (str(node.module), *(f"{node.module}.{alias.name}" for alias in node.names))
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def test_every_import_is_seen():
    for path in cache.SOURCE.rglob("*.py"):
        wanted = {file for name in imports(path) if (file := cache._file(name))}
        assert wanted <= set(cache.imported(path)), path


@pytest.mark.parametrize(
    "text",
    [
        "from rodwell.physics.on_wall.model import RodOnCylinder\n",
        "from rodwell.physics.on_wall import linear as straight, model\n",
        "def f():\n    from rodwell.physics.on_wall import (\n        linear,  # straight rod\n        model,\n    )\n",
        "import rodwell.physics.on_wall.model\n",
        "import rodwell.physics.on_wall.model as ours  # ours\n",
    ],
)
def test_imports_are_seen_in_all_their_forms(text):
    assert cache.SOURCE / "physics" / "on_wall" / "model.py" in {cache._file(name) for name in cache._names(text)}


def reached(function: Any, seen: set[Any]) -> set[Any]:
    """Functions of rodwell that are compiled with a function: what its code names, and what they name in turn."""
    function = getattr(function, "py_func", function)
    function = getattr(function, "_defn", function)  # an intrinsic
    if function not in seen and getattr(function, "__module__", "").startswith("rodwell."):
        seen.add(function)
        for name in getattr(function, "__code__", compile("", "", "exec")).co_names:
            value = function.__globals__.get(name)
            if callable(value) and not isinstance(value, type):
                reached(value, seen)
    return seen


def test_the_stamp_covers_all_that_is_compiled_together():
    modules = [f"rodwell.{name}".replace("/", ".") for name in WITH_KERNELS]
    count = 0
    for module in modules:
        for value in vars(import_module(module)).values():
            if isinstance(value, Dispatcher) and value.py_func.__module__ == module:
                for function in reached(value, set()):
                    count += 1
                    assert Path(function.__code__.co_filename) in cache.sources(module), function
    assert count > 60
    formulas = reached(RodOnCylinder.density, set()) | reached(RodOnCylinder.observed, set())
    assert len(formulas) > 4
    for function in formulas:
        assert Path(function.__code__.co_filename) in cache.sources(RodOnCylinder.__module__), function


def test_a_model_within_a_record_is_seen():
    """The kernels take the model in the record of the mesh."""
    newton, arguments = first_run.KERNELS[1]
    assert newton.py_func.__name__ == "newton"
    assert RodOnCylinder in cache._models((arguments,))


def test_every_kernel_is_known_here():
    listed = {f"{name}.py" for name in WITH_KERNELS}
    holding = {
        path.relative_to(cache.SOURCE).as_posix()
        for path in cache.SOURCE.rglob("*.py")
        if re.search(r"import [\w, ]*\bkernel\b", path.read_text(encoding="utf-8"))
    }
    assert holding == listed


def test_the_stamp_tells_the_model_and_leaves_out_what_shapes_no_code():
    module = "rodwell.numerics.equilibria.newton"
    assert cache.stamp(module) != cache.stamp(module, RodOnCylinder)
    assert cache.stamp(module) == cache.stamp(module)
    assert Path(__file__) in cache.sources(Theirs.__module__)  # a model of somebody else
    assert cache.SOURCE / "physics" / "on_wall" / "_density.py" in cache.sources(RodOnCylinder.__module__)
    for unrelated in ("errors.py", "numerics/continuation/location.py", "analysis/branch/follow.py"):
        assert cache.SOURCE / unrelated not in cache.sources(module)


SOLVE = """
import numpy as np
from rodwell.numerics.equilibria.newton import hyperplane
x, row = np.array([3.0, 4.0]), np.empty(2)
hyperplane(np.array([[1.0], [1.0]]), 1.0, 1.0, x, 0.0, row)
print((5.0 * x).tolist(), sum(hyperplane.stats.cache_hits.values()))
"""


def test_an_edit_of_an_inner_kernel_is_compiled_into_what_calls_it(tmp_path):
    shutil.copytree(cache.SOURCE, tmp_path / "rodwell", ignore=shutil.ignore_patterns("__pycache__"))
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "NUMBA_CACHE_DIR": str(tmp_path / "kernels")}

    def run() -> str:
        done = subprocess.run(
            [sys.executable, "-c", SOLVE], env=environment, capture_output=True, text=True, check=True
        )
        return done.stdout.strip()

    assert (run(), run()) == ("[3.0, 4.0] 0", "[3.0, 4.0] 1")
    inner = tmp_path / "rodwell" / "numerics" / "splines" / "banded.py"
    before = inner.read_text(encoding="utf-8")
    after = before.replace("out[j] + band[j, 0] * xj", "out[j] + 4.0 * band[j, 0] * xj")
    assert after != before
    inner.write_text(after, encoding="utf-8")
    assert (run(), run()) == ("[1.5, 2.0] 0", "[1.5, 2.0] 1")
    with (tmp_path / "rodwell" / "numerics" / "continuation" / "location.py").open("a") as unrelated:
        unrelated.write("\n")
    assert run() == "[1.5, 2.0] 1"
