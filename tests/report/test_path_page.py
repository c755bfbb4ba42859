"""The rod off the wall in space, and the page with a slider through a load path."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from written import OF_SYSTEM, of_page, violations

import rodwell
from rodwell.analysis.off_wall.state import PARTIAL, SINUSOIDAL, ContactState, contact_state
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.space.in_hole import geometry_in_hole
from rodwell.answers.words.wording import forces_in
from rodwell.cli.path_text import print_path
from rodwell.plots.paths.animation import _of
from rodwell.plots.paths.axes import units_of
from rodwell.plots.paths.path import plot_path
from rodwell.quantities.units import SYSTEMS
from rodwell.report.pages.path import PAGE, frames, write_path_page
from rodwell.report.pages.viewer import view

PROBLEM = rodwell.Problem(15.0, twist=2.0)


@pytest.fixture(scope="module")
def path() -> LoadPath:
    """A twisted rod loaded to partial contact, and unloaded to where it is straight."""
    return rodwell.load_path(PROBLEM, until=-124.0, unload_to=-108.0, mirror=True, seeds=1)


@pytest.fixture(scope="module")
def touching(path: LoadPath) -> ContactState:
    return path.at(-118.0)[0].state


@pytest.fixture(scope="module")
def apart(path: LoadPath) -> ContactState:
    return path.at(-124.0)[0].state


def rate(values: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Derivative by central differences, without the places next to the ends."""
    return np.asarray(np.gradient(values, s, axis=0))[2:-2]


@settings(max_examples=6)
@given(st.sampled_from([1.0, 4.0, None]))
def test_frames_belong_to_the_curve(apart: ContactState, scale: float | None) -> None:
    g = geometry_in_hole(apart.fine, 2001, radial_scale=scale)
    along = rate(g.centreline, g.s)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    assert along == pytest.approx(g.t1[2:-2], abs=2e-6 * g.radial_scale)
    for a, b in ((g.d1, g.u1), (g.d0, g.v1)):
        assert np.cross(g.t1, a) == pytest.approx(b, abs=1e-12)
    turning = np.sum(rate(g.d1, g.s) * g.u1[2:-2], axis=1)
    assert turning == pytest.approx(0.0, abs=1e-5)  # the frame does not turn about the tangent
    twist = np.sum(rate(g.d0, g.s) * g.v1[2:-2], axis=1)
    assert twist == pytest.approx(-PROBLEM.twist / PROBLEM.torsional_stiffness, abs=1e-5)  # the material does: -T1/C


def test_curvatures_are_those_of_the_rod_not_of_the_picture(apart: ContactState) -> None:
    g = geometry_in_hole(apart.fine, 2001, radial_scale=None)
    true = geometry_in_hole(apart.fine, 2001)
    assert g.radial_scale > 1.0
    assert g.curvatures == pytest.approx(true.curvatures)
    size = np.linalg.norm(rate(true.t1, true.s), axis=1)
    for frame in (true.curvatures, true.material_curvatures):
        assert np.hypot(frame[2:-2, 1], frame[2:-2, 2]) == pytest.approx(size, abs=5e-6)
    assert true.material_curvatures[:, 0] == pytest.approx(-PROBLEM.twist / PROBLEM.torsional_stiffness)


def test_in_contact_it_is_the_rod_on_the_wall(path: LoadPath, touching: ContactState) -> None:
    """Two models of the same rod: where it lies, and how much it is curved."""
    branch = rodwell.follow(PROBLEM, mode=1, until=-118.0, mirror=True)
    (solution,) = branch.states_at(-118.0)
    assert touching.kind == SINUSOIDAL
    on, off = solution.geometry(401), path.at(-118.0)[0].geometry(401)
    assert off.centreline == pytest.approx(on.centreline, abs=1e-9)
    assert np.hypot(off.curvatures[:, 1], off.curvatures[:, 2]) == pytest.approx(
        np.hypot(on.curvatures[:, 1], on.curvatures[:, 2]), abs=1e-7
    )
    assert not off.lift_off
    assert not np.any(np.abs(off.fields["gap"]) > 1e-12)


def test_ends_of_contact_are_marked_and_read(apart: ContactState) -> None:
    assert apart.kind == PARTIAL
    seen = view(apart.fine)
    names = [part["name"] for part in seen.data["parts"] if part["name"].startswith("end of contact")]
    assert len(names) == len(apart.point_forces)
    assert "gap" in seen.data["along"]["says"][200]
    assert "Red rings: ends of contact" in seen.caption


def test_files_of_a_state_off_the_wall(path: LoadPath, apart: ContactState, tmp_path: Path) -> None:
    files = rodwell.export(path.at(-124.0)[0], [tmp_path / name for name in ("a.csv", "a.vtu", "a.glb", "a.html")])
    assert all(file.stat().st_size > 1000 for file in files)
    lines = (tmp_path / "a.csv").read_text().splitlines()
    heads = [line for line in lines if line.startswith("#")]
    assert any("d1 without turning about t1" in line for line in heads)
    assert any(re.search(r"error estimates, largest over s: x [0-9.e-]+ L", line) for line in heads)
    names = next(line for line in lines if not line.startswith("#")).split(",")
    assert "gap [clearance]" in names
    gaps = np.genfromtxt(tmp_path / "a.csv", delimiter=",", skip_header=len(heads) + 1)[
        :, names.index("gap [clearance]")
    ]
    assert float(gaps.max()) == pytest.approx(max(gap.largest.value for gap in apart.gaps), rel=1e-3)


