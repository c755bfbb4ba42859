"""[[hole.section]] of a case: a hole whose diameter has steps, beside a rod or a string."""

from __future__ import annotations

import copy
import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from rodwell.case.case import Case, CaseError
from rodwell.case.keys import keys_named
from rodwell.cli.main import cli

EXAMPLE = Path(__file__).parents[2] / "examples" / "tubing-two-casings.toml"
DATA = tomllib.loads(EXAMPLE.read_text(encoding="utf-8"))
INCH = 0.0254


def changed(casing: dict[str, Any] | None = None, liner: dict[str, Any] | None = None, **sections: Any) -> Case:
    """The example with other values in its sections; None takes a key away."""
    data = copy.deepcopy(DATA)
    for part, changes in zip(data["hole"]["section"], (casing or {}, liner or {}), strict=True):
        part.update(changes)
        for key in [key for key, value in part.items() if value is None]:
            del part[key]
    for name, values in sections.items():
        data[name] = data[name] | values if isinstance(values, dict) else values
    return Case.from_dict(data)


def test_clearances_are_half_of_what_the_rod_leaves() -> None:
    """From the top down in the file, from s = 0 up in the problem; lengths in L, clearances as ratios."""
    found = changed()
    (first, _, _, one, _), (second, _, _, ratio, _) = found.problem.sections
    assert (first, second) == pytest.approx((0.5, 0.5))
    liner, casing = 0.5 * (6.094 - 2.875) * INCH, 0.5 * (8.681 - 2.875) * INCH
    assert found.problem.clearance * 120.0 * 0.3048 == pytest.approx(liner)
    assert (one, ratio) == pytest.approx((1.0, casing / liner))
    assert [pair.name for pair in found.pairs] == ["hole.section 2 (liner)", "hole.section 1 (casing)"]


def by_depth(
    hole: dict[str, Any] | None = None, casing: Any = ("1000 ft", "1060 ft"), liner: Any = (None, "1200 ft")
) -> Case:
    """The example with sections between measured depths."""
    parts = [
        {"length": None, "from": start, "to": end} if start else {"length": None, "to": end}
        for start, end in (casing, liner)
    ]
    return changed(parts[0], parts[1], hole=hole or {})


