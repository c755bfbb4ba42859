"""What figures and pages of load paths show, in which units: drawn by Matplotlib or not."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from rodwell.analysis.off_wall.arrange import turns_of
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.measured import measured
from rodwell.analysis.off_wall.state import HELIX, kind_of
from rodwell.analysis.path.frames import Frame
from rodwell.analysis.path.load_path import LoadPath
from rodwell.answers.words.wording import forces_of
from rodwell.case.case import Case
from rodwell.numerics.stretches.carry import sampler
from rodwell.plots.units import axis
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain


class Units(NamedTuple):
    """From units B = L = 1 to those of the axes: shortening and load, and what the axes say of both."""

    shortening: float
    load: Callable[[float], float]
    across: str
    up: str


def units_of(result: LoadPath, case: Case | None) -> Units:
    """Compression at s = 1 in B/L² over 10⁻³ L; of a case with dimensions as its pages say forces, in its units."""
    moved = "displacement of the driven end" if result.compliance else "shortening of the rod's span"
    if case is None or case.scales is None:
        return Units(1e3, lambda force: -force, f"{moved}  [10⁻³ L]", "end compression −F at s = 1  [B/L²]")
    said, curve = forces_of(case), result.curve
    x, length = axis("z", case.scales, float(np.max(across_of(result, curve["shortening"], curve["force"]))))
    y, force = axis("force", case.scales, float(np.max(np.abs(said.drawn(curve["force"])))))
    return Units(x, lambda load: y * float(said.drawn(load)), f"{moved}  [{length}]", f"{said.axis}  [{force}]")


def across_of(result: LoadPath, shortening: Any, force: Any) -> Any:
    """How far the driven end has come, u − cF, from the shortening u of the span: c is what gives way in series."""
    return shortening - result.compliance * force


def words(frame: Frame, said: Forces) -> str:
    """What is shown, in one line."""
    return f"{frame.leg}, {said.label(frame.state.load)}: {described(frame.state, said.scales)}"


def described(state: PatternedState, scales: Scales | None) -> str:
    """What a state is: its kind, gaps, the largest point force, stability."""
    turns = turns_of(state.model, sampler(state.solved.shape))
    kind, numbers = kind_of(state, turns), measured(state)
    parts = [f"{kind} of {abs(turns)} turn{'s' if abs(turns) != 1 else ''}" if kind == HELIX else kind]
    gaps = [float(gap) for gap, on in zip(numbers.gaps, state.touching, strict=True) if not on]
    if gaps:
        parts.append(f"{len(gaps)} gap{'s' if len(gaps) != 1 else ''} up to {plain(max(gaps), 3)} of the clearance")
    if numbers.points.size:
        largest = float(np.max(np.abs(numbers.points)))
        text = f"{plain(largest, 3)} B/L²" if scales is None else scales.text(largest, "force", 3)
        parts.append(f"largest point force {text}")
    parts.append("stable" if state.solved.index == 0 else f"unstable (index {state.solved.index})")
    return ", ".join(parts)
