import rodwell
from rodwell.analysis.discrete.measures import Measured

# γ = mg L³/B; degrees from the vertical; Δ/L; T₁ in B/L; both ends clamped
problem = rodwell.Problem(weight=15, alpha=60, clearance=0.01, twist=0.5)
branch = rodwell.follow(problem, mode=1, until=-150)  # F at s = 1 in B/L²
for p in branch.special_points:
    change = f"index {p.index_before} → {p.index_after}"
    print(f"{p.kind:<12} F = {p.force:.8f} ± {p.error:.0e}  {change}")

state = branch.at(-110.0)
print("stable under dead loads:", state.stable)
print("largest pressure, error, places:", state.highest_pressure)
energy, error = state.number(Measured.ENERGY)
print(f"energy above the straight rod: {energy:.8f} ± {error:.0e} B/L")
print(f"certificate: {state.certificate.worst:.0e}, passed: {state.certificate.passed}")

fields = state.fields(401)  # every variable of the paper at 401 places
print(", ".join(fields))
data = branch.dataset  # xarray: all points, with units, equation numbers and errors
data.to_netcdf("results/branch.nc", engine="h5netcdf")
print(data["T2"].attrs)
