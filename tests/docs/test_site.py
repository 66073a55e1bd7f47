"""The check of the built site finds what it is for; and where there is mkdocs, the site passes it."""

from __future__ import annotations

import importlib.util
import os
import subprocess
from pathlib import Path

import check
import options_whole
import pytest
import stage
from conftest import PROGRAM, SOURCE


@pytest.mark.parametrize(
    "body, fault",
    [
        ('<script src="https://example.org/a.js"></script>', "loads https://example.org/a.js"),
        ('<img src="//example.org/a.png">', "loads //example.org/a.png"),
        ('<a href="gone.html">there</a>', "gone.html leads nowhere"),
        ('<a href="#gone">there</a>', "#gone: there is no such place"),
        ("<p>These:\n- one</p>", "a list or table became text"),
    ],
)
def test_faults_are_found(tmp_path: Path, body: str, fault: str) -> None:
    (tmp_path / "page.html").write_text(f"<html><body>{body}</body></html>")
    found = check.faults(tmp_path)
    assert len(found) == 1 and fault in found[0]


def test_links_outside_are_no_fault(tmp_path: Path) -> None:
    (tmp_path / "page.html").write_text('<a href="https://example.org">there</a><a id="x" href="page.html#x">here</a>')
    assert check.faults(tmp_path) == []


def test_a_sheet_that_loads_from_outside_is_found(tmp_path: Path) -> None:
    (tmp_path / "a.css").write_text("@import 'https://example.org/font.css'; a { background: url(data:image/png;base64,xx) }")
    assert len(check.faults(tmp_path)) == 1


def test_links_to_sources_become_text(tmp_path: Path) -> None:
    pages = stage.stage(tmp_path)
    assert Path("README.md") in pages
    assert "](examples)" not in (tmp_path / "README.md").read_text()


def test_lists_get_room() -> None:
    assert stage.with_lists_apart("These:\n- one\n  more\n- two") == "These:\n\n- one\n  more\n- two"
    assert stage.with_lists_apart("```\na\n- b\n```") == "```\na\n- b\n```"


def test_the_site_is_built_and_sound() -> None:
    if importlib.util.find_spec("mkdocs") is None or not Path("/usr/share/mkdocs/themes/material").exists():
        pytest.skip("there is no mkdocs-material; scripts/docs installs it")
    done = subprocess.run(
        [SOURCE / "scripts" / "docs"], env={**os.environ, "ITIN_PROGRAM": str(PROGRAM)}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_options_in_calls_stay_whole() -> None:
    call = '<div class="language-sh highlight"><code>itin<span class="w"> </span>tin<span class="w"> </span>--all -o</code></div>'
    whole = options_whole.on_page_content(call)
    assert '<span class="whole">--all</span>' in whole and '<span class="whole">-o</span>' in whole
    assert options_whole.on_page_content("<p>a --all</p>") == "<p>a --all</p>"
