"""A first case file, commented: for a well string, a guidewire or catheter, a robot in a pipe."""

from __future__ import annotations

import json
import textwrap
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass

from rodwell.case.case import Case, CaseError
from rodwell.case.catalogue import package_catalogue
from rodwell.case.keys import TOP, Key, every_key, purpose
from rodwell.errors import InputError
from rodwell.quantities.units import KINDS as QUANTITIES
from rodwell.quantities.units import to_si

WIDTH = 100


@dataclass(frozen=True)
class Question:
    """What is asked for a first case.

    Attributes
    ----------
    name
        Of the option.
    asks
        In words.
    key
        Where the answer stands, "section.key".
    default
        The answer where none is given, as it is written in a case file.
    field
        The same in the units of the field; "" for the same as ``default``.
    """

    name: str
    asks: str
    key: str
    default: str
    field: str = ""

    def usual(self, units: str) -> str:
        """The answer where none is given, for results in these units."""
        return self.field if units == "field" and self.field else self.default

    def checked(self, answer: str) -> str:
        """Return the answer.

        Raises
        ------
        ValueError
            With what is wrong with a quantity of another kind, or a name that is not in the catalogue.
        """
        kind, name = _keys()[self.key].kind.partition(",")[0], self.key.partition(".")[2]
        if kind in QUANTITIES:
            to_si(answer, kind)
        if name in ("pipe", "material"):
            try:
                getattr(package_catalogue(), name)(answer)
            except InputError as error:
                raise ValueError(error.reason) from None
        return answer


@dataclass(frozen=True)
class Kind:
    """A kind of first case.

    Attributes
    ----------
    about
        In words.
    title
        Title of the case.
    units
        Units of the results, if none are asked for.
    intro
        Comment at the head of the file.
    questions
        What is asked.
    fixed
        Further keys, by section and key, with their values.
    hints
        Keys that stand in the file as comments, with an example.
    """

    about: str
    title: str
    units: str
    intro: str
    questions: tuple[Question, ...]
    fixed: Mapping[str, str | int]
    hints: Mapping[str, str]


_STIFFNESS = "Bending stiffness of the wire, measured"
KINDS: dict[str, Kind] = {
    "well": Kind(
        "a string of pipe in a straight stretch of a well",
        "Drill pipe in an inclined hole",
        "field",
        "A stretch of pipe in a straight hole full of mud. Give the stretch that may buckle, the force at its lower "
        "end, and look at the report: does it buckle, does it leave the wall, what does it bear?",
        (
            Question("pipe", "Pipe, as `rodwell catalogue` names it", "rod.pipe", "5 in 19.5 lb/ft drill pipe"),
            Question("length", "Length of the stretch", "rod.length", "90 m", "300 ft"),
            Question("hole", "Diameter of the hole", "hole.diameter", "216 mm", "8.5 in"),
            Question("angle", "Inclination from the vertical", "hole.angle_from_vertical", "30 deg"),
            Question("mud", "Density of the mud", "mud.density", "1200 kg/m^3", "10 lb/gal"),
            Question("load", "Force at the lower end, compression negative", "load.applied", "-150 kN", "-35000 lbf"),
        ),
        {"rod.ends": "clamped-clamped", "load.at": "bottom", "analysis.modes": 3},
        {"rod.grade": "S-135", "load.until": "-60000 lbf"},
    ),
    "wire": Kind(
        "a guidewire, catheter or other shaft pushed through a vessel",
        "Guidewire in a vessel",
        "mm",
        "A shaft pushed through a straight stretch of vessel. No stiffness is standard: put in what three-point "
        "bending gives for yours; the values below show its order of size. The weight hardly matters and may be 0 N/m.",
        (
            Question("pipe", "Wire or catheter, as `rodwell catalogue` names it", "rod.pipe", "0.035 in guidewire"),
            Question("length", "Length between supports", "rod.length", "120 mm"),
            Question("stiffness", _STIFFNESS, "rod.bending_stiffness", "1400 N·mm²"),
            Question("weight", "Weight per length", "rod.weight_per_length", "0.04 N/m"),
            Question("hole", "Inner diameter of the vessel", "hole.diameter", "6 mm"),
            Question("angle", "Inclination from the vertical", "hole.angle_from_vertical", "90 deg"),
            Question("load", "Push, negative", "load.applied", "-1 N"),
        ),
        {"rod.ends": "clamped-pinned", "analysis.modes": 3},
        {"rod.torsional_stiffness": "1800 N·mm²", "mud.outside": "1060 kg/m^3",
         "load.twist": "0.5 N mm"},
    ),
    "robot": Kind(
        "a slender body that stands or climbs in a pipe",
        "Climbing robot in a pipe",
        "si",
        "The slender body of a robot in a pipe, under its own weight. The report has the critical length: how long it "
        "may be before it buckles with no force at its top at all.",
        (
            Question("material", "Material, as `rodwell catalogue` names it", "rod.material", "PEEK"),
            Question("length", "Length of the body", "rod.length", "3 m"),
            Question("diameter", "Diameter of the body", "rod.outer_diameter", "6 mm"),
            Question("hole", "Inner diameter of the pipe", "hole.diameter", "60 mm"),
            Question("angle", "Inclination of the pipe from the vertical", "hole.angle_from_vertical", "0 deg"),
        ),
        {"rod.ends": "clamped-clamped", "analysis.modes": 3},
        {"rod.inner_diameter": "4 mm", "load.applied": "-1 N"},
    ),
}  # fmt: skip
"""Kinds of first case by name."""


