"""Load paths where the clearance varies smoothly: Newton's matrix, the strong form, limits, virtual work, refusals."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from strong_form import integrated

import rodwell
from rodwell.analysis.off_wall.arrange import arranged, solved
from rodwell.analysis.off_wall.measured import measured, position
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.analysis.off_wall.varying.model import RodBesideVaryingWall
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.load_path import LoadPath
from rodwell.analysis.path.straightening import straight_state
from rodwell.analysis.straight.ramps import least_contact_on_ramps
from rodwell.cli.main import cli
from rodwell.numerics.stretches.assembly import Assembled, assemble, bubbles_of
from rodwell.numerics.stretches.bordered import Row, bordered, fixed_load, fixed_work
from rodwell.numerics.stretches.carry import rim_fields
from rodwell.numerics.stretches.chain import Shape
from rodwell.problem.sections import ramp

WIDENS = ((0.1,), *ramp(0.8, 1.0, 1.2), (0.1, 1, 1, 1.2))
ROD = rodwell.Problem(15.0, 90.0, sections=WIDENS)
STEEP = rodwell.Problem(60.0, 60.0, clearance=0.05, sections=((0.3,), *ramp(0.4, 1.0, 1.5), (0.3, 1, 1, 1.5)))
TAPERS = ramp(1.0, 1.0, 1.5, stiffness=(1.0, 0.6), weight=(1.0, 0.8))


@pytest.fixture(scope="module")
def path() -> LoadPath:
    return load_path(ROD, until=-123.0, unload_to=-90.0, seeds=1)


def _wavy(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    angle = np.stack([0.3 * np.sin(7 * s) + 0.2, 2.1 * np.cos(7 * s), -14.7 * np.sin(7 * s)])
    return rim_fields(angle), angle


def _settled(model: RodInHole, shape: Shape) -> Assembled:
    """A shape whose bubbles are in equilibrium."""
    for _ in range(8):
        step = bubbles_of(assemble(model, shape), 0 * shape.nodes, 0 * shape.breaks, 0.0, 1.0)
        shape = Shape(shape.chain, shape.nodes, shape.bubbles + step, shape.breaks, shape.load)
    return assemble(model, shape)


@pytest.mark.parametrize("row_of", [fixed_load, fixed_work])
@pytest.mark.parametrize("problem", [STEEP, STEEP.but(sections=TAPERS)], ids=["constants", "tapers"])
@pytest.mark.parametrize("touching", [(True, False, True), (True, False, False, True)])
def test_newtons_matrix_is_the_derivative_of_what_it_solves(touching: tuple, problem: rodwell.Problem, row_of) -> None:
    """Ends of contact, a point of contact, and what the load does its work on; off equilibrium."""
    model, breaks = RodBesideVaryingWall(problem), np.array([0.42, 0.55, 0.66][: len(touching) - 1])
    shape, _ = arranged(model, Pattern(touching), breaks, -80.0, _wavy)
    chain, rng = shape.chain, np.random.default_rng(1)
    out = _settled(model, shape)
    nodes = np.where(chain.unmoved, 0.0, rng.standard_normal(shape.nodes.shape))
    ends, load, e = 0.05 * rng.standard_normal(breaks.size), 10.0, 1e-4
    moved = [
        _settled(model, out.shape.moved(part * nodes, 0.0 * shape.bubbles, part * ends, part * load))
        for part in (-2.0 * e, -e, e, 2.0 * e)
    ]
    residual, moments, work = (
        np.tensordot([1.0, -8.0, 8.0, -1.0], [getattr(one, name) for one in moved], 1) / (12.0 * e)
        for name in ("residual", "moments", "energy_by_load")
    )
    row: Row = row_of(chain, 0.3)
    target = work if row.work else load
    found = bordered(out, row).increments(residual, moments, -target)
    for one, known in zip(found, (nodes, ends, load), strict=True):
        assert np.max(np.abs(one + known)) < 1e-6 * np.max(np.abs(known))
    if touching == (True, False, True):
        assert out.by_bend is not None
        assert np.max(np.abs(out.by_bend.nodes)) > 1e-3


def test_the_wall_presses_the_straight_rod_as_it_does_on_the_wall() -> None:
    """Both agree to the order of the slope squared."""
    thin = ROD.but(clearance=1e-3)
    least = least_contact_on_ramps(thin, -80.0)
    state = straight_state(RodBesideVaryingWall(thin), -80.0)
    s = np.array([least.s + 1e-9])
    assert -position(state, s)[2][0] == pytest.approx(least.value, rel=1e-6)


def test_the_straight_rod_loses_stability_at_the_critical_load() -> None:
    thin = ROD.but(clearance=1e-3)
    critical = rodwell.critical_loads(thin, 1)[0].force
    model = RodBesideVaryingWall(thin)
    assert [straight_state(model, critical * part).solved.index for part in (0.99999, 1.00001)] == [0, 1]


def test_a_constant_clearance_gives_the_same_state() -> None:
    """By the model with products of clearance and fields, and by that without."""
    plain = rodwell.Problem(15.0, 60.0)
    one = load_path(plain, until=-122.0, seeds=1).at(-121.0)[0].state.fine
    shape = one.solved.shape
    from rodwell.numerics.stretches.carry import sampler

    other = solved(
        RodBesideVaryingWall(plain), one.pattern, shape.breaks, one.load, sampler(shape), degree=shape.chain.degree,
        elements=one.elements,
    )  # fmt: skip
    assert other is not None
    assert len(one.pattern.touching) > 1
    for a, b in zip(measured(one), measured(other), strict=True):
        assert b == pytest.approx(a, rel=1e-9, abs=1e-11, nan_ok=True)


def test_the_loop_is_followed_and_balanced(path: LoadPath) -> None:
    """Lift-off, gaps that open on the way: every state passes, and it goes back to the straight rod."""
    kinds = [event.kind for event in path.events]
    assert kinds[:4] == ["critical", "lift_off", "gap_opens", "gap_opens"]
    assert kinds[-1] == "critical"
    assert path.reached
    assert not path.missed
    assert all(event.state.certificate.passed for event in path.events if event.state is not None)


def test_free_stretches_solve_the_equations_of_a_rod_in_space(path: LoadPath) -> None:
    state = path.at(-120.0)[0].state
    assert len(state.gaps) == 2
    for gap in state.gaps:
        end = integrated(state, gap.start.value, gap.end.value)
        x, y, _ = position(state.fine, np.array([gap.end.value]))
        assert end == pytest.approx(np.array([x[0, 0], y[0, 0]]) / ROD.clearance, abs=3e-8)
    for end in (gap.end.value for gap in state.gaps):
        x, y, _ = position(state.fine, np.array([end]))
        assert np.hypot(x[0, 0], y[0, 0]) / ROD.clearance == pytest.approx(ROD.rod.clearance(np.array([end]))[0])


def test_energy_changes_by_the_work_of_the_load(path: LoadPath) -> None:
    for force in (-112.0, -120.0):
        low, here, high = (path.at(force + d)[0].state for d in (-1e-3, 0.0, 1e-3))
        slope = (high.energy.value - low.energy.value) / 2e-3
        assert slope == pytest.approx(here.shortening.value, rel=1e-6)


def test_the_mirror_image_has_the_same_path() -> None:
    """Seen from the other end, and to the other side; but buckling, for which the push along the hole counts."""
    turned = tuple((one[0], *(r[::-1] if isinstance(r, tuple) else r for r in one[1:])) for one in ROD.sections[::-1])
    loads = [
        [event.force.value for event in load_path(problem, until=-117.0, mirror=mirror, seeds=1).events]
        for problem, mirror in ((ROD, False), (ROD.but(sections=turned), True))
    ]
    assert len(loads[0]) == 2
    assert loads[0][1] == pytest.approx(loads[1][1], rel=1e-8)
    assert loads[0][0] == pytest.approx(loads[1][0], rel=1e-3)


def test_what_is_left_out_is_told(path: LoadPath) -> None:
    """The wall's push along the hole: of the rod that lies still ∫ p Δ′ ds, with p = w − (BΔ″)″ + F Δ″ that weighs it.

    The energy by it and a displacement along the hole of no more than the whole shortening, lying included.
    """
    s = np.linspace(0.1, 0.9, 2001)
    first, second = ROD.rod.clearance.derivative, ROD.rod.clearance.derivative.derivative
    pushed = 15.0 * 0.01 * 0.2  # ∫ w Δ′; the other terms weigh Δ′Δ‴ and Δ′Δ″, even about the middle, at the ends 0
    state = path.at(-105.0)[0].state
    assert state.left_out["axial_force"] == pytest.approx(pushed, rel=1e-3)
    assert "the wall's push along the hole is left out" in path.assumptions
    assert np.trapezoid(first(s) * second(s), s) == pytest.approx(0.0, abs=1e-6)
    still = 0.5 * 1e-4 * np.trapezoid(first(s) ** 2, s)
    assert 0.0 < state.left_out["energy"] < pushed * still
    assert state.as_dict()["left_out"] == state.left_out


REFUSED = [
    ({"twist": 1.0}, "twist = 1.0: must be 0 where the clearance varies"),
    ({"alpha": 0.0}, "must give the rod lateral weight where the clearance varies"),
    ({"ends": ("clamped", "ball")}, "ball: where the clearance varies, it leaves the wall as soon as it buckles"),
    ({"sections": ((0.1, 2), *WIDENS[1:])}, "'a step or a kink at s/L = 0.1': must go over without steps and kinks"),
    ({"sections": ((0.3,), *ramp(0.4, 1.0, 1.2), (0.3, 1, 1, 1.2))}, "must press the rod to the wall everywhere befo"),
]


@pytest.mark.parametrize(
    ("changes", "message"), REFUSED, ids=[next(iter(one[0])) + str(i) for i, one in enumerate(REFUSED)]
)
def test_what_has_no_path_is_refused(changes: dict, message: str) -> None:
    with pytest.raises(rodwell.InputError) as raised:
        load_path(ROD.but(**changes), until=-120.0)
    assert message in str(raised.value)


def test_a_gap_opens_where_the_contact_force_jumps() -> None:
    """At an end of a quarter of the ramp: nearly all of it on the side where contact ceases to push."""
    length, first = 0.586, 0.338
    problem = rodwell.Problem(
        30.0, 60.0, ends=("clamped", "guided"),
        sections=((first,), *ramp(length, 1.0, 0.836), (1 - first - length, 1, 1, 0.836)),
    )  # fmt: skip
    found = load_path(problem, until=-145.0, seeds=1)
    assert found.reached
    opens = next(event for event in found.events if event.kind == "lift_off")
    step = first + 0.75 * length
    assert opens.s[0] == pytest.approx(step, abs=1e-9)
    gap = found.at(-144.0)[0].state.gaps[0]
    assert 0.0 < step - gap.start.value < 0.3 * (gap.end.value - step)


def test_the_command_line_follows_it(tmp_path: Path) -> None:
    written = "0.1:1:1:1,0.8:1:1:1~1.2,0.1:1:1:1.2"
    given = ["path", "--weight", "15", "--alpha", "90", "--sections", written, "--json", "--out", str(tmp_path / "out")]
    shown = CliRunner().invoke(cli, [*given, "--until", "-117", "--at", "-112"])
    assert shown.exit_code == 0, shown.output
    data = json.loads(shown.stdout)
    assert [event["kind"] for event in data["events"]] == ["critical", "lift_off"]
    state = data["states"][0]
    assert state["certificate"]["passed"]
    assert state["left_out"]["axial_force"] > 0.0
    assert (tmp_path / "out" / "load-path.png").exists()
