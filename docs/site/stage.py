#!/usr/bin/env python3
"""Lays out the documentation for mkdocs: the pages and pictures where they lie in the source, so that their links hold,
the reference, and mkdocs.yml.

    stage.py PROGRAM FOLDER

Pages are README.md, those of docs, and what these lead to. What they link to else (a source, a folder) is in the source and
not on the site: there the link becomes plain text.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True

SOURCE = Path(__file__).resolve().parents[2]
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)#\s]*)(#[^)\s]*)?\)")
PICTURES = {".png", ".jpg", ".webp", ".svg"}

Entry = tuple[str, str]
# Pages that another part of the source brings along are left out where it is not there.
NAVIGATION: list[tuple[str, list[Entry]]] = [
    ("Start", [("itin", "README.md"), ("Quick start", "docs/quick-start.md"), ("Installing", "docs/installing.md")]),
    (
        "Understand",
        [
            ("How it works", "docs/how-it-works.md"),
            ("Accuracy", "docs/accuracy.md"),
            ("Refraction", "docs/refraction.md"),
            ("Limitations", "docs/limitations.md"),
            ("Files from strangers", "docs/security.md"),
        ],
    ),
    (
        "How to",
        [
            ("Site a mast", "docs/how-to/mast.md"),
            ("From a lidar tile to a mast", "docs/how-to/lidar-tile.md"),
            ("Check a radio link", "docs/how-to/link.md"),
            ("Assess a wind farm", "docs/how-to/wind-farm.md"),
            ("Place cameras in a street", "docs/how-to/camera.md"),
            ("Take woodland into account", "docs/how-to/woodland.md"),
            ("Combine several sources", "docs/how-to/several-sources.md"),
            ("Work in QGIS", "docs/qgis.md"),
            ("Work in Python", "docs/python.md"),
            ("Use the live map", "docs/live-map.md"),
            ("Use more than one machine", "docs/many-machines.md"),
            ("Come from another program", "docs/coming-from.md"),
        ],
    ),
    (
        "Guides",
        [
            ("Importing", "docs/importing.md"),
            ("Triangulations", "docs/triangulations.md"),
            ("Places", "docs/places.md"),
            ("Viewsheds", "docs/viewsheds.md"),
            ("Lines and links", "docs/lines.md"),
            ("Siting masts", "docs/sites.md"),
            ("Premises", "docs/premises.md"),
            ("Wind turbines", "docs/turbines.md"),
            ("Turbines at dwellings", "docs/dwellings.md"),
            ("Woods", "docs/woods.md"),
        ],
    ),
    (
        "Reference",
        [
            ("All verbs", "docs/reference/index.md"),
            ("Formats", "docs/formats.md"),
            ("The store's bytes", "libitin/FORMAT.md"),
            ("The server's protocol", "cli/serve/PROTOCOL.md"),
            ("Benchmarks", "benchmarks/README.md"),
        ],
    ),
    ("Develop", [("C++", "docs/cpp.md"), ("A walk through the code", "docs/code.md"), ("Contributing", "CONTRIBUTING.md")]),
]


def links(text: str) -> list[str]:
    """The files that a page links to, those in code left out."""
    without_code = re.sub(r"^```.*?^```|`[^`\n]*`", "", text, flags=re.DOTALL | re.MULTILINE)
    return [match[3] for match in LINK.finditer(without_code) if match[3] and "://" not in match[3]]


def guides() -> list[Path]:
    return sorted(path for path in (SOURCE / "docs").rglob("*.md") if "site" not in path.relative_to(SOURCE).parts)


def pages_and_pictures() -> tuple[list[Path], set[Path]]:
    """README, the guides, and all pages and pictures that these lead to."""
    pages, pictures = [SOURCE / "README.md", *guides()], set()
    for page in pages:  # grows meanwhile
        for link in links(page.read_text()):
            target = (page.parent / link).resolve()
            if target.suffix == ".md" and target.is_file() and target not in pages:
                pages.append(target)
            elif target.suffix in PICTURES:
                pictures.add(target)
    return pages, pictures


def without_dead_links(page: Path, text: str, staged: set[Path]) -> str:
    def kept(match: re.Match[str]) -> str:
        target = match[3]
        if not target or "://" in target or (page.parent / target).resolve() in staged:
            return match[0]
        return match[2]

    return LINK.sub(kept, text)


def with_lists_apart(text: str) -> str:
    """The text with an empty line before each list, without which mkdocs takes a list that follows a sentence for text."""
    lines: list[str] = []
    in_code, in_list = False, False
    for line in text.split("\n"):
        in_code ^= line.lstrip().startswith("```")
        is_item = line.startswith("- ") and not in_code
        if is_item and not in_list and lines and lines[-1]:
            lines.append("")
        in_list = is_item or (in_list and line.startswith(" "))
        lines.append(line)
    return "\n".join(lines)


def stage(folder: Path) -> list[Path]:
    """Copies pages and pictures; returns the pages, below `folder`."""
    pages, pictures = pages_and_pictures()
    staged = {*pages, *pictures}
    for picture in pictures:
        target = folder / picture.relative_to(SOURCE)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(picture, target)
    for page in pages:
        target = folder / page.relative_to(SOURCE)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(with_lists_apart(without_dead_links(page, page.read_text(), staged)))
    return [page.relative_to(SOURCE) for page in pages]


def navigation(folder: Path, verbs: list[str]) -> str:
    lines = ["nav:"]
    for title, entries in NAVIGATION:
        lines.append(f"  - {title}:")
        lines += [f'      - "{name}": {path}' for name, path in entries if (folder / path).exists()]
        if title == "Reference":
            lines.append("      - Verbs:")
            lines += [f"          - {verb}: docs/reference/{verb}.md" for verb in verbs]
    return "\n".join(lines) + "\n"


def main(program: str, folder: Path) -> None:
    pages = folder / "pages"
    shutil.rmtree(pages, ignore_errors=True)
    stage(pages)
    reference = pages / "docs" / "reference"
    subprocess.run([sys.executable, SOURCE / "cli/reference/write", program, "pages", reference], check=True)
    shutil.copy(SOURCE / "docs/site/itin.css", pages / "itin.css")
    verbs = [path.stem for path in sorted(reference.glob("*.md")) if path.stem != "index"]
    settings = (SOURCE / "docs/site/mkdocs.yml").read_text()
    (folder / "mkdocs.yml").write_text(settings + navigation(pages, verbs))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], Path(sys.argv[2]))
