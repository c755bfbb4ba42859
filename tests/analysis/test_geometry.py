"""The rod in space: frames against derivatives, twist of material lines, meshes against areas and volumes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rodwell
from rodwell.analysis.space.geometry import Geometry
from rodwell.analysis.space.surfaces import Mesh, cylinder, material_lines, ring, straight_contact, tube
from rodwell.errors import InputError
from rodwell.physics.on_wall.frames import frames

STATES = {
    "lift-off": lambda: rodwell.follow(rodwell.Problem(15)).lift_off.solution,
    "twisted, inclined": lambda: rodwell.follow(rodwell.Problem(15, alpha=60, twist=-4.0)).lift_off.solution,
    "coil": lambda: rodwell.equilibrium(rodwell.Problem(15, clearance=0.05, turns=1, twist=2.0), -140.0),
    "outside, on top": lambda: rodwell.follow(rodwell.Problem(15, on_top=True, outside=True), until=-80.0)[-1],
    "pinned, guided": lambda: rodwell.follow(rodwell.Problem(15, ends="pinned-guided"), until=-95.0)[-1],
    "free": lambda: rodwell.follow(rodwell.Problem(15, alpha=45, ends="clamped-free"), until=-40.0)[-1],
}


@pytest.fixture(scope="module", params=STATES)
def state(request: pytest.FixtureRequest) -> rodwell.Solution:
    return STATES[request.param]()


@pytest.fixture(params=[1.0, None], ids=["true scale", "enlarged"])
def rod(state: rodwell.Solution, request: pytest.FixtureRequest) -> Geometry:
    return state.geometry(1601, radial_scale=request.param)


def rate(values: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Derivative by central differences of fourth order, ends left out."""
    h = s[1] - s[0]
    return (values[:-4] - 8.0 * values[1:-3] + 8.0 * values[3:-1] - values[4:]) / (12.0 * h)


def volume(mesh: Mesh) -> float:
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    return float(np.sum(a * np.cross(b, c)) / 6.0)


def area(mesh: Mesh) -> float:
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    return float(np.sum(np.linalg.norm(np.cross(b - a, c - a), axis=1)) / 2.0)


def open_edges(mesh: Mesh) -> int:
    """Edges that do not have exactly one triangle on either side, with opposite sense."""
    edges = np.concatenate([mesh.triangles[:, [0, 1]], mesh.triangles[:, [1, 2]], mesh.triangles[:, [2, 0]]])
    there, back = (np.sort(edges[:, [i, 1 - i]] @ [len(mesh.vertices), 1]) for i in (0, 1))
    assert np.all(np.diff(there) > 0)
    return int(np.sum(there != back))


@given(*[st.lists(st.floats(-30.0, 30.0), min_size=3, max_size=3) for _ in range(3)])
def test_frames_are_those_of_equation_1(xi2: list[float], eta: list[float], xi1: list[float]) -> None:
    """R₁₂ = R₁₁ R₂(η), R₂₂ = R₁₂ R₁(ξ₂) with {t₂, d₂, v₂} = {k, i, j}, and R₁₁ = R₀₁ R₁(ξ₁)."""

    def about_first(x: float) -> np.ndarray:
        return np.array([[1, 0, 0], [0, np.cos(x), -np.sin(x)], [0, np.sin(x), np.cos(x)]])

    def about_second(x: float) -> np.ndarray:
        return np.array([[np.cos(x), 0, np.sin(x)], [0, 1, 0], [-np.sin(x), 0, np.cos(x)]])

    axes = frames(np.array(xi1), np.array(eta), np.array(xi2))
    t1, d1, u1 = np.moveaxis(axes["R11"], 2, 0)
    _, d0, v1 = np.moveaxis(axes["R01"], 2, 0)
    fixed = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).T  # columns k, i, j
    for n in range(3):
        r11 = fixed @ about_first(xi2[n]).T @ about_second(eta[n]).T
        assert np.stack([t1[n], d1[n], u1[n]], axis=1) == pytest.approx(r11, abs=1e-13)
        r01 = np.stack([t1[n], d0[n], v1[n]], axis=1)
        assert r01 @ about_first(xi1[n]) == pytest.approx(r11, abs=1e-13)


