"""An audit as plain data, for JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rodwell._version import __version__
from rodwell.answers.comparison.exact_loads import PLACES
from rodwell.answers.words.steps import held
from rodwell.formulas import LEFT_OUT
from rodwell.formulas.record import NAMES, NOMENCLATURE
from rodwell.problem.words import ends_text
from rodwell.quantities.units import SI

if TYPE_CHECKING:
    from rodwell.answers.comparison.beside import FormulaRow, Other
    from rodwell.formulas import Formula
    from rodwell.studies.audit.audit import AtApplied, Audit


FORCE = (1, 0)


def audit_dict(audit: Audit) -> dict[str, Any]:
    """Return an audit as plain data: values in units B = L = 1, with ``si`` beside them for physical cases."""
    problem = audit.problem
    return {
        "title": audit.title,
        "rodwell_version": __version__,
        "conventions": "units B = L = 1 unless si, field or mm; compression positive in formulas and at top (s = 1), "
        f"middle, bottom (s = 0); force: end force at s = 1, tension positive; percent: formula/exact − 1; "
        f"{', '.join([ends_text(problem), *held(problem.rod)])}",
        "problem": {
            "weight": problem.weight, "alpha": problem.alpha, "clearance": problem.clearance,
            "twist": problem.twist,
            "ends": list(problem.ends), "on_top": problem.on_top, "outside": problem.outside,
            "floats": problem.floats, **problem.given_more,
        },
        "exact": [
            {
                "name": load.name, "label": load.label, "force": load.force, "error": load.error,
                "compression": {place: load.at(place) for place in PLACES},
                **_si(audit, FORCE, {"force": load.force, "error": load.error}),
            }
            for load in audit.loads
        ],
        "exact_not_found": list(audit.not_found),
        "formulas": [_row(audit, row) for row in audit.rows],
        "other_formulas": [_other(audit, other) for other in audit.others],
        "at_applied_loads": [_applied(audit, one) for one in audit.applied],
        "left_out": [{"name": item.name, "text": item.text, "reason": item.reason} for item in LEFT_OUT],
    }  # fmt: skip


def _applied(audit: Audit, one: AtApplied) -> dict[str, Any]:
    """The other formulas at a load that acts."""
    exact = one.exact
    return {
        "load": exact.label, "given": one.load.given, "force": exact.force, "straight": one.straight,
        "compression": {place: exact.at(place) for place in PLACES},
        **_si(audit, FORCE, {"force": exact.force}),
        "other_formulas": [_other(audit, other) for other in one.others],
    }  # fmt: skip


def _si(audit: Audit, dimension: tuple[int, int], numbers: dict[str, float]) -> dict[str, Any]:
    if audit.scales is None:
        return {}
    factor = audit.factor(dimension)
    out: dict[str, Any] = {"si": {name: value * factor for name, value in numbers.items()}}
    system = audit.scales.system
    if system != SI:
        unit, text = system.unit(NOMENCLATURE[dimension])
        out[system.name] = {name: value * factor / unit for name, value in numbers.items()} | {"unit": text}
    return out


def _formula(formula: Formula) -> dict[str, Any]:
    return {
        "key": formula.key, "name": formula.name, "formula": formula.text, "kind": formula.kind,
        "place": formula.place, "source": formula.source, "evidence": formula.evidence, "holds": formula.holds,
        "assumes": formula.assumes,
    }  # fmt: skip


def _row(audit: Audit, row: FormulaRow) -> dict[str, Any]:
    value = {} if row.value is None else _si(audit, FORCE, {"value": row.value})
    return {
        **_formula(row.formula),
        "value": row.value,
        **value,
        "valid": row.valid,
        "outside_because": list(row.reasons),
        "missing": list(row.missing),
        "against": row.against,
        "verdict": row.verdict,
        **_sections(audit, row),
        "comparisons": [
            {
                "load": c.load, "place": c.place, "exact": c.exact, "exact_error": c.error, "percent": c.percent,
                "percent_error": c.percent_error, "safe": c.safe,
            }
            for c in row.comparisons
        ],
    }  # fmt: skip


def _sections(audit: Audit, row: FormulaRow) -> dict[str, Any]:
    """Of a string, the section that governs, and the formula's load in each."""
    if not row.section:
        return {}
    each = [
        {"section": one.section, "value": one.value, "force": one.force,
         **_si(audit, FORCE, {"value": one.value, "force": one.force})} for one in row.by_section
    ]  # fmt: skip
    return {"section": row.section, "by_section": each}


def _other(audit: Audit, other: Other) -> dict[str, Any]:
    dimension = other.formula.dimension
    value = {} if other.value is None else _si(audit, dimension, {"value": other.value})
    return {
        **_formula(other.formula),
        "value": other.value,
        "dimension": NAMES.get(dimension, f"force^{dimension[0]} length^{dimension[1]}"),
        **value,
        "relative_error": other.relative_error,
        "valid": not other.reasons,
        "outside_because": list(other.reasons),
        "missing": list(other.missing),
    }
