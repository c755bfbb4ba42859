"""Exported files, read back with the libraries that other programs use: same numbers, whole files or none."""

from __future__ import annotations

import csv
import json
import os
import struct
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
import trimesh
from click.testing import CliRunner
from pypdf import PdfReader

import rodwell
from rodwell.analysis.space.scene import linear_colours, palette, pressure_colours, rgb, scene
from rodwell.analysis.space.surfaces import tube
from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.report.folders.export import FORMATS

EXAMPLE = Path(__file__).parents[2] / "examples" / "drill-string.toml"


@pytest.fixture(scope="module")
def case() -> rodwell.Case:
    return rodwell.Case.read(EXAMPLE)


@pytest.fixture(scope="module")
def physical(case: rodwell.Case) -> rodwell.Solution:
    return rodwell.follow(case.problem).lift_off.solution


@pytest.fixture(scope="module")
def twisted() -> rodwell.Solution:
    return rodwell.equilibrium(rodwell.Problem(15, alpha=60, turns=1, twist=2.0), -140.0)


def gltf(path: Path) -> dict[str, Any]:
    """The JSON chunk of a binary glTF file."""
    data = path.read_bytes()
    magic, version, total = struct.unpack("<4sII", data[:12])
    assert (magic, version, total) == (b"glTF", 2, len(data))
    size, kind = struct.unpack("<I4s", data[12:20])
    assert kind == b"JSON"
    return json.loads(data[20 : 20 + size])


def test_stl_is_watertight_and_in_metres(physical: rodwell.Solution, case: rodwell.Case, tmp_path: Path) -> None:
    file = tmp_path / "rod.stl"
    assert rodwell.export(physical, file, scales=case.scales, sides=48) == [file]
    mesh = trimesh.load_mesh(file)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    section = 24.0 * np.sin(2.0 * np.pi / 48.0) * 0.05**2
    assert mesh.volume == pytest.approx(section * 30.0, rel=1e-4)  # Pappus: 30 m of a rod 10 cm thick
    assert mesh.volume == pytest.approx(np.pi * 0.05**2 * 30.0, rel=0.004)
    shortening = 30.0 * (1.0 - physical.fields(2)["z"][1])
    assert mesh.extents[2] == pytest.approx(30.0 - shortening, abs=1e-4)
    assert mesh.bounds[0, 0] == pytest.approx(-0.35, abs=1e-4)  # the lowest line of a hole 70 cm wide


def test_vtu_holds_every_field(twisted: rodwell.Solution, tmp_path: Path) -> None:
    files = rodwell.export(twisted, tmp_path / "coil.vtu", places=101, sides=12, rod_radius=0.001)
    assert [file.name for file in files] == ["coil.vtu", "coil-centreline.vtu", "coil-cylinder.vtu"]
    surface, line, wall = (meshio.read(file) for file in files)
    fields = twisted.fields(101)
    for name, unit in (("contact_pressure", "B/L^3"), ("T2", "B/L"), ("rod_F1", "B/L^2"), ("eta", "rad")):
        column = f"{name} [{unit}]"
        assert np.array_equal(line.point_data[column], fields[name])
        assert np.array_equal(surface.point_data[column][: 12 * 101].reshape(101, 12), np.tile(fields[name], (12, 1)).T)
    assert line.point_data["twist [1/L]"] == pytest.approx(-2.0 * 1.3)
    assert np.array_equal(line.point_data["wall_pushes"], -np.sign(fields["contact_pressure"]))
    frame = np.stack([line.point_data[name] for name in ("t1", "d0", "v1")], axis=-1)
    assert np.linalg.det(frame) == pytest.approx(1.0)
    assert line.points[:, 2] == pytest.approx(fields["z"])
    assert line.points[:, 0] == pytest.approx(-0.01 * np.cos(fields["xi2"]))
    assert line.points[:, 1] == pytest.approx(0.01 * np.sin(fields["xi2"]))
    body = tube(twisted.geometry(101, rod_radius=0.001), 12)
    assert np.array_equal(surface.points, body.vertices)
    assert np.array_equal(surface.cells_dict["triangle"], body.triangles)
    assert np.hypot(*wall.points[:, :2].T) == pytest.approx(0.011)


