"""Root bracketing, maxima of the contact pressure, and how changes of the index are resolved."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline

from rodwell import Problem, follow
from rodwell.numerics.continuation.crossings import _bisect
from rodwell.numerics.continuation.events import Event
from rodwell.numerics.continuation.location import Segment, bracketed_root
from rodwell.numerics.continuation.stretch import _Stretch
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.maxima import maxima
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.held import Ends
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.model import RodOnCylinder


@given(st.floats(0.01, 0.99), st.integers(1, 9).filter(lambda k: k % 2 == 1))
def test_root_of_flat_and_steep_functions(place: float, power: int) -> None:
    found = bracketed_root(lambda x: (x - place) ** power, 0.0, 1.0, (-place) ** power, (1.0 - place) ** power)
    assert found == pytest.approx(place, abs=1e-11)


def test_root_of_a_function_with_a_kink() -> None:
    def f(x: float) -> float:
        return max(math.sin(3.0 * x) - 0.9, 2.0 * x - 0.8)

    assert bracketed_root(f, 0.0, 1.0, f(0.0), f(1.0)) == pytest.approx(math.asin(0.9) / 3.0, abs=1e-12)


@pytest.mark.parametrize(("linear", "bent"), [(0.5, 0.1), (0.9, -0.15), (0.45, 0.02)])
def test_where_the_inverse_is_a_quadratic_its_interpolation_meets_the_root(linear: float, bent: float) -> None:
    """x = 0.3 + a f + b f²: the secant is the first place that is looked at, the second is the root."""
    calls = []

    def f(x: float) -> float:
        calls.append(x)
        return (math.sqrt(linear**2 + 4.0 * bent * (x - 0.3)) - linear) / (2.0 * bent)

    assert bracketed_root(f, 0.0, 1.0, f(0.0), f(1.0), noise=1e-14) == pytest.approx(0.3, abs=1e-14)
    assert len(calls) == 4


class Staircase:
    """A segment whose index jumps at given places."""

    def __init__(self, jumps: dict[float, int]) -> None:
        self.jumps, self.family = jumps, self

    def __call__(self, t: float) -> Staircase:
        step = Staircase(self.jumps)
        step.index = sum(by for place, by in self.jumps.items() if t > place)  # type: ignore[attr-defined]
        step.c = np.zeros(3)  # type: ignore[attr-defined]
        return step

    def nearest_curvature(self, state: object, vector: object, iterations: int) -> tuple[float, float]:
        return 1.0, 0.0  # no sign change: resolution is by the index alone


@pytest.mark.parametrize("jumps", [{0.3: 1}, {0.3: 1, 0.3000001: 1}, {0.2: 1, 0.7: -1, 0.9: 2}, {0.5: 2}], ids=str)
def test_every_change_of_the_index_is_resolved(jumps: dict[float, int]) -> None:
    segment = Staircase(jumps)
    found = _bisect(segment, 0.0, 1.0, segment(0.0).index, segment(1.0).index)  # type: ignore[arg-type, attr-defined]
    changes = {round(bracket.low, 9): bracket.after - bracket.before for bracket in found}
    total = sum(jumps.values())
    assert sum(changes.values()) == total
    if len({by > 0 for by in jumps.values()}) == 1:
        assert changes == pytest.approx({round(k, 9): v for k, v in jumps.items()}, abs=1e-8)


def on_curve(t: float) -> State:
    """A point of the curve c = (t, t², t³, 1), λ = (t − ½)², with its unit tangent in the Euclidean metric."""
    tangent, rate = np.array([1.0, 2.0 * t, 3.0 * t * t, 0.0]), 2.0 * (t - 0.5)
    length = math.sqrt(tangent @ tangent + rate * rate)
    t1, r = tangent / length, rate / length
    c = np.array([t, t * t, t**3, 1.0])
    return State(SplineSpace(np.linspace(0.0, 1.0, 3), 2), c, (t - 0.5) ** 2, t1, r, t1, r, 0, 0.0)


def cubic_arc() -> Segment:
    """Its stretch from t = 0.2 to 0.9."""
    return Segment(None, on_curve(0.2), on_curve(0.9))  # type: ignore[arg-type]


def test_the_interpolant_between_two_states_is_hermites_cubic() -> None:
    """SciPy's CubicHermiteSpline over the distance along the first tangent, tangents scaled to it."""
    arc = cubic_arc()
    a, b, length = arc.first, arc.last, arc.first.along(arc.last)
    growth = float(a.row @ b.tangent) + a.row_lam * b.tangent_lam
    values = np.array([[*x.c, x.lam] for x in (a, b)])
    slopes = np.array([[*a.tangent, a.tangent_lam], np.array([*b.tangent, b.tangent_lam]) / growth])
    cubic = CubicHermiteSpline([0.0, length], values, slopes)
    for t in (0.2, 0.5, 0.7):
        c, lam = arc._interpolant(t)
        np.testing.assert_allclose([*c, lam], cubic(t * length), rtol=0.0, atol=1e-15)


