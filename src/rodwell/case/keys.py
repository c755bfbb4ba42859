"""Every key of a case file, as the schema has it: kind, unit, default, what is allowed, examples and meaning."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from rodwell.case import schema
from rodwell.case.checks.explain import SECTIONS, plain, unknown
from rodwell.case.kinds import Several
from rodwell.errors import InputError
from rodwell.quantities.units import KINDS

TOP = "top"
"""Name for the keys at the top of the file, outside all sections."""


@dataclass(frozen=True)
class Key:
    """A key of a case file.

    Attributes
    ----------
    section, name
        Where it stands; section :data:`TOP` for the keys before the first section.
    kind
        Kind of quantity ("length"), "number", "whole number", "text", "true or false" or "list of text".
    unit
        SI unit of a quantity, "" for others; any unit of the kind may be written.
    allowed
        What is allowed beyond the kind, in words; "" for no limit.
    required
        Whether a section must have it.
    default
        What holds where it is not given, as it would be written; "" for nothing.
    examples
        As they would be written in TOML.
    meaning
        In a few words, with names of keys in backquotes.
    """

    section: str
    name: str
    kind: str
    unit: str
    allowed: str
    required: bool
    default: str
    examples: tuple[str, ...]
    meaning: str

    @property
    def full_name(self) -> str:
        """Section and key, or the key alone at the top of the file."""
        return self.name if self.section == TOP else f"{self.section}.{self.name}"

    def as_dict(self) -> dict[str, Any]:
        """Everything as plain data, for JSON."""
        return {
            "key": self.full_name, "kind": self.kind, "unit": self.unit, "allowed": self.allowed,
            "required": self.required, "default": self.default, "examples": list(self.examples),
            "meaning": self.meaning,
        }  # fmt: skip


def purpose(section: str) -> str:
    """Return what a section is for, in a sentence."""
    if section == TOP:
        return (schema.CaseFile.__doc__ or "").partition("\n")[0]
    text = (SECTIONS[section].__doc__ or "").partition("\n")[0].partition(": ")[2]
    return text[:1].upper() + text[1:]


def keys_of(section: str) -> tuple[Key, ...]:
    """Return the keys of a section, in the order of the schema; of :data:`TOP`, those outside all sections."""
    model: type[BaseModel] = schema.CaseFile if section == TOP else SECTIONS[section]
    fields = {name: field for name, field in model.model_fields.items() if section != TOP or name not in SECTIONS}
    return tuple(key_of_field(section, field.alias or name, field) for name, field in fields.items())


def every_key() -> dict[str, tuple[Key, ...]]:
    """Return the keys of all sections."""
    return {section: keys_of(section) for section in (TOP, *SECTIONS)}


def keys_named(name: str) -> tuple[Key, ...]:
    """Return the keys of a section, one key ("rod.length"), or all keys of a name ("length").

    Raises
    ------
    InputError
        If there is no such section or key, with the nearest, or with what is written instead.
    """
    asked = name.strip().strip("[]")
    listed = "hole.section"  # the one section whose name has a dot
    section, _, key = (listed, "", asked[len(listed) + 1 :]) if f"{asked}.".startswith(f"{listed}.") else (
        asked.partition(".")
    )  # fmt: skip
    section = plain(section)
    if not key:
        if section == TOP or section in SECTIONS:
            return keys_of(section)
        found = tuple(one for keys in every_key().values() for one in keys if one.name == section)
        if found:
            return found
        raise InputError("keys", name, unknown((asked,)))
    if section == TOP or section in SECTIONS:
        found = tuple(one for one in keys_of(section) if one.name == plain(key))
        if found:
            return found
    raise InputError("keys", name, unknown((section, key)) if section != TOP else unknown((key,)))


def key_of_field(section: str, name: str, field: FieldInfo) -> Key:
    """Return a key from its field in a schema."""
    kind, allowed = _kind(field)
    extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
    unit = KINDS[kind][0].replace("*", " ") if kind in KINDS else ""
    default = "" if field.is_required() or field.default is None else _default(field.default, unit)
    examples = tuple(written(example) for example in field.examples or ())
    return Key(section, name, kind + (", or a list" if _takes_list(field) else ""), unit,
               str(extra.get("allowed") or allowed), field.is_required(), default, examples,
               field.description or "")  # fmt: skip


def _default(value: Any, unit: str) -> str:
    return written(f"{value:g} {unit}" if unit else value)


def written(value: Any) -> str:
    """Return a value as TOML has it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list | tuple):
        return f"[{', '.join(written(one) for one in value)}]"
    return f'"{value}"' if isinstance(value, str) else f"{value:g}"


def _validators(annotation: Any) -> Iterator[Any]:
    """What reads a value, from its annotation: the functions of its validators, outermost first."""
    for part in (*getattr(annotation, "__metadata__", ()), *get_args(annotation)):
        yield getattr(part, "func", None)
        yield from _validators(part)


def _readers(field: FieldInfo) -> list[Any]:
    found = [getattr(part, "func", None) for part in field.metadata]
    return [one for one in (*found, *_validators(field.annotation)) if one is not None]


def _takes_list(field: FieldInfo) -> bool:
    return any(isinstance(one, Several) for one in _readers(field))


def _kind(field: FieldInfo) -> tuple[str, str]:
    """Kind of a value, and what is allowed."""
    for one in _readers(field):
        if hasattr(one, "kind"):
            return one.kind, one.allowed
    types = {field.annotation, *get_args(field.annotation)}
    if int in types:
        bounds = {type(one).__name__: one for one in field.metadata}
        least, most = getattr(bounds.get("Ge"), "ge", 1), getattr(bounds.get("Le"), "le", schema.MOST_MODES)
        return "whole number", f"from {least} to {most}"
    if bool in types or any(bool in get_args(one) for one in types):
        return "true or false", ""
    return ("list of text", "") if list[str] in types else ("text", "")
