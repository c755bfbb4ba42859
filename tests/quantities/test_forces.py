"""One end, one sign: compression at the end shown, the other in brackets; research keeps tension positive at s = 1."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales
from rodwell.quantities.units import System
from rodwell.quantities.value import Value

NEWTON = Scales(length=1.0, stiffness=1.0)
AT_BOTTOM = Scales(length=1.0, stiffness=1.0, bottom=True)
FORCE = Value(-100.0, 0.01)


def test_an_inclined_rod_bears_more_at_the_bottom() -> None:
    """N(0) = F − mg L cos α: 100 N of compression at the top are 140 N at the bottom under 40 N of axial weight."""
    top, bottom = Forces(NEWTON, 40.0), Forces(AT_BOTTOM, 40.0)
    assert top.load(FORCE, other=True) == "100.0 N of compression at the top (140.0 N at the bottom)"
    assert bottom.load(FORCE, other=True) == "140.0 N of compression at the bottom (100.0 N at the top)"
    assert bottom.below(FORCE) == "the compression at the bottom below 140.0 N (100.0 N at the top)"
    assert bottom.load(Value(20.0, 1e-3), other=True) == (
        "20.00 N of compression at the bottom (20.00 N of tension at the top)"
    )


def test_a_horizontal_rod_has_one_force_and_research_has_its_own_sign() -> None:
    assert Forces(AT_BOTTOM, 0.0).load(FORCE, other=True) == "100.0 N of compression"
    assert Forces(None, 40.0).load(FORCE, other=True) == "the end force −100.0 B/L² at s = 1"
    assert Forces(None, 40.0).axis == "end compression −F at s = 1"


def test_messages_of_the_engine_name_forces_in_the_readers_words() -> None:
    """The rod of 40 N bears 40 N more compression at the bottom than the 100 B/L² at s = 1."""
    message = "the rod gives way at F = -100 B/L², beyond F = 1.5e-05 B/L²: F = ma stays"
    said = "the rod gives way at 140 N of compression at the bottom, beyond 40 N of compression at the bottom"
    assert Forces(AT_BOTTOM, 40.0).retold(message) == f"{said}: F = ma stays"
    assert Forces(None, 40.0).retold(message) == (
        "the rod gives way at F = −100 B/L², beyond F = 1.5 × 10⁻⁵ B/L²: F = ma stays"
    )


@given(st.floats(-1e4, 1e4), st.floats(0.0, 1e4), st.booleans(), st.sampled_from(["si", "field", "mm"]))
def test_both_ends_differ_by_the_axial_weight(force: float, weight: float, bottom: bool, system: str) -> None:
    said = Forces(Scales(2.0, 3.0, system=System(system), bottom=bottom), weight)
    here = said.compression(Value(force)).value
    assert here == (weight - force if bottom else -force)
    assert said.drawn(force) == here
