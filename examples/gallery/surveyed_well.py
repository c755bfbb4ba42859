"""Pipe in a piece of a surveyed well that builds and turns: where around the hole it lies, under growing compression.

Weight and bend press it to different sides, so that it lies on no straight line along the hole. Waves grow smoothly
with the load, without a load at which it buckles, until it leaves the wall (dots).
"""

from pathlib import Path

import numpy as np

import rodwell
from rodwell.plots.style import LIFTS_OFF, MODES, new_axes

LOADS = (100e3, 500e3, 700e3)
"""Compression at the bottom in N, below that at which the pipe leaves the wall."""


def main():
    case = rodwell.Case.read(Path(__file__).parents[1] / "surveyed-well.toml")
    problem, unit = case.problem, case.scales.factor("force")
    rod = rodwell.lying_rod(problem, rtol=case.rtol)
    last = (problem.hung_weight - rod.lowest.value) * unit
    s = np.linspace(0.0, 1.0, 601)
    depth = 1080.0 - s * case.scales.length
    ax, angles = new_axes(), []
    states = [rod.at(problem.hung_weight - load / unit) for load in LOADS] + [rod.last]
    for load, state, color in zip((*LOADS, last), states, MODES, strict=False):
        angles.append(np.degrees(state.fields(s)["xi2"]))
        ax.plot(depth, angles[-1], color=color, label=f"{load / 1e3:.0f} kN")
    for place in rod.end.s:
        ax.plot(1080.0 - place * case.scales.length, np.interp(place, s, angles[-1]), "o", color=LIFTS_OFF, zorder=5)
    ax.axhline(0.0, color="0.5", lw=0.8)
    ax.set_xlabel("measured depth  [m]")
    ax.set_ylabel("angle around the hole,\nto the left of the low side  [°]")
    ax.set_title("5 in heavy-weight pipe, 8.5 in hole, 3° in 30 m, clamped ends", loc="left", fontsize=9.5)
    ax.legend(title="compression\nat the bottom", loc="center left", bbox_to_anchor=(1.01, 0.5))
    bending = np.hypot(*(rod.rest.fields(s)[f"rod_M{i}"] for i in (2, 3))) * case.scales.factor("moment")
    return ax.figure, {"case": case, "rod": rod, "depth": depth, "bending": bending, "angles": angles}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("surveyed_well.png", dpi=150)
