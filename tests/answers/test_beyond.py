"""Beyond lift-off: the story, its numbers in every form, and that nothing on the wall is lost where there is none."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rodwell
from rodwell.analysis.off_wall.state import HELIX, STRAIGHT
from rodwell.analysis.path.events import CRITICAL, LIFT_OFF, LOADING, SNAP, UNLOADING, Destination, PathPoint
from rodwell.analysis.path.load_path import LoadPath
from rodwell.answers.data.beyond import beyond_table
from rodwell.answers.data.plain import answer_dict
from rodwell.answers.result import beyond as module
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.beyond import Beyond, Step
from rodwell.answers.words.beyond import beyond_sentences, story
from rodwell.case.case import Case
from rodwell.errors import NotConvergedError
from rodwell.plots.paths.beyond import pictured, plot_beyond
from rodwell.quantities.value import Value
from rodwell.report.folders.case import write_results
from rodwell.report.reports.beyond import beyond_section
from rodwell.report.reports.content import Grid

CASE = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3",
            "yield_strength": "500 MPa"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
    "load": {"applied": "-141 kN"},
    "analysis": {"modes": 1, "rtol": 1e-7},
}  # fmt: skip


@pytest.fixture(scope="module")
def answer() -> Answer:
    """The drill string a little beyond lift-off, and not back: a path of a second or two."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "reach", lambda _: (-130.0, None))
        found = rodwell.answer(Case.from_dict(CASE))
        assert found.beyond.path is not None
        return found


def loop(case: Case, *, back: bool = True) -> Beyond:
    """A path as that of the drill string, with its loads only."""
    helix = Destination(HELIX, 1, Value(-0.06), Value(-170.164), 6, 6)
    straight = Destination(STRAIGHT, 0, Value(0.0), Value(-108.045), 6, 6)
    points = [
        PathPoint(CRITICAL, Value(-114.243, 1e-4), (), LOADING),
        PathPoint(LIFT_OFF, Value(-127.96, 1e-4), (0.5,), LOADING),
        PathPoint(SNAP, Value(-170.164, 1e-4), (), LOADING, helix),
    ]  # fmt: skip
    points += [PathPoint(SNAP, Value(-108.045, 1e-4), (), UNLOADING, straight)] if back else []
    path = LoadPath(case.problem, -180.0, -70.0, tuple(points), (), True, "", 1e-8)
    return Beyond(path, "", tuple(Step(one, None) for one in points))


def test_the_whole_story_in_one_sentence() -> None:
    case = Case.from_dict(CASE)
    said = story(case, loop(case))
    assert said.startswith("As compression grows, the rod lifts off at 139.")
    assert "keeps partial contact until 185.6 kN; then snaps to a helix of 1 turn that stays until 117.9 kN" in said
    assert "on unloading, where the rod falls back to the straight shape" in said
    assert said.endswith("(both ends clamped; frictionless, without inertia).")
    still = story(case, loop(case, back=False))
    assert "a helix of 1 turn that is still there at 76.3" in still
    assert "lbf" in story(case.in_units("field"), loop(case))


def test_without_dimensions_the_end_is_said() -> None:
    case = Case.from_dict({"dimensionless": {"weight": 16.5}})
    assert "As compression at s = 1 grows, the rod lifts off at 127.960 B/L²" in story(case, loop(case))


def test_a_path_that_ends_early_says_so() -> None:
    case = Case.from_dict(CASE)
    whole = loop(case)
    assert whole.path is not None
    path = replace(whole.path, events=whole.path.events[:2], reached=False, ended_because="steps became too short")
    said = story(case, Beyond(path, "", whole.events[:2]))
    assert (
        "keeps partial contact to the last state found; it was not followed to the end: steps became too short" in said
    )


def test_a_path_that_takes_too_long_ends_where_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PATIENCE", -1.0)
    found = rodwell.answer(Case.from_dict(CASE)).beyond
    assert found.path is not None
    assert not found.path.reached
    assert [step.event.kind for step in found.events] == [CRITICAL]
    assert "it was not followed to the end: it takes longer than" in story(Case.from_dict(CASE), found)


