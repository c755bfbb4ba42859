"""Lift-off over weight and inclination: where another mode buckles first, and where another place leaves the wall.

Colours and lines: the compression at the end s = 1 at which the rod leaves the wall. Hatched: a compression of 160 B/L²
lifts it off. Marks: between two neighbours of the grid the mode changes, or the place that lifts off jumps; each is
located to a 64th of their distance.
"""

import rodwell
from rodwell.plots.style import new_axes
from rodwell.studies.maps.jumps import MODE


def main():
    found = rodwell.map(
        rodwell.Problem(15, 90), "lift-off", over={"weight": "5..120 in 17", "alpha": "45..90 in 7"},
    )  # fmt: skip
    ax = new_axes((7.2, 4.8))
    found.plot(ax, load=-160.0)
    where = found.jumps
    flat = where["at_alpha"] == 90.0
    return ax.figure, {
        "values": found.values,
        "weights": found.question.axes[0].numbers,
        "counts": found.counts,
        "low": where["low"][flat & (where["outcome"] == MODE)],
        "high": where["high"][flat & (where["outcome"] == MODE)],
    }


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("lift-off-map.png", dpi=150)
