"""Holes whose diameter goes over smoothly from one to another: from the case file to the report."""

from __future__ import annotations

import json
import tomllib
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from rodwell import Case, InputError, NotConvergedError, Problem, answer, critical_loads, follow, ramp
from rodwell.answers.data.varying import varying_dict
from rodwell.answers.result.varying import varying_answer
from rodwell.answers.words.varying import varying_sentences, varying_statuses
from rodwell.cli.main import cli
from rodwell.web.given import Given

EXAMPLE = Path(__file__).parents[2] / "examples" / "tubing-two-casings.toml"
DATA: dict[str, Any] = tomllib.loads(EXAMPLE.read_text(encoding="utf-8"))
INCH = 0.0254


def _data(**changes: Any) -> dict[str, Any]:
    """Tubing in a hole that narrows over a third of its length."""
    data = deepcopy(DATA)
    data["hole"]["section"] = [
        {"length": "40 ft", "diameter": "7 in"},
        {"name": "taper", "length": "40 ft", "diameter": "6.9 in", "diameter_at_top": "7 in"},
        {"length": "40 ft", "diameter": "6.9 in"},
    ]
    data["hole"]["section"][1] |= changes
    return data


def test_the_problem_is_that_of_a_ramp() -> None:
    problem = Case.from_dict(_data()).problem
    bottom, top = (0.5 * (diameter - 2.875) for diameter in (6.9, 7.0))
    length = 120 * 12
    assert problem.clearance == pytest.approx(bottom / length, rel=1e-12)
    third = 1.0 / 3.0
    ratios = ramp(third, 1.0, top / bottom)
    assert [section[3] for section in problem.sections[1:5]] == [pytest.approx(one[3], rel=1e-12) for one in ratios]
    ours = Problem(problem.weight, 90.0, bottom / length, sections=((third,), *ratios, (third, 1, 1, top / bottom)))
    assert critical_loads(problem, 2).forces == pytest.approx(critical_loads(ours, 2).forces, rel=1e-9)
    plain = Case.from_dict(_data(diameter_at_top="6.9 in")).problem
    assert not plain.ramps


