"""Strings that bridge steps of the clearance: closed forms, a second method for small slopes, limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq, fsolve

from rodwell import (
    InputError,
    Problem,
    certify,
    coil,
    critical_loads,
    equilibrium,
    follow,
    load_path,
    loads_without_wall,
    tensile_loads,
)
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.state import BRIDGED, ContactState, contact_state
from rodwell.analysis.path.bridging import bridged

Array = np.ndarray


def lying(problem: Problem, load: float = 0.0) -> ContactState:
    """How the string lies at a load that compresses it nowhere."""
    found = bridged(RodInHole(problem), load)
    assert found is not None
    return contact_state(found)


def test_a_heavy_string_over_one_step_has_the_closed_form() -> None:
    """Small slopes, no end force: lengths a, c on the wide and the narrow side, c = (√3 − 1) a, a⁴ = 24Bδ/((2√3 − 3)w).

    From B y⁗ = −w with y = y′ = y″ = 0 where contact ends, height δ at the edge, slope and moment continuous there; the
    forces are w a (√3 − 1)/2 on the wide side, half of that on the narrow one, and what is left of the weight.
    """
    weight, clearance, narrow = 1.5, 1e-4, 0.6
    state = lying(Problem(weight, clearance=clearance, sections=((0.5, 1, 1, 1), (0.5, 1, 1, narrow))))
    a = (24.0 * (1.0 - narrow) * clearance / ((2.0 * math.sqrt(3.0) - 3.0) * weight)) ** 0.25
    c, p = (math.sqrt(3.0) - 1.0) * a, weight * a * (math.sqrt(3.0) - 1.0) / 2.0
    assert [point.kind for point in state.point_forces] == ["end", "edge", "end"]
    places = [point.s.value for point in state.point_forces]
    assert places == pytest.approx([0.5 - a, 0.5, 0.5 + c], abs=1e-7)
    forces = [point.force.value for point in state.point_forces]
    assert forces == pytest.approx([p, weight * (a + c) - 1.5 * p, p / 2.0], rel=1e-7)
    assert state.certificate.passed
    assert state.kind == BRIDGED
    assert state.stability_index == 0


def small_slopes(weight: float, step: float, compression: float) -> tuple[Array, Array]:
    """The same bridge under compression: its lengths (a, c) and forces (at the wide wall, the edge, the narrow one).

    B y⁗ + C y″ = −w on both sides, from y = y′ = y″ = 0 where contact ends: with k² = C/B
    y = A (kx − sin kx)/k² − w/C (x²/2 + (cos kx − 1)/k²).
    """
    k = math.sqrt(compression)
    q = weight / compression

    def branch(x: float, amplitude: float) -> Array:
        s, c = math.sin(k * x), math.cos(k * x)
        return np.array([
            amplitude * (k * x - s) / k**2 - q * (x**2 / 2.0 + (c - 1.0) / k**2),
            amplitude * (1.0 - c) / k - q * (x - s / k),
            amplitude * s - q * (1.0 - c),
            amplitude * k * c - q * k * s,
        ])  # fmt: skip

    def misses(unknown: Array) -> Array:
        a, c, left, right = unknown[:2].tolist() + (unknown[2:] * step).tolist()
        wide, narrow = branch(a, left), branch(c, right)
        return np.array([wide[0] - step, narrow[0], wide[1] + narrow[1], wide[2] - narrow[2]]) / step

    a = (24.0 * step / ((2.0 * math.sqrt(3.0) - 3.0) * weight)) ** 0.25
    guess = [a, 0.73 * a, 0.37 * weight * a / k / step, 0.18 * weight * a / k / step]
    found = fsolve(misses, guess, xtol=1e-13)
    assert np.max(np.abs(misses(found))) < 1e-11
    (a, c), (left, right) = found[:2], found[2:] * step
    edge = -branch(c, right)[3] - branch(a, left)[3]
    return np.array([a, c]), np.array([left * k, edge, right * k])


def sideways(weight: float, clearance: float, narrow: float, compression: float) -> float:
    """Zero at a buckling load: det of the transfer matrix's part that clamped ends leave, for small slopes.

    v⁗ + C v″ + f v = 0, f the contact force per length over the clearance, and springs of the point forces over it.
    """
    (a, c), forces = small_slopes(weight, (1.0 - narrow) * clearance, compression)

    def along(length: float, bed: float) -> Array:
        rates = np.diag([1.0, 1.0, 1.0], 1)
        rates[3, 0], rates[3, 2] = -bed, -compression
        return np.asarray(expm(length * rates))

    def spring(force: float, radius: float) -> Array:
        jump = np.eye(4)
        jump[3, 0] = -force / radius
        return jump

    wide, tight = clearance, narrow * clearance
    whole = along(0.5 - a, weight / wide)
    for part in (spring(forces[0], wide), along(a, 0.0), spring(forces[1], tight), along(c, 0.0),
                 spring(forces[2], tight), along(0.5 - c, weight / tight)):  # fmt: skip
        whole = part @ whole
    return float(np.linalg.det(whole[:2, 2:]))


def test_the_buckling_load_is_that_of_transfer_matrices_for_small_slopes() -> None:
    weight, clearance, narrow = 0.015, 1e-5, 0.6
    loads = np.linspace(60.0, 120.0, 61)
    values = [sideways(weight, clearance, narrow, float(c)) for c in loads]
    first = int(np.flatnonzero(np.diff(np.sign(values)))[0])
    exact = float(brentq(lambda c: sideways(weight, clearance, narrow, c), loads[first], loads[first + 1], xtol=1e-12))
    problem = Problem(weight, clearance=clearance, sections=((0.5, 1, 1, 1), (0.5, 1, 1, narrow)))
    path = load_path(problem, until=-200.0)
    found = path.first("critical")
    assert found is not None
    assert found.state is not None
    assert found.force.value == pytest.approx(-exact, rel=1e-8)
    (a, c), forces = small_slopes(weight, (1.0 - narrow) * clearance, exact)
    assert [p.s.value for p in found.state.point_forces] == pytest.approx([0.5 - a, 0.5, 0.5 + c], abs=1e-7)
    assert [p.force.value for p in found.state.point_forces] == pytest.approx(forces.tolist(), rel=1e-6)
    assert not path.reached
    assert "buckles sideways" in path.ended_because


def test_without_a_step_nothing_changes_and_near_none_little() -> None:
    """As the step vanishes the buckling load tends to that of the rod on the wall."""
    uniform = critical_loads(Problem(1000.0), 1)[0].force
    misses = []
    for step in (1e-4, 1e-8):
        path = load_path(Problem(1000.0, sections=((0.5, 1, 1, 1.0), (0.5, 1, 1, 1.0 - step))), until=-900.0)
        found = path.first("critical")
        assert found is not None
        misses.append(abs(found.force.value / uniform - 1.0))
    assert misses == sorted(misses, reverse=True)
    assert misses[-1] < 1e-7


@pytest.mark.parametrize(
    ("changes", "more", "field"),
    [
        ({"twist": 1.0}, {}, "twist"),
        ({"alpha": 0.0}, {}, "sections"),
        ({}, {"unload_to": -1.0}, "unload_to"),
        ({}, {"mirror": True}, "mirror"),
        ({}, {"control": "shortening"}, "control"),
        ({}, {"wall_stiffness": 1e6}, "wall_stiffness"),
    ],
)
def test_what_is_not_computed_of_it_is_refused(changes: dict[str, float], more: dict[str, object], field: str) -> None:
    problem = Problem(15.0, sections=((0.5, 1, 1, 1), (0.5, 1, 1, 0.6))).but(**changes)
    with pytest.raises(InputError) as told:
        load_path(problem, until=-0.5 if "control" not in more else 1e-3, **more)  # type: ignore[arg-type]
    assert told.value.field == field or (field == "wall_stiffness" and told.value.field == "sections")


def test_no_clearance_stands_in_for_the_others() -> None:
    """What is computed of rods on the wall refuses a string that leaves it, and says what does not."""
    problem = Problem(15.0, sections=((0.5, 1, 1, 1), (0.5, 1, 1, 0.6)))
    coiled = problem.but(turns=1)
    for compute in (
        lambda: critical_loads(problem), lambda: loads_without_wall(problem), lambda: follow(problem, until=-200.0),
        lambda: coil(coiled), lambda: equilibrium(coiled, -100.0), lambda: certify(problem),
        lambda: tensile_loads(problem),
    ):  # fmt: skip
        with pytest.raises(InputError, match="sections"):
            compute()


def test_a_ratio_that_all_share_goes_into_the_clearance() -> None:
    alike = Problem(15.0, sections=((0.5, 1, 1, 0.6), (0.5, 2, 1, 0.6)))
    assert alike == Problem(15.0, clearance=0.006, sections=((0.5, 1, 1), (0.5, 2, 1)))
    with pytest.raises(InputError, match="section 2, clearance"):
        Problem(15.0, clearance=0.1, sections=((0.5, 1, 1, 1), (0.5, 1, 1, 20.0)))


def test_an_edge_is_the_same_seen_from_the_other_end() -> None:
    """A tool joint of three lengths: the mirror image of a state is that of the string turned round."""
    sections = ((0.35, 1, 1, 1), (0.1, 1, 1, 0.7), (0.55, 1, 1, 1))
    one, other = lying(Problem(400.0, sections=sections)), lying(Problem(400.0, sections=sections[::-1]))
    assert [p.kind for p in one.point_forces] == [p.kind for p in other.point_forces][::-1]
    assert [p.force.value for p in one.point_forces] == pytest.approx([p.force.value for p in other.point_forces][::-1])
    assert one.fine.pattern.edges == pytest.approx([0.35, 0.45])
    assert one.certificate.passed
    total = one.contact_total.value
    assert total == pytest.approx(400.0, rel=1e-9)  # all the weight: nothing else holds it
