"""The engine on two models of a few lines, without a rod: what it finds is known in closed form or by quadrature.

Both are ½u'² − λV(u) with u held at both ends: the pendulum, V = 1 − cos u, whose straight state buckles in
pitchforks, and V = u + u³/3, whose only branch turns back in a fold.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from discretised import nothing_on_disk
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq, minimize_scalar
from scipy.special import ellipe, ellipk

from rodwell.numerics.continuation.events import INDEX, TURN, Event, Leaving, LocatedEvent
from rodwell.numerics.continuation.location import Segment
from rodwell.numerics.continuation.walk import Stepping, Trace, trace
from rodwell.numerics.equilibria.conjugate import conjugate_rate
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.maxima import maxima
from rodwell.numerics.equilibria.newton import newton
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.numerics.splines.banded import multiply
from rodwell.numerics.splines.held import Ends
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import FloatArray


class Toy(NamedTuple):
    """½u'² − λV, V = a(1 − cos u) + b(u + u³/3), with its derivatives; the parameters are λ, a and b.

    One class for both models: kernels are compiled once.
    """

    u: int = 0

    @staticmethod
    def density(_: Any, u: Any, __: Any, parameters: Any, rates: Any) -> Any:
        (lam, a, b), rate, none = (parameters[i] for i in range(3)), rates[0], (0.0, 0.0, 0.0)
        v = a * (1.0 - np.cos(u[0])) + b * (u[0] + u[0] ** 3 / 3.0)
        v1 = a * np.sin(u[0]) + b * (1.0 + u[0] ** 2)
        v2 = a * np.cos(u[0]) + b * 2.0 * u[0]
        hessian = (-lam * v2, 0.0, 0.0), (0.0, 1.0, 0.0), none
        return 0.5 * u[1] ** 2 - lam * v, -rate * v, (-lam * v1, u[1], 0.0), (-rate * v1, 0.0, 0.0), hessian

    @staticmethod
    def given() -> tuple[str, ...]:
        return ()

    @staticmethod
    def observed(_: Any, u: Any, __: Any, ___: Any) -> Any:
        return u[0]


PENDULUM, FOLDING = (1.0, 0.0), (0.0, 1.0)
"""a and b of the two."""

MIDDLE, SLOPE, ENERGY = range(3)
"""What is measured: u(½), u'(0), and the energy."""

DEGREE, ELEMENTS = 7, 16
END = "end"


@pytest.fixture(scope="module", autouse=True)
def _nothing_on_disk() -> Iterator[None]:
    with nothing_on_disk():
        yield


def measure(_: Family, state: State) -> FloatArray:
    u, slope = state.space.evaluate(state.c, np.array([0.0, 0.5]), 2)
    return np.array([[u[1], slope[0], state.energy], [1.0] * 3, [0.0] * 3])


def meshes_of(shares: tuple[float, float], parity: int, degree: int = DEGREE, elements: int = ELEMENTS) -> TwoMeshes:
    """Equilibria in λ, with a and b as given; u' = π and λ = 10 count as one unit of arclength."""
    space = SplineSpace(np.linspace(0.0, 1.0, elements + 1), degree, degree + 1)
    path = np.zeros((4, 3))
    path[0, 1:], path[1, 0] = shares, 1.0
    return TwoMeshes(Family(Toy(), path, space, Ends((1, 1)), parity, 1.0, np.pi, 10.0), measure, rtol=1e-9)


def followed(meshes: TwoMeshes, start: MeshedState, loads: Sequence[float], *, leaves: Leaving | None = None) -> Trace:
    """The branch from a point to where λ falls below the first of ``loads``, or rises above the last."""
    events = [Event.at(f"{load}", load) for load in loads]
    names = f"{loads[0]}", f"{loads[-1]}"

    def stop(found: LocatedEvent) -> str:
        return END if found.name in names and found.rising == (found.name == names[1]) else ""

    result = trace(meshes, start, Stepping(0.05, 0.3), events, stop=stop, leaves=leaves)
    assert result.end == END
    assert all(point.accurate for point in result.points)
    return result


# The pendulum.


@pytest.fixture(scope="module")
def straight() -> Trace:
    """The straight state, from λ = 1 past four pitchforks."""
    meshes = meshes_of(PENDULUM, 0)
    zeros = [(family, np.zeros(family.space.size)) for family in (meshes.coarse, meshes.fine)]
    return followed(meshes, meshes.point(*(f.state(zero, 1.0, zero, 1.0, 0) for f, zero in zeros)), (0.0, 170.0))


LOADS = (10.0, 12.0, 15.0, 20.0, 30.0)


@pytest.fixture(scope="module")
def buckled(straight: Trace) -> Trace:
    """What leaves the straight state at the first pitchfork, in the direction in which the Hessian is singular."""
    meshes, point = straight.found[0].meshes, straight.found[0].point
    states = []
    for family, state in ((meshes.coarse, point.coarse), (meshes.fine, point.fine)):
        direction = np.ones(state.c.size)
        family.nearest_curvature(state, direction, 8)
        upwards = direction * np.sign(np.sum(direction))
        states.append(family.state(state.c, state.lam, upwards, 0.0, 0))
    return followed(meshes, meshes.point(*states), (0.0, *LOADS), leaves=Leaving(falling=1, rising=0))


