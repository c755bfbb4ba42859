import rodwell

case = rodwell.Case.read("examples/guidewire.toml")  # mm, N·mm², N/m: any units, with their names
newton = case.scales.factor("force")  # B/L² in N
push = -rodwell.critical_loads(case.problem, 1)[0].force * newton
print(f"buckles at a push of {push:.3f} N at s = 1")

wire = case.problem.but(weight=0.0, turns=1, ends="pinned-pinned")  # no weight, wound once around the vessel
coil = rodwell.coil(wire, until=-15.0 / newton)
for p in coil.special_points:
    print(f"{p.kind:<12} push {-p.force * newton:.3f} N, stability index {p.index_after}")
state = coil.at(-10.0 / newton)  # 10 N of push
total, error = state.total_wall_force
per_mm = state.largest("contact_pressure")[0] * case.scales.factor("force_per_length") / 1e3
print(f"at 10 N the wall bears {total * newton:.4f} ± {error * newton:.0e} N, at most {per_mm:.4f} N/mm")
rodwell.export(state, ["results/wire/wire.html", "results/wire/wire.glb", "results/wire/wire.csv"], scales=case.scales)
