"""Numbers and units as people write them: thousands separators, units of the trade, capitals, and what was meant.

What has one meaning only is understood; what may mean two things is refused with both of them, written out.
"""

from __future__ import annotations

import re

_MANTISSA = (
    r"\d{1,3}(?:[ \u00a0\u2009\u202f'’_]\d{3})+(?:\.\d*)?"  # 35 000, 35'000, 35_000
    r"|[1-9]\d{0,2}(?:,\d{3}){2,}(?:\.\d*)?"  # 1,234,567
    r"|[1-9]\d{0,2},\d{3}\.\d+"  # 35,000.5
    r"|\d+\.?\d*|\.\d+"
)
NUMBER = rf"[+-]?(?:{_MANTISSA})(?:[eE][+-]?\d{{1,3}})?(?![\d.,])"
"""A number as text, with separators of thousands where they can mean nothing else."""

LONGEST = 200
"""Characters that a number with its unit may have."""

_LEADING = re.compile(rf"\s*({NUMBER})\s*(.*?)\s*")
_ONE_COMMA = re.compile(r"\s*([+-]?\d+),(\d+)\s*([^\d,.].*?)?\s*")
_CONTINENTAL = re.compile(r"\s*([+-]?\d{1,3}(?:\.\d{3})+),(\d+)\s*(.*?)\s*")
_DOTS = re.compile(r"\s*([+-]?\d{1,3}(?:\.\d{3}){2,})\s*(.*?)\s*")
_MIXED = re.compile(r"\s*([+-]?)(\d+)[\s-]+(\d+)/(\d+)\s*(.*?)\s*")

_DEGREES = {
    **dict.fromkeys(("°F", "degF", "deg F", "F", "° F"), "delta_degF"),
    **dict.fromkeys(("°C", "degC", "deg C", "C", "° C"), "delta_degC"),
}

BY_KIND: dict[str, dict[str, str]] = {
    "length": {"mil": "thou", "mils": "thou", "Fr": "french_size", "F": "french_size", '"': "in", "″": "in", "''": "in",
               "'": "ft", "′": "ft"},
    "temperature change": _DEGREES,
    "thermal expansion": {f"/{name}": f"1/{unit}" for name, unit in _DEGREES.items()} | {"/K": "1/K"},
}  # fmt: skip
"""Names that mean one thing for one kind of quantity and another thing elsewhere: mils and French sizes of length,
degrees of a change of temperature, which have no zero."""

OF_FORCE = ("force", "force per length", "moment")
"""Kinds in which klb and klbs, as the field writes them, are thousands of pounds-force."""

EVERYWHERE = {
    "Nm": "N*m", "kNm": "kN*m", "MNm": "MN*m", "mNm": "mN*m", "Nmm": "N*mm", "Nm^2": "N*m^2", "Nmm^2": "N*mm^2",
    "kNm^2": "kN*m^2", "Msi": "Mpsi", "SG": "sg", "s*g": "sg", "S*G": "sg", "g/cc": "g/cm^3", "kips": "kip",
}  # fmt: skip
"""Names that the registry of units does not have, or takes for something that no rod has (Nm of yarn)."""

DEFINITIONS = (
    "pounds_per_gallon = pound / gallon = ppg",
    "specific_gravity = 1000 * kilogram / meter ** 3 = sg",
    "pounds_per_foot = force_pound / foot = ppf",
    "pounds_per_cubic_foot = pound / foot ** 3 = pcf",
    "bar_gauge = bar = barg",
    "psi_gauge = force_pound / inch ** 2 = psig",
    "kilodecanewton = 10000 * newton = kdaN",
    "ton_force_us = 2000 * force_pound = tonf_us",
    "ton_force_uk = 2240 * force_pound = tonf_uk",
    "french_size = meter / 3000",
    "ten_meters = 10 * meter",
    "thirty_meters = 30 * meter",
    "hundred_meters = 100 * meter",
    "hundred_feet = 100 * foot",
)
"""Units of the trade. Gauge pressures are counted from the atmosphere, as all pressures of a case are."""

GAUGE = re.compile(r"\b(barg|psig)\b")
"""Units of gauge pressure."""

REFUSED = {
    "tonf": (
        "is 2000 lbf in the US, 2240 lbf in the UK and 1000 kgf where tons are metric: write tonf_us, tonf_uk or tf, "
        "or the force in kN"
    ),
    "psia": "is counted from vacuum, pressures here from the atmosphere: take off 14.696 and write psi (or psig)",
    "bara": "is counted from vacuum, pressures here from the atmosphere: take off 1.01325 and write bar (or barg)",
}
"""Units that are not taken, and what to write instead."""

INTENDED = (
    "N", "kN", "MN", "daN", "kdaN", "lbf", "klbf", "kip", "kgf", "m", "mm", "cm", "km", "µm", "um", "ft", "in", "yd",
    "Pa", "kPa", "MPa", "GPa", "psi", "ksi", "Mpsi", "bar", "barg", "psig", "deg", "rad", "kg", "g", "lb", "gal", "ppg",
    "ppf", "pcf", "sg", "s", "N*m", "kN*m",
)  # fmt: skip
"""Names that capitals are compared with, the likeliest first."""

PER_LENGTH = {"10m": "ten_meters", "30m": "thirty_meters", "100m": "hundred_meters", "100ft": "hundred_feet"}
"""Lengths over which the field counts degrees: deg/30 m, deg/100 ft."""

