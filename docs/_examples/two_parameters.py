import rodwell

branch = rodwell.follow(rodwell.Problem(weight=15, alpha=89), until=-500)
curve = rodwell.special_curve(branch.labelled("fold 1"), "alpha", 20)  # the fold in F and α (degrees)
for mark in curve.marks:
    print(f"{mark.kind} at α = {mark.x:.6f}°, F = {mark.value:.6f} B/L² at s = 1: {mark.note}")
lift = rodwell.special_curve(branch.labelled("lift_off 1"), "weight", 40)
print(f"lift-off at γ = {lift.x[-1]:g}: F = {lift.values[-1]:.8g} B/L², ± {lift.errors[-1]:.0e}")
