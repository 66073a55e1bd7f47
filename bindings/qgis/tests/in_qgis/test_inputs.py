"""Layers and places as planners have them: in other CRS, in memory, selected, filtered, edited, without a CRS, on the web."""

from __future__ import annotations

import filecmp
from pathlib import Path
from typing import Any

import pytest
from conftest import DATA, Feedback, Qgis, run_program
from qgis.core import (
    QgsApplication,
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsFeature,
    QgsGeometry,
    QgsPointXY,
    QgsProcessingFeatureSourceDefinition,
    QgsProject,
    QgsRasterLayer,
    QgsReferencedPointXY,
    QgsVectorLayer,
)

SITES = [(310375, 183525, "Garth", 10.0), (322300, 190000, "East", 12.0), (314200, 177800, "South", 14.0)]


def memory_layer(code: str = "EPSG:27700", sites: list[tuple[float, float, str, float]] = SITES) -> QgsVectorLayer:
    """Returns a layer of sites that is in no file."""
    crs = f"crs={code}&" if code else ""
    layer = QgsVectorLayer(f"Point?{crs}field=name:string&field=height:double", "Masts of ours", "memory")
    transform = QgsCoordinateTransform(
        QgsCoordinateReferenceSystem("EPSG:27700"), QgsCoordinateReferenceSystem(code or "EPSG:27700"), QgsProject.instance()
    )
    for x, y, name, height in sites:
        feature = QgsFeature(layer.fields())
        feature.setGeometry(QgsGeometry.fromPointXY(transform.transform(QgsPointXY(x, y))))
        feature.setAttributes([name, height])
        layer.dataProvider().addFeatures([feature])
    if not code:
        layer.setCrs(QgsCoordinateReferenceSystem())
    QgsProject.instance().addMapLayer(layer)
    return layer


def counts(qgis: Qgis, store: Path, out: Path, observers: Any, **cells: Any) -> Path:
    values = {"STORE": str(store), "OBSERVERS": observers, "MODE": "count", "RADIUS": 5000, "OUTPUT": str(out)}
    return Path(qgis.run("viewshed", {**values, **(cells or {"CELL": 100})})["OUTPUT"])


