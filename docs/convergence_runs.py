"""What the page on convergence measures: errors on uniform meshes, and estimates beside true errors.

``make_convergence`` shows it; ``tests/validation/test_convergence_page.py`` asserts what the page says.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Any, NamedTuple

import numpy as np

import rodwell
from rodwell import Problem
from rodwell.analysis.discrete.choices import DEGREE
from rodwell.analysis.discrete.family import family as equilibria
from rodwell.analysis.discrete.family import spline_ends
from rodwell.analysis.discrete.measures import Measured, measure, measured_meshes
from rodwell.analysis.discrete.meshes import first_space
from rodwell.analysis.straight import kept
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState
from rodwell.numerics.splines.spaces import Prolongation, SplineSpace
from rodwell.physics.exact import pair_loads
from rodwell.physics.on_wall.strand import contact_pressure

PROBLEM, FORCE = Problem(40.0, alpha=60.0, twist=0.5), -190.0
"""The state of the first figure: no symmetry, axial weight, twist."""

DEGREES = (4, 5, 6, DEGREE)
MESHES = np.array([12, 16, 20, 26, 32, 40, 50, 64, 80, 100, 128, 160])
PLACES = np.linspace(0.0, 1.0, 4001)
LOAD_MESHES = {
    4: (8, 12, 16, 24, 32, 44, 64),
    5: (8, 12, 16, 24, 32, 44),
    6: (8, 12, 16, 24, 32, 38),
    DEGREE: (6, 8, 10, 12),
}
"""Up to where round-off begins: at degree 9 that is before the order of a load can be seen."""

ENDS = ("clamped-clamped", "clamped-pinned", "pinned-clamped", "pinned-pinned", "clamped-guided")
SHARES = (1.0, 0.7, 0.5, 0.35)
"""Elements of the first mesh, as a part of those that the program would take."""


class Orders(NamedTuple):
    """Errors on uniform meshes, relative: of y in H², of the contact pressure (largest over s), of a critical load."""

    h2: np.ndarray
    pressure: np.ndarray
    load: np.ndarray

    def slopes(self, degree: int) -> tuple[float, float, float]:
        """Observed orders: from the last two meshes."""
        meshes = (state_meshes(degree), state_meshes(degree), np.array(LOAD_MESHES[degree]))
        return tuple(-_slope(m, error) for m, error in zip(meshes, self, strict=True))  # type: ignore[return-value]


def _slope(meshes: np.ndarray, error: np.ndarray) -> float:
    return float((np.log(error[-1] / error[-2])) / np.log(meshes[-1] / meshes[-2]))


def state_meshes(degree: int) -> np.ndarray:
    """Elements of the meshes for states: at the program's degree the finest is left out, which is at round-off."""
    return MESHES[:-1] if degree == DEGREE else MESHES


def theory(degree: int) -> tuple[int, int, int]:
    """Orders that splines of a degree promise: H², contact pressure (three derivatives), eigenvalues."""
    return degree - 1, degree - 2, 2 * (degree - 1)


def _solve(elements: int, degree: int, start: tuple[SplineSpace, np.ndarray]) -> tuple[Family, State]:
    """The state at FORCE on a uniform mesh, from a state known on another space."""
    space = SplineSpace(np.linspace(0.0, 1.0, elements + 1), degree)
    family = equilibria(PROBLEM, space, parity=0, wavenumber=8.0, scale=50.0)
    other, c = start
    _, state, _ = family.at(space.project(other.evaluate(c, space.points, 1)[0], spline_ends(PROBLEM)), FORCE)
    if state is None:
        raise RuntimeError(f"docs: no state on {elements} elements of degree {degree}")
    return family, state


@cache
def orders() -> dict[int, Orders]:
    """Errors by degree, against degree 10 on 200 elements, and against a certified load."""
    near = rodwell.follow(PROBLEM, 1, until=FORCE, rtol=1e-9)[-1].point.fine
    family, fine = _solve(200, 10, (near.space, near.c))
    u = fine.space.evaluate(fine.c, PLACES, 4)
    pressure = contact_pressure(PLACES, *u, family.parameters(FORCE))
    load = float(rodwell.certify(PROBLEM, 1)[0].force.middle)
    out = {}
    for degree in DEGREES:
        h2, p, f = [], [], []
        for elements in state_meshes(degree):
            family, state = _solve(int(elements), degree, (fine.space, fine.c))
            v = state.space.evaluate(state.c, PLACES, 4)
            h2.append(np.sqrt(np.trapezoid((v[2] - u[2]) ** 2, PLACES) / np.trapezoid(u[2] ** 2, PLACES)))
            error = contact_pressure(PLACES, *v, family.parameters(FORCE)) - pressure
            p.append(np.max(np.abs(error)) / np.max(np.abs(pressure)))
        for elements in LOAD_MESHES[degree]:
            values, _ = kept.loads_on_mesh(PROBLEM, SplineSpace(np.linspace(0.0, 1.0, elements + 1), degree), 1, None)
            f.append(abs(values[0] + load) / abs(load))
        out[degree] = Orders(np.array(h2), np.array(p), np.array(f))
    return out


