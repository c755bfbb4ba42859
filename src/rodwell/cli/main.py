"""Entry point of the command ``rodwell``: heavy modules are imported by the commands that need them."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")  # threads slow small banded systems; must be set before NumPy loads
os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")  # case files are read the same wherever others add some

import click

from rodwell._version import __version__
from rodwell.cli.terminal import Terminated, ending_well, interrupt_behind, never_fail_to_encode, output_is_lost
from rodwell.compiling.garbage import collect_seldom
from rodwell.errors import CacheWarning, InputError, InputWarning, RodwellError

INPUT_ERROR, COMPUTATION_ERROR, INTERRUPTED = 2, 1, 130

MODULES = {
    **{name: name for name in ("run", "screen", "drag", "packer", "audit", "critical", "path", "endless", "explore")},
    **{name: name for name in ("export", "init", "keys", "catalogue", "paper", "sensitivity")},
    **dict.fromkeys(("certify", "modes"), "exact"),
    **dict.fromkeys(("liftoff", "twist"), "quick"),
    **dict.fromkeys(("diagram", "curve"), "maps"),
    **{"verify": "check", "map": "mapping"},
}
"""Module of :mod:`rodwell.cli` in which each command stands."""


class Commands(Mapping[str, click.Command]):
    """The commands by name: the module of one is imported when it is asked for, for one does not need the others."""

    def __getitem__(self, name: str) -> click.Command:
        module = import_module(f"rodwell.cli.{MODULES[name]}")
        command: click.Command = getattr(module, "map_command" if name == "map" else name)
        return command

    def __iter__(self) -> Iterator[str]:
        return iter(MODULES)

    def __len__(self) -> int:
        return len(MODULES)


@click.group(commands=Commands(), context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="rodwell")
def cli() -> None:
    """Slender rods inside cylinders: buckling, lift-off, and what the wall must bear.

    Forces are those at the end s = 1 (the upper end of an inclined cylinder), tension positive; ends are
    clamped unless said otherwise. Start with:  rodwell init, which writes a first case file; rodwell keys
    explains its keys.
    """


def main() -> None:
    """Run the command line; turn every expected error into one message and an exit code."""
    collect_seldom()
    warnings.showwarning = _warned
    never_fail_to_encode()
    try:
        with ending_well():
            cli.main(standalone_mode=False)
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message())
        sys.exit(INPUT_ERROR)
    except click.ClickException as error:
        error.show()
        sys.exit(error.exit_code)
    except click.Abort as abort:  # click's word for Ctrl-C, but for an EOFError from anywhere as well
        if isinstance(abort.__cause__, EOFError):
            raise abort.__cause__ from None
        _interrupted(abort.__cause__)
    except KeyboardInterrupt as interrupt:
        _interrupted(interrupt)
    except SystemError as error:
        cause = interrupt_behind(error)
        if cause is None:
            raise
        _interrupted(cause)
    except InputError as error:
        click.echo(f"rodwell: error: {error}", err=True)
        sys.exit(INPUT_ERROR)
    except RodwellError as error:
        click.echo(f"rodwell: not converged: {error}", err=True)
        sys.exit(COMPUTATION_ERROR)
    except BrokenPipeError:  # the reader of a pipe has left
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(COMPUTATION_ERROR)
    except MemoryError as error:
        click.echo(f"rodwell: error: there is not memory enough{f': {error}' if str(error) else ''}", err=True)
        sys.exit(COMPUTATION_ERROR)
    except OSError as error:
        click.echo(f"rodwell: error: {output_is_lost(error) or error}", err=True)
        sys.exit(COMPUTATION_ERROR)


_show_warning = warnings.showwarning


def _warned(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
    """Tell a warning of rodwell in one line, without the place in the source; others as Python does."""
    if issubclass(category, CacheWarning | InputWarning):
        click.echo(f"rodwell: warning: {message}", err=True)
    else:
        _show_warning(message, category, *where, **more)


def _interrupted(cause: BaseException | None) -> None:
    what, code = ("interrupted", INTERRUPTED)
    if isinstance(cause, Terminated):
        what, code = f"ended by {cause.name}", cause.exit_code
    kept = getattr(cause, "kept", "nothing was written")
    click.echo(f"rodwell: {what}; {kept}", err=True)
    sys.exit(code)


if __name__ == "__main__":
    main()
