"""Changes of length of tubing in a packer, one after the other."""

from __future__ import annotations

from typing import Any

from rodwell.plots.style import GREY, INK, MODES, WARN, new_axes
from rodwell.quantities.known import INCH
from rodwell.studies.packer.lengths import KINDS
from rodwell.studies.packer.packer import PackerAnswer

NAMES = {"piston": "piston", "buckling": "buckling", "ballooning": "ballooning", "temperature": "temperature"}


def plot_packer(answer: PackerAnswer, ax: Any = None) -> Any:
    """Draw each change of length from where the last ended, then the movement if free and as it is; return the axes.

    Down is longer.
    """
    ax = new_axes() if ax is None else ax
    assert answer.case.scales is not None
    m = answer.moved
    largest = max(abs(value.value) for value in (*m.changes.values(), m.landed, m.free))
    system = answer.case.scales.system
    unit, text = (INCH, "in") if system.name == "field" else system.unit("length", largest)
    steps = [(NAMES[kind], m.changes[kind].value) for kind in KINDS]
    if m.landed_with:
        steps.insert(0, ("slack-off" if m.landed_with < 0.0 else "pick-up", m.landed.value))
    at, reached = 0.0, [m.free.value, m.movement.value]
    for i, (_, step) in enumerate(steps):
        ax.bar(i, step / unit, bottom=at / unit, width=0.6, color=MODES[0] if step < 0.0 else MODES[1])
        low = min(at, at + step) / unit
        ax.annotate(f"{step / unit:+#.4g}".replace("-", "−"), (i, low), xytext=(0, 4), textcoords="offset points",
                    ha="center", va="bottom", fontsize=8.5)  # fmt: skip
        at += step
        reached.append(at)
        ax.plot([i + 0.3, i + 0.7], [at / unit] * 2, color=GREY, lw=0.8)
    last = len(steps)
    ax.bar(last, m.free.value / unit, width=0.6, color="white", ec=INK, lw=1.2)
    ax.bar(last + 1, m.movement.value / unit, width=0.6, color=WARN if m.stopped else MODES[2])
    for i, value in ((last, m.free.value), (last + 1, m.movement.value)):
        ax.annotate(f"{value / unit:+#.4g}".replace("-", "−"), (i, min(value, 0.0) / unit), xytext=(0, 4),
                    textcoords="offset points", ha="center", va="bottom", fontsize=8.5)  # fmt: skip
    ax.axhline(0.0, color=INK, lw=0.9)
    ax.set_axisbelow(True)
    low, high = min(0.0, *reached) / unit, max(0.0, *reached) / unit
    room = 0.1 * (high - low or 1.0)
    ax.set_ylim(high + room, low - room)  # down is positive
    ax.set_xticks(range(last + 2), [*(name for name, _ in steps), "if free", "movement"])
    ax.grid(visible=False, axis="x")
    ax.set_ylabel(f"end of the tubing: down is positive  [{text}]")
    ax.set_title(answer.case.title, loc="left", fontsize=9.5)
    return ax
