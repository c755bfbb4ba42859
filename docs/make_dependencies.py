"""The table of the page on what rodwell stands on: packages, versions, licences, read from what is installed."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path
from typing import Any, NamedTuple

from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parent.parent
EXTRAS = ("pdf", "map", "explore")
"""Extras for users; those for tests, pages and development come with no installed rodwell."""

WHY = {
    "numpy": "arrays, LAPACK",
    "scipy": "roots, special functions, the second solver of `verify`",
    "numba": "compiles the engine's kernels",
    "pydantic": "checks case files",
    "pint": "units, where files are read and results are written",
    "click": "the command line",
    "rich": "progress bars and tables on a terminal",
    "xarray": "labelled results",
    "h5netcdf": "NetCDF files",
    "h5py": "NetCDF files",
    "matplotlib": "figures",
    "pillow": "animations",
    "jinja2": "the report as a page",
    "xlsxwriter": "tables as XLSX",
    "trimesh": "glTF and STL",
    "meshio": "VTK",
    "python-flint": "loads with proof: ball arithmetic",
    "openpyxl": "surveys in XLSX",
    "lasio": "surveys in LAS",
    "typst": "the report as PDF",
    "dask": "maps on several processes and machines",
    "distributed": "maps on several processes and machines",
    "zarr": "the store of a map",
    "bokeh": "Dask's dashboard",
    "starlette": "the page of `rodwell explore`",
    "uvicorn": "its server",
    "websockets": "its connection",
}
"""What each is for."""


class Package(NamedTuple):
    """A package that is needed: its name, the requirement or what needs it, and what its own metadata say."""

    name: str
    needed: str
    version: str
    licence: str


def key(name: str) -> str:
    """A name as package indexes compare it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def licence(about: Any) -> str:
    """The licence of a package in its own words: its expression, else its classifiers, else the field."""
    if expression := about.get("License-Expression"):
        return str(expression)
    named = [line.split("::")[-1].strip() for line in about.get_all("Classifier") or [] if line.startswith("License ")]
    return "; ".join(named) or str(about.get("License") or "not said")


def needed() -> dict[str, list[Package]]:
    """Packages that rodwell needs itself, and those of each extra."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    groups = {"rodwell": project["dependencies"]} | {
        f"rodwell[{x}]": project["optional-dependencies"][x] for x in EXTRAS
    }
    return {group: [_package(Requirement(line), line) for line in lines] for group, lines in groups.items()}


def _package(requirement: Requirement, needed_as: str) -> Package:
    found = metadata.distribution(requirement.name)
    return Package(key(requirement.name), needed_as, found.version, licence(found.metadata))


def behind() -> list[Package]:
    """What these need in turn, each with what needs it first, in the order of names."""
    known = {package.name for group in needed().values() for package in group}
    out: dict[str, Package] = {}
    ahead = [(name, name) for name in sorted(known)]
    while ahead:
        name, by = ahead.pop(0)
        for requirement in _requirements(name):
            other = key(requirement.name)
            if other not in known:
                known.add(other)
                out[other] = _package(requirement, by)
                ahead.append((other, other))
    return [out[name] for name in sorted(out)]


def _requirements(name: str) -> Iterator[Requirement]:
    """What a package needs on this machine, without its extras."""
    for line in metadata.distribution(name).requires or []:
        requirement = Requirement(line)
        if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
            yield requirement


def pages(_: Path) -> dict[str, str]:
    """Both tables."""
    lines = ["| Needed by | Package, at least | What for | Tried with | Licence |", "| --- | --- | --- | --- | --- |"]
    for group, packages in needed().items():
        for package in packages:
            why, wanted = WHY[package.name], package.needed.replace(">=", " ")
            lines.append(f"| `{group}` | {wanted} | {why} | {package.version} | {package.licence} |")
    lines += [
        "",
        "These need in turn:",
        "",
        "| Package | Needed by | Tried with | Licence |",
        "| --- | --- | --- | --- |",
    ]
    lines += [f"| {one.name} | {one.needed} | {one.version} | {one.licence} |" for one in behind()]
    return {"dependencies.md": "\n".join(lines) + "\n"}