def test_at_lift_off_both_models_bear_the_same(answer: Answer) -> None:
    """Contact in all, shortening and stress of the state on the wall (another discretisation) and on the path."""
    step = next(one for one in answer.beyond.events if one.event.kind == LIFT_OFF)
    on_wall = answer.assessment.at_lift_off
    assert on_wall is not None
    assert step.state is not None
    assert step.event.force.value == pytest.approx(on_wall.force, rel=1e-7)
    assert step.state.state.contact_total.value == pytest.approx(on_wall.total_contact.value, rel=1e-5)
    assert step.state.state.shortening.value == pytest.approx(on_wall.shortening.value, rel=1e-6)
    stress, known = step.state.stress, answer.assessment.stress(on_wall)
    assert stress is not None
    assert known is not None
    assert stress.value == pytest.approx(known.value, rel=1e-6)
    assert stress.axial == pytest.approx(known.axial, rel=1e-6)
    assert stress.bending == pytest.approx(known.bending, rel=1e-6)
    assert stress.safety is not None
    assert stress.safety.value == pytest.approx(500e6 / stress.value, rel=1e-12)


def test_the_largest_stress_is_that_of_the_largest_curvature(answer: Answer) -> None:
    """A solid round rod: axial stress N/A and bending E κ d/2 at the place found, from the fields of the state."""
    ((_, found),) = answer.beyond.applied
    assert not isinstance(found, str)
    assert found.stress is not None
    assert found.state.gaps
    f = found.state.fields(np.array([found.stress.s]))
    length, stiffness = 30.0, 200e9 * np.pi / 64.0 * 0.1**4
    bending = 200e9 * f["curvature"][0] / length * 0.05
    axial = f["tension"][0] * stiffness / length**2 / (np.pi / 4.0 * 0.1**2)
    assert found.stress.bending == pytest.approx(bending, rel=1e-9)
    assert found.stress.axial == pytest.approx(axial, rel=1e-9)
    assert found.stress.value == pytest.approx(bending - axial, rel=1e-9)
    every = found.state.fields(4001)
    assert np.max(every["curvature"]) <= f["curvature"][0] * (1.0 + 1e-5)


def test_the_load_that_acts_is_told(answer: Answer) -> None:
    text = beyond_sentences(answer.case, answer.beyond)
    said = next(line for line in text if line.startswith("At 141 kN of compression"))
    assert "the rod is in the state partial contact, with gaps of up to" in said
    assert "safety factor" in said
    assert "(frictionless, without inertia)" in said


@pytest.mark.usefixtures("nothing_drawn")
def test_report_table_and_json_hold_the_same(answer: Answer, tmp_path: Path) -> None:
    names = write_results(answer, tmp_path / "out", path=True)
    assert {"load-path.png", "load-path.svg", "load-path.csv"} <= set(names)
    data = json.loads((tmp_path / "out" / "answer.json").read_text(encoding="utf-8"))["beyond_lift_off"]
    table = beyond_table(answer.case, answer.beyond)
    assert len(data["events"]) == len(table.rows) == len(answer.beyond.events)
    for event, row in zip(data["events"], table.rows, strict=True):
        assert event["si"]["value"] == pytest.approx(row[1], rel=1e-12)
        if "state" in event:
            total = event["state"]["contact_total"]["value"] * answer.case.scales.factor("force")  # type: ignore[union-attr]
            assert row[8] == pytest.approx(total, rel=1e-12)
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    assert "Beyond lift-off" in page
    assert story(answer.case, answer.beyond).partition(";")[0] in page
    grids = [block for block in beyond_section(answer.case, answer.beyond).blocks if isinstance(block, Grid)]
    assert len(grids) == 2
    assert len(grids[0].rows) == len(table.rows)


