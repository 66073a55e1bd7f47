"""Results become layers in the program's colours, and those of a folder a group in order."""

from __future__ import annotations

from pathlib import Path

from conftest import Qgis
from qgis.core import QgsCoordinateReferenceSystem, QgsMapLayer, QgsPalettedRasterRenderer, QgsProject

GARTH = "310375,183525 [EPSG:27700]"


def layers_of(qgis: Qgis) -> list[QgsMapLayer]:
    return list(qgis.project.mapLayers().values())


def test_viewshed_has_its_colours(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "OBSERVER": GARTH, "RADIUS": 3000, "CELL": 100, "OUTPUT": str(tmp_path / "v.tif")}
    qgis.load("viewshed", {**values, "POLYGONS": str(tmp_path / "v.gpkg")})
    raster = next(layer for layer in layers_of(qgis) if layer.source().endswith(".tif"))
    renderer = raster.renderer()
    assert isinstance(renderer, QgsPalettedRasterRenderer)
    assert "visible" in [of_class.label for of_class in renderer.classes()]
    polygons = next(layer for layer in layers_of(qgis) if ".gpkg" in layer.source())
    assert polygons.renderer().type() == "categorizedSymbol"


def test_mesh_has_the_crs_of_the_store(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "CENTRE": GARTH, "DISC_RADIUS": 1000, "OUTPUT": str(tmp_path / "m.2dm")}
    qgis.load("surfacemesh", values)
    (mesh,) = layers_of(qgis)
    assert mesh.isValid() and mesh.crs() == QgsCoordinateReferenceSystem("EPSG:27700")


def test_line_of_sight_is_a_group(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "FROM": GARTH, "TO": "320000,176000 [EPSG:27700]", "OUTPUT": str(tmp_path / "l.gpkg")}
    qgis.load("lineofsight", values)
    (group,) = qgis.project.layerTreeRoot().children()
    assert group.name() == "Line of sight: l.gpkg"
    assert {"sight_line", "points", "ground"} <= {child.name() for child in group.children()}


def test_profile_is_a_layer(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    ends = {"FROM": GARTH, "TO": "320000,176000 [EPSG:27700]"}
    qgis.load("profile", {"STORE": str(cardiff), **ends, "OUTPUT": str(tmp_path / "p.geojson")})
    assert [layer.name() for layer in layers_of(qgis)] == ["Profile"]


def test_sites_are_a_group_in_order(qgis: Qgis, cardiff: Path, folder: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "SEARCH_AREA": str(folder / "area.gpkg"), "SPACING": 2000, "COUNT": 2, "RADIUS": 4000}
    made = qgis.load("sitemasts", {**values, "CELL": 100, "OUTPUT": str(tmp_path / "masts")})
    assert Path(made["PAGE"]).name == "report.html"
    (group,) = qgis.project.layerTreeRoot().children()
    assert group.name() == "Choose sites for masts: masts"
    names = [child.name() for child in group.children()]
    assert names == ["sites", "candidates", "links", "best-server", "redundancy", "coverage"]
    shown = [child.name() for child in group.children() if child.isVisible()]
    assert shown == ["sites", "links", "coverage"]


def test_zones_are_a_group_with_styles(qgis: Qgis, cardiff: Path, folder: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "TURBINES": str(folder / "turbines.gpkg"), "RADIUS": 3000, "CELL": 200}
    qgis.load("ztv", {**values, "OUTPUT": str(tmp_path / "ztv")})
    (group,) = qgis.project.layerTreeRoot().children()
    names = [child.name() for child in group.children()]
    assert "tip-count" in names and "visible-height" in names
    assert [child.name() for child in group.children() if child.isVisible()] == ["turbines", "study_area", "tip-count"]


def test_results_may_be_temporary(qgis: Qgis, cardiff: Path, folder: Path) -> None:
    values = {"STORE": str(cardiff), "TURBINES": str(folder / "turbines.gpkg"), "RADIUS": 3000, "CELL": 200}
    made = qgis.load("ztv", {**values, "OUTPUT": "TEMPORARY_OUTPUT"})
    assert (Path(made["OUTPUT"]) / "tip-count.tif").exists()
    made = qgis.load("viewshed", {"STORE": str(cardiff), "OBSERVER": GARTH, "CELL": 200, "OUTPUT": "TEMPORARY_OUTPUT"})
    assert Path(made["OUTPUT"]).exists()
    layer = next(layer for layer in layers_of(qgis) if layer.source() == made["OUTPUT"])
    assert isinstance(layer.renderer(), QgsPalettedRasterRenderer)


def test_results_may_be_left_unloaded(qgis: Qgis, cardiff: Path, folder: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "TURBINES": str(folder / "turbines.gpkg"), "RADIUS": 3000, "CELL": 200}
    qgis.load("ztv", {**values, "LOAD_RESULTS": False, "OUTPUT": str(tmp_path / "ztv")})
    assert QgsProject.instance().mapLayers() == {}