def test_vtu_in_si(physical: rodwell.Solution, case: rodwell.Case, tmp_path: Path) -> None:
    _, line, wall = rodwell.export(physical, tmp_path / "rod.vtu", scales=case.scales, places=51)
    data = meshio.read(line).point_data
    pressure = physical.fields(51)["contact_pressure"] * case.scales.stiffness / case.scales.length**3
    assert data["contact_pressure [N/m]"] == pytest.approx(pressure)
    assert data["s [m]"] == pytest.approx(np.linspace(0.0, 30.0, 51))
    assert np.hypot(*meshio.read(wall).points[:, :2].T) == pytest.approx(0.35)


def test_csv_is_the_centreline_with_frames(twisted: rodwell.Solution, tmp_path: Path) -> None:
    (file,) = rodwell.export(twisted, tmp_path / "rod.csv", places=201)
    lines = file.read_text(encoding="utf-8").splitlines()
    comments = [line for line in lines if line.startswith("#")]
    assert "tension positive" in comments[0]
    assert any("true scale" in line for line in comments)
    assert f"contact_pressure {twisted.field_errors(201)['contact_pressure']:.1e} B/L^3" in comments[-1]
    header, *rows = csv.reader(lines[len(comments) :])
    table = dict(zip(header, np.array(rows, dtype=float).T, strict=True))
    rod = twisted.geometry(201)
    assert np.array_equal(table["s [L]"], rod.s)
    for i, axis in enumerate("xyz"):
        assert np.array_equal(table[f"{axis} [L]"], rod.centreline[:, i])
        for name in ("t1", "d1", "u1", "d0", "v1"):
            assert np.array_equal(table[f"{name}_{axis}"], getattr(rod, name)[:, i])
    for name in ("xi1", "xi2", "eta"):
        assert np.array_equal(table[f"{name} [rad]"], rod.fields[name])
    for i in range(3):
        assert np.array_equal(table[f"omega{i + 1} [1/L]"], rod.curvatures[:, i])
        assert np.array_equal(table[f"material_omega{i + 1} [1/L]"], rod.material_curvatures[:, i])
    assert np.array_equal(table["contact_pressure [B/L^3]"], rod.fields["contact_pressure"])


def test_glb_is_the_scene(physical: rodwell.Solution, case: rodwell.Case, tmp_path: Path) -> None:
    (file,) = rodwell.export(physical, tmp_path / "rod.glb", scales=case.scales, places=101, sides=12)
    read = trimesh.load_scene(file)
    rod = physical.geometry(101, rod_radius=0.05 / 30.0, radial_scale=None)
    parts = {part.name: part for part in scene(rod, 12)}
    assert set(read.geometry) == set(parts)
    assert {"rod", "cylinder", "material line 1", "lift-off at s = 0.5"} <= set(parts)
    for name, part in parts.items():  # y up: k, i, j are x, y, z
        assert read.geometry[name].vertices == pytest.approx(30.0 * part.mesh.vertices[:, [2, 0, 1]], abs=2e-5)
        assert np.array_equal(read.geometry[name].faces, part.mesh.triangles)
    data = gltf(file)
    materials = {m["name"]: m for m in data["materials"]}
    assert materials["cylinder"]["alphaMode"] == "BLEND"
    assert materials["cylinder"]["doubleSided"]
    assert materials["cylinder"]["pbrMetallicRoughness"]["baseColorFactor"][3] == pytest.approx(0.22, abs=0.01)
    assert materials["rod"]["pbrMetallicRoughness"]["metallicFactor"] == 0.0
    drawn = next(mesh["primitives"][0] for mesh in data["meshes"] if mesh["name"] == "rod")
    assert {"POSITION", "NORMAL", "COLOR_0"} <= set(drawn["attributes"])
    colours = np.asarray(read.geometry["rod"].visual.vertex_attributes["color"])[:, :3]
    assert colours == pytest.approx(255.0 * linear_colours(parts["rod"].colour), abs=0.51)
    assert "times enlarged" in json.dumps(data)


