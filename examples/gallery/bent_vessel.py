"""A guidewire pushed around a bend, where it lifts off the wall of the vessel.

The vessel is a bent tube of 80 mm radius; blue is where the wire presses its wall most. Before the wire buckles its
push κF on the outer wall is even along the bend.
"""

from pathlib import Path

import numpy as np

import rodwell
from rodwell.plots.rod3d import plot_rod
from rodwell.strength.loaded import LoadedRod


def main():
    case = rodwell.Case.read(Path(__file__).parents[1] / "bent-vessel.toml")
    problem = case.problem
    branch = rodwell.follow(problem)  # to lift-off
    lift = branch.lift_off
    ax = plot_rod(lift.solution, case.scales)
    pushed = LoadedRod("pushed", problem, case.applied[0].force)
    found = {
        "problem": problem,
        "pushed": pushed.force,
        "push_on_wall": -pushed.fields(np.array([0.5]))["contact_pressure"][0],
        "critical": branch.special_points[0].force,
        "lift_off": lift,
    }
    return ax.figure, found


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("bent_vessel.png", dpi=150)
