"""The page on what rodwell stands on knows every package, and each has a licence that rodwell's users can live with."""

import re
from typing import Any

import pytest
from programs import ROOT, loaded

PERMISSIVE = r"BSD|MIT|Apache|PSF|Python Software Foundation|Zlib|0BSD|CC0|HPND"
LIBRARIES = {"python-flint": "LGPL"}
"""Bindings of a library under weak copyleft, which stays a library of its own."""


@pytest.fixture(scope="module")
def page() -> Any:
    """The module that makes the page."""
    return loaded(ROOT / "docs" / "make_dependencies.py")


def test_the_page_says_what_each_package_is_for(page: Any) -> None:
    assert {package.name for group in page.needed().values() for package in group} == set(page.WHY)


def test_licences_are_permissive(page: Any) -> None:
    direct = [package for group in page.needed().values() for package in group]
    for package in [*direct, *page.behind()]:
        assert re.search(PERMISSIVE, package.licence), package
        copyleft = re.search(r"[AL]?GPL", package.licence)
        assert (copyleft.group() if copyleft else None) == LIBRARIES.get(package.name), package
