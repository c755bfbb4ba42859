"""The page on the braid: balances of forces in components, as the page shows them."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.fixture(scope="module")
def page() -> Any:
    sys.path.insert(0, str(DOCS))
    try:
        return importlib.import_module("make_braid")
    finally:
        sys.path.remove(str(DOCS))


def test_forces_on_the_whole_rod_add_up_to_nothing(page: Any) -> None:
    """Newton: fittings, wall and weight; along the axis F and the weight γ cos α = 7.5 alone."""
    forces = page.balance()
    assert sum(forces.values()) == pytest.approx(np.zeros(3), abs=1e-9)
    assert forces["support at s = 0, on the rod"][2] == pytest.approx(110.0 + 7.5, rel=1e-12)
    assert forces["weight"] == pytest.approx([-15.0 * np.sin(np.pi / 3.0), 0.0, -7.5], rel=1e-12)


def test_moment_of_the_braid_changes_with_its_force(page: Any) -> None:
    """M′ + t₁ × F = 0 and F′ = mg cos α k, (22)–(27) as vectors, with M and F rebuilt from rod and cylinder by (45)."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    low, high = 0.2, 0.7
    s, w = 0.5 * (low + high + (high - low) * nodes), 0.5 * (high - low) * weights

    def whole(places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        v = page.vectors(places)
        return v["rod force"] + v["cylinder force"], v["rod moment"] + v["cylinder moment"] + v["lever"]

    forces, moments = whole(np.array([low, high]))
    inside, _ = whole(s)
    fields = page.state().fields(s)
    tangent = page.frames(fields["xi1"], fields["eta"], fields["xi2"])["R11"][:, :, 0]
    assert forces[1] - forces[0] == pytest.approx([0.0, 0.0, 7.5 * (high - low)], abs=1e-8)
    assert moments[1] - moments[0] == pytest.approx(-w @ np.cross(tangent, inside), abs=1e-9)
