import matplotlib.pyplot as plt

import rodwell
from rodwell.plots.bifurcation import plot_bifurcation

result = rodwell.diagram(rodwell.Problem(weight=15, alpha=90), modes=4, until=-500)
figure, ax = plt.subplots(figsize=(5.2, 3.4), layout="constrained")  # inches
plot_bifurcation(result.branches, result.critical, ax=ax)
ax.get_legend().remove()
figure.savefig("results/figure.pdf")  # vector graphics
figure.savefig("results/figure.png", dpi=200)
plt.close(figure)
for joint in result.joints:
    print(f"{joint.child} leaves {joint.branch} at F = {joint.force:.4f} B/L²")