def test_doubt_of_a_load_is_how_far_it_moves_with_the_place() -> None:
    """dλ/dt by differences; where λ turns back in the middle, as a parabola does, λ″/2 · shift² at least."""
    arc = cubic_arc()
    length = arc.first.along(arc.last)
    for t in (0.3, 0.6):
        here, ahead = on_curve(t), on_curve(t + 1e-6)
        rate = (ahead.lam - here.lam) / (arc.first.along(ahead) - arc.first.along(here)) * length
        assert arc.doubt(here, arc.first.along(here) / length, 1e-9) == pytest.approx(1e-9 * abs(rate), rel=1e-5)
    ends = Segment(None, on_curve(0.0), on_curve(1.0))  # type: ignore[arg-type]
    assert ends.doubt(on_curve(0.5), 0.5, 1e-3) == pytest.approx(2.0 * 1e-6, rel=1e-12)


class Losing:
    """Meshes that have finer ones, on which one of two points is not found."""

    def __init__(self, lost: str) -> None:
        self.lost = lost

    def refined(self, _: object) -> Losing:
        return self

    def adopt(self, _: object, point: str) -> tuple[None, str | None]:
        return None, None if point == self.lost else point


@pytest.mark.parametrize(("lost", "kept"), [("before", False), ("after", False), ("neither", True)])
def test_a_stretch_on_finer_meshes_has_both_its_ends(lost: str, kept: bool) -> None:
    finer = _Stretch(Losing(lost), "before", "after").on_finer("between")  # type: ignore[arg-type]
    assert (finer is not None) == kept


@pytest.mark.parametrize(("ahead", "starts"), [(0.0, True), (1e-9, True), (1e-5, False)])
def test_the_zero_of_an_event_next_to_the_start_is_the_start(ahead: float, starts: bool) -> None:
    """Up to a millionth of the stretch."""
    ends = [SimpleNamespace(lam=lam, values=np.zeros(1)) for lam in (3.0 - ahead, 4.0)]
    assert _Stretch(None, *ends).starts_at(Event.at("3", 3.0)) == starts  # type: ignore[arg-type]


def test_what_happens_past_the_start_is_placed_on_the_whole_stretch(monkeypatch: pytest.MonkeyPatch) -> None:
    """A stretch 0.1 long is looked at from 1e-4 on: what lies half-way from there lies at 0.001 + 0.999/2 of it."""
    just_past = SimpleNamespace(lam=1e-4, tangent_lam=1.0, index=0)
    start = SimpleNamespace(lam=0.0, along=lambda other: 1e-4 if other is just_past else 0.1)
    stretch = _Stretch(  # type: ignore[arg-type]
        SimpleNamespace(point=lambda *_: "there"), SimpleNamespace(fine=start), SimpleNamespace(fine="end")
    )
    stretch.__dict__["segments"] = [lambda t: just_past if t == pytest.approx(1e-3) else None] * 2
    monkeypatch.setattr(_Stretch, "changes", lambda _: [(0.5, "found")])
    ((place, found),) = stretch.changes_past_the_start(SimpleNamespace(index=lambda _: 0))  # type: ignore[arg-type]
    assert (place, found) == (pytest.approx(0.001 + 0.999 * 0.5), "found")


