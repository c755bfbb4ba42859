"""Messages in the units that the user wrote, and what follows from how a value was written."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from rodwell.case.facts import Fact
from rodwell.errors import InputError
from rodwell.quantities.text import minus
from rodwell.quantities.units import in_unit_of
from rodwell.quantities.written import GAUGE, number_and_rest

_METRES = re.compile(r"(-?\d[\d.]*(?:e[+-]?\d+)?) m(?![\w/²³^*·])")
_PER_METRE = re.compile(r"(-?\d[\d.]*(?:e[+-]?\d+)?) N/m\b")
_LISTED = re.compile(r"(string|hole\.section) (\d+)")
_FIELD = re.compile(r"\b(in|ft|lbf?|klbf|gal|ppg|ppf|pcf|psig?|ksi|inch|inches|feet|foot)\b|[\"″′]")


def in_written_units(reason: str, written: object) -> str:
    """The reason with lengths, and weights per length, in the user's units too: "of 0.127 m (5 in)".

    Parameters
    ----------
    reason
        What is said, in SI units.
    written
        The value in question as it was written; without a unit nothing is added.
    """
    found = number_and_rest(written) if isinstance(written, str) else None
    unit = "" if found is None else found[1]
    if not unit:
        return reason
    length = unit if _goes_with(unit, "m") else "ft" if _FIELD.search(unit) else "m"
    if length != "m":
        reason = _METRES.sub(lambda one: f"{one[0]} ({_in(one[1], 'm', length)})", reason)
    if _FIELD.search(unit):
        reason = _PER_METRE.sub(lambda one: f"{one[0]} ({_in(one[1], 'N/m', 'lbf/ft')})", reason)
    return reason


def _goes_with(unit: str, other: str) -> bool:
    try:
        in_unit_of(1.0, unit, other)
    except ValueError:
        return False
    return True


def _in(number: str, unit: str, other: str) -> str:
    return minus(f"{in_unit_of(float(number), unit, other):.6g} {other}")


def _as_written(data: Mapping[str, Any], field: str, value: object) -> object:
    """What the user wrote for a key, rather than what became of it; None stays None."""
    section, _, key = field.rpartition(".") if _LISTED.match(field) else field.partition(".")
    written = data.get(section)
    number = _LISTED.match(section)
    if number is not None:
        whole = data if number[1] == "string" else data.get("hole", {})
        sections = whole.get(number[1].rpartition(".")[2], ())
        written = sections[int(number[2]) - 1] if int(number[2]) <= len(sections) else None
    return written[key] if value is not None and isinstance(written, Mapping) and key in written else value


def in_users_words(data: Mapping[str, Any], error: InputError) -> tuple[str, object, str]:
    """Key, value as it was written, and reason in the units that were written."""
    value = _as_written(data, error.field, error.value)
    written = _a_length(data) if value is None and error.field == "hole.section" else value
    return error.field, value, in_written_units(error.reason, written)


def _a_length(data: Mapping[str, Any]) -> object:
    """A length of the sections of the hole as it was written: an error of all of them is told in its unit."""
    first = data["hole"]["section"][0]
    return next((first[key] for key in ("length", "to", "from") if key in first), None)


def gauge_facts(data: Mapping[str, Any]) -> tuple[Fact, ...]:
    """What is said of pressures that were written as gauge pressures."""
    section = data.get("pressure")
    texts = [text for text in section.values() if isinstance(text, str)] if isinstance(section, Mapping) else []
    written = [text for text in texts if GAUGE.search(text)]
    if not written:
        return ()
    note = f"{', '.join(written)}, as all pressures here; absolute ones are 1.01325 bar (14.696 psi) higher"
    return (Fact("pressures", "gauge, counted from the atmosphere", note=note),)
