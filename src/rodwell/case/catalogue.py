"""Pipes, materials and grades by name: the catalogue of the package (``data/*.toml``) and files of the user's."""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, lru_cache
from importlib import resources
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from rodwell.case.entries import Entry, Grade, Material, Pipe
from rodwell.case.file import LARGEST_CATALOGUE, decoded, first_bytes, parsed
from rodwell.errors import InputError

Raw = dict[str, Any]
Model = TypeVar("Model", bound=Entry)

KINDS: dict[str, type[Entry]] = {"pipe": Pipe, "material": Material, "grade": Grade}
"""What a catalogue holds: [[pipe]], [[material]] and [[grade]]."""

INSTEAD = {
    "pipe": "give rod.outer_diameter, inner_diameter, material (or youngs_modulus and density) instead, or a file of "
    "your own in [catalogue]",
    "material": "give rod.youngs_modulus and rod.density instead",
    "grade": "give rod.yield_strength instead",
}
"""What to do where a name is not in the catalogue."""

MOST_NAMES = 24
"""As many names as a message lists in full."""

LONGEST_NAME = 200
"""Longer ones are no names: they are compared as they are."""

_SPELLINGS = (
    (re.compile(r"[×*]"), "x"),
    (re.compile("\"|″|''|\\binch(es)?\\b"), " in "),
    (re.compile(r"\blbf/ft\b|\blbs?/ft\b|\bppf\b|#"), " lb/ft "),
    (re.compile(r"(?<=[\d ])f(r|rench)?\b"), " fr "),
)
_MIXED = re.compile(r"(?:(\d+)[\s-]+)?(\d+)/(\d+)")
_NUMBER = re.compile(r"\d+\.?\d*|\.\d+")


def key_of(name: str) -> str:
    """Return a name as it is compared: capitals, spaces, hyphens, 2-7/8 or 2.875, 19.50 or 19.5, ppf or lb/ft."""
    text = name.lower()
    if len(text) > LONGEST_NAME:
        return text
    for pattern, plain in _SPELLINGS:
        text = pattern.sub(plain, text)
    text = _MIXED.sub(_decimal, text)
    text = _NUMBER.sub(lambda found: f"{float(found[0]):g}", text)
    return re.sub(r"[\s_-]+", "", text)


def _decimal(match: re.Match[str]) -> str:
    whole, over, under = (int(part or 0) for part in match.groups())
    return match[0] if under == 0 else f"{whole + over / under:g}"


@dataclass(frozen=True)
class Catalogue:
    """Entries by kind ("pipe", "material", "grade") and by the key of their name, checked when they are taken."""

    entries: Mapping[str, Mapping[str, Raw]] = field(default_factory=dict)

    def pipe(self, name: str) -> Pipe:
        """Return a pipe; raises InputError for ``rod.pipe`` with the nearest names."""
        return self._get(Pipe, "pipe", name, "rod.pipe")

    def material(self, name: str, key: str = "rod.material") -> Material:
        """Return a material; raises InputError for ``key`` with the nearest names."""
        return self._get(Material, "material", name, key)

    def grade(self, name: str) -> Grade:
        """Return a grade; raises InputError for ``rod.grade`` with the nearest names."""
        return self._get(Grade, "grade", name, "rod.grade")

    def names(self, kind: str) -> list[str]:
        """Names of all entries of a kind."""
        return list(dict.fromkeys(str(raw["name"]) for raw in self.entries[kind].values()))

    def _get(self, model: type[Model], kind: str, name: str, key: str) -> Model:
        raw = self.entries[kind].get(key_of(name))
        if raw is None:
            raise InputError(key, name, f"is not in the catalogue; {self._hint(kind, name)}{INSTEAD[kind]}")
        return model.model_validate(raw)

    def _hint(self, kind: str, name: str) -> str:
        known = self.entries[kind]
        near = difflib.get_close_matches(key_of(name), known, n=3, cutoff=0.5)
        near_names = list(dict.fromkeys(repr(known[key]["name"]) for key in near))
        if near_names:
            return f"nearest: {', '.join(near_names)}; or "
        names = self.names(kind)
        return f"it holds {', '.join(names)}; or " if len(names) <= MOST_NAMES else ""


