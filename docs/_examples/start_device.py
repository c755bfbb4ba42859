import rodwell

case = rodwell.Case.read("examples/guidewire.toml")
newton = case.scales.factor("force")  # B/L² in N
per_mm = case.scales.factor("force_per_length") / 1e3  # B/L³ in N/mm
push = -rodwell.critical_loads(case.problem, 1)[0].force * newton
print(f"buckles at a push of {push:.3f} N at s = 1")

# no weight, both ends pinned, wound once around the vessel
wire = case.problem.but(weight=0.0, turns=1, ends="pinned-pinned")
coil = rodwell.coil(wire, until=-15.0 / newton)  # tension positive
for p in coil.special_points:
    print(f"{p.kind:<12} push {-p.force * newton:.3f} N, index {p.index_after}")

state = coil.at(-10.0 / newton)  # 10 N of push
total, error = (number * newton for number in state.total_wall_force)
most = state.largest("contact_pressure").value * per_mm
print(f"at 10 N the wall bears {total:.4f} ± {error:.0e} N, at most {most:.4f} N/mm")

files = [f"results/wire/wire.{suffix}" for suffix in ("html", "glb", "csv")]
rodwell.export(state, files, scales=case.scales)
