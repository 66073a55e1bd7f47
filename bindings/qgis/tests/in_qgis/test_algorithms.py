"""Every algorithm on demo data makes, to the byte, what the command line makes."""

from __future__ import annotations

import filecmp
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
from conftest import DATA, Qgis, run_program

from itin_qgis.tasks import TASKS

GARTH = "310375,183525"
CARDIFF_BAY = "320000,176000"
HAS_SECONDS = ("ztv.json", "site.json", "premises.json", "dwellings.json")
"""Documents that tell how long a run took."""

# Name, parameters, the same on the command line. {s} is the store, {f} the folder of inputs, {o} that of outputs.
CASES: list[tuple[str, dict[str, Any], str]] = [
    ("importterrain", {"RASTERS": ["{d}/cardiff.tif"], "STORE": "{o}/new.itin"}, "import {o}/new.itin {d}/cardiff.tif"),
    (
        "importlines",
        {"INPUT": "{d}/garth-contours.geojson", "KIND": "contours", "Z_FIELD": "height", "ID_FIELD": "id",
         "STORE": "{o}/new.itin"},
        "import {o}/new.itin {d}/garth-contours.geojson --kind contours --z-field height --id-field id",
    ),
    (
        "importfeatures",
        {"INPUT": "{d}/alexandria-buildings.geojson", "KIND": "buildings", "HEIGHT_FIELD": "HEIGHT", "STORE": "{o}/town.itin"},
        "import {o}/town.itin {d}/alexandria-buildings.geojson --kind buildings --height-field HEIGHT",
    ),
    ("info", {"STORE": "{c}", "DIGEST": True}, "info {c} --digest"),
    ("check", {"STORE": "{c}", "QUICK": True}, "check {c} --quick"),
    (
        "surfaceraster",
        {"STORE": "{c}", "EXTENT": "308000,314000,181000,187000 [EPSG:27700]", "CELL": 25, "OUTPUT": "{o}/h.tif"},
        "tin {c} --bbox 308000,181000,314000,187000 --in-crs EPSG:27700 --cell 25 -o {o}/h.tif",
    ),
    (
        "surfacemesh",
        {"STORE": "{c}", "CENTRE": GARTH + " [EPSG:27700]", "DISC_RADIUS": 1000, "TOLERANCE": 4, "OUTPUT": "{o}/m.2dm"},
        "tin {c} --disc 310375,183525,1000 --in-crs EPSG:27700 --tolerance 4 -o {o}/m.2dm",
    ),
    (
        "viewshed",
        {"STORE": "{c}", "OBSERVER": GARTH + " [EPSG:27700]", "OBSERVER_HEIGHT": 10, "TARGET_HEIGHT": 2, "RADIUS": 5000,
         "CELL": 50, "OUTPUT": "{o}/v.tif", "POLYGONS": "{o}/v.gpkg", "IMAGE": "{o}/v.png"},
        "viewshed {c} --observer 310375,183525 --in-crs EPSG:27700 --observer-height 10 --target-height 2 --radius 5000 "
        "--cell 50 -o {o}/v.tif -o {o}/v.gpkg --image {o}/v.png",
    ),
    (
        "viewshed",
        {"STORE": "{c}", "OBSERVERS": "{f}/sites.gpkg", "MODE": "which", "RADIUS": 5000, "CELL": 100, "OUTPUT": "{o}/w.tif",
         "EACH": "{o}/each"},
        "viewshed {c} --observers {f}/sites.gpkg --layer sites --mode which --radius 5000 --cell 100 -o {o}/w.tif "
        "--each {o}/each",
    ),
    (
        "viewshed",
        {"STORE": "{t}", "OBSERVER": "321800,4297750 [EPSG:26918]", "MODE": "blocker", "CELL": 2, "OUTPUT": "{o}/b.tif",
         "FEATURES": "{o}/f.tif"},
        "viewshed {t} --observer 321800,4297750 --in-crs EPSG:26918 --mode blocker --cell 2 -o {o}/b.tif "
        "--features {o}/f.tif",
    ),
    (
        "radiocoverage",
        {"STORE": "{c}", "OBSERVER": GARTH + " [EPSG:27700]", "OBSERVER_HEIGHT": 20, "TARGET_HEIGHT": 2, "RADIUS": 4000,
         "CELL": 100, "FREQUENCY": 5.8, "EFFECTIVE_EARTH": "4/3", "LOSS": True, "OUTPUT": "{o}/r.tif"},
        "viewshed {c} --observer 310375,183525 --in-crs EPSG:27700 --observer-height 20 --target-height 2 --radius 4000 "
        "--cell 100 --frequency 5.8 --effective-earth 4/3 --loss -o {o}/r.tif",
    ),
    (
        "skyline",
        {"STORE": "{c}", "OBSERVER": GARTH + " [EPSG:27700]", "RADIUS": 5000, "STEP": 1, "OUTPUT": "{o}/s.csv",
         "PANORAMA": "{o}/s.svg"},
        "viewshed {c} --observer 310375,183525 --in-crs EPSG:27700 --radius 5000 --horizon-step 1 --horizon {o}/s.csv "
        "--horizon {o}/s.svg",
    ),
    (
        "visibility",
        {"STORE": "{c}", "EXTENT": "308000,314000,181000,187000 [EPSG:27700]", "CELL": 500, "RADIUS": 3000,
         "OBSERVER_HEIGHT": 20, "OUTPUT": "{o}/i.tif"},
        "visibility {c} --bbox 308000,181000,314000,187000 --in-crs EPSG:27700 --cell 500 --radius 3000 "
        "--observer-height 20 -o {o}/i.tif",
    ),
    (
        "lineofsight",
        {"STORE": "{c}", "FROM": GARTH + " [EPSG:27700]", "FROM_HEIGHT": 20, "TO": CARDIFF_BAY + " [EPSG:27700]",
         "TO_HEIGHT": 10, "FREQUENCY": 5.8, "EFFECTIVE_EARTH": "4/3", "CRITERIA": "4/3:0.6 1:0.3", "OUTPUT": "{o}/l.gpkg",
         "REPORT": "{o}/l.html", "FURTHER_REPORT": "{o}/l.pdf"},
        "los {c} --from 310375,183525,20 --to 320000,176000,10 --in-crs EPSG:27700 --frequency 5.8 --effective-earth 4/3 "
        "--criterion 4/3:0.6 --criterion 1:0.3 --report {o}/l.gpkg --report {o}/l.html --report {o}/l.pdf",
    ),
    (
        "links",
        {"STORE": "{c}", "LINKS": "{f}/links.csv", "OUTPUT": "{o}/l.gpkg", "TABLE": "{o}/l.csv", "SUMMARY": "{o}/l.pdf",
         "REPORTS": "{o}/reports"},
        "los {c} --links {f}/links.csv -o {o}/l.gpkg -o {o}/l.csv -o {o}/l.pdf --report {o}/reports/{{id}}.pdf",
    ),
    (
        "profile",
        {"STORE": "{c}", "FROM": GARTH + " [EPSG:27700]", "TO": CARDIFF_BAY + " [EPSG:27700]", "TOLERANCES": "0 16",
         "OUTPUT": "{o}/p.geojson", "CHART": "{o}/p.svg", "TABLE": "{o}/p.csv"},
        "profile {c} --from 310375,183525 --to 320000,176000 --in-crs EPSG:27700 --tolerance 0 --tolerance 16 "
        "-o {o}/p.geojson -o {o}/p.svg -o {o}/p.csv",
    ),
    (
        "sitemasts",
        {"STORE": "{c}", "SEARCH_AREA": "{f}/area.gpkg", "SPACING": 2000, "COUNT": 2, "RADIUS": 4000, "CELL": 100,
         "OUTPUT": "{o}/masts"},
        "site {c} --search-area {f}/area.gpkg --spacing 2000 --count 2 --radius 4000 --cell 100 -o {o}/masts",
    ),
    (
        "premises",
        {"STORE": "{t}", "MASTS": "{f}/masts.gpkg", "RADIUS": 300, "FREQUENCY": 26, "EFFECTIVE_EARTH": "4/3",
         "OUTPUT": "{o}/premises"},
        "premises {t} --masts {f}/masts.gpkg --layer masts --radius 300 --frequency 26 --effective-earth 4/3 "
        "-o {o}/premises",
    ),
    (
        "dwellings",
        {"STORE": "{c}", "TURBINES": "{f}/turbines.gpkg", "DWELLINGS": "{f}/viewpoints.gpkg", "RADIUS": 20000, "YEAR": 2027,
         "TIME_ZONE": "+1", "OUTPUT": "{o}/dwellings"},
        "dwellings {c} --turbines {f}/turbines.gpkg --layer turbines --dwellings {f}/viewpoints.gpkg --radius 20000 "
        "--year 2027 --time-zone +1 -o {o}/dwellings",
    ),
    (
        "ztv",
        {"STORE": "{c}", "TURBINES": "{f}/turbines.gpkg", "VIEWPOINTS": "{f}/viewpoints.gpkg", "RADIUS": 5000, "CELL": 200,
         "OUTPUT": "{o}/ztv"},
        "ztv {c} --turbines {f}/turbines.gpkg --layer turbines --viewpoints {f}/viewpoints.gpkg --radius 5000 --cell 200 "
        "-o {o}/ztv",
    ),
    (
        "siteturbines",
        {"STORE": "{c}", "SEARCH_AREA": "{f}/area.gpkg", "SPACING": 1000, "COUNT": 3, "HUB_HEIGHT": 80, "ROTOR_DIAMETER": 90,
         "ROTOR_SPACING": "5x3", "WIND_FROM": 240, "RADIUS": 4000, "CELL": 200, "OUTPUT": "{o}/turbines"},
        "site {c} --turbines --search-area {f}/area.gpkg --spacing 1000 --count 3 --hub-height 80 --rotor-diameter 90 "
        "--rotor-spacing 5x3 --wind-from 240 --radius 4000 --cell 200 -o {o}/turbines",
    ),
]


