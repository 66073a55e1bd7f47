"""What the guide tells planners to do, done."""

from __future__ import annotations

import filecmp
import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import DATA, PLUGINS, SOURCE, Qgis
from qgis.core import QgsFeature, QgsGeometry, QgsProject, QgsRectangle, QgsVectorLayer
from test_inputs import same_cells

GUIDE = (SOURCE / "docs" / "qgis.md").read_text()
LIDAR_TILE = (SOURCE / "docs" / "how-to" / "lidar-tile.md").read_text()


@pytest.fixture
def folder(tmp_path: Path, cardiff: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "cardiff.itin").symlink_to(cardiff)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def blocks(language: str, page: str = GUIDE) -> list[str]:
    found = re.findall(r"^```(\w*)\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    return [text for name, text in found if name == language]


def run_here(block: str) -> None:
    exec(compile(block, "docs/qgis.md", "exec"), {})  # noqa: S102


def test_block_of_python_runs(qgis: Qgis, folder: Path) -> None:
    run_here(blocks("python")[1])
    assert (folder / "height.tif").exists()


def test_commands_of_qgis_process_run(folder: Path) -> None:
    (block,) = blocks("")
    environment = os.environ | {"QGIS_PLUGINPATH": PLUGINS, "QGIS_CUSTOM_CONFIG_PATH": str(folder / "profile")}
    subprocess.run(["bash", "-e", "-c", block], env=environment, check=True, capture_output=True, timeout=120)
    assert (folder / "seen.tif").exists()


def test_a_mast_from_a_lidar_tile(qgis: Qgis, tmp_path: Path) -> None:
    store = str(tmp_path / "delft.itin")
    qgis.run("importterrain", {"FILES": [str(DATA / "delft-lidar.laz")], "STORE": store})
    houses = {"INPUT": str(DATA / "delft-houses.geojson"), "KIND": "buildings", "HEIGHT_FIELD": "height"}
    qgis.run("importfeatures", {**houses, "STORE": store})

    area = QgsVectorLayer("Polygon?crs=EPSG:28992", "Where a mast may stand", "memory")
    square = QgsFeature()
    square.setGeometry(QgsGeometry.fromRect(QgsRectangle(84880, 447500, 84960, 447580)))
    area.dataProvider().addFeatures([square])
    QgsProject.instance().addMapLayer(area)
    sites = {"SEARCH_AREA": area, "SPACING": 40, "MAST_HEIGHT": "20", "COUNT": 1, "RADIUS": 100, "CELL": 5}
    made = qgis.load("sitemasts", {"STORE": store, **sites, "OUTPUT": str(tmp_path / "masts")})
    assert Path(made["PAGE"]).exists()

    (layer,) = QgsProject.instance().mapLayersByName("sites")
    radio = {"OBSERVERS": layer, "TARGET_HEIGHT": 2, "FREQUENCY": 5.8, "EFFECTIVE_EARTH": "4/3", "RADIUS": 100, "CELL": 5}
    assert Path(qgis.run("radiocoverage", {"STORE": store, **radio, "OUTPUT": str(tmp_path / "r.tif")})["OUTPUT"]).exists()


def test_the_mast_of_the_script_is_that_of_the_command_line(
    qgis: Qgis, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "scripts").symlink_to(SOURCE / "scripts")
    monkeypatch.chdir(tmp_path)
    run_here(blocks("python")[0])
    commands = "\n".join(blocks("sh", LIDAR_TILE))
    subprocess.run(["sh", "-ec", commands], check=True, capture_output=True, timeout=120)
    assert filecmp.cmp("delft.itin", "qgis.itin", shallow=False)
    for name in ("sites.csv", "sites.gpkg", "candidates.csv", "radio.tif", "radio.qml"):
        assert filecmp.cmp(f"by-command/{name}", f"by-qgis/{name}", shallow=False), name
    assert same_cells(tmp_path / "by-command" / "coverage.tif", tmp_path / "by-qgis" / "coverage.tif")
