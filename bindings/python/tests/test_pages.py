"""What is written for readers does what it says: the guide, and the examples."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import PROGRAM, SOURCE

TURBINES = "x,y,hub_height,rotor_diameter\n310375,183525,80,90\n312000,185000,80,90\n"
LINKS = "id,x1,y1,h1,x2,y2,h2\na,310375,183525,20,312000,185000,12\nb,310375,183525,20,308000,181000,12\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "scripts").symlink_to(SOURCE / "scripts")
    (tmp_path / "turbines.csv").write_text(TURBINES)
    (tmp_path / "links.csv").write_text(LINKS)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def blocks_of(page: Path) -> list[str]:
    blocks: list[str] = re.findall(r"```python\n(.*?)```", page.read_text(), re.DOTALL)
    return blocks


# The blocks of docs/qgis.md are for QGIS: scripts/qgis-test runs them there.
PAGES = [
    page
    for page in [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]
    if blocks_of(page) and page.stem != "qgis"
]


@pytest.mark.parametrize("page", PAGES, ids=[page.stem for page in PAGES])
def test_the_blocks_of_a_page_run_one_after_the_other(folder: Path, page: Path) -> None:
    for module in ("rasterio", "xarray"):
        pytest.importorskip(module)
    names: dict[str, object] = {}
    for block in blocks_of(page):
        exec(compile(block, str(page), "exec"), names)  # noqa: S102
    if page.stem != "python":
        return
    assert len(blocks_of(page)) > 5
    for made in ("seen.tif", "judged.csv", "masts/sites.csv", "zone/tip-count.tif", "winter-foliage.tif"):
        assert (folder / made).exists(), made
    assert (folder / "amenity" / "dwellings.csv").exists()


def test_a_mast_is_sited_to_the_same_bytes_by_commands_and_in_python(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = SOURCE / "docs" / "how-to" / "lidar-tile.md"
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    monkeypatch.setenv("PATH", f"{Path(PROGRAM).parent}{os.pathsep}{os.environ['PATH']}")
    commands = re.findall(r"```sh\n(.*?)```", page.read_text(), re.DOTALL)
    subprocess.run(["sh", "-ec", "".join(commands)], check=True, capture_output=True)
    exec(compile("".join(blocks_of(page)), str(page), "exec"), {})  # noqa: S102
    assert (folder / "delft.itin").read_bytes() == (folder / "python.itin").read_bytes()
    for name in ("sites.csv", "sites.gpkg", "candidates.csv", "links.csv", "coverage.png", "radio.tif", "radio.qml"):
        assert (folder / "by-command" / name).read_bytes() == (folder / "by-python" / name).read_bytes(), name


@pytest.mark.parametrize(
    "example, needs, makes",
    [
        ("viewshed_raster.py cardiff.itin 310375 183525 seen.tif", ["rasterio"], "seen.tif"),
        ("links_table.py cardiff.itin links.gpkg judged.gpkg", ["geopandas"], "judged.gpkg"),
        ("sites_map.py cardiff.itin sites.png", ["matplotlib"], "sites.png"),
    ],
)
def test_examples_run(folder: Path, cardiff_file: Path, example: str, needs: list[str], makes: str) -> None:
    for module in needs:
        pytest.importorskip(module)
    (folder / "cardiff.itin").symlink_to(cardiff_file)
    if "geopandas" in needs:
        links_of_lines(folder / "links.gpkg")
    program, *arguments = example.split()
    command = [sys.executable, str(SOURCE / "examples" / "python" / program), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout
    assert (folder / makes).stat().st_size > 1000


def links_of_lines(path: Path) -> None:
    """Writes a layer of three links, one of which leaves the data."""
    import geopandas
    from shapely.geometry import LineString

    hill = (310375, 183525)
    lines = [LineString([hill, end]) for end in [(312000, 185000), (308000, 181000), (0, 0)]]
    frame = geopandas.GeoDataFrame({"name": ["a", "b", "c"]}, geometry=lines, crs="EPSG:27700")
    frame.to_file(path)
