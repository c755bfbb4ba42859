"""Derivatives of the load at which a bridging string buckles sideways: against differences of the loads themselves."""

from __future__ import annotations

import json
from collections.abc import Callable

import pytest
from click.testing import CliRunner

from rodwell import InputError, Problem, load_path, sensitivities
from rodwell.analysis.loads.sensitivity import Sensitivity
from rodwell.cli.main import cli

SECTIONS = ((0.35, 1.0, 1.0, 1.0), (0.3, 1.4, 1.3, 0.8), (0.35, 0.8, 1.0, 1.1))
STRING = Problem(60.0, 75.0, sections=SECTIONS)
TAPERED = Problem(60.0, 75.0, sections=(SECTIONS[0], (0.3, (1.0, 1.4), (1.0, 1.3), 0.8), SECTIONS[2]))


@pytest.fixture(scope="module")
def found() -> Sensitivity:
    (one,) = sensitivities(STRING, rtol=1e-10)
    return one


def _load(problem: Problem) -> float:
    event = load_path(problem, rtol=1e-10).first("critical")
    assert event is not None
    return event.force.value


def _difference(moved: Callable[[float], Problem], h: float = 1e-3) -> float:
    """Central differences of loads, of the fourth order."""
    one, half = ((_load(moved(x)) - _load(moved(-x))) / (2.0 * x) for x in (h, 0.5 * h))
    return (4.0 * half - one) / 3.0


def _with_second(*ratios: object) -> Problem:
    return STRING.but(sections=(SECTIONS[0], (0.3, *ratios), SECTIONS[2]))


MOVED: dict[str, tuple[Callable[[float], Problem], Callable[[Sensitivity], object], float]] = {
    "weight": (lambda x: STRING.but(weight=60.0 * (1.0 + x)), lambda s: s.derivatives["weight"], 60.0),
    "alpha": (lambda x: STRING.but(alpha=75.0 + 90.0 * x), lambda s: s.derivatives["alpha"], 90.0),
    "clearance": (lambda x: STRING.but(clearance=0.01 * (1.0 + x)), lambda s: s.derivatives["clearance"], 0.01),
    "stiffness": (lambda x: _with_second(1.4 * (1.0 + x), 1.3, 0.8), lambda s: s.sections[1]["stiffness"], 1.4),
    "weight ratio": (lambda x: _with_second(1.4, 1.3 * (1.0 + x), 0.8), lambda s: s.sections[1]["weight"], 1.3),
    "clearance ratio": (lambda x: _with_second(1.4, 1.3, 0.8 * (1.0 + x)), lambda s: s.sections[1]["clearance"], 0.8),
    "step": (
        lambda x: STRING.but(sections=((0.35 + x, 1.0), (0.3 - x, *SECTIONS[1][1:]), SECTIONS[2])),
        lambda s: s.sections[0]["upper_end"], 1.0,
    ),
}  # fmt: skip


@pytest.mark.parametrize("which", MOVED)
def test_derivatives_are_those_of_differences(found: Sensitivity, which: str) -> None:
    moved, of, size = MOVED[which]
    value, error = of(found)  # type: ignore[misc]
    slope = _difference(moved, 3e-4 if which == "step" else 1e-3) / size
    assert value == pytest.approx(slope, rel=1e-7)
    assert abs(value - slope) <= error + 2e-8 * abs(slope)
    assert error < 1e-6 * abs(value)


def test_a_string_as_a_whole_and_what_is_left_out(found: Sensitivity) -> None:
    """All weights, all clearances: sums over sections; Euler's relation of a load that scales with B."""
    weights = sum(one["weight"].value * ratio[2] for one, ratio in zip(found.sections, SECTIONS, strict=True))
    assert weights == pytest.approx(found.derivatives["weight"].value * STRING.weight, rel=1e-8)
    clearances = sum(one["clearance"].value * ratio[3] for one, ratio in zip(found.sections, SECTIONS, strict=True))
    assert clearances == pytest.approx(found.derivatives["clearance"].value * STRING.clearance, rel=1e-8)
    stiffness = sum(one["stiffness"].value * ratio[1] for one, ratio in zip(found.sections, SECTIONS, strict=True))
    assert stiffness + weights == pytest.approx(found.force, rel=1e-8)
    assert "upper_end" not in found.sections[-1]
    assert found.converged
    (tapered,) = sensitivities(TAPERED)
    assert set(tapered.sections[1]) == {"stiffness_factor", "weight_factor", "clearance"}
    alike = STRING.but(sections=((0.35, 1.0), (0.3, 1.4), (0.35, 0.8, 1.0, 0.9)))
    assert ["clearance" in one for one in sensitivities(alike)[0].sections] == [False, False, True]


def test_the_command_tells_them_and_other_modes_are_refused(found: Sensitivity) -> None:
    sections = ",".join(":".join(map(str, one)) for one in SECTIONS)
    arguments = ["sensitivity", "--weight", "60", "--alpha", "75", "--sections", sections]
    told = json.loads(CliRunner().invoke(cli, [*arguments, "--json"]).output)["loads"]
    assert [one["name"] for one in told] == ["load at which it buckles sideways"]
    assert told[0]["sections"][1]["clearance"]["value"] == pytest.approx(found.sections[1]["clearance"].value, rel=1e-7)
    shown = CliRunner().invoke(cli, arguments)
    assert "dF per unit of the clearance ratio, section 2" in shown.output
    with pytest.raises(InputError, match="must be 1 where the clearance has steps"):
        sensitivities(STRING, 2)