@dataclass(frozen=True)
class Estimates:
    """Error estimates and true errors, each relative to the scale of its number, (k,)."""

    claimed: np.ndarray
    true: np.ndarray
    share: np.ndarray
    number: np.ndarray

    @property
    def ratio(self) -> np.ndarray:
        """True error over estimate, (k,)."""
        return self.true / self.claimed


@cache
def estimates(count: int = 30) -> Estimates:
    """States of random problems on meshes of several densities; the reference is a mesh finer than that for 1e-10."""
    rng = np.random.default_rng(1)
    rows: list[tuple[float, ...]] = []
    for _ in range(count):
        problem = _random(rng, twisted=True)
        mode = rodwell.critical_loads(problem, int(rng.integers(1, 4)))[-1]
        force = mode.force - rng.uniform(0.1, 1.2) * mode.wavenumber**2
        rows += _one(problem, mode, force)
    return Estimates(*np.array(rows).T)


def _random(rng: np.random.Generator, *, twisted: bool) -> Problem:
    return Problem(
        float(10.0 ** rng.uniform(0.5, 2.7)),
        alpha=float(rng.uniform(5.0, 90.0)),
        clearance=float(10.0 ** rng.uniform(-2.5, -1.3)),
        twist=float(rng.choice([0.0, rng.uniform(-3.0, 3.0)])) if twisted else 0.0,
        ends=str(rng.choice(ENDS)),  # type: ignore[arg-type]
    )


def _one(problem: Problem, mode: Any, force: float) -> list[tuple[float, ...]]:
    family, state = rodwell.follow(problem, mode, until=force, rtol=1e-10)[-1].levels[1]
    finer = family.on(family.space.refined())
    _, best, _ = finer.at(Prolongation(family.space, finer.space)(state.c), force)
    if best is None:
        raise RuntimeError(f"docs: no reference for {problem} at {force}")
    exact, scales, _ = measure(finer, best)
    rows = []
    for share in SHARES:
        point = _on_share(problem, mode, family, best, share)
        if point is not None:
            for i in Measured:
                if point.values[i] == exact[i] == 0.0:  # known exactly: ω₂ where an end turns freely
                    continue
                rows.append((point.error[i] / scales[i], abs(point.values[i] - exact[i]) / scales[i], share, float(i)))
    return rows


def _on_share(problem: Problem, mode: Any, family: Family, best: State, share: float) -> MeshedState | None:
    """The state on both meshes, the first with a share of the elements that the program would take."""
    base = first_space(problem, min(best.lam, mode.force), max(best.lam, mode.force)).breaks
    elements = 2 * max(4, round(0.5 * share * (base.size - 1)))
    breaks = np.interp(np.linspace(0.0, base.size - 1, elements + 1), np.arange(base.size), base)
    rough = replace(family, space=SplineSpace(breaks, DEGREE))
    c = rough.space.project(best.space.evaluate(best.c, rough.space.points, 1)[0], rough.ends)
    _, coarse, _ = rough.at(c, best.lam)
    if coarse is None:
        return None
    meshes = measured_meshes(rough, 1e-6, 4000)
    fine = replace(coarse, space=meshes.fine.space, c=meshes.up(coarse.c))
    return meshes.at(MeshedState(coarse, fine, np.empty(0), np.empty(0), 0.0), best.lam)


@cache
def loads() -> tuple[np.ndarray, np.ndarray]:
    """Error estimates and true errors of critical loads of a horizontal rod, against the roots of (77), relative."""
    claimed, true = [], []
    for weight in np.geomspace(0.5, 5000.0, 25):
        found = rodwell.critical_loads(Problem(float(weight)), 6)
        exact = sorted((f for i in (1, 2, 3, 4) for f in pair_loads(i, np.sqrt(weight / 0.01))), reverse=True)
        claimed += list(found.errors / np.abs(found.forces))
        true += list(np.abs(found.forces - exact[:6]) / np.abs(found.forces))
    return np.array(claimed), np.array(true)


@cache
def lift_offs() -> tuple[np.ndarray, np.ndarray]:
    """Error estimates and true errors of located lift-off loads at three tolerances, against one of 1e-10, relative."""
    rng = np.random.default_rng(2)
    claimed, true = [], []
    for _ in range(16):
        problem = _random(rng, twisted=False)
        mode = rodwell.critical_loads(problem, int(rng.integers(1, 3)))[-1]
        exact = _lift_off(problem, mode, 1e-10).force
        for rtol in (1e-2, 1e-6, 1e-8):
            found = _lift_off(problem, mode, rtol)
            claimed.append(found.error / abs(exact))
            true.append(abs(found.force - exact) / abs(exact))
    return np.array(claimed), np.array(true)


def _lift_off(problem: Problem, mode: Any, rtol: float) -> Any:
    found = rodwell.follow(problem, mode, rtol=rtol).lift_off
    if found is None:
        raise RuntimeError(f"docs: no lift-off of {problem}")
    return found
