"""Commands in a curved hole: loads of both signs in words and JSON, lift-off with its own places, what is refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from rodwell import InputError, Problem, critical_loads, load_path
from rodwell.cli.main import cli


def run(*words: str) -> tuple[int, str]:
    result = CliRunner().invoke(cli, words)
    return result.exit_code, result.output


def test_critical_says_which_side_and_where_the_wall_would_have_to_pull() -> None:
    code, text = run("critical", "--weight", "15", "--alpha", "90", "--build", "0.2", "--modes", "2")
    text = " ".join(text.split())
    assert code == 0
    assert "lies on the low side of a curved hole (build 0.2/L, α = 90° at mid-length)" in text
    assert "−177.3205402" in text
    assert "in tension, 1 +235.8340576" in text
    assert "the wall would have to pull, 32.1 B/L³ at s/L = 0" in text
    assert "below 74.8159 B/L²" in text


def test_critical_as_json() -> None:
    code, text = run("critical", "--weight", "15", "--alpha", "90", "--build", "-0.2", "--modes", "2", "--json")
    data = json.loads(text)
    assert code == 0
    assert data["tensile_loads"] == []
    assert data["without_wall"] is None
    assert data["lying"]["highest_force"] is None
    assert data["lying"]["lowest_force"]["value"] == pytest.approx(-74.4344023, rel=1e-8)  # w cos(κᵣ/2)/κᵣ + κᵣ²
    assert [peak["value"] > 0.0 for peak in data["lying"]["least_contact"]] == [True, False]


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("diagram", "--walk", "0.2", "--search", "unfolding"), "in straight holes only"),
        (("liftoff", "--walk", "0.2", "--mode", "2"), "has no modes"),
        (("liftoff", "--walk", "0.2", "--mirror"), "has no modes"),
        (("critical", "--build", "150"), "must be above the clearance"),
        (("critical", "--build", "7"), "makes the hole run into itself"),
        (("critical", "--build", "0.2", "--ends", "ball-ball"), "leaves the wall at a ball end"),
        (
            ("critical", "--walk", "0.2", "--sections", "0.5:1:1:1.2,0.5:2"),
            "must have one clearance in a hole that leaves the vertical plane",
        ),
        (("certify", "--build", "0.2"), "loads are proved of a rod without weight"),
        (("sensitivity", "--build", "0.2", "--walk", "0.1", "--mode", "2"), "no critical load"),
        (("twist", "--build", "0.2"), "in straight holes only"),
        (("path", "--walk", "0.1", "--sections", "0.5:1:1,0.5:2", "--until", "-200"), "beside sections"),
        (("path", "--build", "0.2", "--until", "-200", "--wall-stiffness", "1e6"), "whose wall is hard here"),
        (
            ("path", "--build", "0.2", "--sections", "0.5:1,0.5:2/1", "--until", "-200"),
            "must not taper in a curved hole",
        ),
        (
            ("curve", "critical", "--over", "twist", "--from", "0", "--to", "1", "--build", "0.2", "--walk", "0.1"),
            "no critical load",
        ),
    ],
)
def test_what_is_refused_says_why(words: tuple[str, ...], why: str) -> None:
    result = CliRunner().invoke(cli, (*words, "--weight", "15", "--alpha", "90"))
    assert isinstance(result.exception, InputError)
    assert why in str(result.exception)


def test_the_load_path_off_the_wall() -> None:
    """Lift-off is that of `rodwell liftoff`; states have their numbers with every cross-section at its own place."""
    words = ("path", "--weight", "15", "--alpha", "90", "--build", "0.2", "--until", "-250", "--at", "-247")
    code, text = run(*words)
    assert code == 0
    assert "the rod that lies along the hole buckles" in text
    assert "with every cross-section at its own place" in text
    assert "straight rod" not in text
    code, text = run(*words, "--json")
    data = json.loads(text)
    events = {event["kind"]: event["force"]["value"] for event in data["events"]}
    assert events["critical"] == pytest.approx(-177.320540182, rel=1e-11)
    lift = json.loads(run("liftoff", "--weight", "15", "--alpha", "90", "--build", "0.2", "--json")[1])
    assert events["lift_off"] == pytest.approx(lift["lift_off"]["force"], rel=1e-8)
    (state,) = data["states"]
    assert state["certificate"]["passed"]
    assert 0.0 < state["place_errors"]["energy"] < 2e-5 * abs(state["energy"]["value"])


def test_lift_off_with_and_without_own_places() -> None:
    code, text = run("liftoff", "--weight", "15", "--alpha", "90", "--build", "0.2", "--json")
    data = json.loads(text)
    assert code == 0
    own = data["lift_off_own_places"]
    assert abs(own["value"] - data["lift_off"]["force"]) < 1e-2
    assert own["error"] < 1e-6


def test_out_of_the_vertical_plane_and_its_mirror_image() -> None:
    """A hole that walks to the right and one that walks to the left are images of each other: so are their rods."""
    code, text = run("critical", "--weight", "15", "--alpha", "80", "--build", "0.2", "--walk", "0.3")
    text = " ".join(text.split())
    assert code == 0
    assert "build 0.2/L, walk 0.3/L, α = 80° at mid-length" in text
    assert "below it leaves the wall highest" in text
    code, image = run("liftoff", "--weight", "15", "--alpha", "80", "--build", "0.2", "--walk=-0.3", "--json")
    data = json.loads(image)
    assert code == 0
    assert data["critical_load"] is None
    lift = data["lift_off"]
    assert f"lowest −{-lift['force']:.7f}" in text
    assert f"at s/L = {lift['s'][0]:.6f} below" in text
    assert data["lying"]["lowest_force"]["ends_by"] == "lift_off"
    assert data["lying"]["lowest_force"]["value"] == lift["force"]
    own = data["lift_off_own_places"]
    assert abs(own["value"] - lift["force"]) < 1e-2
    assert own["error"] < 1e-6


def test_the_load_path_out_of_the_vertical_plane() -> None:
    """From the rod as it lies; lift-off is that of `rodwell liftoff`, energies count from what the text says."""
    given = ("--weight", "15", "--alpha", "80", "--build", "0.2", "--walk", "0.3")
    lift = json.loads(run("liftoff", *given, "--json")[1])["lift_off"]
    words = ("path", *given, "--until", "-250", "--at", "-100,-250")
    code, text = run(*words)
    assert code == 0
    assert "buckles" not in text
    assert "F = −100, loading: on the wall, stable" in text
    data = json.loads(run(*words, "--json")[1])
    assert data["reached"]
    assert data["events"][0]["kind"] == "lift_off"
    assert data["events"][0]["force"]["value"] == pytest.approx(lift["force"], rel=1e-9)
    assert [state["kind"] for state in data["states"]] == ["on the wall", "partial contact"]
    assert all(state["certificate"]["passed"] for state in data["states"])


BENT_STRING = ("--weight", "15", "--alpha", "60", "--build", "0.3", "--sections", "0.6:1:1,0.4:0.3:0.5", "--modes", "1")


def test_critical_says_what_a_bend_asks_of_the_wall_at_a_step() -> None:
    """The couple is 0.7 κ/(1 + κΔ); the load that of shooting from section to section."""
    code, text = run("critical", *BENT_STRING)
    text = " ".join(text.split())
    assert code == 0
    assert "−99.57424418" in text
    assert "has a step (s/L = 0.6) the wall would have to hold the rod by a couple, of up to 0.2094 B/L" in text
    assert "off the wall beside the step, over about 0.099 L or more" in text
    (step,) = json.loads(run("critical", *BENT_STRING, "--json")[1])["lying"]["steps"]
    assert step["couple"]["value"] == pytest.approx(0.7 * 0.3 / 1.003, rel=1e-12)
    assert step["leaves_wall"]


def test_run_tells_the_load_of_a_string_that_nothing_holds_at_its_steps_too(tmp_path: Path) -> None:
    case = tmp_path / "bent.toml"
    case.write_text(
        'title = "bent"\n[dimensionless]\nweight = 15\nalpha = 60\nbuild = 0.3\nclearance = 0.01\n'
        'sections = "0.6:1:1,0.4:0.3:0.5"\n[analysis]\nmodes = 1\n'
    )
    code, text = run("run", str(case), "--no-path", "--out", str(tmp_path / "out"))
    assert code == 0
    data = json.loads((tmp_path / "out" / "answer.json").read_text())
    problem = Problem(15.0, 60.0, build=0.3, sections=((0.6, 1.0, 1.0), (0.4, 0.3, 0.5)))
    event = load_path(problem).first("critical")
    assert event is not None
    assert data["lying"]["not_held_at_steps"]["value"] == pytest.approx(event.force.value, rel=1e-8)
    words = " ".join(text.replace("│", " ").split())
    assert f"One that nothing holds there buckles sideways at the end force −{-event.force.value:.6g}" in words


def test_certify_says_which_numbers_are_taken_exactly() -> None:
    code, text = run("certify", "--weight", "0", "--build", "0.5", "--modes", "1", "--digits", "8")
    assert code == 0
    assert "Clearance and build are taken as the decimals given." in " ".join(text.split())


def test_strings_off_the_wall_of_a_build_have_their_loads() -> None:
    """Of the command line what the library has: steps of the stiffness alone, and of the clearance."""
    given = ("--weight", "50", "--alpha", "60", "--build", "0.2")
    steps = (*given, "--sections", "0.5:1,0.5:3")
    problem = Problem(50.0, 60.0, build=0.2, sections=((0.5, 1.0), (0.5, 3.0)))
    event = load_path(problem).first("critical")
    assert event is not None
    assert event.meaning == "the string in the curved hole buckles sideways"
    data = json.loads(run("critical", *steps, "--modes", "1", "--json")[1])
    assert data["not_held_at_steps"]["value"] == pytest.approx(event.force.value, rel=1e-8)
    assert data["critical_loads"] == pytest.approx([critical_loads(problem, 1)[0].force], rel=1e-8)
    assert "not held at its steps, off the wall beside them: −258.858" in run("critical", *steps, "--modes", "1")[1]
    assert "buckles sideways" in run("path", *steps)[1]
    over = (*given, "--sections", "0.4,0.2:1:1:0.5,0.4")
    bridges = problem.but(sections=((0.4, 1, 1, 1), (0.2, 1, 1, 0.5), (0.4, 1, 1, 1)))
    event = load_path(bridges).first("critical")
    assert event is not None
    data = json.loads(run("critical", *over, "--json")[1])
    assert data["critical_loads"] == pytest.approx([event.force.value], rel=1e-8)
    assert data["bridged"]["certificate"]["passed"]
