"""The path of a hole of a case along a survey or a centre line, read from its file."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from rodwell.case.hole.schema import Hole
from rodwell.survey.centerline import read_centerline
from rodwell.survey.path import HolePath, Tortuosity, path_of_points, path_of_survey
from rodwell.survey.survey import Survey


def path_of(hole: Hole, file: str, folder: Path) -> HolePath:
    """The path of a hole along its file, in ``folder``; ``file`` is the key that names it, survey or centerline.

    Raises
    ------
    InputError
        If the file cannot be read, or no path goes through what it holds.
    """
    path = folder / str(getattr(hole, file))
    try:
        stat = path.stat()
        stamp = (stat.st_mtime_ns, stat.st_size)
    except OSError:
        stamp = (0, 0)  # said when it is read
    if file == "centerline":
        return _of_points(path, stamp)
    tortuosity = None
    if hole.tortuosity is not None:
        tortuosity = Tortuosity(hole.tortuosity, hole.tortuosity_step, hole.tortuosity_seed)
    return _of_survey(path, stamp, hole.well, hole.depth_unit, tortuosity)


@lru_cache(maxsize=8)
def _of_survey(
    path: Path, stamp: tuple[int, int], well: str | None, depth_unit: str | None, tortuosity: Tortuosity | None
) -> HolePath:
    """Path of a survey, read once for all points of a study; ``stamp`` says that the file is still the same."""
    return path_of_survey(Survey.read(path, well=well, depth_unit=depth_unit), tortuosity)


@lru_cache(maxsize=8)
def _of_points(path: Path, stamp: tuple[int, int]) -> HolePath:
    return path_of_points(read_centerline(path), path.name)
