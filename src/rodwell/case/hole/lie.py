"""How the hole of a case lies in space: straight, bent with one curvature, or along a survey or a centre line."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rodwell.case.facts import Fact
from rodwell.case.hole.schema import Hole
from rodwell.errors import InputError
from rodwell.problem import hole as problem
from rodwell.problem.points import Rows
from rodwell.quantities.text import plain

if TYPE_CHECKING:
    from rodwell.survey.path import HolePath, Piece

SAME_LENGTH = 1e-4
"""Relative difference of ``to`` − ``from`` and the length of the rod that counts as none: depths are rounded."""

OF_A_FILE = ("from_", "to")
OF_A_SURVEY = ("well", "depth_unit", "tortuosity", "tortuosity_step", "tortuosity_seed")
ANGLES = ("angle_from_vertical", "angle_from_horizontal")


@dataclass(frozen=True)
class Lie:
    """How the hole lies, in the terms of :class:`rodwell.problem.problem.Problem`.

    Attributes
    ----------
    alpha
        Inclination at mid-length in degrees.
    build, walk
        Curvatures in 1/L.
    axis
        Points or stations of the axis in L; empty where ``build`` and ``walk`` say all.
    height
        Of the axis at s = 1 above that at s = 0, in L.
    facts
        What is to be told of it.
    """

    alpha: float
    build: float = 0.0
    walk: float = 0.0
    axis: Rows = ()
    height: float = 0.0
    facts: tuple[Fact, ...] = ()


def lie_of(hole: Hole, length: float, folder: Path, by_depth: bool = False) -> Lie:
    """How the hole of a rod of a length in m lies; files are sought from the folder of the case.

    ``by_depth``: whether sections of the hole are told by measured depth, so that ``from`` and ``to`` need no file.

    Raises
    ------
    InputError
        Naming the key that is missing, contradicts another, or does not fit the rod.
    """
    file = _one_way(hole, by_depth)
    if file is None:
        return _bent(hole, length)
    from rodwell.case.hole.along_file import path_of  # noqa: PLC0415 - reading surveys is for those who have one

    name = "from" if hole.from_ is not None else "to"
    path = _named(f"hole.{file}", getattr(hole, file), lambda: path_of(hole, file, folder))
    upper, lower = depths_of(hole, length, path.bottom)
    if not path.top - SAME_LENGTH * length <= upper < lower <= path.bottom + SAME_LENGTH * length:
        given = getattr(hole, "from_" if name == "from" else "to")
        raise InputError(
            f"hole.{name}" if given is not None else f"hole.{file}",
            f"{given:g} m" if given is not None else getattr(hole, file),
            f"lays the rod of {length:.6g} m from {upper:.6g} to {lower:.6g} m, but {path.source} knows the hole from "
            f"{path.top:.6g} to {path.bottom:.6g} m only: a hole must be known all along its rod; give a shorter rod, "
            "other depths, or a longer file",
        )
    lower = min(lower, path.bottom)
    piece = path.piece(max(path.top, lower - length), lower)
    found = piece.hole
    height = float(np.diff(found.points(np.array([0.0, 1.0]))[:, 2])[0])
    facts = (
        Fact("hole", f"{plain(piece.upper, 7)} to {plain(piece.lower, 7)} m of {path.source}",
             note="s = 1 is at the smaller depth"),
        Fact("inclination α at mid-length", f"{plain(found.alpha, 6)}°", note="of the hole's axis"),
        *_curvature_facts(found, length),
        *_survey_facts(piece, hole),
    )  # fmt: skip
    return Lie(found.alpha, axis=piece.axis, height=height, facts=facts)


def _bent(hole: Hole, length: float) -> Lie:
    """A hole of one curvature, or none."""
    alpha = angle_of(hole)
    build, walk = (hole.build or 0.0) * length, (hole.walk or 0.0) * length
    try:
        arc = problem.Hole.arc(alpha, build, walk)
    except InputError as error:
        raise InputError(f"hole.{error.field}", None, error.reason) from None
    if arc.straight:
        return Lie(alpha, height=0.0 if alpha == 90.0 else math.cos(math.radians(alpha)))
    height = float(np.diff(arc.points(np.array([0.0, 1.0]))[:, 2])[0])
    return Lie(alpha, build, walk, height=height, facts=_curvature_facts(arc, length))


def _curvature_facts(hole: problem.Hole, length: float) -> tuple[Fact, ...]:
    if hole.straight:
        return (Fact("curvature of the hole", "straight"),)
    rate = f"{plain(math.degrees(hole.sharpest) * 30.0 / length, 4)}°/30 m"
    turn = f"the hole turns by {plain(math.degrees(hole.turning), 4)}° along the rod"
    return (Fact("smallest radius of the hole's axis", length / hole.sharpest, "length", f"{rate}; {turn}"),)


def _survey_facts(piece: Piece, hole: Hole) -> tuple[Fact, ...]:
    if piece.path.survey is None:
        return ()
    turned = f"directions at stations met within {plain(math.degrees(piece.turned), 1)}°"
    out = (Fact("largest distance from minimum curvature", piece.astray, "length", turned),)
    if hole.tortuosity is None:
        return out
    size = f"{plain(math.degrees(hole.tortuosity), 4)}°"
    text = f"every {plain(hole.tortuosity_step, 4)} m between stations, normal, seed {hole.tortuosity_seed}"
    return (*out, Fact("tortuosity, standard deviation in each direction", size, note=text))


def _one_way(hole: Hole, by_depth: bool) -> str | None:
    """The key that names a file, or None; refuses what contradicts it, and what needs one."""
    files = [key for key in ("survey", "centerline") if getattr(hole, key) is not None]
    if len(files) == 2:
        raise InputError("hole.centerline", hole.centerline, "contradicts hole.survey: give only one of the two")
    file = files[0] if files else None
    given = hole.model_fields_set
    if file is not None:
        for key in (*ANGLES, "build", "walk"):
            if getattr(hole, key) is not None:
                what = "inclination" if key in ANGLES else "curvature"
                raise InputError(f"hole.{key}", None, f"is given twice: hole.{file} has the {what}; leave one out")
    for key in (*(OF_A_FILE if file is None and not by_depth else ()), *(OF_A_SURVEY if file != "survey" else ())):
        if key in given:
            needs = "hole.survey or hole.centerline" if key in OF_A_FILE else "hole.survey"
            raise InputError(f"hole.{key.rstrip('_')}", None, f"needs {needs}: give that too, or leave it out")
    if hole.tortuosity is None and {"tortuosity_step", "tortuosity_seed"} & given:
        raise InputError("hole.tortuosity", None, "is missing: give it beside its step and seed, or leave these out")
    return file


def _named(key: str, value: str, compute: Callable[[], HolePath]) -> HolePath:
    try:
        return compute()
    except InputError as error:
        if error.field.startswith("tortuosity"):
            raise InputError(f"hole.{error.field}", error.value, error.reason) from None
        where = "" if error.field in ("survey", "centerline", "axis") else f"{error.field}: "
        raise InputError(key, value, where + error.reason) from None


def depths_of(hole: Hole, length: float, bottom: float) -> tuple[float, float]:
    """Measured depths of the rod's ends s = 1 and s = 0 in m; the latter at ``bottom`` if neither is given."""
    if hole.from_ is not None and hole.to is not None:
        if abs(hole.to - hole.from_ - length) > SAME_LENGTH * length:
            raise InputError(
                "hole.from",
                f"{hole.from_:g} m",
                f"and hole.to = {hole.to:g} m are {hole.to - hole.from_:.6g} m apart, and the rod is {length:.6g} m "
                "long: give one of them, and the other follows from the rod",
            )
        return hole.from_, hole.to
    if hole.from_ is not None:
        return hole.from_, hole.from_ + length
    lower = bottom if hole.to is None else hole.to
    return lower - length, lower


def angle_of(hole: Hole) -> float:
    """Inclination from the vertical in degrees, of hole.angle_from_vertical or hole.angle_from_horizontal."""
    given = [(name, value) for name in ANGLES if (value := getattr(hole, name)) is not None]
    if len(given) != 1:
        raise InputError(
            "hole.angle_from_vertical",
            None,
            "is missing: give it or hole.angle_from_horizontal (or a hole.survey or hole.centerline)"
            if not given
            else "contradicts hole.angle_from_horizontal: give only one of the two",
        )
    name, value = given[0]
    degrees = round(math.degrees(value), 12)  # "90 deg" makes its way through radians
    low, high = (0.0, 180.0) if name == "angle_from_vertical" else (-90.0, 90.0)
    if not low <= degrees <= high:
        beyond = "beyond horizontal s = 1 is the lower end"
        raise InputError(f"hole.{name}", f"{degrees:g} deg", f'must be from "{low:g} deg" to "{high:g} deg": {beyond}')
    return degrees if name == "angle_from_vertical" else 90.0 - degrees
