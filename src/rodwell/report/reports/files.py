"""Files that stand beside a report: what each holds, and the list of them for its last section."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rodwell.report.reports.content import Linked

FILES = {
    "report.html": "the report, self-contained",
    "rod-3d.html": "the rod in its cylinder, to turn and zoom",
    "answer.json": "key figures and special points",
    "tables.xlsx": "key figures, special points and every state along the rod as a workbook",
    "key-figures.csv": "the key figures as a table",
    "along-rod.csv": "force, contact, moments and stresses along the rod in each state",
    "load-path-3d.html": "the rod in its hole as the load grows and comes back, to slide through, turn and zoom",
    "load-path.csv": "events beyond lift-off and on the way back: loads, gaps, forces on the wall, stress",
    "branches.nc": "every field along every branch (NetCDF)",
    "case.toml": "the case as it was read",
}
"""Files in the folder of a case, pictures aside; that of the load path only where it was followed."""

CONVENTION_OF_DATA = (
    "Data files (JSON, CSV, XLSX, NetCDF) keep tension positive, end forces at s = 1, and say so where they stand."
)

KINDS = {".png": "picture", ".svg": "picture, for print and for editing", ".pdf": "this report as PDF"}


def linked(names: Iterable[str], known: Mapping[str, str]) -> tuple[Linked, ...]:
    """The files that a report names, with what they hold; the report itself is none of them."""
    out = []
    for name in sorted(names):
        holds = known.get(name, KINDS.get(name[name.rfind(".") :], ""))
        if name != "report.html":
            out.append(Linked(name, holds))
    return tuple(out)