def test_frames_are_orthonormal_and_follow_the_centreline(rod: Geometry) -> None:
    for second, third in ((rod.d1, rod.u1), (rod.d0, rod.v1)):
        frame = np.stack([rod.t1, second, third], axis=-1)
        assert np.abs(np.swapaxes(frame, 1, 2) @ frame - np.eye(3)).max() < 1e-13
        assert np.linalg.det(frame) == pytest.approx(1.0)
    tangent = rate(rod.centreline, rod.s)
    length = np.linalg.norm(tangent, axis=1)
    assert np.abs(tangent / length[:, None] - rod.t1[2:-2]).max() < 1e-7
    if rod.radial_scale == 1.0:
        assert np.abs(length - 1.0).max() < 1e-8  # inextensible
    assert np.hypot(*rod.centreline[:, :2].T) == pytest.approx(rod.radial_scale * rod.clearance)


def test_curvatures_are_those_of_the_frames(state: rodwell.Solution) -> None:
    rod = state.geometry(1601)
    for frame, curvatures in (
        ((rod.t1, rod.d1, rod.u1), rod.curvatures),
        ((rod.t1, rod.d0, rod.v1), rod.material_curvatures),
    ):
        first, second, third = frame
        found = [
            np.sum(rate(second, rod.s) * third[2:-2], axis=1),
            np.sum(rate(third, rod.s) * first[2:-2], axis=1),
            np.sum(rate(first, rod.s) * second[2:-2], axis=1),
        ]
        scale = np.abs(curvatures).max()
        assert np.abs(np.stack(found, axis=-1) - curvatures[2:-2]).max() < 1e-6 * scale


def test_twist_of_the_material_lines_on_the_tube(state: rodwell.Solution, rod: Geometry) -> None:
    """Rate of turning of a column of vertices about the drawn centreline: −T₁/C, none without end twist."""
    mesh = tube(rod, 16)
    column = mesh.vertices[: 16 * rod.s.size].reshape(-1, 16, 3)[:, 5]
    director = (column - rod.centreline) / rod.drawn_radius
    assert np.linalg.norm(director, axis=1) == pytest.approx(1.0)
    found = np.sum(rate(director, rod.s) * np.cross(rod.t1, director)[2:-2], axis=1)
    problem = state.problem
    assert found == pytest.approx(-problem.twist * (1.0 + problem.poisson), abs=2e-5)
    assert set(mesh.angle) == {*(2.0 * np.pi * k / 16 for k in range(16))}


def test_tube_is_closed_and_has_the_volume_of_pappus(rod: Geometry) -> None:
    """Volume of a tube: cross-section times length, whatever the curvature; the cross-section has 48 sides here."""
    mesh = tube(rod, 48)
    assert open_edges(mesh) == 0
    length = np.sum(np.linalg.norm(np.diff(rod.centreline, axis=0), axis=1))
    section = 24.0 * np.sin(2.0 * np.pi / 48.0) * rod.drawn_radius**2
    assert volume(mesh) == pytest.approx(section * length, rel=2e-4)
    if rod.radial_scale == 1.0:
        assert section * length == pytest.approx(np.pi * rod.rod_radius**2, rel=0.004)


def test_rod_touches_the_wall_and_does_not_pass_it(rod: Geometry) -> None:
    mesh = tube(rod, 48)
    distance = np.hypot(*mesh.vertices[:-2, :2].T)
    across = 1.0 - np.cos(np.pi / 48.0)  # a flat side stays that far off, in parts of the radius
    nearest = distance.min() if rod.outside else distance.max()
    assert nearest == pytest.approx(rod.wall_radius, abs=across * rod.drawn_radius + 1e-4 * rod.wall_radius)
    wall = cylinder(rod)
    assert np.hypot(*wall.vertices[:, :2].T) == pytest.approx(rod.wall_radius)
    straight = straight_contact(rod)
    assert straight[:, 0] == pytest.approx(rod.wall_radius * (1.0 if rod.outside else -1.0))


