"""Beyond lift-off in a hole that builds: the curve holds the rod on its wall far longer than a straight hole does.

The same rod as in the load path of a straight hole, on the outside of an arc of 0.2 rad. It buckles and lifts off at
about twice the compression and snaps to a helix of two turns. On the way back (dashed) it loses one turn, then the
other, before it lies along the hole again.
"""

import rodwell


def main():
    path = rodwell.load_path(rodwell.Problem(weight=15, alpha=90, build=0.2), until=-360.0, unload_to=-170.0)
    ax = path.plot()
    return ax.figure, {f"{one.leg} {one.kind}": one.force.value for one in path.events}


if __name__ == "__main__":
    figure, _ = main()
    figure.savefig("build_path.png", dpi=150)
