"""Between buckling and lift-off: how much more a rod bears on the wall, from horizontal to steep.

Between the lines the rod is buckled but lies on the wall. Where the lift-off line has its kink, the place
that lifts off jumps.
"""

import numpy as np

import rodwell
from rodwell.plots.style import MODES, WARN, new_axes


def main():
    rod = rodwell.Problem(weight=15)
    lift = rodwell.lift_off_curve(rod, "alpha", (90, 10))
    (buckle,) = rodwell.critical_curves(rod, "alpha", (10, 90), modes=1)
    ax = new_axes()
    ax.fill_between(buckle.x, 0.0, -buckle.values, color="#dceaf5", lw=0.0)
    ax.plot(buckle.x, -buckle.values, color=MODES[0], lw=2.0, label="buckling")
    ax.plot(lift.x, -lift.values, color=WARN, lw=2.0, label="lift-off, first mode")
    for mark in lift.marks:
        ax.plot(mark.x, -mark.value, "o", color=WARN, mec="#1f2933", label="touching place jumps")
    ax.text(50.0, 40.0, "straight rod stable", ha="center", color=MODES[0])
    ax.set_xlim(10.0, 90.0)
    ax.set_ylim(0.0, 140.0)
    ax.set_xlabel("inclination α from the vertical  [degrees]")
    ax.set_ylabel("end compression −F at s = 1  [B/L²]")
    ax.set_title("γ = 15, Δ/L = 0.01, both ends clamped", loc="left", fontsize=9.5)
    ax.legend(loc="lower right")
    order = np.argsort(lift.x)
    lifts = np.interp(buckle.x, lift.x[order], lift.values[order])
    return ax.figure, {"horizontal": lift.values[0], "after_buckling": bool(np.all(lifts < buckle.values))}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("lift_off.png", dpi=150)