_PER_LENGTH = re.compile(r"/\s*(\d+)\s*(ft|m)\b")
_WORD = re.compile(r"[A-Za-zµμ]+")


class AmbiguousUnitError(ValueError):
    """A unit that means several things; the message says what to write instead."""


_POWER_OF_TEN = re.compile(r"(?<=\d)\s*[×x*·]\s*10([⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]{1,3})")
_RAISED = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹", "-+0123456789")


def as_typed(text: str) -> str:
    """A number as it is written in results, as keyboards have it: −6.4 × 10⁻⁵ as -6.4e-5."""
    return _POWER_OF_TEN.sub(lambda found: f"e{found[1].translate(_RAISED)}", text.replace("−", "-"))


def number_and_rest(text: str) -> tuple[float, str] | None:
    """The number that a text begins with, and what follows; None where it begins with none that can be read."""
    found = _LEADING.fullmatch(as_typed(text)) if len(text) <= LONGEST else None
    return None if found is None else (_number(found[1]), found[2])


def _number(text: str) -> float:
    return float(re.sub(r"(?<=\d)[ \u00a0\u2009\u202f'’_,](?=\d)", "", text))


def remedy(text: str) -> str:
    """How to write a number that cannot be read, ending in "; " or ", "; nothing where nothing is known of it."""
    text = text.replace("−", "-")
    found = _CONTINENTAL.fullmatch(text)
    if found is not None:
        return f'"{_joined(found[1].replace(".", "") + "." + found[2], found[3])}" with a decimal point, not a comma; '
    found = _DOTS.fullmatch(text)
    if found is not None:
        return f'"{_joined(found[1].replace(".", ""), found[2])}" without points between thousands; '
    found = _ONE_COMMA.fullmatch(text)
    if found is not None:
        point = _joined(f"{found[1]}.{found[2]}", found[3])
        if len(found[2]) == 3 and found[1].lstrip("+-") not in ("", "0") and len(found[1].lstrip("+-")) <= 3:
            whole = _joined(found[1] + found[2], found[3])
            return f'"{whole}" if the comma separates thousands or "{point}" if it is a decimal comma; '
        return f'a decimal point, not a comma, "{point}"; '
    found = _MIXED.fullmatch(text)
    if found is not None and int(found[4]):
        value = int(found[2]) + int(found[3]) / int(found[4])
        return f'"{_joined(f"{found[1]}{value:g}", found[5])}"; '
    return "a decimal point, not a comma, " if "," in text else ""


def _joined(number: str, unit: str | None) -> str:
    return f"{number} {unit or ''}".rstrip()


_DIRECTED = re.compile(r"(.*?)\s*\b(?:of\s+|in\s+)?(tension|pull|pulling|compression|push|pushing)\s*", re.IGNORECASE)
_PULLS = ("tension", "pull", "pulling")


def direction(text: str) -> tuple[str, int]:
    """A force without the word that says how it acts, and +1 for tension, −1 for compression, 0 for no such word."""
    found = _DIRECTED.fullmatch(text) if len(text) <= LONGEST else None
    if found is None:
        return text, 0
    return found[1], 1 if found[2].lower() in _PULLS else -1


def plain_unit(text: str, kind: str = "") -> str:
    """A unit as the registry reads it: ft-lbf, N.m, kg/m3, in., deg/100 ft, and names of the trade.

    Raises
    ------
    AmbiguousUnitError
        For a unit that means several things, with what to write instead.
    """
    unit = text.strip().replace("·", "*").replace("⋅", "*").replace("⁴", "^4").replace("²", "^2").replace("³", "^3")
    unit = re.sub(r"(?<=[A-Za-z])[.-](?=[A-Za-z])", "*", unit)  # ft-lbf, N.m
    unit = re.sub(r"(?<=[A-Za-z])\.(?=\s|/|\)|\*|$)", "", unit)  # in., ft.
    unit = re.sub(r"(?<=[A-Za-z])([234])(?![\d.])", r"^\1", unit)  # mm2, m3, in4
    unit = _PER_LENGTH.sub(lambda found: "/" + PER_LENGTH.get(found[1] + found[2], found[0][1:]), unit)
    if kind in OF_FORCE:
        unit = re.sub(r"\bklbs?\b", "klbf", unit)
    for name, why in REFUSED.items():
        if re.search(rf"\b{name}\b", unit):
            raise AmbiguousUnitError(f"{name!r} {why}")
    known = BY_KIND.get(kind, {})
    if unit in known:
        return known[unit]
    return re.sub(r"[A-Za-z]+(?:\*[gG]\b)?(?:\^\d)?", lambda found: EVERYWHERE.get(found[0], found[0]), unit)


def with_other_capitals(unit: str) -> list[str]:
    """The unit with the names in it spelt as units are that differ by capitals only, the likeliest first."""
    words = {word for word in _WORD.findall(unit) if word not in INTENDED or word in ("mN", "Mm")}
    out = [unit]
    for word in words:
        near = [name for name in INTENDED if name.lower() == word.lower() and name != word]
        near += [name.replace("*", " ") for name in INTENDED if name.replace("*", "").lower() == word.lower() != name]
        if near:
            out = [re.sub(rf"(?<![A-Za-z]){word}(?![A-Za-z])", name, one) for one in out for name in near]
    return [one for one in dict.fromkeys(out) if one != unit]
