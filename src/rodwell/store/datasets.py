"""Which results have a dataset: found by :mod:`rodwell.faces`."""

from __future__ import annotations

from functools import singledispatch
from typing import TYPE_CHECKING, Any

from rodwell.analysis.beyond.off_wall_branch import OffWallBranch
from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.path.load_path import LoadPath
from rodwell.store.dataset import branch_dataset, solution_dataset
from rodwell.store.map_arrays import map_dataset
from rodwell.store.path_arrays import off_wall_dataset, path_dataset
from rodwell.studies.maps.result import Map

if TYPE_CHECKING:
    import xarray as xr


@singledispatch
def dataset(result: object, *_arguments: Any, **_options: Any) -> xr.Dataset:
    """Return a result as an xarray Dataset: for the methods of results."""
    raise TypeError(f"{type(result).__name__} has no dataset")


dataset.register(Branch, branch_dataset)
dataset.register(Solution, solution_dataset)
dataset.register(Map, map_dataset)
dataset.register(LoadPath, path_dataset)
dataset.register(OffWallBranch, off_wall_dataset)