@cache
def package_catalogue() -> Catalogue:
    """Return the catalogue of the package."""
    entries: dict[str, dict[str, Raw]] = {kind: {} for kind in KINDS}
    folder = resources.files("rodwell.case") / "data"
    for file in sorted(folder.iterdir(), key=lambda item: item.name):
        if file.name.endswith(".toml"):
            _add(entries, _entries(tomllib.loads(file.read_text(encoding="utf-8"))))
    return Catalogue(entries)


def read_catalogue(files: Sequence[str], folder: Path) -> Catalogue:
    """Return the package's catalogue and the user's ``files``, relative to ``folder``; theirs goes before ours.

    Raises
    ------
    InputError
        For ``catalogue.files``: a file that cannot be read, or an entry that is not right.
    """
    entries = {kind: dict(known) for kind, known in package_catalogue().entries.items()}
    for name in files:
        _add(entries, _checked_entries(_read(folder / name, name), name))
    return Catalogue(entries)


def _read(path: Path, name: str) -> str:
    try:
        with path.open("rb") as opened:
            raw = first_bytes(opened, LARGEST_CATALOGUE)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            "catalogue.files", name, f"cannot be read ({reason}); give a TOML file, its path from the case file"
        ) from None
    return decoded(raw, "catalogue.files", name, "give a TOML file, its path from the case file", LARGEST_CATALOGUE)


@lru_cache(maxsize=8)  # every point of a study, and every side of an uncertainty, asks for the same
def _checked_entries(text: str, name: str) -> tuple[tuple[str, Raw], ...]:
    """Entries of a file of the user's, each checked."""
    found = tuple(_entries(parsed(text, "catalogue.files", name), name))
    for kind, raw in found:
        _check(kind, raw, name)
    return found


def _entries(data: Mapping[str, Any], file: str = "") -> Iterable[tuple[str, Raw]]:
    """Entries of a file with its common keys; ``file`` is that of the user, for messages and as the source."""
    tables = {key: value for key, value in data.items() if isinstance(value, dict | list)}
    common = {key: value for key, value in data.items() if key not in tables}
    for key in data:
        if not (key in KINDS if key in tables else any(key in model.model_fields for model in KINDS.values())):
            what = "is not known; a catalogue holds [[pipe]], [[material]], [[grade]] and keys common to all of them"
            raise InputError("catalogue.files", file, f"{key} {what}")
    for kind, listed in tables.items():
        if not isinstance(listed, list) or not all(isinstance(raw, dict) for raw in listed):
            raise InputError("catalogue.files", file, f"must have its entries under [[{kind}]], in double brackets")
        for raw in listed:
            known = {k: v for k, v in common.items() if k in KINDS[kind].model_fields}
            yield kind, ({"source": file} if file else {}) | known | raw


def _check(kind: str, raw: Raw, file: str) -> None:
    """Refuse an entry of the user's with what is wrong in it."""
    try:
        KINDS[kind].model_validate(raw)
    except ValidationError as error:
        item = error.errors()[0]
        where = ".".join(str(part) for part in item["loc"]) or "entry"
        what = item["msg"].removeprefix("Value error, ")
        if item["type"] == "extra_forbidden":
            near = difflib.get_close_matches(where, KINDS[kind].model_fields, n=1)
            what = f"is not known{f'; did you mean {near[0]!r}?' if near else ''}"
        elif item["type"] == "missing":
            what = "is missing; add it"
        name = raw.get("name", "without name")
        raise InputError("catalogue.files", file, f"{kind} {name!r}: {where} {what}") from None


def _add(entries: dict[str, dict[str, Raw]], listed: Iterable[tuple[str, Raw]]) -> None:
    for kind, raw in listed:
        for name in (raw["name"], *raw.get("aliases", ())):
            entries[kind][key_of(name)] = raw
