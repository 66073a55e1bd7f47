"""What pages say in prose: links and anchors lead somewhere, on GitHub too; options exist; every guide is on the site."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import stage
import verbs
from conftest import PAGES, SOURCE, page_name, prose


def anchors(page: Path) -> set[str]:
    """The anchors that GitHub, and the site, give the headings of a page."""
    found: set[str] = set()
    for heading in re.findall(r"^#+ (.*)$", prose_with_code(page), re.MULTILINE):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return found


def prose_with_code(page: Path) -> str:
    return re.sub(r"^```.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_links_lead_to_places_that_are_there(page: Path) -> None:
    for match in stage.LINK.finditer(re.sub(r"`[^`\n]*`", "", prose_with_code(page))):
        target, anchor = match[3], match[4]
        if "://" in target:
            continue
        file = (page.parent / target).resolve() if target else page
        assert file.exists(), match[0]
        if anchor:
            assert anchor[1:] in anchors(file), match[0]


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_options_in_prose_exist(page: Path, program: verbs.Program) -> None:
    known = {name for verb in program.verbs for option in verb.options for name in option.names} | {"--version"}
    for code in re.findall(r"`([^`\n]+)`", prose(page)):
        own = re.sub(r"\b(scripts|cmake|gdal\w*|ssh|docs|podman|apt-get)\b.*", "", code)
        for option in re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", own):
            assert option in known, f"{option} in `{code}`"


def test_every_guide_is_on_the_site() -> None:
    on_site = {path for _, entries in stage.NAVIGATION for _, path in entries}
    assert {page_name(page) for page in PAGES} <= on_site


def test_names_of_blocks_are_those_that_are_run() -> None:
    """A block is run (sh, bash by bindings/dask/tests, python, cpp, cmake), or has no name where it only shows."""
    for page in PAGES:
        opened = re.findall(r"^```(.*)$", page.read_text(), re.MULTILINE)[::2]
        assert set(opened) <= {"", "sh", "bash", "python", "cpp", "cmake"}, page


def test_blocks_in_cpp_and_cmake_are_of_pages_that_are_compiled() -> None:
    for page in PAGES:
        if re.search(r"^```cpp$", page.read_text(), re.MULTILINE):
            assert page_name(page) in {"docs/cpp.md", "README.md"}  # tests/consumer compiles the first
