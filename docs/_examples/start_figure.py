import matplotlib.pyplot as plt

import rodwell
from rodwell.plots.bifurcation import plot_bifurcation

result = rodwell.diagram(rodwell.Problem(weight=15, alpha=90), modes=4, until=-500)
figure, ax = plt.subplots(figsize=(3.4, 2.6), layout="constrained")  # one column of a journal, inches
plot_bifurcation(result.branches, result.critical, ax=ax)
ax.get_legend().remove()
figure.savefig("results/figure.pdf")  # vector graphics
figure.savefig("results/figure.png", dpi=200)
plt.close(figure)
print([f"{joint.child} leaves {joint.branch} at F = {joint.force:.4f}" for joint in result.joints])
