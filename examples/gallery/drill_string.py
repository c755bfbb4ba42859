"""A 30 m drill string at the load at which it leaves the wall.

Blue is where the wall pushes most; the ring marks the place where the push has fallen to nothing.
"""

from pathlib import Path

import rodwell
from rodwell.plots.rod3d import plot_rod


def main():
    case = rodwell.Case.read(Path(__file__).parents[1] / "drill-string.toml")
    branch = rodwell.follow(case.problem, mode=1)  # from the critical load to lift-off
    ax = plot_rod(branch.lift_off.solution, case.scales)
    kilonewton = case.scales.factor("force") / 1e3
    found = {
        "weight": case.problem.weight,
        "clearance": case.problem.clearance,
        "critical": branch.special_points[0].force,
        "critical_kN": branch.special_points[0].force * kilonewton,
        "lift_off_at": branch.lift_off.s,
        "push": branch.lift_off.solution.highest_pressure[0],
    }
    return ax.figure, found


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("drill_string.png", dpi=150)
