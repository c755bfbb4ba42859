"""What a buckled pipe does to its casing: the moments in the cylinder along its length.

The weight of the sideways rod twists the cylinder (T₂), contact bends it (μ, λ cos η). At s = 1 the cylinder
is free of load; at s = 0 its support must bear what is left.
"""

from pathlib import Path

import numpy as np

import rodwell
from rodwell.plots.cylinder import plot_cylinder_moments


def main():
    case = rodwell.Case.read(Path(__file__).parents[1] / "drill-string.toml")
    state = rodwell.follow(case.problem, mode=1).lift_off.solution
    ax = plot_cylinder_moments(state, case.scales)
    ax.set_title("Drill string at lift-off, horizontal, both ends clamped", loc="left", fontsize=9.5)
    s = np.linspace(0.0, 1.0, 4001)
    fields = state.fields(s)
    found = {
        "s": s,
        "y": fields["y"],
        "T2": fields["T2"],
        "lateral_weight": case.problem.lateral_weight,
        "clearance": case.problem.clearance,
    }
    return ax.figure, found


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("wall_moments.png", dpi=150)
