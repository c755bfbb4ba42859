"""The endless string of equal joints: closed-form transfer matrices, finite strings, the limit of light joints."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.optimize import brentq

from rodwell import InputError, NotConvergedError, Problem, jointed_string
from rodwell.cli.main import cli

Array = np.ndarray
JOINT = (0.5 / 18.0, 4.0, 2.5, 0.54)
SECTIONS = (JOINT, (17.0 / 18.0, 1.0, 1.0, 1.0), JOINT)
PERIOD = Problem(33.0 / 216.0, clearance=4.92e-3, sections=SECTIONS)
"""A sixth of the string on tool joints in ``test_bridged_strings``, whose six joints buckle at 1 to 1.2 times 36π²."""

CASE = """
[rod]
ends = "clamped-clamped"
[[string]]
pipe = "5 in 19.5 lb/ft drill pipe"
joints = 1
joint_length = "9 m"
tool_joint_diameter = "6.625 in"
tool_joint_length = "0.5 m"
tool_joint_bore = "3.25 in"
[hole]
diameter = "8.5 in"
angle_from_vertical = "90 deg"
"""


def piece(length: float, stiffness: float, compression: float) -> Array:
    """Takes (v, v′, M, Q) along a beam column: v = v₀ + M(1 − cos kx)/P + Qx/P + (Pv₀′ − Q) sin kx/(kP), k² = P/B."""
    p, k = compression, math.sqrt(compression / stiffness)
    s, c = math.sin(k * length), math.cos(k * length)
    return np.array([
        [1.0, s / k, (1.0 - c) / p, (length - s / k) / p],
        [0.0, c, k * s / p, (1.0 - c) / p],
        [0.0, -p * s / k, c, s / k],
        [0.0, 0.0, 0.0, 1.0],
    ])  # fmt: skip


def period(problem: Problem, compression: float) -> Array:
    """From mid-joint to mid-joint; half of the weight of a period on each edge."""
    rod = problem.sections
    weight = problem.weight * sum(length * q for length, _, q, *_ in rod)
    spring = np.eye(4)
    spring[3, 0] = -0.5 * weight / (problem.clearance * rod[0][3])
    half, body = (piece(length, b, compression) for length, b, *_ in rod[:2])
    return np.asarray(half @ spring @ body @ spring @ half)


def clamped(count: int, compression: float, of: Problem = PERIOD) -> float:
    """Zero where a string of so many joints between clamped ends buckles sideways."""
    whole = np.linalg.matrix_power(period(of, compression), count)
    return float(whole[0, 2] * whole[1, 3] - whole[0, 3] * whole[1, 2])


def test_a_wave_of_constant_amplitude_exists_beyond_the_load_and_not_before() -> None:
    """Eigenvalues of the transfer matrix of a period: on the unit circle beyond, off it below."""
    found = jointed_string(PERIOD)
    p = -found.load.value

    def nearest(compression: float) -> tuple[float, float]:
        factors = np.linalg.eigvals(period(PERIOD, compression))
        best = factors[np.argmin(np.abs(np.abs(factors) - 1.0))]
        return abs(abs(best) - 1.0), abs(float(np.angle(best)))

    assert min(nearest(x)[0] for x in np.linspace(0.05 * p, 0.999 * p, 60)) > 1e-3
    beyond, phase = nearest(1.0001 * p)
    assert beyond < 1e-9
    assert phase == pytest.approx(found.phase, abs=0.1)
    assert found.load.error < 1e-4 * p


def sag(problem: Problem, compression: float) -> float:
    """Of A + Bx + C cos kx + D sin kx − wx²/2P in half a tool joint and half a body, symmetric, zero at the edge."""
    (edge, stiff, heavy, *_), (_, soft, light, *_) = problem.sections[:2]
    p, w = compression, problem.weight
    rows, right = [], []

    def terms(b: float, x: float, order: int) -> list[float]:
        k = math.sqrt(p / b)
        line = [[1.0, x], [0.0, 1.0]] + 2 * [[0.0, 0.0]]
        return [
            *line[order],
            k**order * math.cos(k * x + order * math.pi / 2),
            k**order * math.sin(k * x + order * math.pi / 2),
        ]

    def falls(q: float, x: float, order: int) -> float:
        return w * q / p * [0.5 * x**2, x, 1.0, 0.0][order]

    for piece, b, q, x, order in (
        (0, stiff, heavy, 0.0, 1), (0, stiff, heavy, 0.0, 3), (0, stiff, heavy, edge, 0), (1, soft, light, edge, 0),
        (1, soft, light, 0.5, 1), (1, soft, light, 0.5, 3),
    ):  # fmt: skip
        rows.append([0.0] * 4 * piece + terms(b, x, order) + [0.0] * 4 * (1 - piece))
        right.append(falls(q, x, order))
    for order, first, last in ((1, 1.0, 1.0), (2, stiff, soft)):  # slope and moment
        rows.append([first * t for t in terms(stiff, edge, order)] + [-last * t for t in terms(soft, edge, order)])
        right.append(first * falls(heavy, edge, order) - last * falls(light, edge, order))
    found = np.linalg.solve(np.array(rows), np.array(right))
    return -float(np.dot(found[4:], terms(soft, 0.5, 0)) - falls(light, 0.5, 0))


def test_the_sag_is_that_of_a_beam_column_in_closed_form() -> None:
    found = jointed_string(PERIOD)
    assert found.sag.value == pytest.approx(sag(PERIOD, -found.load.value), rel=1e-8)
    heavier = sag(PERIOD, -found.load.value + found.load.error)
    assert 0.0 < heavier - found.sag.value < 2.0 * found.sag.error < 0.01 * found.sag.value
    weight = 33.0 / 216.0 * sum(length * q for length, _, q, *_ in SECTIONS)
    assert 2.0 * found.edge_force.value == pytest.approx(weight, rel=1e-13)
    assert found.room.value == pytest.approx(0.46 * 4.92e-3, abs=found.room.error)


def test_finite_strings_come_down_to_the_endless_one() -> None:
    """12 and 24 joints between clamped ends: the difference falls with the square of the number of joints."""
    endless = -jointed_string(PERIOD).load.value
    twelve, many = (brentq(lambda p, n=n: clamped(n, p), 9.97, top) for n, top in ((12, 10.3), (24, 10.05)))
    assert 0.0 < many - endless < 0.005 * endless
    assert (twelve - endless) / (many - endless) == pytest.approx(4.0, rel=0.2)


@pytest.mark.parametrize("weight", [33.0 / 216.0, 1e-3])
def test_where_a_string_of_so_many_joints_buckles_is_told(weight: float) -> None:
    """Waves of one joint, and of many: between clamped ends, by transfer matrices; the first of the loads of each."""
    period = PERIOD.but(weight=weight)
    found = jointed_string(period)
    endless = -found.load.value
    for count in (12, 24):
        least, most = (-load for load in found.of_joints(count))
        grid = np.linspace(0.99 * least, least + 1.5 * (most - least), 400)
        signs = np.sign([clamped(count, p, period) for p in grid])
        first = grid[int(np.argmax(signs[1:] != signs[:-1]))]
        assert endless + 0.85 * found.end_effect / count**2 < first < most
    with pytest.raises(InputError, match="at least 3"):
        found.of_joints(2)


def test_light_joints_are_a_bed_of_their_weight() -> None:
    """Waves much longer than a joint: 2√(Bw/Δ) of the means, Δ that of the tool joints."""
    found = jointed_string(PERIOD.but(weight=1e-6, clearance=0.01))
    mean = 1.0 / sum(length / b for length, b, *_ in SECTIONS)
    weight = 1e-6 * sum(length * q for length, _, q, *_ in SECTIONS)
    assert found.spread.value == pytest.approx(-2.0 * math.sqrt(mean * weight / 0.0054))
    assert found.load.value == pytest.approx(found.spread.value, rel=1e-4)
    assert found.phase == pytest.approx((weight / (mean * 0.0054)) ** 0.25, rel=1e-2)


def test_a_drill_pipe_buckles_far_below_the_load_of_its_spread_weight(tmp_path: Path) -> None:
    """Twelve joints of it between clamped ends buckle at 154 kN (load path): the endless string a little below."""
    file = tmp_path / "joint.toml"
    file.write_text(CASE, encoding="utf-8")
    done = CliRunner().invoke(cli, ["endless", "--joint", str(file), "--json"])
    data = json.loads(done.output)
    assert -154e3 < data["load_si"]["value"] < -148e3
    assert data["spread_load"]["value"] / data["load"]["value"] == pytest.approx(263.0 / 151.0, rel=0.03)
    file.write_text(CASE.replace("joints = 1", "joints = 12"), encoding="utf-8")  # one of them is the period
    of_twelve = json.loads(CliRunner().invoke(cli, ["endless", "--joint", str(file), "--json"]).output)
    twelve = of_twelve.pop("string")
    assert of_twelve == data
    assert twelve["joints"] == 12
    assert twelve["load"][0] == data["load"]
    told = " ".join(CliRunner().invoke(cli, ["endless", "--joint", str(file)]).output.split())
    assert "opposite sides" in told
    assert "A string of 12 of them" in told
    refused = CliRunner().invoke(cli, ["endless", "--joint", str(file), "--beta", "3"])
    assert "--beta = 3.0: does not go with --joint" in str(refused.exception)


def test_what_is_no_endless_string_of_joints_is_refused() -> None:
    with pytest.raises(InputError, match="half a tool joint, wider sections"):
        jointed_string(PERIOD.but(sections=()))
    with pytest.raises(InputError, match="same seen from either end"):
        jointed_string(PERIOD.but(sections=((0.1, 1, 1, 0.5), (0.7, 1, 1, 1), (0.2, 1, 1, 0.5))))
    with pytest.raises(InputError, match="must press"):
        jointed_string(PERIOD.but(alpha=0.0))
    with pytest.raises(NotConvergedError, match="touches the wall"):
        jointed_string(PERIOD.but(weight=100.0))
