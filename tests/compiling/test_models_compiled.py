"""Commands have those kernels only that their own model needs: the list of what a process has read or compiled."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

SCRIPT = """
import gc, json, sys
from click.testing import CliRunner
from rodwell.cli.main import cli

result = CliRunner().invoke(cli, sys.argv[1:])
assert result.exit_code == 0, result.output
from numba.core.dispatcher import Dispatcher

found = {}
for one in [one for one in gc.get_objects() if isinstance(one, Dispatcher)]:
    for signature in one.overloads if one.py_func.__module__.startswith("rodwell") else ():
        models, ahead = found.setdefault(one.py_func.__qualname__, []), list(signature)
        while ahead:
            argument = ahead.pop()
            if hasattr(argument, "instance_class"):
                models.append(argument.instance_class.__name__)
                ahead += getattr(argument, "types", ())
print(json.dumps(found))
"""
"""Runs a command, and tells the named tuples in the types for which each kernel is there."""

ROD = ("--weight", "15", "--alpha", "60")
BRANCH = ("diagram", *ROD, "--modes", "1", "--until")


@pytest.mark.parametrize(
    ("command", "model"),
    [
        (("critical", *ROD), None),
        (("critical", *ROD, "--build", "0.05"), None),
        (("path", *ROD, "--sections", "0.5:1,0.5:1:-1", "--until", "-30"), None),
        ((*BRANCH, "-110"), "RodOnCylinder"),
        ((*BRANCH, "-110", "--sections", "0.5:1,0.5:1.1"), "RodOfSections"),
        ((*BRANCH, "-130", "--build", "0.05"), "RodInCurvedHole"),
    ],
)
def test_a_command_has_no_kernel_of_a_model_that_it_does_not_use(command: tuple[str, ...], model: str | None) -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT, *command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    kernels = json.loads(done.stdout)
    models = {name for names in kernels.values() for name in names if name.startswith("Rod")}
    assert models == (set() if model is None else {model})
    assert ("newton" in kernels) is (model is not None)
