"""The catalogue against other numbers of the same standards, spellings, and files of the user's."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from rodwell import Case
from rodwell.case.catalogue import key_of, package_catalogue, read_catalogue
from rodwell.cli.main import main

INCH, FOOT, LBF = 0.0254, 0.3048, 4.4482216152605
CATALOGUE = package_catalogue()
PIPES = [CATALOGUE.pipe(name) for name in CATALOGUE.names("pipe")]


def area(pipe: object) -> float:
    """Section of the body in in²."""
    return math.pi / 4.0 * (pipe.outer_diameter**2 - pipe.bore**2) / INCH**2  # type: ignore[attr-defined]


def test_every_entry_is_right_and_has_its_source() -> None:
    assert len(PIPES) == 93
    for kind in ("material", "grade"):
        for name in CATALOGUE.names(kind):
            assert getattr(CATALOGUE, kind)(name).source
    for pipe in PIPES:
        assert pipe.source
        assert pipe.note
        steel = pipe.kind in ("drill pipe", "tubing", "coiled tubing", "sucker rod")
        assert steel or pipe.kind in ("guidewire", "catheter", "fibre")
        assert pipe.name.endswith(pipe.kind)
        if pipe.material is not None:
            assert (CATALOGUE.material(pipe.material).name == "steel") is steel


@pytest.mark.parametrize(
    ("name", "section"),
    [  # cross-sectional areas of the body, tabulated beside the dimensions in API RP 7G
        ("2-7/8 in 10.4 lb/ft drill pipe", 2.8579),
        ("3-1/2 in 13.3 lb/ft drill pipe", 3.6209),
        ("4-1/2 in 16.6 lb/ft drill pipe", 4.4074),
        ("5 in 19.5 lb/ft drill pipe", 5.2746),
        ("5 in 25.6 lb/ft drill pipe", 7.0686),
        ("5-1/2 in 21.9 lb/ft drill pipe", 5.8282),
        ("6-5/8 in 25.2 lb/ft drill pipe", 6.5262),
    ],
)
def test_section_of_drill_pipe(name: str, section: float) -> None:
    assert area(CATALOGUE.pipe(name)) == pytest.approx(section, abs=6e-5)


@pytest.mark.parametrize("pipe", [p for p in PIPES if p.plain_end_weight], ids=lambda p: p.name)
def test_plain_end_weight_of_drill_pipe(pipe: object) -> None:
    """10.68 (D − t) t lb/ft, the formula of API Spec 5CT, against the weights listed: wall and bore agree with them."""
    wall = 0.5 * (pipe.outer_diameter - pipe.bore) / INCH  # type: ignore[attr-defined]
    weight = 10.68 * (pipe.outer_diameter / INCH - wall) * wall  # type: ignore[attr-defined]
    assert pipe.plain_end_weight / (LBF / FOOT) == pytest.approx(weight, abs=0.012)  # type: ignore[attr-defined]
    assert pipe.weight_per_length > pipe.plain_end_weight  # type: ignore[attr-defined]


@pytest.mark.parametrize("pipe", [p for p in PIPES if p.kind == "tubing"], ids=lambda p: p.name)
def test_nominal_weight_of_tubing(pipe: object) -> None:
    """Upsets and couplings add up to a tenth to the plain-end weight."""
    assert 1.0 < pipe.weight_per_length / (LBF / FOOT) / (3.4 * area(pipe)) < 1.1  # type: ignore[attr-defined]


def test_coiled_tubing_weighs_what_its_section_does() -> None:
    """2 in × 0.156 in: 3.072 lb/ft by 10.68 (D − t) t (5CT)."""
    case = Case.from_dict({
        "rod": {"pipe": "2 in x 0.156 in coiled tubing", "length": "10 m"},
        "hole": {"diameter": "4 in", "angle_from_vertical": "90 deg"},
    })  # fmt: skip
    assert case.rod is not None
    assert case.rod.weight_in_air / (LBF / FOOT) == pytest.approx(10.68 * (2.0 - 0.156) * 0.156, rel=2e-3)


def test_french_sizes_and_guidewires() -> None:
    assert CATALOGUE.pipe("6 Fr catheter").outer_diameter == pytest.approx(2e-3, rel=1e-15)
    assert CATALOGUE.pipe("0.035 in guidewire").outer_diameter == pytest.approx(0.889e-3, rel=1e-14)
    for pipe in PIPES:
        if pipe.kind in ("guidewire", "catheter"):  # none is standard
            assert (pipe.bending_stiffness, pipe.weight_per_length, pipe.material) == (None, None, None)


@pytest.mark.parametrize("pipe", [p for p in PIPES if p.kind == "sucker rod"], ids=lambda p: p.name)
def test_weight_of_sucker_rods(pipe: object) -> None:
    """Couplings add about a twelfth to the weight of the body, 3.4 lb/ft for each in²."""
    body = 3.4 * math.pi / 4.0 * (pipe.outer_diameter / INCH) ** 2  # type: ignore[attr-defined]
    assert 1.06 < pipe.weight_per_length / (LBF / FOOT) / body < 1.10  # type: ignore[attr-defined]
    assert pipe.bore is None  # type: ignore[attr-defined]
    assert not pipe.hollow  # type: ignore[attr-defined]


def test_fibres_have_the_stiffness_of_their_section() -> None:
    for name, modulus, diameter in (("0.125 mm optical fibre", 72.7e9, 125e-6), ("0.007 mm carbon fibre", 230e9, 7e-6)):
        case = Case.from_dict({
            "rod": {"pipe": name, "length": "10 mm"}, "hole": {"diameter": "1 mm", "angle_from_vertical": "90 deg"},
        })  # fmt: skip
        assert case.scales is not None
        assert case.scales.stiffness == pytest.approx(modulus * math.pi / 64.0 * diameter**4, rel=1e-12)


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("5 in 19.50 lb/ft drill pipe", "5 in 19.5 lb/ft drill pipe"),
        ('5" 19.5 ppf Drill Pipe', "5 in 19.5 lb/ft drill pipe"),
        ("2.875 in 6.50# tubing", "2-7/8 in 6.5 lb/ft tubing"),
        ("2 7/8 inch 6.5 lbf/ft tubing", "2-7/8 in 6.5 lb/ft tubing"),
        ("2 in × .156 in coiled tubing", "2 in x 0.156 in coiled tubing"),
        ("5 French catheter", "5 Fr catheter"),
        ("5F catheter", "5 Fr catheter"),
        (".035in guide wire", "0.035 in guidewire"),
        ("7/8 in Sucker Rod", "7/8 in sucker rod"),
        ('1 1/8" sucker rod', "1-1/8 in sucker rod"),
        ("18F catheter", "18 Fr catheter"),
    ],
)
def test_spellings(written: str, name: str) -> None:
    assert CATALOGUE.pipe(written).name == name


def test_spellings_of_materials_and_grades() -> None:
    assert CATALOGUE.material("Aluminum").name == "aluminium"
    assert CATALOGUE.grade("s135").yield_strength == pytest.approx(135e3 * LBF / INCH**2)
    assert CATALOGUE.grade("L-80").name == "L80"
    assert key_of("1/0 in") == "1/0in"  # no division by zero


def test_steel_is_that_of_the_buoyancy_factor() -> None:
    steel = CATALOGUE.material("steel")
    assert steel.density == pytest.approx(65.5 * 0.45359237 / (231.0 * INCH**3), rel=1e-12)
    assert steel.youngs_modulus == pytest.approx(30e6 * LBF / INCH**2, rel=1e-12)


def listed(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, *words: str) -> str:
    monkeypatch.setattr("sys.argv", ["rodwell", "catalogue", *words])
    main()
    return capsys.readouterr().out


def test_the_command_lists_names(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    text = listed(capsys, monkeypatch)
    for kind in ("pipe", "material", "grade"):
        assert all(name in text for name in CATALOGUE.names(kind))
    text = listed(capsys, monkeypatch, "tubing", "2.875", "5CT", "--units", "mm")
    assert "2-7/8 in 6.5 lb/ft tubing" in text
    assert "OD 73.02 mm   ID 62 mm" in text
    assert "drill" not in text
    assert "Nothing in the catalogue holds rope" in listed(capsys, monkeypatch, "rope")
    own = tmp_path / "mine.toml"
    own.write_text(OWN, encoding="utf-8")
    found = json.loads(listed(capsys, monkeypatch, "shaft", "--file", str(own), "--json"))
    assert [pipe["name"] for pipe in found["pipe"]] == ["my shaft"]
    assert found["pipe"][0]["source"] == "data sheet 17"
    with pytest.raises(SystemExit) as stopped:
        listed(capsys, monkeypatch, "--file", str(tmp_path / "none.toml"))
    assert stopped.value.code == 2
    assert "--file" in capsys.readouterr().err


OWN = """
source = "data sheet 17"

