"""What the name of a column means: words, units in brackets or behind the name, and how sure that is."""

from __future__ import annotations

import functools
import unicodedata
from dataclasses import dataclass

from rodwell.survey.reading.tables import LONGEST_NAME, Cell

SPELT = {
    "md": {
        "m": "m", "meter": "m", "meters": "m", "metre": "m", "metres": "m", "mtr": "m", "mts": "m", "metros": "m",
        "ft": "ft", "feet": "ft", "foot": "ft", "usft": "ft", "ftus": "ft", "pies": "ft", "f": "ft",
    },
    "inclination": {
        "deg": "degree", "degs": "degree", "degree": "degree", "degrees": "degree", "dega": "degree", "degr": "degree",
        "°": "degree", "grados": "degree", "rad": "radian", "rads": "radian", "radian": "radian", "radians": "radian",
    },
    "force": {"n": "N", "kn": "kN", "lbf": "lbf", "klbf": "klbf", "klb": "klbf", "klbs": "klbf", "kip": "klbf",
              "kips": "klbf", "lb": "lbf", "tonf": "metric_ton*g_0"},
    "well": {},
}  # fmt: skip
SPELT["azimuth"] = SPELT["inclination"]
"""Units as they are written in headers, and what they are."""

COLUMNS: dict[str, frozenset[str]] = {
    "md": frozenset({
        "md", "measured depth", "depth md", "md depth", "md rkb", "mdrkb", "measured depth rkb", "meas depth",
        "measureddepth", "measured depth md", "md measured depth", "mdkb", "md kb", "mdrt", "md rt", "md brt",
    }),
    "inclination": frozenset({
        "inc", "incl", "inclination", "inclin", "hole angle", "deviation", "dev", "angle", "incl angle", "devi",
        "hole inclination", "inclination angle", "inc angle", "inclination from vertical", "hole deviation",
    }),
    "azimuth": frozenset({
        "azi", "az", "azm", "azim", "azimuth", "azi grid", "azi true", "azimuth grid", "azimuth true", "hazi",
        "azim tn", "azim gn", "grid azimuth", "true azimuth", "azi azimuth", "hole azimuth", "azimuth azi",
    }),
    "force": frozenset({"force", "axial force", "effective force", "axial load", "tension", "effective tension"}),
    "well": frozenset({
        "well", "well name", "wellname", "uwi", "well uwi", "well id", "wellid", "wellbore", "wellbore name",
        "wellbore id", "borehole", "borehole name", "borehole id", "hole id", "holeid", "bhid", "api", "api number",
        "well no", "well number",
    }),
}  # fmt: skip
"""Names that mean one thing; lower case, words separated by blanks, units left out."""

WORDS: dict[str, frozenset[str]] = {
    "md": frozenset({
        "md", "depth", "dept", "tiefe", "teufe", "messtiefe", "bohrtiefe", "prof", "profundidad", "profundidade",
        "profondeur", "profondita", "ahd", "ahmd", "mdrkb", "mdkb", "mdrt", "mdbrt", "глубина",
    }),
    "inclination": frozenset({
        "inc", "incl", "inclin", "inclination", "inclinations", "inclinacion", "inclinacao", "inclinaison",
        "inclinazione", "neigung", "drift", "deviation", "devi", "dev", "hdev", "zenith", "наклон",
    }),
    "azimuth": frozenset({
        "azi", "az", "azm", "azim", "azimuth", "azimuths", "azimut", "azimute", "azth", "azmth", "hazi", "dir",
        "direction", "bearing", "richtung", "азимут",
    }),
    "force": frozenset({"force", "tension", "load", "compression", "wob"}),
    "well": frozenset(),
}  # fmt: skip
"""Words that a name of this meaning has; one of them and nothing but :data:`BESIDE` is understood."""

_ANY = frozenset({"hole", "wellbore", "borehole", "well", "survey", "station", "corrected", "corr", "final", "raw",
                  "definitive", "calculated", "calc", "value", "of", "de", "del", "the", "mwd", "gyro"})  # fmt: skip
BESIDE: dict[str, frozenset[str]] = {
    "md": _ANY | {
        "measured", "meas", "along", "ah", "rkb", "kb", "rt", "brt", "df", "kelly", "bushing", "rotary", "table",
        "medida", "medido", "mesuree", "gemessene", "misurata", "log", "drillers", "driller", "measure", "below",
    },
    "inclination": _ANY | {"angle", "from", "vertical", "angulo"},
    "azimuth": _ANY | {
        "grid", "true", "magnetic", "mag", "north", "gn", "tn", "mn", "angle", "reference", "ref", "geographic",
        "from", "angulo", "to",
    },
    "force": frozenset({"axial", "effective"}),
    "well": frozenset(),
}  # fmt: skip
"""Words that may stand beside them."""

OTHER = frozenset({
    "dls", "dogleg", "doglegs", "rate", "build", "turn", "walk", "tvd", "tvdss", "vs", "vsec", "section", "toolface",
    "tf", "gtf", "mtf", "closure", "error", "err", "sigma", "std", "uncertainty", "correction", "declination",
    "convergence", "temp", "temperature", "gravity", "offset", "displacement", "departure", "delta", "diff", "change",
    "water", "casing", "bit", "latitude", "lat", "longitude", "long", "lon", "northing", "easting", "subsea",
    "vertical", "tortuosity", "course", "hookload", "interval", "tie",
})  # fmt: skip
"""Words of other quantities: a column that has one of them is neither depth along the hole nor one of its angles."""

