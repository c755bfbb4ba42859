import rodwell

wire = rodwell.Problem(weight=0, clearance=0.01)
path = rodwell.load_path(wire, until=-82, unload_to=-30)
for event in path.events:
    print(f"{event.leg:9} {event.force.value:.8f} ± {event.force.error:.0e}  {event.meaning}")
for sentence in path.meaning:
    print(sentence)
