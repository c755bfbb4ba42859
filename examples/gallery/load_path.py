"""The whole load path: lift-off, partial contact, the snap into a helix, and the way back.

Compression grows (solid) until partial contact ends in a limit point and the rod snaps into a helix; taken off
(dashed), the helix stays until it has come off the wall and falls back to the straight shape.
"""

import rodwell


def main():
    path = rodwell.load_path(rodwell.Problem(weight=15, alpha=90), until=-155.0, unload_to=-95.0)
    ax = path.plot()
    loads = {f"{one.leg} {one.kind}": one.force.value for one in path.events}
    return ax.figure, loads


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("load_path.png", dpi=150)
