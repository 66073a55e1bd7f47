#!/usr/bin/env python3
"""Finds what is wrong with the built pages: an address outside that a page would load, a link or an anchor that leads
nowhere, and Markdown that has not become what it should.

    check.py HTML_FOLDER
"""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("object", "data")}


class Page(HTMLParser):
    """The anchors of a page, what it loads, and what it links to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = {"", "__skip"}
        self.loads: list[str] = []
        self.links: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name == "id" and value:
                self.anchors.add(value)
            if (tag, name) in LOADED and value:
                self.loads.append(value)
            if (tag, name) == ("a", "href") and value is not None:
                self.links.append(value)


def is_outside(address: str) -> bool:
    parts = urlsplit(address)
    return parts.netloc != "" or parts.scheme not in ("", "data")


def faults(root: Path) -> list[str]:
    found: list[str] = []
    pages = {path: Page(path.read_text()) for path in sorted(root.rglob("*.html"))}
    for path, page in pages.items():
        name = path.relative_to(root)
        if name.name == "404.html":
            continue  # its addresses are those of a server's root
        found += [f"{name}: loads {address}" for address in page.loads if is_outside(address)]
        found += [f"{name}: {paragraph}" for paragraph in lists_that_are_text(path.read_text())]
        for link in [*page.links, *page.loads]:
            parts = urlsplit(link)
            if is_outside(link) or parts.scheme == "data":
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                found.append(f"{name}: {link} leads nowhere")
            elif target in pages and unquote(parts.fragment) not in pages[target].anchors:
                found.append(f"{name}: {link}: there is no such place on that page")
    for sheet in root.rglob("*.css"):
        for address in re.findall(r"url\(\s*[\"']?([^\"')]+)|@import\s+[\"']([^\"']+)", sheet.read_text()):
            if is_outside("".join(address)):
                found.append(f"{sheet.relative_to(root)}: loads {''.join(address)}")
    return found


def lists_that_are_text(html: str) -> list[str]:
    """Lists and tables that mkdocs takes for text, since no empty line stands before them."""
    without_code = re.sub(r"<pre>.*?</pre>|<code>.*?</code>", "", html, flags=re.DOTALL)
    return [f"a list or table became text: {match[1][:60]!r}" for match in re.finditer(r"\n((?:- |\|)[^\n<]+)", without_code)]


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    wrong = faults(Path(sys.argv[1]).resolve())
    sys.exit("\n".join(wrong) or None)
