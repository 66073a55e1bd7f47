"""Values of parameters become lists of arguments, and no text of a planner becomes an option."""

from __future__ import annotations

from typing import Any

import pytest

from itin_qgis.tasks import TASKS
from itin_qgis.tasks.parameters import Box, FolderOutput, LayerFile, Place, number_text
from itin_qgis.tasks.task import IN_CRS

OF_NAME = {task.name: task() for task in TASKS}


def call(name: str, **values: Any) -> list[str]:
    return OF_NAME[name].arguments(values)


@pytest.mark.parametrize(
    "name, values, expected",
    [
        (
            "importterrain",
            {"RASTERS": ["/a.tif", "/b.tif"], "FILES": ["/c.laz"], "STORE": "/s.itin", "REPLACE": True, "CRS": "EPSG:27700"},
            "import /s.itin /a.tif /b.tif /c.laz --replace --crs=EPSG:27700",
        ),
        (
            "importlines",
            {"INPUT": LayerFile("/l.gpkg", "roads"), "KIND": "roads", "STORE": "/s.itin", "THEME": "lanes"},
            "import /s.itin /l.gpkg --layer=roads --kind=roads --theme=lanes",
        ),
        (
            "importfeatures",
            {"INPUT": LayerFile("/h.gpkg"), "KIND": "buildings", "HEIGHT_FIELD": "H", "STORE": "/s.itin", "HEIGHT": 6.5},
            "import /s.itin /h.gpkg --kind=buildings --height-field=H --height=6.5",
        ),
        ("info", {"STORE": "/s.itin"}, "info /s.itin"),
        ("check", {"STORE": "/s.itin", "QUICK": True}, "check /s.itin --quick"),
        (
            "surfaceraster",
            {"STORE": "/s.itin", "CELL": 10.0, "OUTPUT": "/o.tif"},
            "tin /s.itin --cell=10 --output=/o.tif --overwrite --all",
        ),
        (
            "surfacemesh",
            {"STORE": "/s.itin", "CENTRE": Place(-3.25, 51.5), "DISC_RADIUS": 500.0, "OUTPUT": "/o.2dm", IN_CRS: "EPSG:4326"},
            "tin /s.itin --disc=-3.25,51.5,500 --output=/o.2dm --in-crs=EPSG:4326 --overwrite",
        ),
        (
            "viewshed",
            {"STORE": "/s.itin", "OBSERVER": Place(310375, 183525), "OBSERVER_HEIGHT": 2, "TARGET_HEIGHT": 1.5,
             "MODE": "count", "OUTPUT": "/o.tif", "POLYGONS": "/o.gpkg"},
            "viewshed /s.itin --observer=310375,183525 --target-height=1.5 --mode=count --output=/o.tif --output=/o.gpkg "
            "--overwrite",
        ),
        (
            "radiocoverage",
            {"STORE": "/s.itin", "OBSERVERS": LayerFile("/m.gpkg", "masts"), "FREQUENCY": 5.8, "LOSS": True,
             "EFFECTIVE_EARTH": "4/3", "OUTPUT": "/o.tif"},
            "viewshed /s.itin --observers=/m.gpkg --layer=masts --frequency=5.8 --loss --effective-earth=4/3 "
            "--output=/o.tif --overwrite",
        ),
        (
            "skyline",
            {"STORE": "/s.itin", "OBSERVER": Place(1, 2), "STEP": 0.5, "OUTPUT": "/h.csv", "PANORAMA": "/h.svg"},
            "viewshed /s.itin --observer=1,2 --horizon-step=0.5 --horizon=/h.csv --horizon=/h.svg --overwrite",
        ),
        (
            "visibility",
            {"STORE": "/s.itin", "EXTENT": Box(0, 0, 10, 20.5), "CELL": 5, "RADIUS": 100, "OUTPUT": "/o.tif"},
            "visibility /s.itin --bbox=0,0,10,20.5 --cell=5 --radius=100 --output=/o.tif --overwrite",
        ),
        (
            "lineofsight",
            {"STORE": "/s.itin", "FROM": Place(1, 2), "FROM_HEIGHT": 20, "TO": Place(3, 4), "TO_HEIGHT": 2,
             "CRITERIA": "4/3:0.6 ke:0.3", "OUTPUT": "/o.gpkg", "REPORT": "/o.html"},
            "los /s.itin --from=1,2,20 --to=3,4,2 --criterion=4/3:0.6 --criterion=ke:0.3 --report=/o.gpkg --report=/o.html "
            "--overwrite",
        ),
        (
            "links",
            {"STORE": "/s.itin", "LINKS": LayerFile("/l.csv"), "OUTPUT": "/o.gpkg", "REPORTS": "/r"},
            "los /s.itin --links=/l.csv --output=/o.gpkg --report=/r/{id}.pdf --overwrite",
        ),
        (
            "profile",
            {"STORE": "/s.itin", "FROM": Place(1, 2), "TO": Place(3, 4), "TOLERANCES": "0 4", "OUTPUT": "/o.geojson"},
            "profile /s.itin --from=1,2 --to=3,4 --tolerance=0 --tolerance=4 --output=/o.geojson --overwrite",
        ),
        (
            "sitemasts",
            {"STORE": "/s.itin", "SEARCH_AREA": LayerFile("/a.gpkg"), "SPACING": 4000, "COUNT": 5, "PREMISES": True,
             "HUB": Place(1, 2), "HUB_HEIGHT": 20, "OUTPUT": "/o"},
            "site /s.itin --search-area=/a.gpkg --spacing=4000 --count=5 --output=/o --hub=1,2,20 --demand=premises",
        ),
        (
            "premises",
            {"STORE": "/s.itin", "MASTS": LayerFile("/m.gpkg"), "RADIUS": 300, "OUTPUT": "/o", "OVERWRITE": True},
            "premises /s.itin --masts=/m.gpkg --radius=300 --output=/o --overwrite",
        ),
        (
            "ztv",
            {"STORE": "/s.itin", "TURBINES": LayerFile("/t.gpkg"), "RADAR": Place(5, 6), "RADAR_HEIGHT": 12, "CELL": 100,
             "OUTPUT": "/o"},
            "ztv /s.itin --turbines=/t.gpkg --cell=100 --output=/o --radar=5,6,12",
        ),
        (
            "dwellings",
            {"STORE": "/s.itin", "TURBINES": LayerFile("/t.gpkg"), "YEAR": 2027, "TIME_ZONE": "+1", "OUTPUT": "/o"},
            "dwellings /s.itin --turbines=/t.gpkg --year=2027 --time-zone=+1 --output=/o",
        ),
        (
            "siteturbines",
            {"STORE": "/s.itin", "CANDIDATES": LayerFile("/c.gpkg"), "TIP_HEIGHT": 125, "COUNT": 6, "OUTPUT": "/o"},
            "site /s.itin --candidates=/c.gpkg --tip-height=125 --count=6 --output=/o --turbines",
        ),
    ],
)
def test_values_become_arguments(name: str, values: dict[str, Any], expected: str) -> None:
    assert call(name, **values) == [*expected.split(), "--progress=lines"]


