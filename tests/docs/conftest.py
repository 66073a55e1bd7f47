"""The pages of the documentation, and what the program says of itself."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ["ITIN_PROGRAM"])
sys.path += [str(SOURCE / "cli" / "reference"), str(SOURCE / "docs" / "site")]

import stage  # noqa: E402
import verbs  # noqa: E402

PAGES = [SOURCE / "README.md", *stage.guides()]


def page_name(page: Path) -> str:
    return str(page.relative_to(SOURCE))


def prose(page: Path) -> str:
    """The page without blocks of code: text, and code within text."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"^    .*$", "", text, flags=re.MULTILINE)


@pytest.fixture(scope="session")
def program() -> verbs.Program:
    return verbs.read_program(PROGRAM)