def filled(value: Any, names: dict[str, object]) -> Any:
    if isinstance(value, list):
        return [filled(each, names) for each in value]
    return value.format(**names) if isinstance(value, str) else value


def files_of(folder: Path) -> Sequence[Path]:
    return sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())


@pytest.mark.parametrize("name, values, command", CASES, ids=[f"{at}-{case[0]}" for at, case in enumerate(CASES)])
def test_makes_what_the_command_line_makes(
    qgis: Qgis, cardiff: Path, town: Path, folder: Path, tmp_path: Path, name: str, values: dict[str, Any], command: str
) -> None:
    # One folder, used twice: results name their own files.
    out, kept = tmp_path / "out", tmp_path / "of-qgis"
    names = {"c": cardiff, "t": town, "f": folder, "d": DATA, "o": out}
    out.mkdir()
    if name == "importfeatures":
        run_program("import", out / "town.itin", DATA / "alexandria-dtm.tif")
    made = qgis.run(name, {key: filled(value, names) for key, value in values.items()})
    out.rename(kept)

    out.mkdir()
    if name == "importfeatures":
        run_program("import", out / "town.itin", DATA / "alexandria-dtm.tif")
    if name == "links":
        (out / "reports").mkdir()
    printed = run_program(*filled(command, names).split())

    assert files_of(kept) == files_of(out)
    compared = [path for path in files_of(out) if path.name not in HAS_SECONDS]
    different = [str(path) for path in compared if not filecmp.cmp(kept / path, out / path, shallow=False)]
    assert different == []
    for key in values:
        if str(values[key]).startswith("{o}") and (key, name) != ("STORE", "importfeatures"):
            assert made[key] == filled(values[key], names)
    if name in ("info", "check"):
        assert made["PRINTED"].splitlines()[0] == printed.splitlines()[0]


def test_every_algorithm_is_among_the_cases(qgis: Qgis) -> None:
    from qgis.core import QgsApplication

    listed = [algorithm.name() for algorithm in QgsApplication.processingRegistry().providerById("itin").algorithms()]
    assert sorted(listed) == sorted({case[0] for case in CASES}) == sorted(task.name for task in TASKS)
