"""The numbers of an answer as text that is ready to be read, for report and summary."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.state.certificate import Certificate
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.key_number import KeyNumber
from rodwell.answers.words.shown_loads import shown_sensitivities
from rodwell.answers.words.wording import forces_of, place_text
from rodwell.case.case import Case
from rodwell.quantities.text import error_digit, minus, number_text, plain
from rodwell.quantities.value import Value

PLAIN_UNITS = {
    "1": "", "angle": "rad", "length": "L", "curvature": "1/L", "force": "B/L²", "force_per_length": "B/L³",
    "moment": "B/L", "energy": "B/L", "stress": "B/L⁴",
}  # fmt: skip
"""Units B = L = 1 as they are read, for every dimension of the nomenclature."""


def number(known: Value) -> str:
    """A number with the digits that its error estimate supports, ten at most; the last one is in doubt."""
    return number_text(known)


def short(error: float) -> str:
    """An error of one digit."""
    return error_digit(error)


def rows(numbers: Iterable[KeyNumber], case: Case) -> list[dict[str, str]]:
    """The table of key numbers, as the case's reader counts: compression at the end shown, places by their depth.

    Without dimensions: end forces at s = 1, tension positive, in units B = L = 1.
    """
    if case.scales is None:
        return plain_rows(numbers)
    return [_row(key, case) for key in numbers if not (key.name.endswith("_bottom") and key.dimension == "force")]


def plain_rows(numbers: Iterable[KeyNumber]) -> list[dict[str, str]]:
    """The key numbers in units B = L = 1: end forces at s = 1, tension positive."""
    return [
        {
            "label": key.label,
            "value": f"{number(key.number)} {PLAIN_UNITS[key.dimension]}".rstrip(),
            "error": f"{short(key.error)} {PLAIN_UNITS[key.dimension]}".rstrip(),
            "note": "; ".join(filter(None, (_places(key), key.note))),
        }
        for key in numbers
    ]


def _places(key: KeyNumber) -> str:
    return f"at s/L = {', '.join(plain(s, 6) for s in key.s)}" if key.s else ""


END_FORCE, REAL = ", end force at s = 1", ", at s = 1"
"""How the labels of end forces end, and of real ones."""


def _row(key: KeyNumber, case: Case) -> dict[str, str]:
    """One key number of a case with dimensions."""
    assert case.scales is not None
    said, label, known, notes = forces_of(case), key.label, key.number, [key.note]
    if label.endswith(END_FORCE):
        label = f"{label.removesuffix(END_FORCE)}, compression{said.at_end}"
        notes.append(said.other(known).strip(" ()"))
        known = said.compression(known)
    elif key.name.endswith("_real"):
        label, known = f"{label.removesuffix(REAL)}, compression at the top", known.times(-1.0)
    elif key.name == "window":
        notes = [key.note.partition("; ")[2] or key.note]
    notes += [place_text(case, Value(s)) for s in key.s]
    return {
        "label": label,
        "value": case.scales.beside_error(known, key.dimension),
        "error": case.scales.text(known.error, key.dimension, 1),
        "note": "; ".join(filter(None, notes)),
    }


def inputs(case: Case) -> list[tuple[str, str]]:
    """Inputs as given, and what follows from them."""
    out = []
    for section, values in case.given.items():
        parts = {section: values} if isinstance(values, Mapping) else {}
        if section == "string":
            parts = {f"string {number}": one for number, one in enumerate(values, 1)}
        if section == "hole" and "section" in values:
            parts = {section: {key: value for key, value in values.items() if key != "section"}} | {
                f"hole.section {number}": one for number, one in enumerate(values["section"], 1)
            }
        for name, part in parts.items():
            out += [(f"{name}.{key}", str(value)) for key, value in part.items()]
    return out


def derived(case: Case) -> list[tuple[str, str]]:
    """The dimensionless problem and its scales."""
    p = case.problem
    out = [
        ("weight γ = mg L³/B", f"{plain(p.weight, 8)}{', upwards: the rod floats' if p.floats else ''}"),
        ("angle α from the vertical", f"{plain(p.alpha, 8)}°"),
        ("clearance Δ/L (between the axes)", plain(p.clearance, 6)),
        ("Poisson's ratio ν", plain(p.poisson, 6))
        if p.torsion is None
        else ("torsional stiffness C/B", plain(p.torsion, 6)),
        ("end twisting moment T₁", f"{plain(p.twist, 6)} B/L"),
    ]
    if case.scales is not None:
        scales = case.scales
        out += [
            ("length L", scales.text(1.0, "length", 6)),
            ("bending stiffness B", scales.system.text(scales.stiffness, "stiffness", 6)),
            ("unit of force B/L²", scales.text(1.0, "force", 6)),
        ]
    return out


def conversions(case: Case) -> list[tuple[str, str, str]]:
    """What became of the inputs: label, value and where it comes from."""
    if case.scales is None:
        return []
    return [(fact.label, fact.text(case.scales.system), fact.note) for fact in case.facts]


def certificate(found: Certificate) -> dict[str, Any]:
    """The certificate for reading: the largest residual, its limit, and the residuals by group."""

    def two_digits(value: float) -> str:
        return plain(value, 2)

    groups: dict[str, float] = {}
    for name, value in found.residuals.items():
        group = next((title for title, names in _GROUPS.items() if name in names), name)
        group = "end conditions (B1)–(B15)" if name.startswith("(B") else group
        groups[group] = max(value, groups.get(group, 0.0))
    return {
        "worst": two_digits(found.worst),
        "where": found.worst_equation,
        "limit": two_digits(found.limit),
        "passed": found.passed,
        "groups": [(name, two_digits(value)) for name, value in groups.items()],
    }


CHANGES = {
    "clearance": "clearance Δ",
    "weight_per_length": "weight per length",
    "stiffness": "stiffness B",
    "length": "length L",
    "alpha": "angle α, per degree",
    "build": "curvature of the hole",
    "walk": "turn of the hole",
}
"""Inputs by which elasticities are told, in the order of the table."""


def sensitivities(computed: Computed) -> tuple[list[str], list[dict[str, Any]]]:
    """By which inputs elasticities of loads are told; for each load they, and the uncertainty from the inputs."""
    out, shown = [], shown_sensitivities(computed)
    known = {name for load, _ in shown if load.force != 0.0 for name in load.elasticities()}
    names = [name for name in CHANGES if name in known] or list(CHANGES)[:5]
    for load, spread in shown:
        e = load.elasticities() if load.force != 0.0 else {}
        cells = [minus(f"{e[name].value:+.2f} %") if name in e else "" for name in names]
        size = ""
        if spread is not None:
            scales = computed.case.scales
            total = f"{plain(spread.total, 2)} B/L²" if scales is None else scales.system.text(spread.total, "force", 2)
            size = f"± {total}"
        out.append({"name": load.name, "cells": cells, "spread": size})
    return names, out


_GROUPS = {
    "force and moment balance (22)–(27)": ("(22)", "(23)", "(24)", "(25)", "(26)", "(27)"),
    "kinematics (32), (34)–(36), (44)": ("(32)", "(34)", "(35)", "(36)", "(44)"),
    "twisting moment in the cylinder (33)": ("(33)",),
    "multipliers and curvature (41)–(43)": ("(41)", "(42)", "(43)"),
    "moments of rod and cylinder (37)–(39)": ("(37)", "(38)", "(39)"),
    "forces of rod and cylinder (52)–(54), (56)–(58)": ("(52)", "(53)", "(54)", "(56)", "(57)", "(58)"),
    "contact pressure (55)": ("(55)",),
}


KINDS = {
    "critical": "buckling of the straight rod",
    "lift_off": "lift-off",
    "branch_point": "secondary bifurcation",
    "fold": "fold",
    "touch_down": "contact complete again",
    "uncertain": "change of the index that one mesh alone shows",
    "equal_energy": "energy of the straight rod",
    "end": "end of the branch",
}
"""Kinds of special points in words."""


def special(branches: Iterable[Branch], case: Case) -> list[dict[str, Any]]:
    """Special points of every branch: loads as the case's reader counts."""
    out, scales, said = [], case.scales, forces_of(case)
    for branch in branches:
        lower = "secondary " if branch.mode is not None else ""
        for point in branch.special_points:
            shown = said.compression(point.load)
            out.append(
                {
                    "mode": branch.name if branch.mode is None else str(branch.mode.number),
                    "kind": KINDS[point.kind]
                    if case.problem.hole is None
                    else KINDS[point.kind].replace("straight rod", "lying rod").replace("secondary ", lower),
                    "load": f"{number(point.load)}" if scales is None else scales.beside_error(shown, "force"),
                    "error": ""
                    if point.kind == "end"
                    else short(point.error)
                    if scales is None
                    else scales.text(point.error, "force", 1),
                    "index": f"{point.index_before} → {point.index_after}"
                    if point.index_before != point.index_after
                    else str(point.index_after),
                    "place": "; ".join(place_text(case, Value(s)) for s in point.s),
                    "remark": "" if branch.meets_tolerance(point) else "misses the tolerance",
                }
            )
    return out