def test_run_tells_loads_contact_and_what_is_not_computed(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    text = EXAMPLE.read_text(encoding="utf-8")
    before = text[: text.index("# from the top")]
    file.write_text(
        before + '[[hole.section]]\nlength = "40 ft"\ndiameter = "7 in"\n[[hole.section]]\nlength = "40 ft"\n'
        'diameter = "6.9 in"\ndiameter_at_top = "7 in"\n[[hole.section]]\nlength = "40 ft"\ndiameter = "6.9 in"\n'
        '[load]\napplied = "-5000 lbf"\n',
        encoding="utf-8",
    )
    shown = CliRunner().invoke(cli, ["run", str(file), "--out", str(tmp_path / "out")])
    assert shown.exit_code == 0, shown.output
    said = " ".join(shown.output.split())
    assert "lies on a wall whose clearance varies" in said
    assert "and pushes it along the hole with 0.02708 lbf in all, towards the end s = 0." in said
    files = ["answer.json", "case.toml", "critical.csv", "critical.xlsx", "modes.png", "modes.svg", "report.html"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == files
    found = json.loads((tmp_path / "out" / "answer.json").read_text(encoding="utf-8"))
    problem = Case.from_dict(_data()).problem
    assert found["critical_loads"][0]["value"] == pytest.approx(critical_loads(problem, 1)[0].force, rel=1e-9)
    assert found["least_contact"]["value"] > 0.0
    assert found["applied"][0]["buckled"] is False
    assert found["applied"][0]["stress"]["value"] < found["stress"]["at buckling"]["value"]
    assert found["lift_off"]["value"] == pytest.approx(follow(problem).lift_off.force, rel=1e-9)  # type: ignore[union-attr]
    assert "The buckled rod lifts off the wall at 10 320 lbf of compression" in said
    assert found["converged"] is True


def test_stress_is_that_of_force_and_moment_on_the_wall() -> None:
    """Without fluids: N/A ± M r/I, with the curvature that the wall gives the rod that lies."""
    data = _data()
    data["load"] = {"applied": "-8500 lbf"}
    found = varying_answer(Case.from_dict(data))
    outer, inner = 0.5 * 2.875 * INCH, 0.5 * 2.441 * INCH
    area, inertia = np.pi * (outer**2 - inner**2), np.pi / 4.0 * (outer**4 - inner**4)
    scales = found.case.scales
    assert scales is not None
    s = np.linspace(0.0, 1.0, 4001)
    lying, lifted, applied = *found.states, found.under(0)
    for state in (lying, lifted, applied):
        assert state is not None
        f = state.fields(s)
        moment = scales.factor("moment") * np.hypot(f["rod_M2"], f["rod_M3"])
        known = np.max(np.abs(f["rod_F1"]) * scales.factor("force") / area + moment * outer / inertia)
        stress = found.stress(state)
        assert stress is not None
        assert stress.value == pytest.approx(known, rel=1e-4)
    clearance = found.case.problem.rod.clearance.derivative.derivative
    bend = found.case.problem.clearance * np.max(np.abs(clearance(s))) / scales.length
    for name in ("omega3", "rod_M3"):  # of stiffness 1
        assert np.max(np.abs(lying.fields(s)[name])) == pytest.approx(bend * scales.length, rel=1e-5)
    assert found.lift_off is not None
    assert lifted.solution is found.lift_off.solution
    assert lying.total_contact.value == pytest.approx(found.case.problem.weight, rel=1e-6)
    assert varying_statuses(found)[1].word == "bears it"
    data["load"] = {"applied": "-20000 lbf"}
    beyond = varying_answer(Case.from_dict(data))
    assert beyond.under(0) is None
    assert "has buckled and lifted off the wall: what it does then is not computed" in varying_sentences(beyond)[1]
    assert varying_statuses(beyond)[1].word == "not judged"


def test_what_needs_one_clearance_is_refused_at_once() -> None:
    with pytest.raises(InputError, match="and studies, are computed in holes of one"):
        answer(Case.from_dict(_data()))
    with pytest.raises(InputError, match="pictures in space, which `rodwell explore` shows, are computed"):
        Given(_data())


def test_an_answer_is_told_where_the_branch_could_not_be_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: Any, **__: Any) -> None:
        raise NotConvergedError("as if")

    monkeypatch.setattr("rodwell.answers.result.varying.follow", fails)
    found = varying_answer(Case.from_dict(_data()))
    assert "Where the buckled rod lifts off the wall was not found: as if." in varying_sentences(found)
    told = varying_dict(found)
    assert told["lift_off"] is None
    assert told["not_followed"] == "as if"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"diameter": "6.8 in"}, "hole.section: lets the clearance have a step at s/L = 0.3333"),
        ({"diameter_at_top": "2 in"}, "does not fit"),
        ({"diameter_at_top": [6.9, 7.0]}, "is a list"),
    ],
)
def test_what_does_not_fit_is_named(change: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        Case.from_dict(_data(**change))


def test_a_varying_section_lies_beside_the_rod_with_all_of_its_length() -> None:
    data = deepcopy(DATA)
    data["hole"]["section"] = [
        {"from": "0 ft", "to": "60 ft", "diameter": "7 in"},
        {"to": "130 ft", "diameter": "6.9 in", "diameter_at_top": "7 in"},
    ]
    with pytest.raises(InputError, match=r"hole\.section 2.diameter_at_top.*goes beyond the rod"):
        Case.from_dict(data)


def test_the_end_that_is_too_narrow_is_named() -> None:
    with pytest.raises(InputError, match=r"hole\.section 2 \(taper\)\.diameter_at_top = .* the rod does not fit"):
        Case.from_dict(_data(diameter_at_top="2 in"))
    with pytest.raises(InputError, match=r"hole\.section 2 \(taper\)\.diameter = .* the rod does not fit"):
        Case.from_dict(_data(diameter="2 in"))
