"""What the docs name is there: modules and what is in them, files and folders, and the rooms of the house."""

from __future__ import annotations

import ast
import re
import tomllib
from contextlib import suppress
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

import rodwell
from rodwell.quantities.units import KINDS, to_si

ROOT = Path(__file__).parent.parent
SOURCE = ROOT / "src" / "rodwell"
PAGES = sorted(
    page
    for page in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *ROOT.glob("docs/*.md"), *ROOT.glob("docs/*/*.md"))
    if page.parent.name not in ("_generated", "_build") and page.name != "changes.md"  # which names what was
)
ABOUT_CODE = (ROOT / "CONTRIBUTING.md", ROOT / "docs" / "architecture.md")

DOTTED = re.compile(r"(?<![\w./-])rodwell(?:\.[A-Za-z_]\w*)+")
LISTED = re.compile(r"^\.\. automodule:: (\S+)\n +:members: (\w.*)$", re.MULTILINE)
SPAN = re.compile(r"(?<!`)`([^`\n]+)`(?!`)")
PATH = re.compile(r"\.?[a-z_][\w.*-]*(?:/[\w.*-]+)+/?|[a-z_]+/|\w+\.py")
WORD = re.compile(r"[A-Za-z_]\w+(?=\(\)|$)")
WRITTEN = "results/"
"""What begins so is written by a run."""


def spans(page: Path) -> set[str]:
    """What stands between backticks on a page, without the targets of roles, outside blocks of code."""
    text = re.sub(r"^ *```.*?^ *```$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    return {re.sub(r" <.*>$", "", span) for span in SPAN.findall(text)}


@cache
def tree(module: str) -> ast.Module:
    origin = find_spec(module).origin  # type: ignore[union-attr]
    return ast.parse(Path(str(origin)).read_text(encoding="utf-8"))


def is_unit(span: str) -> bool:
    """Whether what looks like a path is a unit, as in "kg/m3"."""
    for kind in KINDS:
        with suppress(ValueError):
            to_si(f"1 {span}", kind)
            return True
    return False


@cache
def is_module(name: str) -> bool:
    """Whether there is a module; parents are imported, and are empty or small."""
    try:
        return find_spec(name) is not None
    except ModuleNotFoundError:
        return False


def there(name: str) -> bool:
    """Whether a dotted name is that of a module, of what a module defines or hands on, or of a member of a class."""
    module, rest = name, []
    while not is_module(module):
        module, _, last = module.rpartition(".")
        rest.insert(0, last)
    return not rest or found(module, *rest)


def found(module: str, first: str, *rest: str) -> bool:
    """Whether a module has a name and that, if it is a class, has a member."""
    if module == "rodwell" and first in rodwell._HOME:
        module = rodwell._HOME[first]
    for node in tree(module).body:
        if isinstance(node, ast.ImportFrom) and first in [alias.asname or alias.name for alias in node.names]:
            return found(str(node.module), first, *rest)
        if first in names_of(node):
            return not rest or (isinstance(node, ast.ClassDef) and has_member(module, node, rest[0]))
    return False


def names_of(node: ast.AST) -> list[str]:
    """What a statement defines."""
    if isinstance(node, ast.ClassDef | ast.FunctionDef):
        return [node.name]
    targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
    return [leaf.id for target in targets if target for leaf in ast.walk(target) if isinstance(leaf, ast.Name)]


def has_member(module: str, node: ast.ClassDef, member: str) -> bool:
    """Whether a class, or one that it stands on, has a member."""
    if any(member in names_of(statement) for statement in node.body):
        return True
    bases = [base.id for base in node.bases if isinstance(base, ast.Name)]
    return any(found(module, base, member) for base in bases)


def is_path(path: str) -> bool:
    """Whether a path, from the root of the repository or of the package, leads somewhere; ``*`` is any part of it."""
    if "/" not in path:
        return any(any((ROOT / folder).rglob(path)) for folder in ("src", "tests", "docs", "benchmarks"))
    return any([*base.glob(path.rstrip("/")), *base.glob(f"{path}.py")] for base in (ROOT, SOURCE))


@cache
def words() -> frozenset[str]:
    """All words of the code and its settings, and the names of its files and folders."""
    files = [*SOURCE.rglob("*.py"), *ROOT.glob("tests/**/*.py"), ROOT / "pyproject.toml", *ROOT.glob("docs/*.py")]
    out = {part for file in files for part in file.relative_to(ROOT).with_suffix("").parts}
    for file in files:
        out.update(re.findall(r"\w+", file.read_text(encoding="utf-8")))
    return frozenset(out)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_dotted_names_and_paths_of_a_page_are_there(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    names = set(DOTTED.findall(text))
    names |= {f"{module}.{name}" for module, listed in LISTED.findall(text) for name in listed.split(", ")}
    paths = {
        span for span in spans(page) if PATH.fullmatch(span) and not span.startswith(WRITTEN) and not is_unit(span)
    }
    missing = [name for name in names if not there(name)] + [path for path in paths if not is_path(path)]
    assert not missing, f"{page.relative_to(ROOT)} names what is not there: {sorted(missing)}"


@pytest.mark.parametrize("page", ABOUT_CODE, ids=lambda page: page.name)
def test_words_for_those_who_change_the_code_occur_in_it(page: Path) -> None:
    missing = {span for span in spans(page) if (word := WORD.match(span)) and word[0] not in words()}
    assert not missing, f"{page.name} has names that the code has not: {sorted(missing)}"


def test_the_page_on_architecture_has_every_room_of_the_contracts() -> None:
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    rooms = {
        "/".join([*container.split(".")[1:], room])
        for contract in contracts
        if contract["type"] == "layers"
        for container in contract["containers"]
        for layer in contract["layers"]
        for room in layer.split(" | ")
    }
    rooms |= {m.removeprefix("rodwell.").replace(".", "/") for c in contracts for m in c.get("modules", ())}
    missing = rooms - spans(ABOUT_CODE[1])
    assert not missing, f"docs/architecture.md lacks the rooms {sorted(missing)}"


def test_names_that_are_not_there_are_seen() -> None:
    assert there("rodwell.Branch.at")
    assert there("rodwell.Solution.force"), "a member of the record that it stands on"
    assert there("rodwell.formulas.Formula"), "handed on"
    assert not there("rodwell.practice.case")
    assert not there("rodwell.Branch.nowhere")
    assert not there("rodwell.numerics.splines.held.nowhere")
    assert is_path("numerics/splines/held")
    assert is_path("case/data/*.toml")
    assert not is_path("numerics/ladder")