[[material]]
name = "braided shaft"
youngs_modulus = "20 GPa"
density = "5000 kg/m^3"

[[pipe]]
name = "my shaft"
outer_diameter = "2 mm"
wall = "0.5 mm"
material = "braided shaft"

[[pipe]]
name = "5 in 19.5 lb/ft drill pipe"
source = "caliper"
outer_diameter = "4.95 in"
inner_diameter = "4.276 in"
material = "steel"

[[grade]]
name = "annealed"
yield_strength = "300 MPa"
"""


def test_files_of_the_user(tmp_path: Path) -> None:
    """Found from the case file's folder; their entries go before those of the package."""
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "mine.toml").write_text(OWN, encoding="utf-8")
    case_file = tmp_path / "case.toml"
    text = (
        '[catalogue]\nfiles = ["sub/mine.toml"]\n[rod]\npipe = "my shaft"\nlength = "200 mm"\ngrade = "annealed"\n'
        '[hole]\ndiameter = "4 mm"\nangle_from_vertical = "90 deg"\n'
    )
    case_file.write_text(text, encoding="utf-8")
    case = Case.read(case_file)
    assert case.rod is not None
    assert case.rod.stiffness == pytest.approx(20e9 * math.pi / 64.0 * (2e-3**4 - 1e-3**4), rel=1e-12)
    assert case.rod.weight_in_air == pytest.approx(5000.0 * math.pi / 4.0 * 3e-6 * 9.80665, rel=1e-12)
    assert case.yield_strength == pytest.approx(300e6)
    assert "data sheet 17" in str(case.facts)
    own = read_catalogue(["sub/mine.toml"], tmp_path)
    assert own.pipe("5 in 19.5 lb/ft drill pipe").source == "caliper"
    assert CATALOGUE.pipe("5 in 19.5 lb/ft drill pipe").outer_diameter == pytest.approx(5 * INCH)