def test_colours_of_the_contact_pressure() -> None:
    ends = palette(np.array([-1.0, 0.0, 1.0]))
    pressed = pressure_colours(np.array([-4.0, -2.0, 0.0, 1e-9]))
    assert pressed[[0, 2, 3]] == pytest.approx(ends[[0, 1, 1]], abs=1e-8)  # a pull of nothing is no pull
    assert pressed[1] == pytest.approx(rgb("#2f7fbf"))
    assert pressure_colours(np.array([-4.0, 2.0, 1.0]))[1] == pytest.approx(ends[2])
    assert pressure_colours(np.zeros(3)) == pytest.approx(np.tile(ends[1], (3, 1)))
    assert linear_colours(np.array([0.0, 0.5, 1.0])) == pytest.approx([0.0, 0.21404114, 1.0])  # IEC 61966-2-1


def test_true_scale_for_programs_and_a_readable_one_for_the_eye(twisted: rodwell.Solution, tmp_path: Path) -> None:
    files = [tmp_path / f"rod{suffix}" for suffix in (".glb", ".stl", ".csv")]
    rodwell.export(twisted, files, places=51)
    assert np.ptp(trimesh.load_scene(files[0]).bounds[:, 1]) > 0.05
    assert np.ptp(trimesh.load_mesh(files[1]).bounds[:, 0]) == pytest.approx(2.0 * 0.012, rel=0.02)
    rodwell.export(twisted, files, places=51, radial_scale=3.0)
    assert trimesh.load_mesh(files[1]).bounds[1, 0] == pytest.approx(3.0 * 0.012, rel=0.01)
    assert "3 times enlarged" in files[2].read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"path": "rod.obj"}, "path"),
        ({"path": "rod"}, "path"),
        ({"path": ["a.csv", "a.csv"]}, "path"),
        ({"rod_radius": "5 cm"}, "rod_radius"),
        ({"rod_radius": -1.0}, "rod_radius"),
        ({"radial_scale": 0.0}, "radial_scale"),
        ({"places": 0}, "places"),
        ({"sides": 2}, "sides"),
    ],
)
def test_bad_input_writes_nothing(
    twisted: rodwell.Solution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, given: dict[str, Any], field: str
) -> None:
    monkeypatch.chdir(tmp_path)
    path = given.pop("path", ["new/rod.csv", "rod.stl"])
    with pytest.raises(InputError) as found:
        rodwell.export(twisted, path, **given)
    assert found.value.field == field
    if field == "path" and "twice" not in str(found.value):
        assert all(suffix in str(found.value) for suffix in FORMATS)
    assert list(tmp_path.iterdir()) == []


def test_no_file_is_half_written(twisted: rodwell.Solution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "rod.csv").write_text("old", encoding="utf-8")

    def full(path: Path, *_: object) -> None:
        path.write_bytes(b"half")
        raise OSError(28, os.strerror(28))

    monkeypatch.setitem(__import__("rodwell.store.shapes", fromlist=["x"]).WRITERS, ".stl", full)
    with pytest.raises(InputError, match="cannot be written"):
        rodwell.export(twisted, [tmp_path / "rod.csv", tmp_path / "rod.stl"])
    assert [file.name for file in tmp_path.iterdir()] == ["rod.csv"]
    assert (tmp_path / "rod.csv").read_text(encoding="utf-8") == "old"
    (tmp_path / "folder.csv").mkdir()
    with pytest.raises(InputError, match="stands in the way"):
        rodwell.export(twisted, tmp_path / "folder.csv")


