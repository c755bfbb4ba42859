"""Branches kept in files: what is read back is what was kept, to the last bit."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import h5netcdf
import numpy as np
import pytest
import xarray as xr

from rodwell import Branch, InputError, Problem, extended, follow, load_branch, save_branch

PROBLEM = Problem(15.0, 89.0, twist=0.5)


def numbers(branch: Branch) -> list[bytes]:
    """All that a branch is made of, as bytes."""
    points = branch.trace.points
    arrays = [x for p in points for x in (p.coarse.c, p.fine.c, p.fine.tangent, p.fine.row, p.values, p.error)]
    special = [(p.value, p.error, p.index_before, p.index_after, *p.s) for p in branch.special_points]
    return [np.ascontiguousarray(x).tobytes() for x in (*arrays, branch.values, *map(np.array, special))]


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(PROBLEM, until=-180.0)


@pytest.fixture
def kept(branch: Branch, tmp_path: Path) -> Path:
    return save_branch(branch, tmp_path / "branch.nc")


def test_a_branch_comes_back_to_the_last_bit(branch: Branch, kept: Path) -> None:
    back = load_branch(kept)
    assert numbers(back) == numbers(branch)
    assert [p.kind for p in back.special_points] == [p.kind for p in branch.special_points]
    assert (back.problem, back.parameter, back.name, back.ending) == (
        branch.problem, branch.parameter, branch.name, branch.ending,
    )  # fmt: skip
    assert back.converged == branch.converged


def test_what_goes_on_from_a_file_is_what_would_have_gone_on(branch: Branch, kept: Path) -> None:
    back = load_branch(kept)
    assert numbers(extended(back, -220.0)) == numbers(extended(branch, -220.0))
    arguments = {"parameter": "weight", "until": 17.0}
    assert numbers(follow(PROBLEM, start=back[-1], **arguments)) == numbers(  # type: ignore[arg-type]
        follow(PROBLEM, start=branch[-1], **arguments)  # type: ignore[arg-type]
    )


def test_another_process_goes_on_with_the_same_points(branch: Branch, kept: Path) -> None:
    code = (
        "import sys, rodwell\n"
        "b = rodwell.extended(rodwell.load_branch(sys.argv[1]), -190.0)\n"
        "print(b.trace.points[-1].fine.c.tobytes().hex(), b.values.tobytes().hex())"
    )
    out = subprocess.run([sys.executable, "-c", code, str(kept)], capture_output=True, text=True, check=True).stdout
    here = extended(branch, -190.0)
    assert out.split() == [here.trace.points[-1].fine.c.tobytes().hex(), here.values.tobytes().hex()]


def test_branches_in_other_parameters_are_kept_too(branch: Branch, tmp_path: Path) -> None:
    other = follow(PROBLEM, start=branch[-1], parameter="alpha", until=85.0)
    assert numbers(load_branch(save_branch(other, tmp_path / "alpha.nc"))) == numbers(other)


def test_the_file_can_be_read_by_others(branch: Branch, kept: Path) -> None:
    with xr.open_dataset(kept, engine="h5netcdf") as data:
        assert data["force"].values == pytest.approx(branch.force)
        assert data.attrs["ended_because"] == branch.ended_because
    with xr.open_dataset(kept, engine="h5netcdf", group="restart") as group:
        assert group.attrs["format"] == 1


def test_files_that_hold_no_branch_are_refused(kept: Path, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"^path = .*cannot be read as NetCDF"):
        load_branch(tmp_path / "none.nc")
    text = tmp_path / "text.nc"
    text.write_text("no NetCDF")
    with pytest.raises(InputError, match=r"^path = .*cannot be read as NetCDF"):
        load_branch(text)
    with h5netcdf.File(tmp_path / "other.nc", "w"):
        pass
    with pytest.raises(InputError, match="holds no branch to go on from"):
        load_branch(tmp_path / "other.nc")
    with h5netcdf.File(kept, "a") as file:
        file["restart"].attrs["format"] = 99
    with pytest.raises(InputError, match="is kept in format 99"):
        load_branch(kept)


def test_damaged_files_are_refused(kept: Path) -> None:
    with h5netcdf.File(kept, "a") as file:
        del file["restart"]._h5group["coefficients"]
    with pytest.raises(InputError, match="is damaged"):
        load_branch(kept)


def test_a_file_that_cannot_be_written_is_said(branch: Branch, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=r"^path"):
        save_branch(branch, tmp_path / "file" / "branch.nc")
