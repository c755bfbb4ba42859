"""Formulas that people use for buckling in wellbores, each with source, validity and units.

Compression is **positive** in every formula, as the field has it; rodwell's own forces are tension positive. The
radial clearance r is the paper's Δ. Any coherent units do. :data:`FORMULAS` holds every formula by key,
:data:`LEFT_OUT` what is known from memory only or refuted.
"""

from rodwell.formulas import helix, inclined, path, pushing, vertical
from rodwell.formulas.left_out import LEFT_OUT, LeftOut
from rodwell.formulas.record import FORMULAS, SYMBOLS, Formula, FormulaInputs

__all__ = [
    "FORMULAS",
    "LEFT_OUT",
    "SYMBOLS",
    "Formula",
    "FormulaInputs",
    "LeftOut",
    "helix",
    "inclined",
    "path",
    "pushing",
    "vertical",
]