def test_frames_go_through_the_path_in_order(path: LoadPath) -> None:
    shown = frames(path)
    loads = [frame.state.load for frame in shown]
    assert loads[0] == 0.0  # the unloaded straight rod
    assert min(loads) == pytest.approx(-124.0)
    assert loads[-1] == pytest.approx(-108.0)
    assert [frame.leg for frame in shown] == sorted((frame.leg for frame in shown), key=("loading", "unloading").index)
    assert [frame.run for frame in shown] == sorted(frame.run for frame in shown)


def test_the_page_holds_what_it_shows(path: LoadPath, tmp_path: Path) -> None:
    from rodwell.report.folders.path import write_path

    assert PAGE in write_path(path, tmp_path)
    page = (tmp_path / PAGE).read_text()
    assert not re.findall(r'(?:src|href)="(?!data:|#)', page)
    data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)[1])
    shown = frames(path)
    assert len(data["frames"]) == len(shown)
    for event, told in zip(path.events, data["events"], strict=True):
        assert told["text"] == event.meaning
        near = min(abs(frame.state.load - event.force.value) for frame in shown if frame.leg == event.leg)
        assert abs(shown[told["frame"]].state.load - event.force.value) == pytest.approx(near, abs=1e-6)
    says = [frame["says"] for frame in data["frames"]]
    assert says[0] == "loading, F = 0 B/L²: straight, stable"
    assert "partial contact, 1 gap up to" in next(each for each in says if "partial" in each)
    assert all("stable" in each for each in says)


def test_a_snap_leads_to_the_state_to_which_the_rod_has_snapped(tmp_path: Path) -> None:
    """At −147.158, two programs (tests/analysis/path/test_load_path.py): into the helix, with one turn."""
    path = rodwell.load_path(rodwell.Problem(15.0), until=-148.0, seeds=1)
    write_path_page(tmp_path / PAGE, path)
    page = (tmp_path / PAGE).read_text()
    data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)[1])
    assert [told["snap"] for told in data["events"]] == [event.kind == "snap" for event in path.events]
    (snap,) = (told for told in data["events"] if told["snap"])
    before, after = (data["frames"][snap["frame"] + i] for i in (-1, 0))
    assert after["run"] == before["run"] + 1
    assert "helix of 1 turn" in after["says"]
    assert "partial contact" in before["says"]


def test_why_a_path_ended_is_said_in_the_words_of_its_case(
    path: LoadPath, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """On the terminal and on the page alike: B/L² of this pipe is 1090.831 N, 120.5 of it are 131.445 kN."""
    rod = {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"}
    hole = {"diameter": "70 cm", "angle_from_vertical": "90 deg"}
    case = rodwell.Case.from_dict({"units": "si", "rod": rod, "hole": hole})
    early = replace(path, reached=False, ended_because="steps became too short at F = -120.5 B/L²")
    says = "steps became too short at 131.4 kN of compression"
    print_path(early, case)
    assert f"Not followed to the end: {says}." in " ".join(capsys.readouterr().out.split())
    write_path_page(tmp_path / PAGE, early, case)
    assert f"The path ends early: {says}." in " ".join((tmp_path / PAGE).read_text().split())
    print_path(early, None)
    assert "too short at F = −120.5 B/L²." in " ".join(capsys.readouterr().out.split())


def test_page_figure_and_animation_show_where_the_driven_end_stands(path: LoadPath, tmp_path: Path) -> None:
    """δ = u − cF, F tension positive, where something gives way in series, and the shortening u where nothing does."""
    for compliance, moved in ((0.0, "shortening of the rod's span"), (2e-5, "displacement of the driven end")):
        driven = replace(path, compliance=compliance)
        write_path_page(tmp_path / PAGE, driven)
        page = (tmp_path / PAGE).read_text()
        data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)[1])
        shown = frames(driven)
        ax = plot_path(driven)
        assert data["axes"]["across"] == ax.get_xlabel() == f"{moved}  [10⁻³ L]"
        lines = np.concatenate([line.get_xydata() for line in ax.lines])
        for frame, drawn in list(zip(shown, data["frames"], strict=True))[:: max(1, len(shown) // 6)]:
            u = contact_state(frame.state).shortening.value
            assert drawn["x"] == pytest.approx(1e3 * (u - compliance * frame.state.load), rel=1e-12, abs=1e-15)
            assert np.min(np.hypot(*(lines - (drawn["x"], drawn["y"])).T)) < 1e-9
            one = _of(frame, driven, units_of(driven, None), forces_in(driven, None))
            assert one.at == pytest.approx((drawn["x"], drawn["y"]), rel=1e-12)


@pytest.mark.parametrize("system", SYSTEMS)
def test_its_numbers_are_written_well_in_the_units_of_a_case(path: LoadPath, system: str, tmp_path: Path) -> None:
    rod = {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"}
    hole = {"diameter": "70 cm", "angle_from_vertical": "90 deg"}
    case = rodwell.Case.from_dict({"units": system, "rod": rod, "hole": hole})
    write_path_page(tmp_path / PAGE, path, case)
    texts = of_page(tmp_path / PAGE)
    assert any("loading" in text for text in texts)
    assert violations(texts) == []
    assert [text for text in texts if OF_SYSTEM[system].search(text)] == []