LOOKS = {"dip": "inclination", "slope": "inclination", "tilt": "inclination", "plunge": "inclination",
         "heading": "azimuth", "trend": "azimuth", "yaw": "azimuth"}  # fmt: skip
STARTS = {"inc": "inclination", "ink": "inclination", "dev": "inclination", "azi": "azimuth", "azy": "azimuth",
          "azm": "azimuth", "depth": "md", "dept": "md"}  # fmt: skip
"""Words, and beginnings of words, that look like one of the quantities and are not understood."""

CERTAIN, UNDERSTOOD, LOOKALIKE = 3, 2, 1


@dataclass(frozen=True)
class Meaning:
    """What a header cell means: "" or a key of :data:`COLUMNS`; how sure that is; unit as written; the words."""

    kind: str = ""
    sure: int = 0
    unit: str = ""
    words: tuple[str, ...] = ()


def meaning(cell: Cell) -> Meaning:
    """Meaning of a header cell, such as "MD [ft]", "md_m", "Azi (azimuth)(°)". Linear in the length of the text."""
    text = cell.strip() if isinstance(cell, str) else ""
    return _meaning_of(text) if 0 < len(text) <= LONGEST_NAME else Meaning()


@functools.lru_cache(maxsize=4096)
def _meaning_of(text: str) -> Meaning:
    name, groups = _brackets(text)
    words = words_of(name)
    best = Meaning(words=tuple(words))
    for kind in COLUMNS:
        found = _as(kind, words, groups)
        if found.sure > best.sure:
            best = found
    if not best.kind and any(_unit_of("azimuth", group) for group in groups) and not OTHER & set(words):
        return Meaning("azimuth", LOOKALIKE, "", tuple(words))  # an angle, whatever it is called
    return best


def _as(kind: str, words: list[str], groups: list[str]) -> Meaning:
    """A name as one of ``kind``: certain, understood, only like one, or nothing."""
    unit, unknown, rest = "", "", list(words)
    if len(rest) > 1 and rest[-1] in SPELT[kind]:
        unit = rest.pop()
    for group in groups:
        inner = words_of(group.lower())  # kN is one word
        if spelt := _unit_of(kind, group):
            unit = spelt
            rest += [word for word in inner if word not in SPELT[kind]]
        elif inner and all(word in WORDS[kind] or word in BESIDE[kind] or word in OTHER for word in inner):
            rest += inner
        else:
            unknown = group.strip()
    unit = unit or unknown
    if " ".join(rest) in COLUMNS[kind] or "".join(rest) in COLUMNS[kind]:
        return Meaning(kind, CERTAIN, unit, tuple(rest))
    foreign = {word for word in rest if word in OTHER and word not in BESIDE[kind]}
    if foreign or kind == "well":
        return Meaning()
    if any(word in WORDS[kind] for word in rest):
        known = all(word in WORDS[kind] or word in BESIDE[kind] for word in rest) and kind != "force"
        return Meaning(kind, UNDERSTOOD if known else LOOKALIKE, unit, tuple(rest))
    starts = (STARTS.get(word[:n]) for word in rest for n in (3, 4, 5))
    if kind in starts or any(LOOKS.get(word) == kind for word in rest):
        return Meaning(kind, LOOKALIKE, unit, tuple(rest))
    return Meaning()


def _unit_of(kind: str, text: str) -> str:
    """The unit that a text in brackets names, as it is written there; "" if none."""
    plain = text.strip().lower().replace("º", "°").replace("â°", "°").replace("�", "°").strip(" .")
    if plain in SPELT[kind]:
        return plain
    words = words_of(plain)
    known = [word for word in words if word in SPELT[kind]]
    others_fit = all(word in BESIDE[kind] or word in WORDS[kind] for word in words if word not in known)
    return known[0] if len(known) == 1 and others_fit else ""


def unit_word(kind: str, cell: Cell) -> str:
    """The unit of ``kind`` that a cell of a line of units names; "" if it names none."""
    return _unit_of(kind, cell.strip(" []()")) if isinstance(cell, str) and len(cell) <= LONGEST_NAME else ""


def words_of(text: str) -> list[str]:
    """Words of a name in lower case without accents: separated by blanks, _ . - / : , or as in "HoleAngle"."""
    text = text.replace("º", "°").replace("Â°", "°")
    plain = [c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c)]
    out: list[str] = []
    word = ""
    for before, c in zip(["", *plain], plain, strict=False):
        if c.isalnum() or c == "°":
            if ((c.isupper() and before.islower()) or c == "°") and word:
                out.append(word)
                word = ""
            word += c.lower()
        elif word:
            out.append(word)
            word = ""
    return [*out, word] if word else out


def _brackets(text: str) -> tuple[str, list[str]]:
    """A name without what stands in brackets, and what stood in them; an open bracket ends with the text."""
    outside: list[str] = []
    inside: list[str] = []
    groups, depth = [], 0
    for c in text:
        if c in "([{":
            depth += 1
        elif c in ")]}" and depth:
            depth -= 1
            if not depth:
                groups.append("".join(inside))
                inside = []
        else:
            (inside if depth else outside).append(c)
    if inside:
        groups.append("".join(inside))
    return "".join(outside), groups
