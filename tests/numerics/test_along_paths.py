"""Along a path of stretches: what is expected ahead, which way a zero is sought; fields and ends on the rim."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern, chain
from rodwell.numerics.stretches import walk
from rodwell.numerics.stretches.carry import angle_of, fit, rim_fields
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.newton import Solved
from rodwell.numerics.stretches.walk import Motion, ahead, length, row_of
from rodwell.problem.problem import Problem

BREAKS = np.array([0.3, 0.7])


def lying() -> Shape:
    """A rod that is free between two stretches on the wall."""
    model = RodInHole(Problem(weight=15, alpha=60))
    links, held = chain(model.problem, model.given, Pattern((True, False, True)), ((2,), (2,), (2,)), 8)

    def sample(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        angle = np.stack([np.sin(np.pi * s) ** 2, np.pi * np.sin(2 * np.pi * s), 2 * np.pi**2 * np.cos(2 * np.pi * s)])
        return rim_fields(angle), angle

    return fit(links, BREAKS, -130.0, sample, held)


def motions(shape: Shape) -> list[Motion]:
    """Three directions; the first has length one, and the others none along it."""
    rng = np.random.default_rng(5)
    found = [
        Motion(rng.standard_normal(shape.nodes.shape), 0.01 * rng.standard_normal(2), rng.standard_normal(),
               rng.standard_normal(shape.bubbles.shape)) for _ in range(3)
    ]  # fmt: skip
    first = found[0].times(1.0 / length(found[0], shape.chain, shape.load))
    row = row_of(first, shape.chain, shape.load)
    parts = [row.of(one.nodes, one.breaks, one.load) for one in found[1:]]
    assert row.of(first.nodes, first.breaks, first.load) == pytest.approx(1.0, rel=1e-12)
    return [first, *(added(one, first, -part) for one, part in zip(found[1:], parts, strict=True))]


def added(one: Motion, other: Motion, factor: float) -> Motion:
    by = other.times(factor)
    return Motion(one.nodes + by.nodes, one.breaks + by.breaks, one.load + by.load, one.bubbles + by.bubbles)


def on_cubic(shape: Shape, directions: list[Motion], place: float) -> Shape:
    for order, one in enumerate(directions, start=1):
        by = one.times(place**order)
        shape = shape.moved(by.nodes, by.bubbles, by.breaks, by.load)
    return shape


def same(one: Shape, other: Shape) -> bool:
    parts = ((one.nodes, other.nodes), (one.bubbles, other.bubbles), (one.breaks, other.breaks), (one.load, other.load))
    return all(np.allclose(a, b, rtol=1e-11, atol=1e-11) for a, b in parts)


def test_a_cubic_path_is_foreseen_from_two_states_and_a_line_from_one() -> None:
    shape = lying()
    directions, back, size = motions(shape), 0.3, 0.2
    rate = directions[0]
    for order, one in enumerate(directions[1:], start=2):
        rate = added(rate, one, order * (-back) ** (order - 1))
    before: Any = SimpleNamespace(shape=on_cubic(shape, directions, -back)), rate.times(2.5)
    along = directions[0]
    assert same(ahead(shape, along, size, before), on_cubic(shape, directions, size))
    assert same(ahead(shape, along, size, None), on_cubic(shape, directions[:1], size))
    wrong_way: Any = SimpleNamespace(shape=on_cubic(shape, directions, back)), rate
    assert same(ahead(shape, along, size, wrong_way), on_cubic(shape, directions[:1], size))
    turned: Any = before[0], rate.times(-1.0)
    assert same(ahead(shape, along, size, turned), on_cubic(shape, directions[:1], size))


class Way:
    """A path that is the line of numbers, one way or the other."""

    def __init__(self, sign: float = 1.0) -> None:
        self.sign = sign

    def times(self, factor: float) -> Way:
        return Way(self.sign * factor)


def at(place: float) -> Solved:
    found: Any = SimpleNamespace(place=place)
    return found  # type: ignore[no-any-return]


@pytest.fixture
def line(monkeypatch: pytest.MonkeyPatch) -> Any:
    def step(_model: Any, state: Any, along: Way, size: float) -> tuple[None, Solved, int]:
        return None, at(state.place + along.sign * size), 1

    monkeypatch.setattr(walk, "step", step)
    monkeypatch.setattr(walk, "tangent", lambda _state, before: before)
    monkeypatch.setattr(walk, "locate", lambda _model, first, second, _function: (first.place, second.place))
    return Way()


@pytest.mark.parametrize("root", [0.31, -0.44])
def test_a_zero_close_by_is_found_by_secants(line: Any, root: float) -> None:
    found: Any = walk.search(None, at(0.0), line, lambda one: np.exp(0.4 * (one.place - root)) - 1.0, 0.5, 4.0)
    assert found.place == pytest.approx(root, abs=1e-10)


@pytest.mark.parametrize(
    ("values", "between"),
    [((0.5, -0.8, -0.1), (0.0, 0.5)), ((0.5, 0.3, -0.1), (0.0, -0.5)), ((0.5, 0.8, -9.0), (0.0, -0.5))],
)
def test_a_zero_is_sought_first_where_values_fall_or_change_their_sign(
    line: Any, values: tuple[float, float, float], between: tuple[float, float]
) -> None:
    """Steps of half a unit; the function jumps, so that secants fail: at rest, a step ahead, a step behind."""
    here, there, behind = values

    def function(one: Any) -> float:
        return there if one.place > 0.45 else behind if one.place < -0.45 else here

    assert walk.search(None, at(0.0), line, function, 0.5, 0.6) == between


def test_fields_on_the_rim_are_derivatives_of_the_angle_and_give_it_back() -> None:
    """X = −cos φ and Y = sin φ along φ = 0.4 + 2s − 3s², by complex steps."""
    s, step = np.array([0.1, 0.4, 0.7]), 1e-30

    def angle(s: Any) -> Any:
        return np.array([0.4 + 2.0 * s - 3.0 * s**2, 2.0 - 6.0 * s, -6.0 + 0.0 * s])

    fields = rim_fields(angle(s))
    ahead = rim_fields(angle(s + 1j * step)).imag / step
    assert fields[:, 0] == pytest.approx(np.array([-np.cos(angle(s)[0]), np.sin(angle(s)[0])]), rel=1e-14)
    assert fields[:, 1:] == pytest.approx(ahead[:, :2], rel=1e-13)
    assert angle_of(1.7 * fields) == pytest.approx(angle(s), rel=1e-12)


@pytest.mark.parametrize(("counts", "elements"), [((2, 2, 2), (1, 4)), ((3, 2, 2), (2, 5)), ((3, 1, 2), (2, 4))])
def test_ends_of_stretches_on_the_rim_are_those_of_their_last_and_first_elements(
    counts: tuple[int, int, int], elements: tuple[int, int]
) -> None:
    """Contact, free, contact: the first end that moves is the end of an element, the second the start of one."""
    problem = Problem(weight=15, alpha=60)
    model = RodInHole(problem)
    each = tuple((n,) for n in counts)
    cuts = chain(model.problem, model.given, Pattern((True, False, True)), each, 8)[0].cuts
    assert [part.tolist() for part in cuts] == [[0, 1], list(elements), [1, 0]]
