import rodwell
from rodwell.analysis.discrete.measures import Measured

problem = rodwell.Problem(weight=15, alpha=90, turns=1)  # both ends clamped, Δ/L = 0.01
branch = rodwell.coil(problem)
for p in branch.special_points:
    print(f"{p.kind:<12}  F = {p.force:.6f} ± {p.error:.0e} B/L²   index {p.index_before} → {p.index_after}")
for force in (-140.0, -200.0):
    energy, error = branch.at(force).number(Measured.ENERGY)
    print(f"energy above the straight rod at F = {force:g}: {energy:.6f} ± {error:.0e} B/L")