def test_the_figure_has_a_circle_and_gaps_for_each_state(answer: Answer) -> None:
    states = pictured(answer.beyond)
    assert states
    figure = plot_beyond(answer.case, answer.beyond)
    assert len(figure.axes) == 1 + 2 * len(states)
    circle = figure.axes[1].lines[1].get_xydata()
    assert np.max(np.hypot(*np.asarray(circle).T)) <= 1.0 + 1e-9


def test_without_being_asked_nothing_is_followed(answer: Answer) -> None:
    assert "beyond_lift_off" not in answer.as_dict()
    assert "beyond_lift_off" in answer_dict(answer, path=True)


@pytest.mark.parametrize("failure", [NotConvergedError("no state was found"), FloatingPointError("overflow")])
@pytest.mark.usefixtures("nothing_drawn")
def test_a_path_that_fails_loses_nothing(failure: Exception, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def fails(*_: object, **__: object) -> LoadPath:
        raise failure

    monkeypatch.setattr(module, "load_path", fails)
    found = rodwell.answer(Case.from_dict({**CASE, "load": {}}))
    assert found.beyond.path is None
    assert str(failure) in found.beyond.why
    assert beyond_sentences(found.case, found.beyond)[0].startswith("What happens beyond lift-off is not told: ")
    names = write_results(found, tmp_path / "out", path=True)
    assert "report.html" in names
    assert "load-path.png" not in names
    data = json.loads((tmp_path / "out" / "answer.json").read_text(encoding="utf-8"))
    assert data["beyond_lift_off"]["computed"] is False
    assert str(failure) in data["beyond_lift_off"]["why"]
    assert data["lift_off"]["force"] == found.lift_off.force  # type: ignore[union-attr]


def test_what_has_no_path_says_why() -> None:
    """Twisted, and pressed to the wall by nothing: the path refuses it, and that is told."""
    given = {"dimensionless": {"weight": 5.0, "alpha": 0.0}, "load": {"twist": 1.0}, "analysis": {"modes": 1}}
    found = rodwell.answer(Case.from_dict(given))
    assert found.beyond.path is None
    assert "nothing presses the rod to the wall" in found.beyond.why


def test_the_story_of_a_weightless_rod() -> None:
    """It arches to the opposite wall (−16K², k/K = 2Δ) and leaves the plane; it comes back without a snap."""
    found = rodwell.answer(Case.from_dict({"dimensionless": {"weight": 0.0}, "analysis": {"modes": 1}}))
    told = beyond_sentences(found.case, found.beyond)[0]
    assert "lifts off at 39.4784 B/L²; touches the wall anew at 39.4979 B/L²; leaves the plane of its arch at" in told
    assert "without a jump; keeps partial contact at 86.8525 B/L²" in told
    assert found.beyond.path is not None
    up, down = found.beyond.path.meaning
    assert "leaves the plane of its arch at 80.6522 B/L², without a jump" in up
    assert down.endswith("is straight again at 39.4784 B/L².")


def test_the_key_of_the_case_file() -> None:
    assert Case.from_dict(CASE).off_wall
    off = {**CASE, "analysis": {"modes": 1, "off_wall": False}}
    assert not Case.from_dict(off).off_wall
    with pytest.raises(rodwell.InputError, match=r"analysis\.off_wall"):
        Case.from_dict({**CASE, "analysis": {"off_wall": "yes"}})


@pytest.mark.parametrize(
    ("build", "said"),
    [
        (-0.5, "lifts off at 28.6602 B/L²; touches the wall anew at 33.2826 B/L²; keeps partial contact at"),
        (-2.0, "without an end force the curve presses the rod off the side of the hole"),
    ],
)
def test_a_rod_that_a_drop_lifts_off_before_it_buckles(build: float, said: str) -> None:
    """Where it can lie without an end force it is followed from there: off the low side, over to the high one."""
    case = rodwell.Case.from_dict({"dimensionless": {"weight": 15.0, "alpha": 90.0}, "analysis": {"modes": 1}})
    case = replace(case, problem=case.problem.but(build=build))
    assert said in beyond_sentences(case, rodwell.answer(case).beyond)[0]
