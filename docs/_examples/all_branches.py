import rodwell
from rodwell.plots.bifurcation import plot_bifurcation

problem = rodwell.Problem(weight=15, alpha=90)  # both ends clamped, Δ/L = 0.01
result = rodwell.diagram(problem, modes=4, until=-700)
for joint in result.joints:
    print(f"{joint.child} and {joint.branch} meet at F = {joint.force:.4f} B/L²")
broken = result["secondary 1"]
print(broken, "because", broken.ended_because)
print("images:", ", ".join(image.name for image in result.images(broken)))
print("every number within rtol:", result.converged)
plot_bifurcation(result.branches, result.critical).figure.savefig("results/diagram.png")
result.datasets["mode 1"].to_netcdf("results/mode-1.nc", engine="h5netcdf")
