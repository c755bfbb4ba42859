"""Post-buckling states against the continuation code AUTO-07p on the paper's 15-dimensional system."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

import rodwell
from rodwell.analysis.discrete.measures import Measured

DATA = Path(__file__).parents[1] / "data" / "auto_branches.csv"
with DATA.open(encoding="utf-8") as file:
    ROWS = [{key: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(file)]
BRANCHES = sorted({(row["weight"], int(row["mode"])) for row in ROWS})
FARTHEST = -1000.0


@pytest.mark.parametrize(("weight", "mode"), BRANCHES)
def test_states_agree(weight: float, mode: int) -> None:
    rows = [r for r in ROWS if (r["weight"], r["mode"]) == (weight, mode) and r["F"] >= FARTHEST]
    branch = rodwell.follow(rodwell.Problem(weight), mode, until=min(r["F"] for r in rows) - 1.0)
    assert branch.reached_end
    assert branch.converged
    for row in rows:
        state = branch.at(row["F"])
        digits = 10.0 ** -min(row["digits_omega2"], 8.0)
        for which, column in (
            (Measured.OMEGA2_1, "omega2_1"),
            (Measured.OMEGA2_0, "omega2_0"),
            (Measured.SHORTENING, "end_shortening"),
        ):
            value, error = state.number(which)
            assert value == pytest.approx(row[column], rel=digits, abs=error + 1e-11)
        highest, error, places = state.highest_pressure
        pressure_digits = 10.0 ** -min(row["digits_p_max"], 7.0)
        assert highest == pytest.approx(row["p_max"], rel=pressure_digits, abs=error)
        assert any(min(abs(s - row["s_p_max"]), abs(1 - s - row["s_p_max"])) < 1e-4 for s in places)
        fields = state.fields(np.array([0.0, 0.5, 1.0]))
        assert fields["T2"][0] == pytest.approx(row["T2_0"], rel=1e-7, abs=1e-9)
        # F₃(1) and M₂(0) nearly cancel for some modes: judged against the largest shear and moment along the rod
        along = state.fields()
        shear, moment = np.max(np.abs(along["rod_F3"])), np.max(np.abs(along["mu"]))
        assert fields["braid_F3"][2] == pytest.approx(row["F3_1"], rel=1e-7, abs=1e-8 * shear)
        assert fields["braid_M2"][0] == pytest.approx(row["M2_0"], rel=1e-7, abs=1e-8 * moment)
        assert fields["xi2"][1] == pytest.approx(row["xi2_mid"], rel=1e-8, abs=1e-8)