@pytest.fixture(scope="module")
def expected(cardiff: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The counts of all three sites, by the command line."""
    return by_program(cardiff, tmp_path_factory.mktemp("counts"), SITES)


def by_program(store: Path, folder: Path, sites: list[tuple[float, float, str, float]]) -> Path:
    table = folder / "sites.csv"
    table.write_text("x,y,name,height\n" + "".join(f"{x},{y},{name},{height}\n" for x, y, name, height in sites))
    out = folder / "counts.tif"
    run_program("viewshed", store, "--observers", table, "--mode=count", "--radius=5000", "--cell=100", "-o", out)
    return out


def same_cells(one: Path, other: Path) -> bool:
    """Says whether two rasters have the same cells; their notes name different files of observers."""
    import rasterio

    with rasterio.open(one) as first, rasterio.open(other) as second:
        return first.transform == second.transform and bool((first.read() == second.read()).all())


def test_layer_in_memory(qgis: Qgis, cardiff: Path, expected: Path, tmp_path: Path) -> None:
    assert same_cells(counts(qgis, cardiff, tmp_path / "o.tif", memory_layer()), expected)
    assert same_cells(counts(qgis, cardiff, tmp_path / "p.tif", memory_layer().id()), expected)


def test_layer_in_degrees(qgis: Qgis, cardiff: Path, expected: Path, tmp_path: Path) -> None:
    # To degrees and back is no step of the store's grid, but could be a column of cells more.
    made = counts(qgis, cardiff, tmp_path / "o.tif", memory_layer("EPSG:4326"), LIKE=str(expected))
    assert same_cells(made, expected)


def test_only_what_is_selected(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    layer = memory_layer()
    layer.selectByExpression("name <> 'East'")
    made = counts(qgis, cardiff, tmp_path / "o.tif", QgsProcessingFeatureSourceDefinition(layer.id(), True))
    assert same_cells(made, by_program(cardiff, tmp_path, [SITES[0], SITES[2]]))


@pytest.fixture
def file_layer(tmp_path: Path) -> QgsVectorLayer:
    """A layer of the three sites in a GeoPackage."""
    import geopandas

    xs, ys, names, heights = zip(*SITES)
    frame = geopandas.GeoDataFrame({"name": names, "height": heights}, geometry=geopandas.points_from_xy(xs, ys), crs=27700)
    frame.to_file(tmp_path / "sites.gpkg", layer="sites", driver="GPKG")
    frame[:1].to_file(tmp_path / "sites.gpkg", layer="fewer", driver="GPKG")
    layer = QgsVectorLayer(f"{tmp_path}/sites.gpkg|layername=sites", "sites", "ogr")
    QgsProject.instance().addMapLayer(layer)
    return layer


def test_layer_of_a_file_is_read_there(qgis: Qgis, cardiff: Path, expected: Path, tmp_path: Path, file_layer: Any) -> None:
    feedback = Feedback()
    values = {"STORE": str(cardiff), "OBSERVERS": file_layer, "MODE": "count", "RADIUS": 5000, "CELL": 100}
    made = qgis.run("viewshed", {**values, "OUTPUT": str(tmp_path / "o.tif")}, feedback)
    assert same_cells(Path(made["OUTPUT"]), expected)
    assert f"--observers={tmp_path}/sites.gpkg --layer=sites" in feedback.commands[0]


def test_filter_and_edits_count(qgis: Qgis, cardiff: Path, tmp_path: Path, file_layer: Any) -> None:
    file_layer.setSubsetString("name <> 'East'")
    made = counts(qgis, cardiff, tmp_path / "o.tif", file_layer)
    file_layer.setSubsetString("")
    wanted = by_program(cardiff, tmp_path, [SITES[0], SITES[2]])
    assert same_cells(made, wanted)

    file_layer.startEditing()
    file_layer.deleteFeature(next(f.id() for f in file_layer.getFeatures() if f["name"] == "East"))
    assert same_cells(counts(qgis, cardiff, tmp_path / "p.tif", file_layer), wanted)
    file_layer.rollBack()


def test_saved_edits_of_an_open_layer_count(qgis: Qgis, cardiff: Path, tmp_path: Path, file_layer: Any) -> None:
    assert sum(1 for _ in file_layer.getFeatures()) == 3
    assert file_layer.startEditing()
    file_layer.deleteFeature(next(f.id() for f in file_layer.getFeatures() if f["name"] == "East"))
    assert file_layer.commitChanges()
    made = counts(qgis, cardiff, tmp_path / "o.tif", file_layer)
    assert same_cells(made, by_program(cardiff, tmp_path, [SITES[0], SITES[2]]))


def test_names_may_have_blanks_and_accents(qgis: Qgis, cardiff: Path, expected: Path, tmp_path: Path) -> None:
    folder = tmp_path / "Pen-y-bont, Tŷ'n \"y\" coed é"
    folder.mkdir()
    (folder / "môr.itin").symlink_to(cardiff)
    layer = memory_layer()
    layer.setName("Mastiau (tŷ)")
    assert same_cells(counts(qgis, folder / "môr.itin", folder / "allan %1.tif", layer), expected)


def test_file_of_several_layers_where_the_program_takes_one(qgis: Qgis, cardiff: Path, tmp_path: Path, file_layer: Any) -> None:
    values = {"STORE": str(cardiff), "CANDIDATES": file_layer, "EXISTING": file_layer, "COUNT": 1, "RADIUS": 3000, "CELL": 200}
    qgis.run("sitemasts", {**values, "OUTPUT": str(tmp_path / "masts")})
    assert (tmp_path / "masts" / "report.html").exists()


def test_layer_without_crs_is_refused(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "OBSERVERS": memory_layer(""), "RADIUS": 5000, "CELL": 100}
    said = qgis.failure("viewshed", {**values, "OUTPUT": str(tmp_path / "o.tif")})
    assert "Masts of ours has no CRS. Give it one" in said


def test_table_without_places_is_read(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    table = tmp_path / "links.csv"
    table.write_text("id,x1,y1,h1,x2,y2,h2\na,310375,183525,20,312000,185000,12\n")
    for uri, kind in ((str(table), "ogr"), (f"file://{table}?delimiter=,", "delimitedtext")):
        layer = QgsVectorLayer(uri, "links", kind)
        assert layer.isValid()
        QgsProject.instance().addMapLayer(layer)
        out = tmp_path / f"{kind}.csv"
        qgis.run("links", {"STORE": str(cardiff), "LINKS": layer, "OUTPUT": f"{tmp_path}/{kind}.gpkg", "TABLE": str(out)})
        assert out.read_text().splitlines()[1].startswith("a,2194.59")


def test_place_and_extent_in_another_crs(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "RADIUS": 3000, "CELL": 100}
    qgis.run("viewshed", {**values, "OBSERVER": "-3.2938,51.54348 [EPSG:4326]", "OUTPUT": str(tmp_path / "a.tif")})
    words = ["--observer=-3.2938,51.54348", "--in-crs=EPSG:4326", "--radius=3000", "--cell=100"]
    run_program("viewshed", cardiff, *words, "-o", tmp_path / "b.tif")
    assert filecmp.cmp(tmp_path / "a.tif", tmp_path / "b.tif", shallow=False)


def test_second_place_comes_in_the_crs_of_the_first(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    feedback = Feedback()
    ends = {"FROM": "310375,183525 [EPSG:27700]", "TO": "-3.1,51.5 [EPSG:4326]"}
    qgis.run("lineofsight", {"STORE": str(cardiff), **ends, "OUTPUT": str(tmp_path / "o.gpkg")}, feedback)
    assert "--from=310375,183525,2" in feedback.commands[0] and "--in-crs=EPSG:27700" in feedback.commands[0]
    assert "--to=3237" in feedback.commands[0]


def test_place_without_crs_is_in_that_of_the_project(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    QgsProject.instance().setCrs(QgsCoordinateReferenceSystem("EPSG:4326"))
    values = {"STORE": str(cardiff), "RADIUS": 3000, "CELL": 100, "OBSERVER": "-3.2938,51.54348"}
    feedback = Feedback()
    qgis.run("viewshed", {**values, "OUTPUT": str(tmp_path / "a.tif")}, feedback)
    assert "--in-crs=EPSG:4326" in feedback.commands[0]


def test_place_in_a_crs_without_a_code(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    crs = QgsCoordinateReferenceSystem.fromProj(
        "+proj=tmerc +lat_0=51.5 +lon_0=-3.2 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs"
    )
    feedback = Feedback()
    values = {"STORE": str(cardiff), "RADIUS": 3000, "CELL": 100, "OBSERVER": QgsReferencedPointXY(QgsPointXY(0, 0), crs)}
    qgis.run("viewshed", {**values, "OUTPUT": str(tmp_path / "a.tif")}, feedback)
    assert "--in-crs=PROJCRS[" in feedback.commands[0]


def test_raster_on_the_web_is_refused(qgis: Qgis, tmp_path: Path) -> None:
    web = QgsRasterLayer("type=xyz&url=https://nowhere.invalid/{z}/{x}/{y}.png", "Web map", "wms")
    QgsProject.instance().addMapLayer(web)
    said = qgis.failure("importterrain", {"RASTERS": [web], "STORE": str(tmp_path / "new.itin")})
    assert "Web map is no raster file on this computer. Save it as a GeoTIFF" in said
    assert not (tmp_path / "new.itin").exists()


def test_raster_that_is_not_there_is_refused(qgis: Qgis, tmp_path: Path) -> None:
    values = {"RASTERS": [str(DATA / "cardiff.tif"), "/nowhere.tif"], "STORE": str(tmp_path / "new.itin")}
    assert "RASTERS" in qgis.failure("importterrain", values)
    # Models do not look before they run.
    algorithm = QgsApplication.processingRegistry().algorithmById("itin:importterrain")
    feedback = Feedback()
    assert not algorithm.run(values, qgis.context(), feedback)[1]
    assert "one of them is no raster" in feedback.errors[0]
    assert not (tmp_path / "new.itin").exists()


def test_files_are_read_whatever_qgis_knows_of_them(qgis: Qgis, tmp_path: Path) -> None:
    values = {"FILES": [str(DATA / "delft-lidar.las")], "CRS": "EPSG:28992", "STORE": str(tmp_path / "new.itin")}
    qgis.run("importterrain", values)
    assert (tmp_path / "new.itin").exists()
