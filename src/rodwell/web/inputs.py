"""What can be moved in a case: each number of it, in its own words and units, and the case with other numbers."""

from __future__ import annotations

import copy
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel

from rodwell.case import schema
from rodwell.case.case import Case
from rodwell.case.hole.schema import Hole
from rodwell.errors import InputError
from rodwell.quantities.units import to_si
from rodwell.quantities.written import number_and_rest

DEFAULT: dict[str, Any] = {
    "title": "Rod in a horizontal cylinder",
    "dimensionless": {"weight": 15.0, "alpha": 90.0, "clearance": 0.01, "ends": "clamped-clamped"},
    "load": {"twist": 0.0},
    "analysis": {"modes": 3, "rtol": 1e-8},
}
"""What is explored where no case file is given: the rod of the paper's Fig. 3(c)."""

SECTIONS: dict[str, type[BaseModel]] = {
    "dimensionless": schema.Dimensionless, "rod": schema.RodInput, "hole": Hole, "mud": schema.Mud,
    "pressure": schema.PressureAtEnd, "load": schema.LoadInput,
}  # fmt: skip
"""Sections whose numbers can be moved; the load itself has a slider of its own."""

NO_NUMBERS = (
    "pipe", "material", "grade", "ends", "at", "kind", "applied", "until", "yield_strength", "gravity", "sections"
)  # fmt: skip
"""Keys that are names, that belong to the load, or that move nothing which is shown."""

ENDS = tuple(
    f"{a}-{b}" for a in ("clamped", "pinned", "guided", "free") for b in ("clamped", "pinned", "guided", "free")
)
"""Ends with which branches can be followed."""

MOST_MODES = 6
"""Branches that a page shows at most: more can hardly be told apart."""

REACH = {"twist": ("moment", 10.0), "build": ("curvature", 0.3), "walk": ("curvature", 0.3)}
"""Numbers of either sign: their dimension, and how far sliders go both ways in units of B and L."""

TWIST_UNIT = {"si": "N m", "field": "ft lbf", "mm": "N mm"}
WEIGHT_UNIT = {"si": (1.0, "N/m"), "field": (4.4482216152605 / 0.3048, "lbf/ft"), "mm": (1e3, "N/mm")}
LABELS = {"dimensionless.weight": "weight γ", "dimensionless.alpha": "inclination α", "load.twist": "end twist T₁",
          "dimensionless.clearance": "clearance Δ/L", "dimensionless.poisson": "Poisson's ratio ν",
          "dimensionless.build": "build of the hole", "dimensionless.walk": "walk of the hole"}  # fmt: skip
UNITS = {
    "dimensionless.weight": "B/L³",
    "dimensionless.alpha": "deg",
    "dimensionless.clearance": "",
    "dimensionless.build": "1/L",
    "dimensionless.walk": "1/L",
    "load.twist": "B/L",
}
BUILD_UNIT = {"si": "deg/30 m", "field": "deg/100 ft", "mm": "rad/m"}


@dataclass(frozen=True)
class Control:
    """A number that can be moved.

    Attributes
    ----------
    name
        Section and key, as in the case file.
    label, hint
        What stands beside the slider, and what the key means.
    unit
        As the user wrote it; empty for a plain number.
    value, low, high
        The number given, and the ends of the slider; a number beyond them can be typed.
    given
        Whether the case has it: what it lacks is added only once it is moved.
    """

    name: str
    label: str
    hint: str
    unit: str
    value: float
    low: float
    high: float
    given: bool = True


def controls(data: Mapping[str, Any], case: Case) -> list[Control]:
    """Return the numbers of a case that can be moved, in the order of its sections.

    Parameters
    ----------
    data
        Content of the case file.
    case
        The same as a case.
    """
    out = []
    for section, model in SECTIONS.items():
        if section == "rod" and "string" in data:
            continue  # its length is a check of those of the sections
        for key, field in model.model_fields.items():
            given = data.get(section, {}).get(key)
            read = None if key in NO_NUMBERS or given is None else _read(given)
            if read is not None:
                out.append(_control(f"{section}.{key}", field.description or "", *read))
    out += _of_string(data.get("string", ()))
    names = {control.name for control in out}
    if case.rod is not None and "pipe" in data.get("rod", {}) and not names & {"rod.density", "rod.weight_per_length"}:
        scale, unit = WEIGHT_UNIT[case.scales.system.name] if case.scales else (1.0, "N/m")
        meaning = schema.RodInput.model_fields["weight_per_length"].description or ""
        weight = _control("rod.weight_per_length", meaning, float(f"{case.rod.weight_in_air / scale:.6g}"), unit)
        out.insert(1, _replaced(weight, given=False))
    if "load.twist" not in names:
        unit = "" if case.scales is None else TWIST_UNIT[case.scales.system.name]
        twist = _control("load.twist", schema.TWIST, 0.0, unit)
        out.append(_replaced(twist, given=False))
    section = "dimensionless" if case.scales is None else "hole"
    for key in ("build", "walk") if _may_bend(data) else ():
        if f"{section}.{key}" not in names:
            unit = "" if case.scales is None else BUILD_UNIT[case.scales.system.name]
            bend = _control(f"{section}.{key}", Hole.model_fields[key].description or "", 0.0, unit)
            out.append(_replaced(bend, given=False))
    return [_with_range(control, case) for control in out]


def _of_string(string: Sequence[Mapping[str, Any]]) -> list[Control]:
    """The numbers of each [[string]], named by its place from the bottom, from 1."""
    out = []
    for number, section in enumerate(string, 1):
        called = section.get("name") or section.get("pipe") or f"section {number}"
        for key, field in schema.StringInput.model_fields.items():
            read = None if key in (*NO_NUMBERS, "joints") else _read(section.get(key))
            if read is not None:
                control = _control(f"string.{number}.{key}", field.description or "", *read)
                out.append(_replaced(control, label=f"{called}: {key.replace('_', ' ')}"))
    return out


