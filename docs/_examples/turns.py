import rodwell

rod = rodwell.Problem(weight=15, alpha=90, clearance=0.005)  # clamped, horizontal
for force in (-60.0, -300.0, -1200.0):  # B/L² at s = 1, tension positive
    found = rodwell.turns_of_least_energy(rod, force)
    energies = ", ".join(f"{turns}: {energy.value:.5g}" for turns, energy in found.energies.items())
    print(f"F = {force:g}: {found.turns} turns; energy in B/L by turns: {energies}")
