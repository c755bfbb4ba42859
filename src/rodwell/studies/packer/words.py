"""What becomes of tubing in a packer, in sentences."""

from __future__ import annotations

from rodwell.quantities.units import System
from rodwell.studies.packer.lengths import total
from rodwell.studies.packer.packer import PackerAnswer


def sentences(answer: PackerAnswer) -> list[str]:
    """The verdict, and what else is to be known."""
    return [_verdict(answer), *_more(answer)]


def _verdict(answer: PackerAnswer) -> str:
    m, system = answer.moved, _system(answer)
    change = total(m.changes).value
    word = "longer" if change > 0.0 else "shorter"
    text = f"Free to move, the tubing would become {_length(system, abs(change))} {word}"
    if m.landed_with:
        text += f", and its end would move {_moves(system, m.free.value)} from where it was landed"
    if not m.stopped:
        return f"{text}; the packer lets it: its seals move {_moves(system, m.movement.value)}."
    held = "holds it down with a tension of" if m.packer.value > 0.0 else "carries it with a compression of"
    lets = "does not let it" if m.movement.value == 0.0 else f"lets it move {_moves(system, m.movement.value)}"
    return f"{text}; the packer {lets} and {held} {system.text(abs(m.packer.value), 'force')}."


def _more(answer: PackerAnswer) -> list[str]:
    m, system = answer.moved, _system(answer)
    out = []
    if m.effective.value < 0.0 and answer.state != "straight":
        whole = m.neutral.value >= answer.tubing.length
        part = "up to the top" if whole else f"{_length(system, m.neutral.value)} above it"
        out.append(
            f"Above the packer the tubing is {answer.state}, under an effective compression of "
            f"{system.text(-m.effective.value, 'force')}, which ends {part}."
        )
    elif m.effective.value < 0.0:
        out.append("Above the packer the tubing is straight: its effective compression is below the buckling load.")
    else:
        out.append("Above the packer the effective force is tension: the tubing is straight.")
    worst = max(float(value) for value in answer.stress.von_mises)
    strength = answer.case.yield_strength
    text = f"The largest equivalent stress, of packer and upper end, is {system.text(worst, 'stress')}"
    if strength is not None and worst > strength:
        text += f": beyond the yield strength of {system.text(strength, 'stress')}, so the tubing stays bent"
    elif strength is not None:
        text += f", {worst / strength:.0%} of the yield strength"
    out.append(text + ".")
    other = answer.unloading
    if answer.tubing.angle > 0.0 and other.free.value != m.free.value:
        out.append(
            "In an inclined hole the history counts. Numbers are for a load that grows; as it falls, places stay "
            f"helical longer: {_length(system, abs(other.free.value - m.free.value))} of movement, "
            f"{system.text(abs(other.packer.value - m.packer.value), 'force')} of the packer's force."
        )
    return out


def _system(answer: PackerAnswer) -> System:
    assert answer.case.scales is not None
    return answer.case.scales.system


def _length(system: System, value: float) -> str:
    return system.text(value, "length")


def _moves(system: System, value: float) -> str:
    return "nowhere" if value == 0.0 else f"{_length(system, abs(value))} {'down' if value > 0.0 else 'up'}"
