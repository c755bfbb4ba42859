"""No circle between files, however they import each other; no file longer, no folder fuller than one looks through."""

from __future__ import annotations

import ast
import graphlib
from collections import Counter
from pathlib import Path

import pytest

import rodwell
from rodwell import faces

SOURCE = Path(rodwell.__file__).parent.parent
FILES = {
    ".".join(p.relative_to(SOURCE).with_suffix("").parts).removesuffix(".__init__"): p
    for p in (SOURCE / "rodwell").rglob("*.py")
}
ROOT = Path(__file__).parents[1]
OF_OTHERS = (".min.js",)  # three.js, as it came
MADE = {"_build", "_generated", "jupyter_execute"}  # while the documentation is built
LINES, IN_A_FOLDER = 300, 20


def named(name: str) -> str:
    """The file that a dotted name lies in; "" for the door and for other packages.

    The door's strings fill the hooks of ``faces``, and nothing imports the door.
    """
    while name and name not in FILES:
        name = name.rpartition(".")[0]
    return "" if name == "rodwell" else name


def imports(path: Path) -> set[str]:
    """Files that a file imports, or names in a string."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value.startswith("rodwell."):
            found.add(node.value)
    return {named(name) for name in found} - {""}


def test_files_import_each_other_in_no_circle() -> None:
    graph = {name: imports(path) - {name} for name, path in FILES.items() if name != "rodwell"}
    graphlib.TopologicalSorter(graph).prepare()  # raises CycleError, with the circle


def test_hooks_of_results_are_filled_by_the_door_and_refuse_to_be_empty(monkeypatch: pytest.MonkeyPatch) -> None:
    assert set(faces._faces) == set(faces.HOOKS)
    with pytest.raises(LookupError, match="no hook 'sound'"):
        faces.fill(sound=print)
    monkeypatch.setattr(faces, "_faces", {})
    with pytest.raises(LookupError, match="'html' is empty"):
        faces.Shown()._repr_html_()


def scripts(room: Path) -> list[Path]:
    """Python and JavaScript that is written by hand, in a room and below."""
    found = [path for suffix in ("py", "js") for path in room.rglob(f"*.{suffix}")]
    return [path for path in found if not path.name.endswith(OF_OTHERS) and MADE.isdisjoint(path.parts)]


@pytest.mark.parametrize("room", [SOURCE / "rodwell", *(ROOT / name for name in ("tests", "docs", "benchmarks"))])
def test_no_file_has_more_lines_than_one_looks_through(room: Path) -> None:
    lines = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in scripts(room)}
    assert lines
    assert {path: number for path, number in lines.items() if number > LINES} == {}


@pytest.mark.parametrize("room", [SOURCE / "rodwell", ROOT / "tests"])
def test_no_folder_has_more_files_than_one_looks_through(room: Path) -> None:
    """But that of the commands, which has one for each."""
    folders = Counter(path.parent for path in scripts(room))
    assert {folder: n for folder, n in folders.items() if n > IN_A_FOLDER and folder.name != "cli"} == {}


@pytest.mark.parametrize("name", ["html", "plot", "dataset", "plain"])
def test_what_has_no_face_says_so(name: str) -> None:
    with pytest.raises(TypeError, match="object"):
        faces.face(name)(object(), None) if name == "plot" else faces.face(name)(object())
