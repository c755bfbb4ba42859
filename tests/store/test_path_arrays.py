"""Load paths as labelled arrays, and in NetCDF files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import rodwell
from rodwell.analysis.path.load_path import LoadPath
from rodwell.store.netcdf import write_load_path


@pytest.fixture(scope="module")
def path() -> LoadPath:
    return rodwell.load_path(rodwell.Problem(15.0), until=-126.5, seeds=1)


@pytest.fixture(scope="module")
def data(path: LoadPath) -> xr.Dataset:
    return path.dataset(41)


def test_states_and_events(path: LoadPath, data: xr.Dataset) -> None:
    """Loads of theory-2: buckling −111.23344016, lift-off −123.173074, a second pair of gaps −124.1911865."""
    assert list(data["event_kind"].values) == ["critical", "lift_off", "gap_opens"]
    assert data["event_force"].values == pytest.approx([-111.23344016, -123.173074, -124.1911865], rel=1e-7)
    assert np.all(data["event_force_error"] < 1e-6)
    assert data.sizes["state"] + data.attrs["states_left_out"] == sum(len(run) for run in path.legs[0].runs)
    assert data["straight_to"].values == pytest.approx([-111.23344016])
    assert np.all(data["stability_index"] == 0)
    assert np.all(np.diff(data["force"]) <= 0.0)


def test_gaps_and_forces_belong_to_their_states(data: xr.Dataset) -> None:
    """One gap from lift-off on, three from the second pair on; P at both ends of each; none before."""
    gaps = np.bincount(data["gap_state"].values, minlength=data.sizes["state"])
    points = np.bincount(data["point_state"].values, minlength=data.sizes["state"])
    off, more = (data["force"].values < load for load in (-123.18, -124.2))
    assert set(gaps[off & ~more]) == {1}
    assert set(gaps[more]) == {3}
    assert set(gaps[data["force"].values > -123.17]) == {0}
    assert np.all(points == 2 * gaps)
    last = data["gap_state"].values == data.sizes["state"] - 1
    assert float(data["gap_largest"].values[last].max()) == pytest.approx(float(data["gap"][-1].max()), rel=1e-3)


def test_fields_agree_with_numbers(path: LoadPath, data: xr.Dataset) -> None:
    """z(1) is one less the shortening; the energy's slope in the load is the shortening."""
    assert 1.0 - data["z"].values[:, -1] == pytest.approx(data["shortening"].values, abs=1e-9)
    assert np.all(data["field_error"].sel(field="gap") < 1e-7)
    middle = 0.5 * (data["shortening"].values[1:] + data["shortening"].values[:-1])
    rate = np.diff(data["energy"]) / np.diff(data["force"])
    assert rate == pytest.approx(middle, rel=0.01)


def test_the_file(path: LoadPath, data: xr.Dataset, tmp_path: Path) -> None:
    write_load_path(path, tmp_path / "path.nc")
    with xr.open_dataset(tmp_path / "path.nc", engine="h5netcdf") as read:
        assert read.sizes["s"] == 201
        assert np.array_equal(read["force"], data["force"])
        assert read["gap"].attrs["units"] == "1"
        assert read.attrs["reached"] == 1
        assert read.attrs["weight"] == 15.0
        assert "wall_stiffness" not in read.attrs


def test_a_path_of_a_rod_that_does_not_buckle_has_its_straight_range_and_no_states(tmp_path: Path) -> None:
    write_load_path(rodwell.load_path(rodwell.Problem(15.0), until=-50.0), tmp_path / "path.nc")
    with xr.open_dataset(tmp_path / "path.nc") as data:
        assert "state" not in data.sizes
        assert data.sizes["straight"] == 1
        assert data.attrs["reached"] == 1
