"""The numbers of an answer as text that is ready to be read, for report and summary."""

from __future__ import annotations

from typing import Any

from rodwell.analysis.state.certificate import Certificate
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.figure import Figure
from rodwell.case.case import Case
from rodwell.quantities.text import supported

PLAIN_UNITS = {"force": "B/L²", "force_per_length": "B/L³", "moment": "B/L", "length": "L", "stress": "B/L⁴", "1": ""}


def number(value: float, error: float) -> str:
    """A value with the digits that its error estimate supports, ten at most; the last one is in doubt."""
    digits = supported(value, error, 10)
    return f"{value:.{digits}g}".replace("-", "−") if digits and value else "0"


def error_text(text: str) -> str:
    """An error of one digit, given as text with its unit, without an exponent where none is needed: 10 nN."""
    size, _, unit = text.replace("−", "-").partition(" ")
    return f"± {float(size):.3g} {unit}".replace("-", "−").rstrip()


def rows(answer: Answer) -> list[dict[str, str]]:
    """The table of key figures."""
    out = []
    for figure in answer.figures.values():
        out.append(
            {
                "label": figure.label,
                "physical": figure.text(answer.case),
                "plain": f"{number(figure.value, figure.error)} {unit(figure)}".rstrip(),
                "error": f"{figure.error:.0e}".replace("e-0", "e-").replace("-", "−"),
                "note": figure.note,
            }
        )
    return out


def unit(figure: Figure) -> str:
    """Unit of the dimensionless number."""
    return PLAIN_UNITS[figure.dimension]


def inputs(case: Case) -> list[tuple[str, str]]:
    """Inputs as given, and what follows from them."""
    out = []
    for section, values in case.given.items():
        for key, value in values.items():
            out.append((f"{section}.{key}", str(value)))
    return out


def derived(case: Case) -> list[tuple[str, str]]:
    """The dimensionless problem and its scales."""
    p = case.problem
    out = [
        ("weight γ = mg L³/B", f"{p.weight:.8g}"),
        ("angle α from the vertical", f"{p.alpha:g}°"),
        ("clearance Δ/L (between the axes)", f"{p.clearance:.6g}"),
        ("Poisson's ratio ν", f"{p.poisson:g}"),
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

    def short(value: float) -> str:
        return f"{value:.1e}".replace("-", "−")

    groups: dict[str, float] = {}
    for name, value in found.residuals.items():
        group = next((title for title, names in _GROUPS.items() if name in names), name)
        group = "end conditions (B1)–(B15)" if name.startswith("(B") else group
        groups[group] = max(value, groups.get(group, 0.0))
    return {
        "worst": short(found.worst),
        "where": found.worst_equation,
        "limit": short(found.limit),
        "passed": found.passed,
        "groups": [(name, short(value)) for name, value in groups.items()],
    }


def sensitivities(answer: Answer) -> list[dict[str, Any]]:
    """Elasticities of the loads, and their uncertainty from the inputs."""
    out = []
    for load, spread in zip(answer.sensitivities, answer.spreads, strict=True):
        e = load.elasticities() if load.force != 0.0 else {}
        names = ("clearance", "weight_per_length", "stiffness", "length", "alpha")
        cells = [f"{e[name][0]:+.3f} %".replace("-", "−") if e else "" for name in names]
        size = ""
        if spread is not None:
            scales = answer.case.scales
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


def special(answer: Answer) -> list[dict[str, Any]]:
    """Special points of every branch."""
    scales = answer.case.scales
    out = []
    for branch in answer.branches:
        assert branch.mode is not None
        for point in branch.special_points:
            out.append(
                {
                    "mode": branch.mode.number,
                    "kind": KINDS[point.kind],
                    "physical": "" if scales is None else scales.text(point.force, "force", 6),
                    "plain": number(point.force, point.error),
                    "error": "" if point.kind == "end" else f"{point.error:.0e}".replace("-", "−"),
                    "index": f"{point.index_before} → {point.index_after}"
                    if point.index_before != point.index_after
                    else str(point.index_after),
                    "place": ", ".join(f"{s:.6g}" for s in point.s),
                }
            )
    return out