def _may_bend(data: Mapping[str, Any]) -> bool:
    """Whether the hole, straight as given, may be bent: a uniform rod lies in it."""
    if "dimensionless" in data:
        return True
    hole = data.get("hole", {})
    return "string" not in data and not any(name in hole for name in ("survey", "centerline", "section"))


def _read(given: object) -> tuple[float, str] | None:
    """Number and unit of what stands in a case file; None for a text without, or one with an uncertainty."""
    if isinstance(given, bool) or not isinstance(given, int | float | str):
        return None
    if not isinstance(given, str):
        return float(given), ""
    read = number_and_rest(given)
    if read is None or not read[1].strip() or "±" in given or "+" in read[1]:
        return None
    return float(read[0]), read[1].strip()


def _control(name: str, meaning: str, value: float, unit: str) -> Control:
    section, *_, key = name.split(".")
    label = LABELS.get(name) or f"{section} {key.replace('_', ' ')}"
    return Control(name, label, meaning, unit or UNITS.get(name, ""), value, 0.0, 0.0)


def _replaced(control: Control, **changes: Any) -> Control:
    return Control(**{**vars(control), **changes})


def _with_range(control: Control, case: Case) -> Control:
    """The control with the ends of its slider: what may sensibly be tried from where it stands."""
    key, value = control.name.split(".")[-1], control.value
    low, high = value / 2.0, 2.0 * value
    if "angle" in key or key == "alpha":
        low, high = 0.0, 90.0
    elif key == "poisson":
        low, high = 0.0, 0.5
    elif key in REACH:
        dimension, reach = REACH[key]
        if case.scales is not None:
            reach *= case.scales.factor(dimension) / to_si(f"1 {control.unit}", dimension)
        reach = float(f"{max(reach, 3.0 * abs(value)):.1g}")
        low, high = -reach, reach
    elif control.name == "dimensionless.weight":
        low, high = 0.0, max(60.0, 4.0 * value)
    elif value == 0.0:
        low, high = 0.0, 1.0
    return _replaced(control, low=float(f"{low:.3g}"), high=float(f"{high:.3g}"))


def moved(data: Mapping[str, Any], known: list[Control], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the content of a case file with other numbers, ends and modes; what was not moved stays as it was written.

    Raises
    ------
    InputError
        For a name that is not known, or what is no number.
    """
    out = copy.deepcopy(dict(data))
    by_name = {control.name: control for control in known}
    for name, value in values.items():
        if name == "ends":
            if value not in ENDS:
                raise InputError("ends", value, f"must be one of {', '.join(ENDS)}")
            out.setdefault("dimensionless" if "dimensionless" in out else "rod", {})["ends"] = value
        elif name == "modes":
            if value not in range(1, MOST_MODES + 1) or isinstance(value, bool):
                raise InputError("modes", value, f"must be a whole number from 1 to {MOST_MODES}")
            out.setdefault("analysis", {})["modes"] = value
        elif name == "sections":
            _put_sections(out, value)
        elif name in by_name:
            _put(out, by_name[name], value)
        else:
            raise InputError(name, value, f"cannot be moved here; there are ends, modes, {', '.join(by_name)}")
    return out


def _put(data: dict[str, Any], control: Control, value: object) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(control.name, value, "must be a number")
    if value == control.value:
        return  # as it was written
    section, *number, key = control.name.split(".")
    plain = "dimensionless" in data or not control.unit
    into = data["string"][int(number[0]) - 1] if number else data.setdefault(section, {})
    into[key] = float(value) if plain else f"{float(value)!r} {control.unit}"
    if number and key in ("length", "joint_length"):
        data.get("rod", {}).pop("length", None)  # of the whole, a check of what is moved here


def _put_sections(data: dict[str, Any], value: object) -> None:
    """Sections of a rod without dimensions, in a line; empty: a uniform rod."""
    if "dimensionless" not in data:
        raise InputError("sections", value, "are those of the case file here: move what [[string]] gives of each")
    if not isinstance(value, str):
        raise InputError("sections", value, "must be text, length:stiffness:weight of each section, parted by commas")
    data["dimensionless"].pop("sections", None)
    if value:
        data["dimensionless"]["sections"] = value


def weight_below(case: Case, load: Mapping[str, Any]) -> float:
    """By how much F is above the force that a case file gives with this [load], in B/L²: the rod's own weight."""
    return case.problem.hung_weight if load.get("at") == "bottom" else 0.0


def force_text(case: Case, force: float) -> Any:
    """A force in B/L², tension positive, as a case file has it, with every digit."""
    if case.scales is None:
        return force
    size = abs(force) * case.scales.factor("force")
    return f"{size!r} N {'compression' if force <= 0.0 else 'tension'}"


def as_toml(data: Mapping[str, Any]) -> str:
    """Return the content of a case file as text."""
    nested = [(f"[{name}]", value) for name, value in data.items() if isinstance(value, Mapping)]
    for name, value in data.items():
        if isinstance(value, list) and value and all(isinstance(one, Mapping) for one in value):
            nested += [(f"[[{name}]]", one) for one in value]
    heads = {head.strip("[]") for head, _ in nested}
    lines = [f"{key} = {_toml(value)}" for key, value in data.items() if key not in heads]
    for head, keys in nested:
        lines += ["", head, *(f"{key} = {_toml(value)}" for key, value in keys.items())]
    return "\n".join(lines).lstrip("\n") + "\n"


def _toml(value: object) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str | bool) else repr(value)