def test_lines_and_rings(rod: Geometry) -> None:
    lines = material_lines(rod, 3, width=0.1)
    assert len(lines) == 3
    length = np.sum(np.linalg.norm(np.diff(rod.centreline, axis=0), axis=1))
    for line in lines:
        assert area(line) == pytest.approx(0.2 * 1.05 * rod.drawn_radius * length, rel=0.05)
    mark = ring(rod, 0.25)
    assert open_edges(mark) == 0
    whole = 2.0 * np.pi**2 * 1.35 * 0.22**2 * rod.drawn_radius**3
    assert 0.5 * whole < volume(mark) < 1.08 * whole  # what would pierce the wall is flattened
    away = np.hypot(mark.vertices[:, 0], mark.vertices[:, 1]) / rod.wall_radius
    assert away.min() >= 1.0 - 1e-12 if rod.outside else away.max() <= 1.0 + 1e-12
    free = replace(rod, clearance=rod.rod_radius if rod.outside else 10.0 * rod.clearance)  # far from the wall
    untouched = ring(free, 0.25)
    place = int(np.argmin(np.abs(rod.s - 0.25)))
    assert volume(untouched) == pytest.approx(whole, rel=0.08)
    assert untouched.vertices.mean(axis=0) == pytest.approx(rod.centreline[place], abs=1e-9)


def test_places_of_lift_off() -> None:
    branch = rodwell.follow(rodwell.Problem(15), until=-200.0)
    assert branch.lift_off.solution.geometry().lift_off == pytest.approx([0.5], abs=1e-6)
    assert branch.at(-118.0).geometry().lift_off == ()
    beyond = branch[-1].geometry()
    assert len(beyond.lift_off) == 2
    assert np.interp(beyond.lift_off[0], beyond.s, beyond.pull) > 0.0
    outside = rodwell.follow(rodwell.Problem(15, on_top=True, outside=True), 2).lift_off
    rod = outside.solution.geometry()
    assert rod.lift_off == pytest.approx(outside.s)
    assert rod.pull.max() < 1e-6 * -rod.pull.min()


def test_straight_rod_and_default_scale() -> None:
    straight = rodwell.follow(rodwell.Problem(15))[0]
    rod = straight.geometry(11, radial_scale=None)
    assert rod.lift_off == ()
    assert rod.rod_radius == pytest.approx(0.2 * 0.01)
    assert rod.radial_scale == pytest.approx(1.0 / (5.0 * 2.0 * 0.012), rel=0.02)
    assert straight.geometry().s.size >= 401
    loose = rodwell.follow(rodwell.Problem(0), until=-60.0)  # nothing presses it, so nothing lifts off
    assert loose[0].geometry().lift_off == ()
    assert len(loose[-1].geometry().lift_off) == 2
    wide = rodwell.follow(rodwell.Problem(15, clearance=0.5))[0]
    assert wide.geometry(radial_scale=None).radial_scale == 1.0


def test_a_readable_picture_is_not_too_steep() -> None:
    rod = rodwell.follow(rodwell.Problem(5000, clearance=1e-3), rtol=1e-6).lift_off.solution.geometry(radial_scale=None)
    assert np.abs(rod.t1[:, 2]).min() == pytest.approx(1.0 / np.sqrt(5.0), rel=0.02)  # slope 2
    assert rod.radial_scale < 1.0 / (5.0 * 2.0 * 0.0012)


@pytest.mark.parametrize(
    ("problem", "given", "field"),
    [
        ({}, {"rod_radius": 0.0}, "rod_radius"),
        ({}, {"rod_radius": -0.01}, "rod_radius"),
        ({}, {"rod_radius": float("nan")}, "rod_radius"),
        ({}, {"rod_radius": "thick"}, "rod_radius"),
        ({}, {"rod_radius": 1.0}, "rod_radius"),
        ({"outside": True, "on_top": True}, {"rod_radius": 0.01}, "rod_radius"),
        ({}, {"radial_scale": 0.5}, "radial_scale"),
        ({}, {"radial_scale": float("inf")}, "radial_scale"),
        ({}, {"places": 1}, "places"),
        ({}, {"places": 2.5}, "places"),
    ],
)
def test_bad_input(problem: dict[str, bool], given: dict[str, object], field: str) -> None:
    state = rodwell.follow(rodwell.Problem(15, **problem))[0]
    with pytest.raises(InputError) as found:
        state.geometry(**given)
    assert found.value.field == field


def test_radius_that_bends_would_close_on_themselves() -> None:
    state = rodwell.follow(rodwell.Problem(15, clearance=0.1), until=-300.0)[-1]
    sharpest = np.linalg.norm(state.geometry(2001).curvatures[:, 1:], axis=1).max()
    assert state.geometry(rod_radius=0.9 / sharpest).rod_radius == 0.9 / sharpest
    with pytest.raises(InputError, match="radius of curvature"):
        state.geometry(rod_radius=1.1 / sharpest)
    with pytest.raises(InputError, match="sides"):
        tube(state.geometry(11), 2)
