import rodwell

coil = rodwell.equilibrium(rodwell.Problem(15, turns=1, twist=2.0), -140.0)
rod = coil.geometry(2001)  # true scale; radial_scale=None: a scale that can be read
print("centreline", rod.centreline.shape, "frames", rod.t1.shape, rod.d0.shape, "radius", rod.rod_radius)
print("twist of the material lines", rod.material_curvatures[0, 0], "= −T₁/C")

case = rodwell.Case.read("examples/drill-string.toml")
state = rodwell.follow(case.problem).lift_off.solution
files = rodwell.export(state, ["results/space/rod.stl", "results/space/rod.vtu"], scales=case.scales)
print(*[file.name for file in files])
