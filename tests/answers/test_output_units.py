"""Results in SI, field and millimetre units: round trips, and the same numbers everywhere."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodwell import Case, InputError, critical_loads, follow
from rodwell.answers.result.answer import Answer, answer
from rodwell.cli.main import main
from rodwell.plots.bifurcation import plot_bifurcation
from rodwell.plots.units import axis
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain
from rodwell.quantities.units import SYSTEMS, System, to_si
from rodwell.report.reports.texts import derived, rows

EXAMPLES = Path(__file__).parents[2] / "examples"

KINDS = {
    "length": "length", "force": "force", "force_per_length": "force per length", "moment": "moment",
    "stress": "stress", "density": "density", "stiffness": "bending stiffness",
}  # fmt: skip
"""What results are in, by dimension, as inputs know it."""

NUMBERS = st.builds(lambda size, sign: sign * size, st.floats(1e-9, 1e9), st.sampled_from([1.0, -1.0]))


@given(NUMBERS, st.sampled_from(sorted(KINDS)), st.sampled_from(SYSTEMS))
def test_what_is_printed_can_be_read_again(value: float, dimension: str, system: str) -> None:
    """To 1e-12, minus sign, prefix and · included."""
    text = System(system).text(value, dimension, 17)
    assert to_si(text, KINDS[dimension]) == pytest.approx(value, rel=1e-12)
    unit, name = System(system).unit(dimension)
    assert to_si(f"{value / unit!r} {name}", KINDS[dimension]) == pytest.approx(value, rel=1e-12)


@given(NUMBERS, st.sampled_from([
    ("length", "in"), ("length", "ft"), ("length", "mm"), ("force", "lbf"), ("force", "klbf"), ("moment", "ft lbf"),
    ("stress", "psi"), ("stress", "ksi"), ("pressure", "psi"), ("density", "lb/gal"), ("density", "ppg"),
    ("force per length", "lbf/ft"), ("bending stiffness", "lbf in^2"), ("angle", "deg"),
]))  # fmt: skip
def test_inputs_scale(number: float, kind_unit: tuple[str, str]) -> None:
    """A number times a unit is that number of units: no unit has an offset, none loses digits."""
    kind, unit = kind_unit
    if kind == "pressure" and number < 0.0:
        number = -number
    assert to_si(f"{number!r} {unit}", kind) == pytest.approx(number * to_si(f"1 {unit}", kind), rel=1e-12)


@pytest.mark.parametrize(
    ("system", "dimension", "value", "text"),
    [
        ("si", "force", -139600.0, "−139.6 kN"),
        ("field", "force", -36705.0 * 4.4482216152605, "−36\u202f700 lbf"),
        ("field", "length", 30.48, "100 ft"),
        ("field", "length", 1.75 * 0.0254, "1.75 in"),
        ("field", "stress", 135e3 * 6894.757293168361, "135\u202f000 psi"),
        ("field", "moment", 1000 * 1.3558179483314004, "1000 ft·lbf"),
        ("field", "density", 1198.2642731, "10 lb/gal"),
        ("field", "force_per_length", 19.5 * 4.4482216152605 / 0.3048, "19.5 lbf/ft"),
        ("mm", "length", 0.12, "120 mm"),
        ("mm", "moment", 1e-3, "1 N·mm"),
        ("mm", "stress", 2e8, "200 MPa"),
        ("mm", "force_per_length", 20.0, "20 mN/mm"),
        ("si", "density", 7850.0, "7850 kg/m³"),
        ("mm", "stiffness", 1.4e-3, "1400 N·mm²"),
    ],
)
def test_texts(system: str, dimension: str, value: float, text: str) -> None:
    assert System(system).text(value, dimension) == text


def test_plain_numbers_have_no_exponent() -> None:
    assert plain(-24816.55) == "−24\u202f820"
    assert plain(123456789.0, 6) == "1.23457 × 10⁸"
    assert plain(0.0) == "0"
    assert plain(float("inf")) == "inf"


@given(st.floats(1e-2, 1e3), st.floats(1e-4, 1e8), st.sampled_from(SYSTEMS), st.floats(1e-6, 1e6))
def test_axes_are_in_the_units_they_name(length: float, stiffness: float, system: str, largest: float) -> None:
    scales = Scales(length, stiffness, system=System(system))
    for name, kind in (("force", "force"), ("z", "length"), ("T2", "moment"), ("contact_pressure", "force per length")):
        factor, unit = axis(name, scales, largest)
        dimension = {"force per length": "force_per_length"}.get(kind, kind)
        expected = largest * scales.factor(dimension)
        if 1e-15 < expected < 1e15:
            assert to_si(f"{largest * factor!r} {unit}", kind) == pytest.approx(expected, rel=1e-9)


@pytest.fixture(scope="module")
def drill_string() -> Answer:
    text = (EXAMPLES / "drill-string.toml").read_text(encoding="utf-8").replace("modes = 4", "modes = 1\nrtol = 1e-6")
    return answer(Case.from_dict(tomllib.loads(text)))


def test_units_change_what_is_shown_and_nothing_else(drill_string: Answer) -> None:
    """Every row of the table says the same in all systems."""
    shown = {}
    for system in SYSTEMS:
        case = drill_string.case.in_units(system)
        assert case.problem == drill_string.case.problem
        there = Answer(case, drill_string.critical, drill_string.branches, drill_string.until)
        shown[system] = {
            key.name: to_si(row["value"], KINDS[key.dimension])
            for key, row in zip(there.key_numbers.values(), rows(there.key_numbers.values(), there.case), strict=True)
        }
        data = there.as_dict()["figures"]["critical_load_1"]
        unit = {"si": "N", "field": "lbf", "mm": "N"}[system]
        assert data[system]["unit"] == unit
        assert to_si(f"{data[system]['value']!r} {unit}", "force") == pytest.approx(data["si"]["value"], rel=1e-12)
        lengths = dict(derived(case))
        assert lengths["length L"] == {"si": "30 m", "field": "98.4252 ft", "mm": "30\u202f000 mm"}[system]
    for system in ("field", "mm"):
        assert shown[system] == pytest.approx(shown["si"], rel=1e-5)


def test_in_units_refuses(drill_string: Answer) -> None:
    assert drill_string.case.in_units(None) is drill_string.case
    with pytest.raises(InputError, match=r"units = 'cgs': must be one of si, field, mm"):
        drill_string.case.in_units("cgs")
    with pytest.raises(InputError, match="needs a case with dimensions"):
        Case.from_dict({"dimensionless": {"weight": 1.0}}).in_units("field")


QUICK = """
units = "field"
[rod]
pipe = "2 in x 0.156 in coiled tubing"
length = "40 ft"
[mud]
outside = "9 lb/gal"
[hole]
diameter = "4 in"
angle_from_vertical = "90 deg"
[analysis]
modes = 1
rtol = 1e-5
"""


def command(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], *words: str) -> str:
    monkeypatch.setattr("sys.argv", ["rodwell", *words])
    monkeypatch.setenv("COLUMNS", "160")
    main()
    return capsys.readouterr().out


def test_commands_show_the_units_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The case's own units by default, --units over them; summary, report, JSON, export and audit."""
    file = tmp_path / "tubing.toml"
    file.write_text(QUICK, encoding="utf-8")
    text = command(monkeypatch, capsys, "run", str(file), "--no-path", "--details", "--out", str(tmp_path / "a"))
    assert re.search(r"until the compression reaches [\d.]+ lbf", text)
    assert "buoyed weight per length mg" in text
    assert not re.search(r"\d k?N\b", text)
    report = (tmp_path / "a" / "report.html").read_text(encoding="utf-8")
    body = re.sub(r"<script.*?</script>|data:[^\"]*", "", report, flags=re.DOTALL)
    assert "forces are effective ones" in body
    assert re.search(r"buoyed weight per length mg</td><td>[\d.]+\u00a0lbf/ft</td>", body)
    assert "lbf/ft" in body
    assert not re.search(r"\d k?N\b", body)
    data = json.loads(command(monkeypatch, capsys, "run", str(file), "--no-path", "--units", "mm",
                              "--out", str(tmp_path / "b"), "--json"))  # fmt: skip
    assert data["figures"]["end_shortening"]["mm"]["unit"] == "mm"
    assert "field" not in data["figures"]["end_shortening"]
    assert {fact["label"] for fact in data["conversions"]} >= {"pipe", "buoyed weight per length mg"}
    text = command(monkeypatch, capsys, "export", str(file), "--to", str(tmp_path / "rod.csv"))
    assert "lbf), tension positive" in text
    text = command(monkeypatch, capsys, "audit", str(file), "--no-chart", "--details", "--out", str(tmp_path / "c"))
    assert "lbf" in text
    assert "psi" in text
    assert not re.search(r"\d k?N\b", text)
    found = json.loads((tmp_path / "c" / "audit.json").read_text(encoding="utf-8"))["exact"][0]
    assert found["field"]["force"] * 4.4482216152605 == pytest.approx(found["si"]["force"], rel=1e-12)


def test_figures_name_their_units() -> None:
    """The axes of a diagram in field units."""
    case = Case.from_dict({
        "rod": {"outer_diameter": "10 cm", "material": "steel", "length": "30 m"},
        "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
        "units": "field",
    })  # fmt: skip
    branch = follow(case.problem, 1, rtol=1e-4)
    ax = plot_bifurcation([branch], critical_loads(case.problem, 1), case.scales)
    assert ax.get_xlabel().endswith("[lbf]")
    assert ax.get_ylabel().endswith("[in]")
