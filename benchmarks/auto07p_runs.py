"""AUTO-07p by way of bifpy: an optimised build, continuation runs, their states, and what they cost."""

from __future__ import annotations

import atexit
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from auto07p_model import (
    CONDITIONS,
    END_CURVATURE,
    TORQUE,
    VARIABLES,
    contact_pressure,
    end_conditions,
    equations,
    straight,
)
from bifpy import auto

OPTIONS = "-O3 -march=native"
FREE = [1, END_CURVATURE + 1, TORQUE + 1]  # F, and the two that follow from it
SETTINGS = {
    "ips": auto.IPS_GENERAL_BVP, "ndim": len(VARIABLES), "nbc": CONDITIONS, "nint": 0, "npar": 8,
    "ncol": 4, "iad": 3, "ilp": 0, "isp": 0, "jac": 1, "itmx": 12, "itnw": 9, "nwtn": 3,
    "ds": 0.05, "dsmin": 1e-6, "nmx": 4000, "npr": 0, "rl1": 1e3, "epsl": 1e-8, "epsu": 1e-8, "epss": 1e-7, "iid": 2,
}  # fmt: skip

LOCATING = {"isp": 2, "epsl": 1e-7, "epsu": 1e-7, "epss": 1e-5, "nwtn": 9, "itmx": 20}
"""Branch points, with which AUTO-07p converges to them; with tighter tolerances it often does not."""