def test_pitchforks_of_the_straight_pendulum(straight: Trace) -> None:
    """u″ + λu = 0 has a solution between held ends where λ = (kπ)²."""
    found = straight.found[:-1]
    assert [(f.name, f.index_before, f.index_after) for f in found] == [(INDEX, k - 1, k) for k in (1, 2, 3, 4)]
    assert all(f.certain and not f.fold for f in found)
    assert [f.point.lam for f in found] == pytest.approx([(k * np.pi) ** 2 for k in (1, 2, 3, 4)], rel=1e-13)


def test_a_step_along_the_tangent_goes_as_far_as_asked_and_meets_the_branch(buckled: Trace) -> None:
    family, state = buckled.meshes[5].coarse, buckled.points[5].coarse
    for length in (0.1, -0.1):
        there = family.step(state, length)
        assert there is not None
        assert state.along(there) == pytest.approx(length, rel=1e-12)
        slope, amplitude = there.space.evaluate(there.c, np.array([0.0, 0.5]), 2)[[1, 0], [0, 1]]
        assert 0.5 * slope**2 == pytest.approx(there.lam * (1.0 - np.cos(amplitude)), rel=1e-8)  # first integral


@pytest.mark.parametrize("load", LOADS)
def test_buckled_pendulum_at_given_loads(buckled: Trace, load: float) -> None:
    """½u'² = λ(cos u − cos a), so √λ = 2K(k) with k = sin(a/2); SciPy's K and E are functions of m = k²."""
    (found,) = (f for f in buckled.found if f.name == f"{load}")
    assert found.point.at(load)
    m = brentq(lambda m: 2.0 * ellipk(m) - np.sqrt(load), 1e-12, 1.0 - 1e-12, xtol=1e-15, rtol=1e-15)
    values, error = found.point.values, found.point.error
    exact = np.empty(3)
    exact[MIDDLE], exact[SLOPE] = 2.0 * np.arcsin(np.sqrt(m)), 2.0 * np.sqrt(m * load)
    exact[ENERGY] = 8.0 * np.sqrt(load) * (ellipe(m) - (1.0 - m) * ellipk(m)) - 2.0 * m * load
    assert values == pytest.approx(exact, rel=1e-9)
    assert np.all(np.abs(values - exact) <= error)
    assert found.index_before == found.index_after == 0


def test_a_place_between_two_points_is_its_part_of_the_way_along_the_first_tangent(buckled: Trace) -> None:
    meshes, (before, after) = buckled.meshes[-1], buckled.points[-2:]
    segment = Segment(meshes.fine, before.fine, after.fine)
    for t in (0.3, 0.8):
        assert before.fine.along(segment(t)) == pytest.approx(t * before.fine.along(after.fine), rel=1e-9)


def test_rate_of_what_the_load_works_on_is_the_second_derivative_of_the_energy(buckled: Trace) -> None:
    """Along the branch dE/dλ = ∂E/∂λ, since ∂E/∂c vanishes: here by differences of energies at loads beside it."""
    found = next(found for found in buckled.found if found.name == "15.0")
    family, state, step = found.meshes.fine, found.point.fine, 0.02
    beside = [family.at(state.c, state.lam + change)[1] for change in (-step, step)]
    second = sum(one.energy - state.energy for one in beside if one is not None) / step**2
    assert conjugate_rate(family, state) / state.tangent_lam == pytest.approx(second, rel=1e-5)


def test_highest_point_of_the_buckled_pendulum(buckled: Trace) -> None:
    """It lies in the middle; what is maximised is what the model observes."""
    family, state = buckled.meshes[-1].fine, buckled.points[-1].fine
    samples, parameters = state.space.samples, family.parameters(state.lam)
    places, values, _ = maxima(family.mesh, state.space.knots, *samples, state.c, parameters, 0.05)
    assert places == pytest.approx([0.5], abs=1e-6)
    assert values == pytest.approx([buckled.points[-1].values[MIDDLE]], rel=1e-12)


def test_buckled_pendulum_turns_back_at_the_straight_one(buckled: Trace) -> None:
    """It passes into its mirror image there: λ turns back, and the index is the same on either side."""
    meshes, last = buckled.meshes[-1], buckled.points[-1]
    result = followed(meshes, meshes.point(last.coarse.reversed(), last.fine.reversed()), (0.0, 12.0))
    (turn,) = (f for f in result.found if f.name in (TURN, INDEX))
    assert (turn.name, turn.index_before, turn.index_after) == (TURN, 0, 0)
    assert turn.point.lam == pytest.approx(np.pi**2, rel=1e-9)
    assert result.points[-1].values[SLOPE] < 0.0 < result.points[0].values[SLOPE]


# The fold.


