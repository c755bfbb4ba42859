"""A branch that lets go of its tables keeps what was found, and makes them again."""

from __future__ import annotations

import rodwell


def test_numbers_are_the_same_after_the_tables_have_gone() -> None:
    branch = rodwell.follow(rodwell.Problem(weight=15.0), 1)
    force = 0.5 * (float(branch.force[0]) + branch.lift_off.force)

    def numbers() -> tuple[float, ...]:
        state = branch.states_at(force)[0]
        return (
            state.force,
            state.largest("contact_pressure").value,
            state.number("energy").value,
            branch[-1].largest("xi2").value,
        )

    before = numbers()
    spaces = [mesh.space for meshes in branch.trace.meshes for mesh in (meshes.coarse, meshes.fine)]
    assert all("table" in vars(space) for space in spaces)
    assert any(space._tables for space in spaces)
    branch.forget_tables()
    assert not any({"table", "samples", "pieces"} & set(vars(space)) or space._tables for space in spaces)
    assert not any("mesh" in vars(meshes.fine) for meshes in branch.trace.meshes)
    assert numbers() == before
