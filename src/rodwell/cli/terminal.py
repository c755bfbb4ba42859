"""Text on the terminal: every character in what the terminal's encoding has; signals that end a run end it well."""

from __future__ import annotations

import codecs
import os
import re
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import click

from rodwell.errors import printable

PLAIN = {
    "−": "-", "–": "-", "—": "-", "‑": "-", "±": "+/-", "×": "x", "·": "*", "°": " deg", "…": "...", "•": "*",
    "→": "->",
    "≥": ">=", "≤": "<=", "≈": "~", "∞": "inf", "√": "sqrt", "∛": "cbrt",
    "∜": "4th root ", "∫": "integral ", "µ": "u", "Δ": "Delta", "γ": "gamma",
    "α": "alpha", "β": "beta", "ν": "nu", "ξ": "xi", "ω": "omega", "θ": "theta", "κ": "kappa", "π": "pi", "ρ": "rho",
    "σ": "sigma", "τ": "tau", "φ": "phi", "ψ": "psi", "Ω": "Omega", "⁻": "^-", "″": "in", "′": "ft", "’": "'",
    "“": '"', "”": '"', "\u00a0": " ", "\u2009": " ", "\u202f": " ",
}  # fmt: skip
"""What stands for a character that an encoding does not have; the others are written as their escapes."""

HANDLER, ASCII = "rodwell.plain", "rodwell_ascii"
"""Names under which Python knows the replacement, and ASCII on a stream."""


def _plain(error: UnicodeError) -> tuple[str | bytes, int]:
    """Replace what cannot be encoded: by what means the same, digits above and below the line too, or by its escape."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    plain = "".join(map(_in_ascii, error.object[error.start : error.end]))
    return re.sub(r"(?<=\^-)\^|(?<=\d)\^(?=\d)", "", plain), error.end  # 10⁻¹² is 10^-12


def _in_ascii(character: str) -> str:
    if character in PLAIN:
        return PLAIN[character]
    for digits, before in (("⁰¹²³⁴⁵⁶⁷⁸⁹", "^"), ("₀₁₂₃₄₅₆₇₈₉", "")):
        if character in digits:
            return f"{before}{digits.index(character)}"
    return character.encode("ascii", "backslashreplace").decode("ascii")


def never_fail_to_encode() -> None:
    """Let standard output and error write every text, whatever their encoding: no minus sign ends a run."""
    codecs.register_error(HANDLER, _plain)
    codecs.register(_named_otherwise)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)  # what stands in for a stream may have none
        if reconfigure is not None:
            ascii_only = codecs.lookup(stream.encoding).name == "ascii"
            reconfigure(encoding=ASCII if ascii_only else None, errors=HANDLER)


def _named_otherwise(name: str) -> codecs.CodecInfo | None:
    """ASCII under another name: click takes a stream of that encoding for a mistake and writes UTF-8 to it."""
    ascii_only = codecs.lookup("ascii")
    return None if name != ASCII else codecs.CodecInfo(
        ascii_only.encode, ascii_only.decode, ascii_only.streamreader, ascii_only.streamwriter,
        ascii_only.incrementalencoder, ascii_only.incrementaldecoder, name=ASCII,
    )  # fmt: skip


def output_is_lost(error: OSError) -> str:
    """What to say where ``error`` is that standard output cannot be written, and where results are; "" where it is not.

    Nothing more is written then: what waits in the stream would be tried again at the end of the program.
    """
    at = error.__traceback__
    while at is not None and at.tb_frame.f_code is not click.echo.__code__:
        at = at.tb_next
    if at is None or at.tb_frame.f_locals["err"]:
        return ""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    text = f"standard output could not be written ({error.strerror or error}): what it was to say is lost"
    folder = sys.modules.get("rodwell.store.folder")  # where nothing is written it is not imported
    places = [] if folder is None else [printable(str(place)) for place in folder.in_place()]
    return f"{text}; results are in {', '.join(places)}" if places else f"{text}; no files were written"


def has_all_characters() -> bool:
    """Whether standard output can hold every character as it is: JSON has its own escapes where it cannot."""
    return (getattr(sys.stdout, "encoding", None) or "").lower().replace("-", "").startswith("utf")


class Terminated(KeyboardInterrupt):
    """A signal that asks to end: what Ctrl-C does, with the signal's own exit code."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number

    @property
    def name(self) -> str:
        """SIGTERM, SIGHUP."""
        return signal.Signals(self.number).name

    @property
    def exit_code(self) -> int:
        """128 and the number of the signal, as shells have it."""
        return 128 + self.number


@contextmanager
def ending_well() -> Iterator[None]:
    """Let SIGTERM and SIGHUP, where they would kill at once, unwind the program: nothing half written stays."""
    before = {}
    if threading.current_thread() is threading.main_thread():
        numbers = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
        before = {number: _end for number in numbers if signal.getsignal(number) is signal.SIG_DFL}  # not under nohup
    for number, handler in before.items():
        signal.signal(number, handler)
    try:
        yield
    finally:
        for number in before:
            signal.signal(number, signal.SIG_DFL)


def _end(number: int, _frame: FrameType | None) -> None:
    raise Terminated(number)


def interrupt_behind(error: BaseException | None) -> BaseException | None:
    """The Ctrl-C or signal that lies behind an error: in a compiled call it surfaces as the cause of a SystemError."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error
