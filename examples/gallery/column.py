"""A slender body held upright in a pipe, buckled by its own weight: the shapes as it is let down.

A vertical column of γ = 100 is too long to stand: its first mode buckles while the top is still pulled. From
the critical tension (light) to compression (dark) the buckle sinks to the lower end.
"""

import matplotlib as mpl
import numpy as np

import rodwell
from rodwell.plots.style import new_axes


def main():
    rod = rodwell.Problem(weight=100, alpha=0)  # clamped at both ends, as the robot's two feet hold it
    branch = rodwell.follow(rod, mode=1, until=-20.0)
    forces = np.linspace(14.0, -20.0, 9)
    ax = new_axes(size=(6.4, 6.0))
    colors = mpl.colormaps["viridis"](np.linspace(0.85, 0.0, forces.size))
    for force, color in zip(forces, colors, strict=True):
        fields = branch.at(force).fields(301)
        for side in (1, -1):  # a branch and its mirror image
            label = f"{force:+.4g}".replace("-", "−") if side > 0 else None
            ax.plot(side * np.degrees(fields["xi2"]), fields["z"], color=color, lw=1.8, label=label)
    ax.axvline(0.0, color="#8a94a0", lw=0.8)
    ax.set_xlabel("angle around the pipe ξ₂  [degrees]")
    ax.set_ylabel("height z  [L]")
    ax.set_title("γ = 100, vertical, Δ/L = 0.01, both ends clamped", loc="left", fontsize=9.5)
    ax.legend(title="F at the top, s = 1\n[B/L²], tension +", loc="center left", bbox_to_anchor=(1.01, 0.5))
    weightless = rodwell.critical_loads(rodwell.Problem(74.628569, alpha=0), 1)[0].force
    return ax.figure, {"critical": branch.special_points[0].force, "self_weight": weightless}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("column.png", dpi=150)