def first_case(kind: str, answers: Mapping[str, str], units: str | None = None, title: str | None = None) -> str:
    """Return the text of a first case file, which runs.

    Parameters
    ----------
    kind
        One of :data:`KINDS`.
    answers
        By name of the question; what is missing is as usual.
    units
        "si", "field" or "mm": units of the results; None: those usual for the kind.
    title
        Title; None: that of the kind.

    Raises
    ------
    InputError
        For a kind, or an answer, that there is not, and for answers that make no case, with what is wrong.
    """
    if kind not in KINDS:
        raise InputError("kind", kind, f"must be one of {', '.join(KINDS)}")
    chosen = KINDS[kind]
    names = [question.name for question in chosen.questions]
    for name in answers:
        if name not in names:
            raise InputError(name, answers[name], f"is not asked for kind {kind}; these are: {', '.join(names)}")
    shown = units or chosen.units
    values: dict[str, str | int] = {q.key: answers.get(q.name, q.usual(shown)) for q in chosen.questions}
    text = _text(chosen, values | dict(chosen.fixed), shown, title or chosen.title)
    try:
        Case.from_dict(tomllib.loads(text), source="first case", text=text)
    except tomllib.TOMLDecodeError as error:
        raise InputError("first case", None, f"an answer cannot stand in a TOML file: {error}") from None
    except CaseError as error:
        raise InputError(
            "first case", None, "; ".join(str(InputError(*problem)) for problem in error.problems)
        ) from None
    return text


def _text(kind: Kind, values: Mapping[str, str | int], units: str, title: str) -> str:
    """The file: head, then each section that is needed, its keys in the order of the schema."""
    head = [*_comment(kind.intro + " `rodwell keys` explains every key."), "",
            f"title = {_written(title)}", f"units = {_written(units)}"]  # fmt: skip
    parts = ["\n".join(head)]
    for section, keys in every_key().items():
        named = [key for key in keys if section != TOP and key.full_name in (*values, *kind.hints)]
        if not named:
            continue
        used = any(key.full_name in values for key in named)
        lines = [*_comment(purpose(section)), f"{'' if used else '# '}[{section}]"]
        for key in named:
            mark = "" if key.full_name in values else "# "
            value = values.get(key.full_name, kind.hints.get(key.full_name, ""))
            lines += [*_comment(_meaning(key)), f"{mark}{key.name} = {_written(value)}"]
        parts.append("\n".join(lines))
    return "\n\n".join(parts) + "\n"


def _meaning(key: Key) -> str:
    limits = f" ({key.allowed})" if key.allowed else ""
    return key.meaning.replace("`", "").replace("**", "") + limits.replace('"', "")


def _comment(text: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, initial_indent="# ", subsequent_indent="# ", break_on_hyphens=False)


def _written(value: str | int) -> str:
    return json.dumps(value, ensure_ascii=False)


def _keys() -> dict[str, Key]:
    return {key.full_name: key for keys in every_key().values() for key in keys}
