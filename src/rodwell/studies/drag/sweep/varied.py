"""Lists and ranges in the file of a well: which inputs vary."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from rodwell.case.checks.explain import LIST_OF_WELLS
from rodwell.case.well.file import LISTED, ROAD_MAP, VARY, named
from rodwell.errors import InputError
from rodwell.studies.labels import label
from rodwell.studies.varied import Place, Varied, checked, is_varied, varied_list, varied_range

PATH = ("survey", "well", "depth_unit")
"""Keys of [hole] that say where it goes: all points of a study share its path."""

_TAPER = (
    "cannot vary: a study goes over keys of [hole], [[hole.section]], [mud], [pressure], [well] and "
    "[[well.operation]]; give one value, and write a taper as one [[string]] for each section"
)

Path = tuple[str | int, ...]


def is_study(data: Mapping[str, Any]) -> bool:
    """Whether the file of a well has a range, or says that it is a study: lists in any other are explained by Well."""
    return data.get("study") is True or any(isinstance(value, str) for _, value in _several(data))


def check_declared(data: Mapping[str, Any]) -> None:
    """Raise an InputError for the first list of values in a file that does not say that it is a study."""
    for path, value in _several(data):
        if data.get("study") is not True and not isinstance(value, str) and path[0] in VARY:
            raise InputError(named(path), value, "is a list" + LIST_OF_WELLS)


def varied_inputs(data: Mapping[str, Any]) -> tuple[Varied, ...]:
    """Return the inputs that vary, in the order of the file.

    Raises
    ------
    InputError
        For a list or range that cannot be read, one where nothing may vary, more than two, or too many points.
    """
    out = []
    for path, value in _several(data):
        why = _fixed(path)
        if why:
            raise InputError(named(path), value, why)
        place = Place(path, named(path), _called(data, path))
        out.append(varied_range(place, value) if isinstance(value, str) else varied_list(place, value))
    return checked(out)


def _several(data: Mapping[str, Any]) -> Iterator[tuple[Path, Any]]:
    """Lists and ranges, where a list is not one by its nature."""
    for section in ("string", *VARY):
        for path, value in _values((section,), data.get(section)):
            if len(path) > 1 and is_varied(value) and (path[:2] != ROAD_MAP or isinstance(value, str)):
                yield path, value


def _values(path: Path, value: Any) -> Iterator[tuple[Path, Any]]:
    """Every value below a place that is no section itself."""
    if isinstance(value, Mapping):
        for key, one in value.items():
            yield from _values((*path, str(key)), one)
    elif isinstance(value, list | tuple) and ".".join(str(part) for part in path) in LISTED:
        for i, one in enumerate(value):
            yield from _values((*path, i), one)
    else:
        yield path, value


def _fixed(path: Path) -> str:
    """Why a value cannot vary; nothing where it can."""
    if path[0] == "string":
        return _TAPER
    if path[0] == "hole" and path[-1] in PATH:
        return "cannot vary: a study keeps the path of the hole; make a file for each"
    if path[:2] == ROAD_MAP:
        return "cannot vary: a study computes the operations, no road map; give one value"
    return "cannot vary: it is a name" if path[-1] == "name" else ""


def _called(data: Mapping[str, Any], path: Path) -> str:
    """What a value is called by people: "bit force of slide", "friction of open hole"."""
    if len(path) == 4:  # a table in double brackets
        table = data[str(path[0])][path[1]][path[2]]
        whose = table.get("name") or table.get("kind") or f"section {int(path[2]) + 1}"
        return f"{str(path[-1]).replace('_', ' ')} of {whose if isinstance(whose, str) else 'the operation'}"
    return label(".".join(str(part) for part in path))
