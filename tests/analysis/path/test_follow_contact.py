"""States off the wall followed to other numbers of their problem: those of load paths computed afresh there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rodwell
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.path import elsewhere
from rodwell.analysis.path.elsewhere import follow_contact

ROD = rodwell.Problem(weight=15.0)


@pytest.fixture(scope="module")
def path() -> rodwell.LoadPath:
    """The horizontal rod up to beyond its snap."""
    return rodwell.load_path(ROD, until=-160.0)


def state(path: rodwell.LoadPath, force: float) -> ContactState:
    return path.at(force)[0].state


def same(one: ContactState, other: ContactState) -> None:
    """Two computations of one state, to 1e-7 in every number and along the rod."""
    assert one.fine.pattern == other.fine.pattern
    assert one.stability_index == other.stability_index == 0
    assert one.fine.bounds == pytest.approx(other.fine.bounds, abs=1e-7)
    for name in ("energy", "shortening", "contact_total", "largest_pressure"):
        assert getattr(one, name).value == pytest.approx(getattr(other, name).value, rel=1e-7, abs=1e-12), name
    places = np.linspace(0.0, 1.0, 51)
    mine, fresh = one.fields(places), other.fields(places)
    for name in ("x", "y", "gap"):
        assert mine[name] == pytest.approx(fresh[name], abs=1e-7 * ROD.clearance), name


@pytest.mark.parametrize(
    ("force", "before", "numbers", "after"),
    [
        (-123.8, "=-=", {"weight": 16.0}, "="),  # the gap closes
        (-123.8, "=-=", {"weight": 14.5, "alpha": 88.0}, "=-=-=-="),  # two more open, at once
        (-124.4, "=-=-=-=", {"weight": 15.15}, "=-="),  # and close again
        (-140.0, "=-=-=-=", {"clearance": 0.0105, "twist": 0.2}, "-=-=-"),  # the ends lift off
        (-144.7, "=-·-·-=", {"weight": 15.15}, "=-=-=-="),  # points of contact grow to stretches
        (-160.0, "=", {"weight": 14.5}, "="),  # the helix
    ],
)  # fmt: skip
def test_the_state_is_that_of_a_path_computed_afresh(
    path: rodwell.LoadPath, force: float, before: str, numbers: dict[str, float], after: str
) -> None:
    start, problem = state(path, force), ROD.but(**numbers)
    found = follow_contact(start, problem)
    assert (start.fine.pattern.text(), found.fine.pattern.text()) == (before, after)
    assert found.problem == problem
    assert found.certificate.passed
    same(found, state(rodwell.load_path(problem, until=force), force))


def test_the_load_moves_too_and_a_state_followed_is_a_start(path: rodwell.LoadPath) -> None:
    """To where a load path goes by the load alone, by way of another weight."""
    there = follow_contact(state(path, -118.0), ROD.but(weight=15.5))
    assert there.fine.pattern.full  # it has not left the wall yet
    same(follow_contact(there, ROD, -123.8), state(path, -123.8))


def test_a_rod_that_would_have_snapped_gives_way(path: rodwell.LoadPath) -> None:
    """The limit point of the path lies at the load of the state where the following ends: two ways to one place."""
    start, light = state(path, -140.0), ROD.but(weight=12.0)
    parts: list[float] = []
    with pytest.raises(rodwell.NotConvergedError, match=r"followed [\d.]+% of the way: .*gives way"):
        follow_contact(start, light, progress=parts.append)
    assert parts == sorted(parts)
    limit = rodwell.load_path(ROD.but(weight=15.0 - 3.0 * parts[-1]), until=-160.0).snaps[0].force.value
    assert limit == pytest.approx(-140.0, abs=2e-3 * 140.0 * (15.0 - 12.0) / 15.0)


def test_following_ends_with_what_progress_raises(path: rodwell.LoadPath) -> None:
    def left_off(_: float) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        follow_contact(state(path, -140.0), ROD.but(weight=15.1), progress=left_off)


def test_a_state_that_misses_its_balance_is_not_given(path: rodwell.LoadPath, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(elsewhere, "LIMIT", 0.0)
    with pytest.raises(rodwell.NotConvergedError, match="misses its balance"):
        follow_contact(state(path, -140.0), ROD.but(weight=15.1))


@pytest.mark.parametrize(
    ("problem", "what"),
    [
        (replace(ROD, ends=("clamped", "pinned")), "ends"),
        (replace(ROD, sections=((0.5, 1.0, 1.0), (0.5, 1.0, 2.0))), "sections"),
        (replace(ROD, weight=0.0), "weight"),
        (replace(ROD, alpha=0.0), "weight"),
        (replace(ROD, outside=True), "outside"),
    ],
)  # fmt: skip
def test_what_is_not_a_matter_of_numbers_is_refused(
    path: rodwell.LoadPath, problem: rodwell.Problem, what: str
) -> None:
    with pytest.raises(rodwell.InputError, match=f"^{what} = "):
        follow_contact(state(path, -140.0), problem)


def test_a_load_that_is_none_is_refused(path: rodwell.LoadPath) -> None:
    with pytest.raises(rodwell.InputError, match="force"):
        follow_contact(state(path, -140.0), ROD, float("nan"))


def test_sections_move_their_numbers() -> None:
    """A string heavier at one end, its step of the weight moved along it and made larger."""

    def string(length: float, weight: float) -> rodwell.Problem:
        return rodwell.Problem(weight=15.0, sections=((length, 1.0, 1.0), (1.0 - length, 1.0, weight)))

    start = rodwell.load_path(string(0.5, 1.1), until=-126.0).at(-126.0)[0].state
    assert not start.fine.pattern.full
    moved = string(0.52, 1.12)
    same(follow_contact(start, moved), rodwell.load_path(moved, until=-126.0).at(-126.0)[0].state)
