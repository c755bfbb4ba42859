"""The paper recomputed: every number and figure of *Buckling and lift-off of a heavy rod compressed into a cylinder*.

One module for each figure or group of numbers. Each says what is computed and which printed numbers it answers for;
:mod:`rodwell.studies.paper.items` lists them all.
"""