def over_half(top: float, weight: Callable[[float, float], float]) -> float:
    """∫ weight(t, q) dt over [0, 1]: half the length, by u = top (1 − t²), where V(top) − V(u) = top t² q."""

    def integrand(t: float) -> float:
        u = top * (1.0 - t * t)
        return weight(t, 1.0 + (top**2 + top * u + u**2) / 3.0)

    return float(quad(integrand, 0.0, 1.0, epsabs=0.0, epsrel=1e-12)[0])


def load_of(top: float) -> float:
    """λ at which the largest u is ``top``, from ½u'² = λ(V(top) − V(u))."""
    return 8.0 * top * over_half(top, lambda _, q: q**-0.5) ** 2


def energy_of(top: float) -> float:
    """∫ u'² ds − λ V(top)."""
    load = load_of(top)
    squares = 4.0 * np.sqrt(2.0 * load) * top**1.5 * over_half(top, lambda t, q: t * t * q**0.5)
    return float(squares - load * (top + top**3 / 3.0))


HIGHEST = minimize_scalar(lambda top: -load_of(top), bounds=(0.5, 3.0), method="bounded", options={"xatol": 1e-8})
FOLD_TOP, FOLD_LOAD = float(HIGHEST.x), -float(HIGHEST.fun)
"""Where λ is largest: its value is known to the square of the error of the place."""


def from_nothing(meshes: TwoMeshes) -> MeshedState:
    """The point u = 0 at λ = 0, from where λ grows."""
    states = [family.at(np.zeros(family.space.size), 0.0)[1] for family in (meshes.coarse, meshes.fine)]
    assert states[0] is not None
    assert states[1] is not None
    return meshes.point(states[0], states[1])


@pytest.fixture(scope="module", params=[1, 0], ids=["kept even", "free"])
def folding(request: pytest.FixtureRequest) -> Trace:
    """The branch from λ = 0 over the fold and back to λ = 1."""
    meshes = meshes_of(FOLDING, request.param)
    return followed(meshes, from_nothing(meshes), (1.0, 10.0))


def test_load_of_the_fold_by_other_means() -> None:
    """u″ = −λ(1 + u²) from the middle, by Runge and Kutta's method, vanishes at the end."""
    assert pytest.approx(4.75496461955985, rel=1e-14) == FOLD_LOAD
    arc = solve_ivp(
        lambda _, u: [u[1], -FOLD_LOAD * (1.0 + u[0] ** 2)],
        (0.5, 1.0),
        [FOLD_TOP, 0.0],
        "DOP853",
        rtol=1e-13,
        atol=1e-13,
    )
    assert arc.y[0, -1] == pytest.approx(0.0, abs=1e-11)


def test_fold_is_found_as_one(folding: Trace) -> None:
    (fold,) = (f for f in folding.found if f.name in (TURN, INDEX))
    assert (fold.name, fold.fold, fold.certain, fold.index_before, fold.index_after) == (INDEX, True, True, 0, 1)
    assert fold.point.lam == pytest.approx(FOLD_LOAD, rel=1e-13)
    assert fold.point.values[MIDDLE] == pytest.approx(FOLD_TOP, rel=1e-7)


def test_both_arms_of_the_fold(folding: Trace) -> None:
    for point in folding.points[1:]:
        top = point.values[MIDDLE]
        assert point.lam == pytest.approx(load_of(top), rel=1e-8)
        assert point.values[ENERGY] == pytest.approx(energy_of(top), rel=1e-8)
        assert point.fine.index == (0 if top < FOLD_TOP else 1)
    assert folding.points[-1].values[MIDDLE] > 5.0 * FOLD_TOP


@pytest.mark.parametrize("elements", [16, 32])
def test_order_of_the_load_at_the_fold(elements: int) -> None:
    """It is that of the energy, twice the degree: halving the elements takes off a factor of 2⁶."""
    meshes = meshes_of(FOLDING, 1, degree=3, elements=elements)
    meshes.rtol = 1.0  # the meshes stay as they are
    (fold,) = (f.point for f in followed(meshes, from_nothing(meshes), (4.0, 10.0)).found if f.fold)
    order = np.log2((fold.coarse.lam - FOLD_LOAD) / (fold.fine.lam - FOLD_LOAD))
    assert order == pytest.approx(6.0, abs=0.05)


def test_machine_code_of_these_models_is_not_left_on_disk() -> None:
    folder = newton.stats.cache_path
    name = Toy.__module__.rpartition(".")[2].encode()
    assert folder is None or not any(name in file.read_bytes() for file in Path(folder).glob("*.nbi"))


def test_tangents_have_length_one_and_rows_are_their_covectors() -> None:
    """In the metric of the family: u' = π and λ = 10 count as one."""
    meshes = meshes_of(FOLDING, 1)
    state = from_nothing(meshes).fine
    pushed = np.asarray(multiply(state.space.slope_gram, state.tangent)) / np.pi**2
    assert state.tangent @ pushed + (state.tangent_lam / 10.0) ** 2 == pytest.approx(1.0, rel=1e-12)
    assert state.row == pytest.approx(pushed, rel=1e-12, abs=1e-14)
    assert state.row_lam == pytest.approx(state.tangent_lam / 100.0, rel=1e-12)
