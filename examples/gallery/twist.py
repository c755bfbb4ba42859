"""Twist on a buckled rod: one sense presses it to the wall, the other lifts it off.

The rod stands at its lift-off load; then the end s = 1 is twisted. On one arm of the odd mode T₁ > 0 helps up
to the dot, where the rod lifts off again; on its mirror image it is T₁ < 0.
"""

import numpy as np

import rodwell
from rodwell.analysis.discrete.measures import Measured
from rodwell.plots.style import MODES, WARN, new_axes


def main():
    ax = new_axes()
    again = []
    for color, mirror in ((MODES[0], False), (MODES[1], True)):
        result = rodwell.torsion(rodwell.Problem(weight=30, alpha=90), mirror=mirror)
        end = result.again
        again.append((end.value, result.prepared.force))
        for until in (1.15 * end.value, -0.15 * end.value):
            start = result.prepared.solution
            branch = rodwell.follow(result.problem, start=start, parameter="twist", until=until, largest_step=0.03)
            p = branch.numbers(Measured.P_MAX)
            ax.plot(branch.values, p, color=color, lw=2.0, alpha=0.3)
            kept = np.abs(branch.values) <= abs(end.value) if until * end.value > 0.0 else p <= 0.0
            ax.plot(branch.values[kept], p[kept], color=color, lw=2.0)
        ax.plot([], [], color=color, lw=2.0, label="its mirror image, ω₂(1) > 0" if mirror else "arm with ω₂(1) < 0")
        ax.plot(end.value, 0.0, "o", color=WARN, mec=color)
    ax.axhline(0.0, color="#1f2933", lw=0.8)
    ax.text(0.02, 0.95, "pale: off the wall", transform=ax.transAxes, color="#8a94a0")
    ax.set_ylim(-14.0, 5.0)
    ax.set_xlabel("end twisting moment T₁ at s = 1  [B/L]")
    ax.set_ylabel("largest contact pressure max p  [B/L³]")
    load = f"F = −{-again[0][1]:.2f} B/L² at s = 1 (tension positive)"
    ax.set_title(f"γ = 30, α = 90°, Δ/L = 0.01, both ends clamped, {load}", loc="left", fontsize=9.5)
    ax.legend(loc="lower center")
    return ax.figure, {"again": again}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("twist.png", dpi=150)