def optimised() -> bool:
    """Build AUTO-07p with optimisation and let bifpy use it; return whether that was possible.

    bifpy 0.3.0 compiles AUTO-07p without any optimisation, and has no option for it: a comparison of times with that
    would flatter us (it is about 2.5 times as slow). Its source distribution is fetched and compiled once, into the
    folder for temporary files.
    """
    from bifpy.auto import _process  # noqa: PLC0415 - there is no public way

    home = Path(tempfile.gettempdir()) / f"rodwell-auto07p-{os.getuid()}-{version('bifpy')}"
    tree = home / f"bifpy-{version('bifpy')}" / "auto"
    compiler = f"{shutil.which('gfortran')} {OPTIONS}"
    try:
        if not (tree / "native" / "main.o").exists():
            home.mkdir(exist_ok=True)
            fetch = [
                sys.executable,
                "-m",
                "pip",
                "download",
                "-q",
                "--no-deps",
                "--no-binary",
                ":all:",
                "-d",
                str(home),
            ]
            subprocess.run([*fetch, f"bifpy=={version('bifpy')}"], check=True, capture_output=True)
            subprocess.run(["tar", "xzf", *map(str, home.glob("*.tar.gz"))], check=True, cwd=home)
            make = ["make", "native", f"F90={compiler}", f"F77={compiler}"]
            subprocess.run(make, check=True, cwd=tree, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return False
    _process._native_build_paths = lambda: (tree / "native/main.o", tree / "lib/libbifpy.a", tree / "include")
    front = home / "bin"  # models are compiled by whatever is called gfortran
    front.mkdir(exist_ok=True)
    (front / "gfortran").write_text(f'#!/bin/sh\nexec {compiler} "$@"\n', encoding="utf-8")
    (front / "gfortran").chmod(0o755)
    os.environ["PATH"] = f"{front}{os.pathsep}{os.environ['PATH']}"
    return True


@dataclass(frozen=True)
class Run:
    """One call of AUTO-07p."""

    points: list[Any]
    folder: Path

    @property
    def labelled(self) -> list[Any]:
        return [p for p in self.points if p.is_labeled]

    def branch_points(self) -> list[Any]:
        return [p for p in self.labelled if p.point_type.name == "BRANCH_POINT"]

    def at(self, parameter: int, value: float) -> list[Any]:
        """Labelled points with a value of a parameter that was asked for."""
        near = 1e-6 * max(1e-3, abs(value))
        return [p for p in self.labelled if abs(p.all_parameters[parameter] - value) < near]

    def cost(self, times: int) -> float:
        """Processor time in seconds of AUTO-07p alone, run again as often as asked: the least."""
        return min(self._again() for _ in range(times))

    def _again(self) -> float:
        for name in ("fort.7", "fort.8", "fort.9"):
            (self.folder / name).unlink(missing_ok=True)
        before = os.times()
        subprocess.run(["./model_exe"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system


class Rod:
    """A rod for AUTO-07p: (F, T₁, w cos α, w sin α, Δ, ν)."""

    def __init__(self, parameters: Sequence[float]) -> None:
        self.parameters = tuple(parameters)
        self._start = straight(self.parameters)
        self._common = {
            "bcnd": end_conditions, "jac": auto.AUTO_JACOBIAN, "bcnd_jac": auto.AUTO_JACOBIAN,
            "transpile": True, "keep_output": True, "icu": FREE,
        }  # fmt: skip

    def trivial(self, down_to: float, ntst: int = 50, dsmax: float = 4.0) -> Run:
        """Follow the straight rod, with its branch points. The mesh stays: there is nothing to adapt it to."""
        for how in ({"isp": 2, "epsl": 1e-9, "epsu": 1e-9}, LOCATING):
            settings = SETTINGS | how | {"ntst": ntst, "iad": 0, "ds": -0.5, "dsmax": dsmax, "rl0": down_to}
            run = self._run(auto.run(equations, self._start, settings, **self._common))
            if run.branch_points():
                return run
        raise RuntimeError(f"AUTO-07p finds no branch point on the straight rod down to F = {down_to}")

    def onward(self, point: Any, down_to: float, ntst: int, dsmax: float, *, switch: bool = False, **more: Any) -> Run:
        """Continue from a labelled point, on the branch that crosses there if ``switch``."""
        calls = {key: more.pop(key) for key in ("uzr", "uzstop", "stop") if key in more}
        settings = SETTINGS | {"ntst": ntst, "dsmax": dsmax, "rl0": down_to} | more
        result = auto.restart(
            equations,
            settings,
            restart_point=point,
            isw=-1 if switch else 1,
            stpnt=self._start,
            **calls,
            **self._common,
        )
        return self._run(result)

    def _run(self, result: Any) -> Run:
        folder = Path(result.output_directory)
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        return Run([p for branch in result.branches for p in branch.points], folder)


class State:
    """A labelled solution: places and the fifteen variables there."""

    def __init__(self, point: Any, rod: Rod) -> None:
        solution = point.boundary_value_solution
        self.s = np.array(solution.normalized_time)
        self.u = np.array(solution.state).T
        self.parameters = (point.parameters[0], *rod.parameters[1:])

    def __getitem__(self, name: str) -> np.ndarray:
        return self.u[VARIABLES.index(name)]

    def pressure(self, u: np.ndarray) -> np.ndarray:
        return np.asarray(contact_pressure(dict(zip(VARIABLES, u, strict=True)), self.parameters, np.cos))

    def largest_pressure(self) -> float:
        """Max of (55) over s, on the piecewise polynomials of the collocation."""
        order = SETTINGS["ncol"]
        best = int(np.argmax(self.pressure(self.u)))
        first = max(0, (best - 1) // order) * order
        found = []
        for begin in (first, min(first + order, self.s.size - 1 - order)):
            part = slice(begin, begin + order + 1)
            x = (self.s[part] - self.s[begin]) / (self.s[begin + order] - self.s[begin])
            fine = np.linspace(0.0, 1.0, 2001)
            polynomials = np.linalg.solve(np.vander(x), self.u[:, part].T)
            p = self.pressure((np.vander(fine, order + 1) @ polynomials).T)
            found.append(float(np.max(p)))
        return max(found)

    def numbers(self) -> dict[str, float]:
        return {
            "ω₂(1)": self["omega2"][-1],
            "ω₂(0)": self["omega2"][0],
            "T₂(0)": self["T2"][0],
            "F₃(1)": self["F3"][-1],
            "1 − z(1)": 1.0 - self["z"][-1],
            "max p": self.largest_pressure(),
        }
