"""Error estimates hold: a sample of the campaign ``benchmarks/campaigns/errors.py``, its committed result, and cases.

The second method is collocation in extended precision, without splines, meshes or solver of the engine.
"""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import rodwell
from rodwell import Branch, Problem
from rodwell.analysis.discrete.measures import Measured

CAMPAIGNS = Path(__file__).parents[2] / "benchmarks" / "campaigns"

FREE_CLAMPED = Problem(30.7, alpha=44.1, clearance=0.019, ends="free-clamped")
LIFT_OFF = -31.025277819765435
"""Of this rod: by collocation with polynomials of degree 15 on 16, 32 and 64 elements, the same to 18 digits."""

SAMPLE = 16
"""Problems of the sample: one of each pair of ends, from another seed than the campaign's."""

needs_digits = pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="no extended precision on this machine")


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    sys.path.insert(0, str(CAMPAIGNS))
    try:
        return importlib.import_module("errors")
    finally:
        sys.path.remove(str(CAMPAIGNS))


@needs_digits
def test_a_sample_of_random_problems(campaign: ModuleType) -> None:
    found = [campaign.judged(7_000_000 + i) for i in range(SAMPLE)]
    rows = [row for some, _ in found for row in some]
    loads = [row for row in rows if row.kind in (*campaign.SPECIAL, "p_max")]
    ratios = np.array([row.true / row.claimed for row in loads])
    assert len(loads) > 1.5 * SAMPLE
    assert np.all(ratios <= 1.0), [row for row in loads if row.true > row.claimed]
    assert np.median(ratios) >= 0.5 / campaign.CAUTION
    assert all(row.true <= campaign.FACTOR * row.claimed for row in rows)


def test_the_committed_campaign() -> None:
    """What the page on convergence says rests on this."""
    result = json.loads((CAMPAIGNS / "errors.json").read_text(encoding="utf-8"))
    found, asked = result["special_points_and_largest_pressures"], result["asked"]
    assert found["numbers"] > 2 * result["problems"] > 600
    assert found["within"] >= asked["within"]
    assert found["worst"] <= asked["worst"]
    assert found["median_caution"] <= asked["median_caution"]
    assert len(result["by_ends"]) == 16


def test_lift_off_at_a_free_end() -> None:
    found = rodwell.follow(FREE_CLAMPED).lift_off
    assert found is not None
    assert found.s == (0.0,)
    assert abs(found.force - LIFT_OFF) <= found.error <= 1e-9


@needs_digits
def test_the_second_method_has_that_load(campaign: ModuleType) -> None:
    found = rodwell.follow(FREE_CLAMPED, rtol=1e-6).lift_off
    assert found is not None
    for every in (1, 2):
        assert float(campaign.load_of(found.solution, "lift_off", every)) == pytest.approx(LIFT_OFF, rel=1e-15)


def intervals(branch: Branch) -> dict[str, tuple[float, float]]:
    """Everything located, and the largest pressure at the end, each with its error."""
    points = [p for p in branch.special_points if p.kind in ("lift_off", "touch_down", "fold", "branch_point")]
    out = {f"{p.kind} {i}": (p.force, p.error) for i, p in enumerate(points)}
    top = branch[-1].number(Measured.P_MAX)
    return {**out, "p_max": (top.value, top.error)}


@pytest.mark.parametrize(
    ("problem", "mode", "until"),
    [
        (FREE_CLAMPED, 1, -45.0),
        (Problem(12.0, 60.0, ends="free-pinned"), 1, -60.0),
        (Problem(22.0), 2, -260.0),
        (Problem(15.0, 80.0, ends="guided-clamped", twist=1.0), 1, -180.0),
    ],
    ids=str,
)
def test_a_change_of_the_weight_by_round_off(problem: Problem, mode: int, until: float) -> None:
    """Round-off moves values by less than their errors: what is no linear dependence on the weight, or on meshes."""
    less, here, more, finer = (
        intervals(rodwell.follow(problem.but(weight=problem.weight * (1.0 + k * 1e-12)), mode, until=until, rtol=rtol))
        for k, rtol in ((-1, 1e-8), (0, 1e-8), (1, 1e-8), (0, 1e-10))
    )
    assert less.keys() == here.keys() == more.keys() == finer.keys()
    for name, (value, error) in here.items():
        bent = less[name][0] + more[name][0] - 2.0 * value
        assert abs(bent) <= less[name][1] + more[name][1] + 2.0 * error, name
        assert abs(finer[name][0] - value) <= finer[name][1] + error, name