def pressure(clearance: float, lateral: float, amplitude: float, shape: str) -> tuple[np.ndarray, np.ndarray]:
    """Maxima for a given y(s), projected on a fine space, and a dense sample of the pressure."""
    from rodwell.physics.on_wall.strand import contact_pressure

    space = SplineSpace(np.linspace(0.0, 1.0, 41), 9)
    s = space.points
    bump = s**2 * (1.0 - s) ** 2
    profile = {"even": bump, "odd": bump * (s - 0.5), "skew": bump * (s - 0.37) * (s - 0.8)}[shape]
    c = space.project(amplitude * profile / np.max(np.abs(profile)), Ends((2, 2)))
    p = np.array([-100.0, 0.0, lateral, clearance, 0.0, 1.0, 0.0])
    grid, table = space.samples
    family = Family(RodOnCylinder(), np.zeros((4, p.size)), space, Ends((2, 2)), 0, clearance, 1.0, 1.0)
    places, values, _ = maxima(family.mesh, space.knots, grid, table, c, p, 0.5)
    around = places[:, None] + np.linspace(-1e-3, 1e-3, 401)  # 5e-6 apart, as much as counts beside them
    dense = np.unique(np.clip(np.concatenate([np.linspace(0.0, 1.0, 2001), around.ravel()]), 0.0, 1.0))
    u = space.evaluate(c, dense, 4)
    return np.array([places, values]), np.array([dense, contact_pressure(dense, *u, p)])


@pytest.mark.parametrize("shape", ["even", "odd", "skew"])
def test_highest_pressure_between_grid_points(shape: str) -> None:
    found, sample = pressure(0.01, 15.0, 0.004, shape)
    best, brute = np.argmax(found[1]), np.argmax(sample[1])
    assert found[1, best] == pytest.approx(sample[1, brute], rel=1e-8)
    assert found[1, best] >= sample[1, brute] - 1e-10 * abs(sample[1, brute])
    if shape == "skew":
        assert found[0, best] == pytest.approx(sample[0, brute], abs=1e-5)


@pytest.mark.parametrize("shape", ["even", "odd"])
def test_maxima_of_a_symmetric_shape_come_in_pairs(shape: str) -> None:
    found, _ = pressure(0.01, 15.0, 0.004, shape)
    assert found[0] == pytest.approx(1.0 - found[0][::-1], abs=1e-7)
    assert found[1] == pytest.approx(found[1][::-1], rel=1e-9)


def test_a_root_is_not_sought_below_the_noise() -> None:
    rng = np.random.default_rng(2)
    calls = []

    def noisy(x: float) -> float:
        calls.append(x)
        return math.sin(x - 0.3) + 1e-9 * rng.uniform(-1.0, 1.0)

    root = bracketed_root(noisy, 0.0, 1.0, noisy(0.0), noisy(1.0), noise=2e-9)
    assert root == pytest.approx(0.3, abs=4e-9)
    assert len(calls) <= 8


def test_a_value_of_the_parameter_is_met_exactly_where_it_does_not_turn_back() -> None:
    problem = Problem(15.0)
    branch = follow(problem, until=-160.0)
    _, (coarse, fine) = branch._segments(5)
    between = 0.4 * fine.first.lam + 0.6 * fine.last.lam
    for segment in (coarse, fine):
        found = segment.exactly(between)
        assert found is not None
        t, state = found
        assert state.lam == between
        assert 0.5 < t < 0.7
        assert state.tangent_lam * segment.first.tangent_lam > 0.0  # in the direction of travel
        other = segment(segment.first.along(state) / segment.first.along(segment.last))  # the same by way of arclength
        np.testing.assert_allclose(other.c, state.c, rtol=0.0, atol=1e-12)
        assert other.lam == pytest.approx(between, abs=1e-9)


def test_a_value_of_the_parameter_is_not_met_beyond_the_span_or_at_a_fold() -> None:
    branch = follow(Problem(15.0), until=-160.0)
    _, (coarse, _) = branch._segments(5)
    assert coarse.exactly(coarse.last.lam - 0.5 * abs(coarse.last.lam - coarse.first.lam)) is None
    folded = Segment(coarse.family, coarse.first, coarse.last.reversed())
    assert folded.exactly(0.5 * (coarse.first.lam + coarse.last.lam)) is None
