"""The numbers of an answer as text that is ready to be read, for report and summary."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.state.certificate import Certificate
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.key_number import KeyNumber
from rodwell.case.case import Case
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import minus, supported
from rodwell.quantities.value import Value

PLAIN_UNITS = {
    "1": "", "angle": "rad", "length": "L", "curvature": "1/L", "force": "B/L²", "force_per_length": "B/L³",
    "moment": "B/L", "energy": "B/L", "stress": "B/L⁴",
}  # fmt: skip
"""Units B = L = 1 as they are read, for every dimension of the nomenclature."""


def number(known: Value) -> str:
    """A number with the digits that its error estimate supports, ten at most; the last one is in doubt."""
    digits = supported(known, 10)
    return minus(f"{known.value:.{digits}g}") if digits and known.value else "0"


def short(error: float) -> str:
    """An error of one digit."""
    return minus(f"{error:.0e}")


def error_text(text: str) -> str:
    """An error of one digit, given as text with its unit, without an exponent where none is needed: 10 nN."""
    size, _, unit = text.replace("−", "-").partition(" ")
    return minus(f"± {float(size):.3g} {unit}").rstrip()


def rows(numbers: Iterable[KeyNumber], case: Case) -> list[dict[str, str]]:
    """The table of key numbers."""
    return [
        {
            "label": key.label,
            "physical": key.text(case),
            "plain": f"{number(key.number)} {PLAIN_UNITS[key.dimension]}".rstrip(),
            "error": minus(f"{key.error:.0e}".replace("e-0", "e-")),
            "note": key.note,
        }
        for key in numbers
    ]


def inputs(case: Case) -> list[tuple[str, str]]:
    """Inputs as given, and what follows from them."""
    out = []
    for section, values in case.given.items():
        parts = {section: values} if isinstance(values, Mapping) else {}
        if section == "string":
            parts = {f"string {number}": one for number, one in enumerate(values, 1)}
        for name, part in parts.items():
            out += [(f"{name}.{key}", str(value)) for key, value in part.items()]
    return out


def derived(case: Case) -> list[tuple[str, str]]:
    """The dimensionless problem and its scales."""
    p = case.problem
    out = [
        ("weight γ = mg L³/B", f"{p.weight:.8g}"),
        ("angle α from the vertical", f"{p.alpha:g}°"),
        ("clearance Δ/L (between the axes)", f"{p.clearance:.6g}"),
        ("Poisson's ratio ν", f"{p.poisson:g}") if p.torsion is None else ("torsional stiffness C/B", f"{p.torsion:g}"),
        ("end twisting moment T₁", f"{p.twist:g} B/L"),
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
        return minus(f"{value:.1e}")

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


def sensitivities(computed: Computed) -> list[dict[str, Any]]:
    """Elasticities of the loads, and their uncertainty from the inputs."""
    out = []
    for load, spread in zip(computed.sensitivities, computed.spreads, strict=True):
        e = load.elasticities() if load.force != 0.0 else {}
        names = ("clearance", "weight_per_length", "stiffness", "length", "alpha")
        cells = [minus(f"{e[name].value:+.3f} %") if e else "" for name in names]
        size = ""
        if spread is not None:
            scales = computed.case.scales
            plain = f"{spread.total:.2g} B/L²"
            size = "±" + (plain if scales is None else scales.system.text(spread.total, "force", 3))
        out.append({"name": load.name, "cells": cells, "spread": size})
    return out


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


def special(branches: Iterable[Branch], scales: Scales | None) -> list[dict[str, Any]]:
    """Special points of every branch."""
    out = []
    for branch in branches:
        assert branch.mode is not None
        for point in branch.special_points:
            out.append(
                {
                    "mode": branch.mode.number,
                    "kind": KINDS[point.kind],
                    "physical": "" if scales is None else scales.beside_error(point.load, "force"),
                    "plain": number(point.load),
                    "error": "" if point.kind == "end" else short(point.error),
                    "index": f"{point.index_before} → {point.index_after}"
                    if point.index_before != point.index_after
                    else str(point.index_after),
                    "place": ", ".join(f"{s:.6g}" for s in point.s),
                    "remark": "" if branch.meets_tolerance(point) else "misses the tolerance",
                }
            )
    return out
