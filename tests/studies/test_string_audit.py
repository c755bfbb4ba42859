"""Formulas of practice for strings: section by section by hand, with the force there; the section that governs."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from rodwell import Case, InputError, Problem, critical_loads
from rodwell.answers.comparison.by_sections import ENDS_OF_ITS_OWN, LEAST_STIFFNESS, section_rods
from rodwell.cli.main import cli
from rodwell.report.reports.audit import conditions, if_held
from rodwell.studies.audit.audit import audit

STRING = Problem(400.0, 70.0, sections=((0.5, 1.0, 1.3), (0.2, 0.3, 0.8), (0.3, 2.0, 0.6)))
BENT = STRING.but(build=0.2)
CASES = Path(__file__).parents[2] / "examples"


def by_hand(lateral: np.ndarray, above: np.ndarray, force: float) -> tuple[int, float, float]:
    """Dawson–Paslay 2√(B wₗ/r) in each section at its bottom: which governs, its load, and the exact force there."""
    stiffness = np.array([section[1] for section in STRING.sections], dtype=float)
    loads = 2.0 * np.sqrt(stiffness * lateral / STRING.clearance)
    first = int(np.argmax(above - loads))
    return first, float(loads[first]), above[first] - force


def test_a_straight_string() -> None:
    """N(s) = F − w cos α ∫ₛ¹ q: what hangs above the bottom of each section, added up by hand."""
    weights = 400.0 * np.array([1.3, 0.8, 0.6])
    above = math.cos(math.radians(70.0)) * np.cumsum((weights * [0.5, 0.2, 0.3])[::-1])[::-1]
    force = critical_loads(STRING, 1)[0].force
    number, value, exact = by_hand(weights * math.sin(math.radians(70.0)), above, force)
    row = audit(STRING).row("dawson_paslay")
    assert row.section == f"section {number + 1}" == "section 2"
    assert row.value == pytest.approx(value, rel=1e-12)
    main = row.main
    assert main is not None
    assert main.exact == pytest.approx(exact, rel=1e-9)
    assert main.percent == pytest.approx(100.0 * (value / exact - 1.0), abs=1e-6)
    assert row.at == "bottom of section 2"
    ends = [one.force for one in row.by_section]
    assert max(ends) == ends[number]
    assert ends[0] == pytest.approx(above[0] - 2.0 * math.sqrt(weights[0] * math.sin(math.radians(70.0)) / 0.01))


def test_a_string_in_a_bend_has_local_inclination_and_force() -> None:
    """He–Kyllingstad, F = (2Bb/r)[1 + √(1 + w sin α r/(B b²))], with α and hung weight of an arc in closed form."""
    row, bent = audit(BENT).row("he_kyllingstad"), 0.2 / (1.0 + 0.01 * 0.2)
    starts, lengths, q, b = (np.array(x) for x in ((0.0, 0.5, 0.7), (0.5, 0.2, 0.3), (1.3, 0.8, 0.6), (1.0, 0.3, 2.0)))
    angles = math.radians(70.0) - bent * (starts + 0.5 * lengths - 0.5)
    rises = [
        (math.sin(math.radians(70.0) - bent * (s - 0.5)) - math.sin(math.radians(70.0) - bent * (s + d - 0.5))) / bent
        for s, d in zip(starts, lengths, strict=True)
    ]
    above = 400.0 * np.cumsum((q * rises)[::-1])[::-1]
    values = 2.0 * b * 0.2 / 0.01 * (1.0 + np.sqrt(1.0 + 400.0 * q * np.sin(angles) * 0.01 / (b * 0.2**2)))
    number = int(np.argmax(above - values))
    assert row.section == f"section {number + 1}"
    assert row.value == pytest.approx(values[number], rel=1e-9)
    assert row.main is not None
    assert row.main.exact == pytest.approx(above[number] - critical_loads(BENT, 1)[0].force, rel=1e-9)
    assert "for straight holes, and this one is curved" in audit(BENT).row("dawson_paslay").reasons


def test_out_of_the_plane_the_bend_is_parted_at_each_section() -> None:
    """|build|² + |turn|² is the curvature squared wherever it is; in the middle they are those given."""
    problem = Problem(15.0, 60.0, build=0.5, walk=0.3, sections=((0.2, 1.0), (0.6, 0.5), (0.2, 0.8)))
    rods = [dict(one.rod.more) for one in section_rods(problem, {})]
    assert all(math.hypot(one["build"], one["turn"]) == pytest.approx(math.hypot(0.5, 0.3)) for one in rods)
    assert (rods[1]["build"], rods[1]["turn"]) == pytest.approx((0.5, 0.3), abs=2e-3)
    assert rods[0]["turn"] != pytest.approx(0.3, abs=0.01)


def test_what_formulas_are_not_for() -> None:
    rows = audit(STRING.but(sections=((0.5, 1.0, 1.3), (0.5, (0.5, 0.3), 0.8))))
    assert LEAST_STIFFNESS in rows.row("dawson_paslay").reasons
    assert ENDS_OF_ITS_OWN in rows.row("paslay_bogy").reasons
    assert ENDS_OF_ITS_OWN not in rows.row("dawson_paslay").reasons
    assert rows.others == ()
    assert any("audit the section that buckles" in note for note in rows.not_found)
    with pytest.raises(InputError, match="must have one clearance"):
        audit(STRING.but(sections=((0.5, 1.0, 1.0, 1.2), (0.5, 1.0, 1.0, 1.0))))


def test_the_middle_of_a_string_is_not_half_of_its_weight() -> None:
    (load, *_) = audit(STRING).loads
    above = 400.0 * math.cos(math.radians(70.0)) * (0.2 * 0.8 + 0.3 * 0.6)
    assert load.at("middle") == pytest.approx(above - load.force, rel=1e-12)


def test_a_case_names_its_sections(tmp_path: Path) -> None:
    case = CASES / "assembly-in-build.toml"
    row = audit(Case.read(case)).row("he_kyllingstad")
    assert row.section == "drill pipe"
    told = CliRunner().invoke(cli, ["audit", str(case), "--out", str(tmp_path / "out"), "--details"])
    assert told.exit_code == 0, told.output
    assert "bottom of drill pipe" in told.output
    assert "section by section: drill pipe governs" in " ".join(told.output.replace("│", " ").split())
    data = json.loads((tmp_path / "out" / "audit.json").read_text())
    (found,) = (one for one in data["formulas"] if one["key"] == "he_kyllingstad")
    assert found["section"] == "drill pipe"
    assert {one["section"] for one in found["by_section"]} == {"drill pipe", "heavy-weight pipe"}
    assert (tmp_path / "out" / "audit.csv").read_text().splitlines()[0].endswith(",section")
    assert "bottom of drill pipe" in (tmp_path / "out" / "report.html").read_text()


def test_what_is_assumed_of_steps_is_said_beside_the_exact_loads() -> None:
    string, uniform = (Problem(100.0, 60.0, sections=given) for given in ([(0.6, 1.0), (0.4, 0.5)], ()))
    assert "if its slope is held at steps of its stiffness" in if_held(string)
    assert if_held(string) in conditions(string)
    assert "its slope held at steps of its stiffness" in audit(string).as_dict()["conventions"]
    assert if_held(uniform) == ""
