"""Elements, chains and their derivatives: against quadrature, differences, and a beam in a disc in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.polynomial import legendre

from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern, chain
from rodwell.numerics.stretches.assembly import assemble, bubbles_of
from rodwell.numerics.stretches.basis import bent, tabulate
from rodwell.numerics.stretches.carry import fields_at, fit, rim_fields, sampler
from rodwell.numerics.stretches.chain import Shape, cartesian, cartesian_curvature, cartesian_derivatives
from rodwell.numerics.stretches.descent import pressed_in, way_from
from rodwell.numerics.stretches.newton import Solved
from rodwell.numerics.stretches.walk import locate, zero_within
from rodwell.problem.problem import Problem

PATTERN, COUNTS = Pattern((True, False, True, False, False, True)), ((2,), (2,), (1,), (1,), (1,), (2,))
BREAKS = np.array([0.2, 0.4, 0.6, 0.7, 0.8])


def test_bubbles_vanish_with_their_slopes_and_have_orthonormal_curvatures() -> None:
    ends = tabulate(9, np.array([0.0, 1.0]), 2)
    assert np.abs(ends[:, :, 4:]).max() < 1e-14
    assert ends[0][:, [0, 2]] == pytest.approx(np.eye(2), abs=1e-14)
    assert ends[1][:, [1, 3]] == pytest.approx(np.eye(2), abs=1e-13)
    points, weights = legendre.leggauss(12)
    second = tabulate(9, 0.5 * (points + 1.0), 3)[2]
    gram = second.T @ (0.5 * weights[:, None] * second)
    assert gram[4:, 4:] == pytest.approx(np.eye(6), abs=1e-12)
    assert np.abs(gram[4:, :4]).max() < 1e-12  # a linear beam's matrix is diagonal in them


def test_derivatives_by_places_are_differences() -> None:
    places, h = np.linspace(0.05, 0.95, 7), 1e-6
    table = tabulate(8, places, 4)
    for order in range(3):
        change = (tabulate(8, places + h, 4)[order] - tabulate(8, places - h, 4)[order]) / (2 * h)
        assert change == pytest.approx(table[order + 1], rel=1e-6, abs=1e-6)


def test_what_moves_and_turns_an_element_does_not_bend_it() -> None:
    places, a = np.linspace(0.0, 1.0, 7), np.random.default_rng(3).standard_normal(10)
    one, other = tabulate(9, places, 4) @ a, tabulate(9, places, 4, rigid=True) @ bent(a)
    assert other == pytest.approx(one, rel=1e-12, abs=1e-11)
    turned = np.array([0.75, 2.0**-11, 0.75 + 2.0**-11, 2.0**-11, *np.zeros(6)])
    assert not (tabulate(9, places, 4, rigid=True) @ bent(turned))[2:].any()


def test_a_way_downhill_is_joined_from_where_it_lingered_last() -> None:
    """Past a saddle at the origin along x = exp(t), y = exp(−t), at rest at x = 10."""
    x = np.array([0.0, 0.01, 0.1, 2.0, 9.0, 10.0])
    places, rates = np.stack([x, np.array([5.0, 0.3, 0.1, 0.0, 0.0, 0.0])], axis=1), np.array([9.0, 1.0, 1.0, 1.0, 1.0])
    end: Any = "at rest"
    way = way_from(places, rates, end)
    assert way.places[0] == pytest.approx([0.1, 0.1])
    assert way.passes(np.array([5.0, 0.9e-3]))
    assert not way.passes(np.array([5.0, 1.1e-3]))
    assert not way.passes(np.array([0.01, 0.3]))
    slow = way_from(places, np.array([9.0, 1.0, 0.1, 1.0, 1.0]), end)  # ten times as long for the third step
    assert slow.places[0] == pytest.approx([2.0, 0.0])


@pytest.mark.parametrize("bend", [-3.0, 0.5, 8.0])
def test_a_zero_is_located_as_closely_as_asked_for_with_few_values(bend: float) -> None:
    asked: list[float] = []

    def value(place: float) -> float:
        asked.append(place)
        return float(np.expm1(bend * (place - 0.3)))

    ends = value(0.0), value(1.0)
    assert zero_within(value, ends, 1e-10) == pytest.approx(0.3, abs=1e-10)
    assert len(asked) <= 12  # of 34 by halves


def test_a_soft_rim_pushes_by_the_derivatives_of_its_energy() -> None:
    """Beyond the rim, against differences; within it, at the middle too, not at all."""
    place = np.array([[0.6, -0.3, 0.0], [-0.9, 0.2, 0.0]])

    def pushed(at: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        gradient, hessian = np.zeros((2, 3, 3)), np.zeros((2, 3, 2, 3, 3))
        return pressed_in(50.0, at, gradient, hessian), gradient[:, 0], hessian[:, 0, :, 0]

    h, (energy, slope, curvature) = 1e-6, pushed(place)
    assert energy[0] == pytest.approx(25.0 * (np.hypot(0.6, 0.9) - 1.0) ** 2)
    for i in range(2):
        step = h * np.eye(2)[i][:, None]
        up, down = pushed(place + step), pushed(place - step)
        assert (up[0] - down[0]) / (2.0 * h) == pytest.approx(slope[i], abs=1e-8)
        assert (up[1] - down[1]) / (2.0 * h) == pytest.approx(curvature[i], abs=1e-7)
    assert not slope[:, 1:].any()
    assert not curvature[..., 1:].any()


def _disturbed(model: RodInHole) -> Shape:
    """A shape that is no equilibrium, in contact and free in turn."""
    links, held = chain(model.problem, model.given, PATTERN, COUNTS, 8)

    def sample(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        angle = np.stack([np.sin(np.pi * s) ** 2, np.pi * np.sin(2 * np.pi * s), 2 * np.pi**2 * np.cos(2 * np.pi * s)])
        return rim_fields(angle), angle

    shape, rng = fit(links, BREAKS, -130.0, sample, held), np.random.default_rng(1)
    bubbles = shape.bubbles + 0.01 * rng.standard_normal(shape.bubbles.shape)
    bubbles[links.on_rim, 1] = 0.0
    nodes = shape.nodes + 0.05 * rng.standard_normal(shape.nodes.shape) * ~links.held
    return Shape(links, nodes, bubbles, BREAKS, -130.0)


def test_gradient_and_hessian_are_those_of_the_energy_breaks_and_load_included() -> None:
    """Along a direction in nodes, breaks and load whose bubbles follow, as the condensed matrices say."""
    model = RodInHole(Problem(weight=15, alpha=60, twist=3.0))
    shape, rng, h = _disturbed(model), np.random.default_rng(2), 1e-6
    out = assemble(model, shape)
    nodes = rng.standard_normal(shape.nodes.shape)
    nil = np.zeros_like(shape.bubbles)
    up, down = (assemble(model, shape.moved(t * nodes, nil, 0 * BREAKS, 0.0)).energy for t in (h, -h))
    assert (up - down) / (2 * h) == pytest.approx(float(np.sum(out.plain * nodes)), rel=1e-8)
    nodes *= ~shape.chain.held
    breaks, load = 0.1 * rng.standard_normal(5), 3.0
    follow = bubbles_of(out, nodes, breaks, load, 0.0)
    up, down = (assemble(model, shape.moved(t * nodes, t * follow, t * breaks, t * load)).plain for t in (h, -h))
    linear = np.einsum("nij,nj->ni", out.diagonal, nodes) + out.by_break @ breaks + out.by_load * load
    linear[1:] += np.einsum("nij,nj->ni", out.below, nodes[:-1])
    linear[:-1] += np.einsum("nij,ni->nj", out.below, nodes[1:])
    assert (up - down) / (2 * h) == pytest.approx(linear, abs=1e-8 * float(np.abs(linear).max()))


def test_polar_nodes_turn_into_cartesian_ones() -> None:
    rng, h = np.random.default_rng(3), 1e-6
    nodes, polar = rng.standard_normal((4, 4)), np.array([True, True, False, True])
    first, covector = cartesian_derivatives(nodes, polar), rng.standard_normal((4, 4))
    second = cartesian_curvature(nodes, polar, covector)
    for j in range(4):
        step = h * np.eye(4)[j]
        change = (cartesian(nodes + step, polar) - cartesian(nodes - step, polar)) / (2 * h)
        assert change == pytest.approx(first[:, :, j], abs=1e-8)
        bend = (cartesian_derivatives(nodes + step, polar) - cartesian_derivatives(nodes - step, polar)) / (2 * h)
        assert np.einsum("ni,nij->nj", covector, bend) == pytest.approx(second[:, j], abs=1e-7)


def test_a_shape_is_carried_over_to_other_elements() -> None:
    """To more elements exactly: polynomials stay what they are."""
    model = RodInHole(Problem(weight=15))
    shape = _disturbed(model)
    links, held = chain(model.problem, model.given, PATTERN, tuple((2 * n,) for (n,) in COUNTS), 8)
    finer = fit(links, BREAKS, -130.0, sampler(shape), held)
    s = np.linspace(0.0, 1.0, 57)
    assert fields_at(finer, s)[0][:, :3] == pytest.approx(fields_at(shape, s)[0][:, :3], abs=1e-9)


@pytest.mark.parametrize("at", [0, 1])
def test_a_zero_at_an_end_of_a_step_is_that_end_and_without_a_change_of_sign_there_is_none(at: int) -> None:
    model = RodInHole(Problem(weight=15, alpha=60, twist=3.0))
    shape = _disturbed(model)
    nil, still = np.zeros_like(shape.nodes), np.zeros_like(shape.bubbles)
    ends = Solved(model, shape), Solved(model, shape.moved(nil, still, 0 * BREAKS, -1.0))
    loads = [end.shape.load for end in ends]
    assert locate(model, *ends, lambda one: one.shape.load - loads[at]) is ends[at]
    assert locate(model, *ends, lambda one: one.shape.load - loads[0] + 2.0) is None