def test_every_task_has_a_call_above() -> None:
    mark = next(mark for mark in test_values_become_arguments.pytestmark if mark.name == "parametrize")
    assert [case[0] for case in mark.args[1]] == [task.name for task in TASKS]


def test_texts_stay_one_word() -> None:
    title = "-o /etc/passwd; $(rm -rf ~) 'Garth' \"Hill\""
    assert f"--title={title}" in call("lineofsight", STORE="/s.itin", TITLE=title)


def test_further_options_are_read_as_on_the_command_line() -> None:
    words = call("info", STORE="/s.itin", FURTHER="--allow-network --project 'Mynydd Meio'")
    assert words == ["info", "/s.itin", "--allow-network", "--project", "Mynydd Meio", "--progress=lines"]


def test_numbers_keep_every_digit() -> None:
    for number in (310375.123456789, -3.293800077410621, 1e-7, 1e21, 0.1, 1234567):
        assert float(number_text(number)) == number
    assert number_text(20.0) == "20"


def test_layers_of_a_folder_come_in_order() -> None:
    output = next(p for p in OF_NAME["sitemasts"].parameters if isinstance(p, FolderOutput))
    names = ["best-server.tif", "coverage.png", "coverage.qml", "coverage.tif", "other.tif", "premises.gpkg", "sites.gpkg"]
    ordered = output.layers_of(names)
    assert ordered == ["sites.gpkg", "best-server.tif", "coverage.tif", "premises.gpkg", "other.tif"]
    seen = [name for name in ("sites", "candidates", "coverage.tif", "other.tif") if output.is_seen(name)]
    assert seen == ["sites", "coverage.tif"]
