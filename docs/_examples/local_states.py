import numpy as np

import rodwell
from rodwell.analysis.endless.local import LIMITS, helical_contact, load_and_slope
from rodwell.formulas.path import path_contact_force

# 5 in, 19.5 lbf/ft drill pipe in an 8.5 in horizontal hole in mud: SI units
stiffness, load, clearance = 1.228e6, 241.0, 0.04445  # B in N m², q in N/m, D in m
compression = np.array([100e3, 200e3, 260e3])  # P in N, positive

beta, slope = load_and_slope(compression, load, stiffness, clearance)
print("β", beta.round(3), " slope", round(float(slope), 4))
print("straight up to", round(2.0 * float(np.sqrt(stiffness * load / clearance)) / 1e3, 1), "kN")

sideways = beta[(beta >= 2.0) & (beta <= LIMITS.sinusoidal_lift_off.value)]
state = rodwell.local_state(sideways, "sinusoidal", slope)
print("sinusoidal: mean contact", (load * state.contact_mean).round(2), "N/m")
print("helical:    mean contact", round(helical_contact(260e3, load, stiffness, clearance), 2), "N/m")
print(rodwell.endless(float(beta[1]), float(slope)))

# the same force in a hole that builds by 3° in 30 m, 60° from the vertical
q = path_contact_force(w=load, alpha=60.0, F=200e3, build=np.radians(3.0) / 30.0, turn=0.0)
curved, slope = load_and_slope(200e3, q, stiffness, clearance)
print("in the curve: q", round(q, 1), "N/m, β", round(float(curved), 3))
