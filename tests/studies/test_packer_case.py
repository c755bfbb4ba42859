"""A case with a packer: the printed example of 1962 as a file, the command, both histories, wrong input."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import rodwell
from rodwell.cli.main import cli
from rodwell.errors import InputError

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "tubing-packer.toml"


def _case(**packer: Any) -> rodwell.Case:
    import tomllib

    data: dict[str, Any] = copy.deepcopy(tomllib.loads(EXAMPLE.read_text(encoding="utf-8")))
    for key, value in packer.items():
        section, _, name = key.rpartition("__")
        place = data[section or "packer"]
        if value is None:
            place.pop(name)
        else:
            place[name] = value
    return rodwell.Case.from_dict(data, text="x")


def test_the_example_is_that_of_1962() -> None:
    """With true diameters in place of rounded areas: within 0.3 in of the printed changes."""
    answer = rodwell.packer(rodwell.Case.read(EXAMPLE))
    inch = 0.0254
    for kind, printed in (("piston", -67.87), ("buckling", -46.05), ("ballooning", -34.69), ("temperature", -16.56)):
        assert answer.moved.changes[kind].value / inch == pytest.approx(printed, abs=0.3)
    assert answer.moved.landed.value / inch == pytest.approx(49.74, abs=0.1)
    assert answer.converged
    assert answer.state == "helical"
    # D r F/(4I), and von Mises by hand at the outer surface, bending in compression
    assert answer.stress.bending[0] == pytest.approx(2.875 * 1.6095 * 66232.0 / (4.0 * 1.6111) * 6894.757, rel=3e-3)
    assert repr(answer).startswith("<packer, motion some: -2.93 m if free, moved -2.93 m")
    assert "buckling" in answer._repr_html_()


def test_the_command_writes_everything(tmp_path: Path) -> None:
    result = CliRunner().invoke(cli, ["packer", str(EXAMPLE), "--out", str(tmp_path / "out")], catch_exceptions=False)
    assert result.exit_code == 0
    assert "its seals move 9.612 ft up" in " ".join(result.output.split())
    files = {file.name for file in (tmp_path / "out").iterdir()}
    assert files == {"case.toml", "packer.csv", "packer.json", "packer.png", "packer.svg", "packer.xlsx", "report.html"}
    data = json.loads((tmp_path / "out" / "packer.json").read_text(encoding="utf-8"))
    assert data["buckling"]["value"] == pytest.approx(-46.0 * 0.0254, rel=1e-3)
    assert data["packer_force"]["value"] == 0.0
    assert data["converged"]
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    assert "which ends 8630 ft above it" in page
    printed = CliRunner().invoke(
        cli, ["packer", str(EXAMPLE), "--out", str(tmp_path / "out"), "--json", "--units", "si"]
    )
    assert json.loads(printed.output)["unit"] == "SI"


def test_an_inclined_hole_gives_both_histories() -> None:
    answer = rodwell.packer(_case(hole__angle_from_vertical="50 deg", motion="none", down=None))
    names = list(answer.as_dict())
    assert "free_unloading" in names
    assert "packer_force_unloading" in names
    assert answer.moved.packer.value < answer.unloading.packer.value or answer.moved.stopped == ""
    assert answer.converged


@pytest.mark.parametrize(
    ("said", "changes"),
    [
        (r"packer.bore = '8 in': must be below the bore of 0.154788 m \(6.094", {"bore": "8 in"}),
        ("packer.motion", {"motion": "sometimes"}),
        ('contradicts motion = "all"', {"motion": "all"}),
        ("packer.motion = 'some': needs up, down or both", {"down": None, "slack_off": None}),
        ("packer.slack_off = .*: needs a packer that holds the tubing", {"motion": "all", "down": None}),
        ("packer.slack_off", {"down": "1 ft"}),
        ("packer.pick_up = .*: contradicts packer.slack_off", {"pick_up": "10 kN"}),
        ("packer.thermal_expansion: is missing", {"thermal_expansion": None}),
        ("packer.temperature_change", {"temperature_change": "20 m"}),
        ("packer.temperature_change .*is not plausible", {"temperature_change": "5000 °F"}),
        ("packer.thermal_expansion .*is not plausible", {"thermal_expansion": "6.9 /°F"}),
        ("takes no uncertainties", {"bore": "3.25 in ± 0.1 in"}),
        (
            "packer.outside = '60 lb/gal': lifts the tubing",
            {"outside": "60 lb/gal", "inside": "0 lb/gal", "inside_pressure": "1 psi"},
        ),
        ("mud.density = '70 lb/gal': lifts the tubing", {"mud__density": "70 lb/gal"}),
        (r"packer.bore = '1 in': is below the tubing's inner diameter of 0.0620\d* m \(2.44\d* in\)", {"bore": "1 in"}),
        (
            r"rod.core_diameter = .*: is that of a solid core, and tubing in a packer has a bore",
            {
                "rod__inner_diameter": None,
                "rod__core_diameter": "1 in",
                "rod__weight_per_length": "5 lbf/ft",
                "mud__density": None,
                "mud__outside": "1 g/cm^3",
                "inside": None,
            },
        ),
        (
            "rod.inner_diameter",
            {"rod__inner_diameter": None, "mud__density": None, "mud__outside": "1 g/cm^3", "inside": None},
        ),
    ],
)
def test_wrong_input(said: str, changes: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=said):
        rodwell.packer(_case(**changes))


def test_a_string_of_sections_is_refused() -> None:
    pipe = {"outer_diameter": "2.875 in", "inner_diameter": "2.441 in", "material": "steel"}
    case = rodwell.Case.from_dict(
        {
            "string": [{**pipe, "length": "1000 ft"}, {**pipe, "length": "500 ft", "inner_diameter": "2 in"}],
            "hole": {"diameter": "6.094 in", "angle_from_vertical": "20 deg"},
            "packer": {"bore": "3.25 in", "motion": "all"},
        }
    )
    with pytest.raises(InputError, match=r"string: is not taken beside \[packer\]"):
        rodwell.packer(case)


def test_a_case_without_packer_says_what_to_write() -> None:
    with pytest.raises(InputError, match=r"packer: is missing: write \[packer\] with bore and motion"):
        rodwell.packer(rodwell.Case.from_dict({"dimensionless": {"weight": 16.5}}))
    with pytest.raises(InputError, match=r"packer: needs \[rod\] and \[hole\]"):
        rodwell.Case.from_dict({"dimensionless": {"weight": 16.5}, "packer": {"bore": "3 in", "motion": "all"}})