def run(*arguments: object) -> Any:
    return CliRunner().invoke(cli, ["export", *map(str, arguments)])


def test_command_writes_every_format(tmp_path: Path) -> None:
    files = [tmp_path / f"rod{suffix}" for suffix in FORMATS]
    done = run(EXAMPLE, *(x for file in files for x in ("--to", file)), "--places", 101)
    assert done.exit_code == 0, done.exception
    assert "−139.582 kN" in done.output
    assert all(file.stat().st_size > 1000 for file in files)
    assert len(list(tmp_path.iterdir())) == len(FORMATS) + 2


def test_command_at_an_end_force(tmp_path: Path) -> None:
    done = run(EXAMPLE, "--at", "-130 kN", "--rod-radius", "2 cm", "--to", tmp_path / "rod.stl", "--places", 101)
    assert done.exit_code == 0, done.exception
    mesh = trimesh.load_mesh(tmp_path / "rod.stl")
    assert mesh.volume == pytest.approx(np.pi * 0.02**2 * 30.0, rel=0.02)
    assert mesh.bounds[0, 0] == pytest.approx(-0.32, abs=1e-4)
    case = tmp_path / "case.toml"
    case.write_text("[dimensionless]\nweight = 15\n", encoding="utf-8")
    done = run(case, "--at", "-120", "--mode", 1, "--to", tmp_path / "plain.csv")
    assert done.exit_code == 0, done.exception
    assert "F = -120 B/L^2" in (tmp_path / "plain.csv").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("options", "field", "phrase"),
    [
        (["--to", "rod.obj"], "--to", ".glb"),
        (["--to", "rod.csv", "--at", "-130"], "--at", "unit"),
        (["--to", "rod.csv", "--at", "lift off"], "--at", "lift-off"),
        (["--to", "rod.csv", "--at", "-110 kN"], "--at", "critical load"),
        (["--to", "rod.csv", "--rod-radius", "2 kN"], "--rod-radius", "length"),
        (["--to", "rod.csv", "--rod-radius", "-2 cm"], "--rod-radius", "above 0"),
        (["--to", "rod.csv", "--radial-scale", "0.1"], "--radial-scale", "true scale"),
        (["--to", "rod.csv", "--mode", "0"], "--mode", "whole number"),
    ],
)
def test_command_on_bad_input(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, options: list[str], field: str, phrase: str
) -> None:
    monkeypatch.chdir(tmp_path)
    done = run(EXAMPLE, *options)
    assert isinstance(done.exception, InputError), done.output
    assert done.exception.field == field
    assert phrase in str(done.exception)
    assert list(tmp_path.iterdir()) == []


def test_command_where_no_state_is_at_lift_off(tmp_path: Path) -> None:
    case = tmp_path / "case.toml"
    case.write_text("[dimensionless]\nweight = 15\nalpha = 0\n", encoding="utf-8")
    done = run(case, "--to", tmp_path / "rod.csv")
    assert isinstance(done.exception, rodwell.NotConvergedError)
    assert "--at" in str(done.exception)


def test_pictures_for_print(physical: rodwell.Solution, case: rodwell.Case, tmp_path: Path) -> None:
    svg, pdf = rodwell.export(physical, [tmp_path / "rod.svg", tmp_path / "rod.pdf"], scales=case.scales)
    root = ElementTree.parse(svg).getroot()
    assert root.tag.endswith("svg")
    assert len(root.findall(".//{http://www.w3.org/2000/svg}image")) >= 1  # the rod as dots
    assert len(root.findall(".//{http://www.w3.org/2000/svg}path")) < 500  # not each of its facets
    (sheet,) = PdfReader(pdf).pages
    assert "of compression" in sheet.extract_text()
    assert {svg.stat().st_size < 1_000_000, pdf.stat().st_size < 1_000_000} == {True}
