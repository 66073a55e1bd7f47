"""What the guide tells planners to do, done."""

from __future__ import annotations

import filecmp
import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import DATA, PLUGINS, SOURCE, Qgis, run_program
from qgis.core import QgsFeature, QgsGeometry, QgsProject, QgsRectangle, QgsVectorLayer
from test_inputs import same_cells

GUIDE = (SOURCE / "docs" / "qgis.md").read_text()
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```", GUIDE, re.DOTALL | re.MULTILINE)


@pytest.fixture
def folder(tmp_path: Path, cardiff: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "cardiff.itin").symlink_to(cardiff)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_block_of_python_runs(qgis: Qgis, folder: Path) -> None:
    (block,) = (text for language, text in BLOCKS if language == "python")
    exec(compile(block, "docs/qgis.md", "exec"), {})  # noqa: S102
    assert (folder / "height.tif").exists()


def test_commands_of_qgis_process_run(folder: Path) -> None:
    (block,) = (text for language, text in BLOCKS if language == "")
    environment = os.environ | {"QGIS_PLUGINPATH": PLUGINS, "QGIS_CUSTOM_CONFIG_PATH": str(folder / "profile")}
    subprocess.run(["bash", "-e", "-c", block], env=environment, check=True, capture_output=True, timeout=120)
    assert (folder / "seen.tif").exists()


def test_a_mast_from_a_lidar_tile(qgis: Qgis, tmp_path: Path) -> None:
    store = str(tmp_path / "delft.itin")
    qgis.run("importterrain", {"FILES": [str(DATA / "delft-lidar.las")], "CRS": "EPSG:28992", "STORE": store})
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

    # The same mast by the command line, to the byte but for the notes that name the area.
    other = tmp_path / "other.itin"
    run_program("import", other, DATA / "delft-lidar.las", "--crs=EPSG:28992")
    run_program("import", other, DATA / "delft-houses.geojson", "--kind=buildings", "--height-field=height")
    assert filecmp.cmp(store, other, shallow=False)
    square_text = "POLYGON((84880 447500,84960 447500,84960 447580,84880 447580,84880 447500))"
    choice = ["--spacing=40", "--mast-height=20", "--count=1", "--radius=100", "--cell=5"]
    run_program("site", store, f"--search-area={square_text}", *choice, "-o", tmp_path / "same")
    for name in ("sites.csv", "sites.gpkg"):
        assert filecmp.cmp(tmp_path / "masts" / name, tmp_path / "same" / name, shallow=False), name
    assert same_cells(tmp_path / "masts" / "coverage.tif", tmp_path / "same" / "coverage.tif")
