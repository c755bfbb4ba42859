"""Axes of maps: ranges, lists, distributions, and the cells that they make."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rodwell
from rodwell.errors import InputError
from rodwell.studies.maps.axes import Axis, Distribution, drawn, read
from rodwell.studies.maps.question import asked

FLAT = rodwell.Problem(15.0, 90.0)


def numbers(given: Any) -> Any:
    axis = read("weight", given)
    assert isinstance(axis, Axis)
    return axis.numbers


def test_ranges_lists_and_single_values() -> None:
    assert numbers("5..200 in 40") == pytest.approx(np.linspace(5.0, 200.0, 40), rel=1e-12)
    assert numbers("1..300 in 5 log") == pytest.approx(np.geomspace(1.0, 300.0, 5), rel=1e-12)
    assert numbers("5, 10, 20") == numbers("[5, 10, 20]") == numbers("5; 10; 20") == numbers([5, 10, 20])
    assert read("weight", 15.0) is None
    assert read("ends", "clamped-pinned") is None
    length = read("rod.length", "3000..12000 cm in 3")
    assert isinstance(length, Axis)
    assert length.values[1] == "7500.0 cm"
    both = read("rod.length", "300 cm..12 m in 2")
    assert isinstance(both, Axis)
    assert (both.numbers, both.unit) == ((3.0, 12.0), "m")
    ends = read("ends", "clamped-clamped, pinned-pinned")
    assert isinstance(ends, Axis)
    assert (ends.numbers, ends.values) == (None, ("clamped-clamped", "pinned-pinned"))


@pytest.mark.parametrize(
    ("given", "what"),
    [
        ("5..200", "does not say how many values"),
        ("5..200 in 1", "must have from 2 to"),
        ("5..5 in 3", "from one finite value to another"),
        ("-5..20 in 4 log", "both ends must be above 0"),
        ("gauss(1, 2)", "is no distribution; there are uniform"),
        ("normal(1)", "needs 2 numbers, mean, standard deviation"),
        ("normal(1, -2)", "needs a deviation above 0"),
        ("triangular(3, 2, 4)", "needs least ≤ likeliest ≤ largest"),
        ([1.0], "must hold from 2 to"),
        ([1.0, math.inf], "must hold finite numbers"),
        ("1 m..3 kg in 4", "do not go together"),
    ],
)
def test_what_cannot_vary_says_why(given: Any, what: str) -> None:
    with pytest.raises(InputError, match="weight") as error:
        read("weight", given)
    assert what in str(error.value)


@given(st.sampled_from(["uniform(2, 7)", "loguniform(0.1, 30)", "normal(4, 0.5)", "triangular(1, 2, 6)"]))
def test_samples_have_the_mean_and_spread_of_their_distribution(text: str) -> None:
    """Closed forms of mean and deviation; a Sobol sequence integrates them to about 1/n."""
    one = read("weight", text)
    assert isinstance(one, Distribution)
    a, b, *_ = one.arguments
    mean, deviation = {
        "uniform": (4.5, 5.0 / math.sqrt(12.0)),
        "loguniform": ((b - a) / math.log(b / a), None),
        "normal": (4.0, 0.5),
        "triangular": (3.0, math.sqrt((1 + 4 + 36 - 2 - 6 - 12) / 18.0)),
    }[one.kind]
    values = drawn([one], 4096, "sobol", 3)[:, 0]
    assert values.mean() == pytest.approx(mean, rel=1e-3)
    if deviation is not None:
        assert values.std() == pytest.approx(deviation, rel=5e-3)
    other = drawn([one], 4096, "random", 3)[:, 0]
    assert other.mean() == pytest.approx(mean, rel=0.05)
    assert not np.array_equal(values, drawn([one], 4096, "sobol", 4)[:, 0])


@given(st.lists(st.integers(2, 60), min_size=1, max_size=3))
def test_chunks_hold_every_cell_once(sizes: list[int]) -> None:
    over = {name: np.arange(1.0, n + 1.0) for name, n in zip(("weight", "alpha", "clearance"), sizes, strict=False)}
    over["clearance"] = over.get("clearance", np.array([1.0, 2.0])) / 100.0
    question = asked(FLAT, "critical", over)
    seen = np.zeros(question.shape, dtype=int)
    for chunk in question.chunks():
        seen[question.region(chunk)] += 1
        where = question.region(chunk)
        assert len(question.cells(chunk)) == np.zeros(question.shape)[where].size
    assert np.all(seen == 1)
    assert question.cells([0] * len(question.shape))[0] == tuple(float(values[0]) for values in over.values())


def test_samples_make_one_dimension_beside_the_grid() -> None:
    found = rodwell.map(
        FLAT, "critical", over={"alpha": [60.0, 90.0], "weight": "normal(15, 1)", "clearance": "uniform(0.01, 0.02)"},
        samples=6, seed=4,
    )  # fmt: skip
    assert found.question.dims == ("alpha", "sample")
    at = found.parameters((1, 3))
    one = rodwell.critical_loads(rodwell.Problem(at["weight"], 90.0, clearance=at["clearance"]), 1)
    assert found.values[1, 3] == one[0].force
    data = found.dataset
    assert data["weight"].dims == ("sample",)
    assert data.value.attrs["units"] == "B/L^2"
    assert len(found.jumps["outcome"]) == 0
