"""What figures and pages of load paths show, in which units: drawn by Matplotlib or not."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from rodwell.analysis.path.load_path import LoadPath
from rodwell.answers.words.wording import forces_of
from rodwell.case.case import Case
from rodwell.plots.units import axis


class Units(NamedTuple):
    """From units B = L = 1 to those of the axes: shortening and load, with their words."""

    shortening: float
    load: Callable[[float], float]
    across: str
    up: str


def units_of(result: LoadPath, case: Case | None) -> Units:
    """Compression at s = 1 in B/L² over 10⁻³ L; of a case with dimensions as its pages say forces, in its units."""
    if case is None or case.scales is None:
        return Units(1e3, lambda force: -force, "10⁻³ L", "end compression −F at s = 1  [B/L²]")
    said, curve = forces_of(case), result.curve
    x, length = axis("z", case.scales, float(np.max(across_of(result, curve["shortening"], curve["force"]))))
    y, force = axis("force", case.scales, float(np.max(np.abs(said.drawn(curve["force"])))))
    return Units(x, lambda load: y * float(said.drawn(load)), length, f"{said.axis}  [{force}]")


def across_of(result: LoadPath, shortening: Any, force: Any) -> Any:
    """How far the driven end has come, u − cF, from the shortening u of the span: c is what gives way in series."""
    return shortening - result.compliance * force
