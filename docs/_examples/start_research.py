import rodwell
from rodwell.analysis.measures import Measured

problem = rodwell.Problem(weight=15, alpha=60, clearance=0.01, twist=0.5)  # γ = mg L³/B, degrees, Δ/L, T₁ in B/L
branch = rodwell.follow(problem, mode=1, until=-150)  # end force at s = 1 in B/L², tension positive
for p in branch.special_points:
    print(f"{p.kind:<12} F = {p.force:.8f} ± {p.error:.0e}  index {p.index_before} → {p.index_after}")

state = branch.at(-110.0)
print("stable under dead loads:", state.stable)
print("largest pressure, error, place:", state.highest_pressure)
print("energy above the straight rod:", state.number(Measured.ENERGY))
print("certificate:", f"{state.certificate.worst:.0e}", "converged:", state.converged)

fields = state.fields(401)  # every variable of the paper at 401 places
print(", ".join(fields))
data = branch.dataset  # xarray: all points, with units, equation numbers and errors
data.to_netcdf("results/branch.nc", engine="h5netcdf")
print(data["T2"].attrs)
