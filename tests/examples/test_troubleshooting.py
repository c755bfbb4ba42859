"""The page of messages names messages that exist."""

import re
from itertools import pairwise
from pathlib import Path

import pytest

HOME = Path(__file__).parents[2]
PAGE = HOME / "docs/howto/troubleshooting.md"


def quoted() -> list[str]:
    """Messages that the page explains: quoted, at the head of a definition."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    heads = [line for line, after in pairwise(lines) if after.startswith(": ") and line[:1] == '"']
    return [message for line in heads for message in re.findall(r'"([^"]+)"', line)]


@pytest.fixture(scope="module")
def source() -> str:
    """All of the program as one text, literals that follow each other joined."""
    text = "\n".join(file.read_text(encoding="utf-8") for file in (HOME / "src/rodwell").rglob("*.py"))
    return re.sub(r'"\s*\n\s*f?"', "", text)


@pytest.mark.parametrize("message", quoted())
def test_the_program_says_so(message: str, source: str) -> None:
    """Where values stand there are dots on the page."""
    for part in filter(None, (part.strip() for part in message.split("…"))):
        assert part in source