def test_sections_may_be_given_by_measured_depth() -> None:
    """As of a well: the rod lies from where the first section begins, or where hole.from says; parts are cut there."""
    assert np.array(by_depth().problem.sections) == pytest.approx(np.array(changed().problem.sections))
    lower = by_depth({"from": "1030 ft"}).problem
    assert [section[0] for section in lower.sections] == pytest.approx([0.75, 0.25])
    assert by_depth({"to": "1150 ft"}).problem == lower
    within = by_depth({"from": "1070 ft"})
    assert within.problem.sections == ()
    assert [pair.name for pair in within.pairs] == []
    assert within.problem.clearance * 120.0 * 0.3048 == pytest.approx(0.5 * (6.094 - 2.875) * INCH)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"liner": ("1061 ft", "1200 ft")}, "hole.section 2 (liner).from = '1061 ft': is not where the section above "
         "ends, 323.088 m"),
        ({"liner": (None, None)}, "hole.section 2 (liner).to: is missing"),
        ({"liner": (None, "1060 ft")}, "hole.section 2 (liner).to = '1060 ft': must be below where the section begins"),
        ({"hole": {"from": "1100 ft"}}, "goes from 304.8 m (1000 ft) to 365.76 m (1200 ft), and the rod lies from "
         "335.28 m (1100 ft) to 371.856 m (1220 ft)"),
        ({"casing": ("1060 ft", "1200 ft"), "liner": ("1000 ft", "1060 ft")},
         "without gap or overlap; these go from the bottom up, as [[string]] does: turn their order round"),
        ({"casing": (None, "1200 ft"), "liner": (None, "1060 ft")}, "these go from the bottom up"),
        ({"hole": {"from": "900 ft"}}, "and the rod lies from 274.32 m (900 ft)"),
        ({"hole": {"from": "1000 ft", "to": "1100 ft"}}, "hole.from"),
    ],
)  # fmt: skip
def test_depths_that_do_not_fit_are_named(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(CaseError) as told:
        by_depth(**changes)
    assert words in str(told.value)


def test_one_diameter_all_along_is_a_hole_without_sections() -> None:
    data = copy.deepcopy(DATA)
    data["hole"] = {"diameter": "8.681 in", "angle_from_vertical": "90 deg"}
    assert changed(liner={"diameter": "8.681 in"}).problem == Case.from_dict(data).problem


def test_sections_of_a_string_and_of_its_hole_part_each_other() -> None:
    """Three pieces: the collar in the liner, the pipe in the liner, the pipe in the casing."""
    pipe = {"outer_diameter": "2.875 in", "inner_diameter": "2.441 in", "material": "steel"}
    string = [{**pipe, "outer_diameter": "4 in", "length": "30 ft", "name": "collar"}, {**pipe, "length": "90 ft"}]
    data = {**copy.deepcopy(DATA), "string": string}
    del data["rod"]
    found = Case.from_dict(data)
    lengths, stiffness, _, clearance, _ = zip(*found.problem.sections, strict=True)
    assert lengths == pytest.approx((0.25, 0.25, 0.5))
    assert stiffness[1] == stiffness[2] == 1.0
    liner = 6.094 - 2.875
    assert clearance == pytest.approx([(6.094 - 4.0) / (8.681 - 2.875), liner / (8.681 - 2.875), 1.0])


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"casing": {"length": "61 ft"}},
         "hole.section: has lengths 18.5928 m (61 ft) + 18.288 m (60 ft) = 36.8808 m (121 ft)"),
        ({"casing": {"diameter": "2.5 in"}},
         "hole.section 1 (casing).diameter = '2.5 in': must be above the rod's outer diameter of 0.073025 m"),
        ({"liner": {"diam": "3 in"}}, "hole.section 2.diam = '3 in': is not known; did you mean 'diameter'?"),
        ({"liner": {"diameter": None}}, "hole.section 2 (liner).diameter: is missing: give it here or in [hole]"),
        ({"liner": {"diameter": ["3 in", "4 in"]}}, "hole.section 2.diameter"),
        ({"liner": {"diameter": "6 in ± 1 in"}}, "cannot have an uncertainty here"),
        ({"liner": {"length": "3"}}, "hole.section 2.length = '3': must be a length"),
        ({"liner": {"length": None}}, "hole.section 2 (liner).length: is missing: give it, or from and to"),
        ({"liner": {"to": "120 ft"}}, "hole.section 1 (casing).length = '60 ft': contradicts from and to"),
        ({"hole": {"clearance": "1 in"}}, "hole.clearance = '1 in': contradicts [[hole.section]]"),
        ({"hole": {"build": "1 deg/30 m"}}, "hole.build = '1 deg/30 m': cannot stand beside [[hole.section]]"),
        ({"hole": {"section": {"length": "3 m"}}}, "must be sections: write [[hole.section]]"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_named(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(CaseError) as told:
        changed(**changes)
    assert words in str(told.value)


def test_keys_are_explained() -> None:
    names = [key.name for key in keys_named("hole.section")]
    assert names == ["name", "length", "from", "to", "diameter", "diameter_at_top"]
    (length,) = keys_named("hole.section.length")
    assert not length.required


def test_run_says_what_was_computed_and_what_not(tmp_path: Path) -> None:
    """The folder of the example: verdict, contact, the loads that act; less compression is a smaller share."""
    out = tmp_path / "out"
    done = CliRunner().invoke(cli, ["run", str(EXAMPLE), "--out", str(out)])
    assert done.exit_code == 0, done.output
    assert "buckles sideways at 6608 lbf of compression; 76 % of that is used" in " ".join(done.output.split())
    assert "Not computed where the clearance has steps" in " ".join(done.output.split())
    files = ["answer.json", "bridging.png", "bridging.svg", "case.toml", "contact.csv", "contact.xlsx", "report.html"]
    assert sorted(file.name for file in out.iterdir()) == files
    data = json.loads((out / "answer.json").read_text(encoding="utf-8"))
    (applied,) = data["applied"]
    assert applied["force"] / data["buckling"]["force"]["value"] == pytest.approx(applied["share_of_buckling"])
    assert applied["rod_stress"]["safety_factor"] > 1.0
    assert [point["kind"] for point in applied["state"]["point_contacts"]] == ["end", "edge", "end"]
    total = data["without_compression"]["state"]["contact_total"]["value"]
    assert total == pytest.approx(Case.read(EXAMPLE).problem.weight, rel=1e-6)  # all the weight
