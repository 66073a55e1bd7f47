"""Sight through woods, and without single features: the command line's answers and bytes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import run

import itin

EYE, END = (321800.0, 4297750.0), (321845.0, 4297745.0)
FROM, TO = f"{EYE[0]},{EYE[1]}", f"{END[0]},{END[1]}"


def same_bytes(ours: Path, theirs: Path) -> None:
    assert ours.read_bytes() == theirs.read_bytes(), ours.name


@pytest.mark.parametrize("leaves", ["on", "off", "leaves"])
def test_a_line_through_woods_is_that_of_the_command_line(wooded: itin.Store, tmp_path: Path, leaves: str) -> None:
    line = wooded.line_of_sight((*EYE, 2), (*END, 12), foliage=0.4, leaf_area=leaves, transmittance=0.2)
    woods = ["--foliage=0.4", "--leaf-area", leaves, "--transmittance", "0.2"]
    ends = ["--from", f"{FROM},2", "--to", f"{TO},12"]
    reports = [item for ending in ("csv", "txt", "gpkg") for item in ("--report", tmp_path / f"theirs.{ending}")]
    document = json.loads(run("los", wooded.path, *ends, *woods, *reports, "--json"))
    assert line.document["foliage"] == document["foliage"]
    for name in ("verdict", "clearance_m", "obstructions", "surface", "critical"):
        assert line.document[name] == document[name]
    assert line.verdict.name.lower() == document["verdict"]
    assert line.foliage is not None and line.foliage.length > 5
    assert line.foliage.transmittance == document["foliage"]["transmittance"]
    for ending in ("csv", "txt", "gpkg"):
        line.write(tmp_path / f"ours.{ending}")
        same_bytes(tmp_path / f"ours.{ending}", tmp_path / f"theirs.{ending}")
    assert wooded.line_of_sight((*EYE, 2), (*END, 12)).foliage is None


def test_a_viewshed_through_woods_is_that_of_the_command_line(wooded: itin.Store, tmp_path: Path) -> None:
    seen = wooded.viewshed((*EYE, 3), radius=150, cell_size=2, foliage=0.5, leaf_area="off", transmittance=0.3)
    for name in ("ours.tif", "ours.gpkg"):
        seen.write(tmp_path / name)
    view = ["--observer", f"{FROM},3", "--target-height", "0", "--radius", "150", "--cell", "2"]
    woods = ["--foliage", "--leaf-area", "off", "--transmittance", "0.3"]
    run("viewshed", wooded.path, *view, *woods, "-o", tmp_path / "theirs.tif", "-o", tmp_path / "theirs.gpkg")
    for ending in (".tif", ".gpkg", "-foliage.tif", "-transmittance.tif"):
        same_bytes(tmp_path / f"ours{ending}", tmp_path / f"theirs{ending}")
    metres, light = seen.values["foliage_m"], seen.values["transmittance"]
    assert metres.shape == light.shape == seen.grid.shape
    through = metres > 0
    np.testing.assert_allclose(light[through], np.exp(-0.05 * metres[through]), rtol=1e-5)
    solid = wooded.viewshed((*EYE, 3), radius=150, cell_size=2)
    assert (solid.verdict == 1).sum() < (seen.verdict == 1).sum() and not solid.values


def test_a_profile_through_woods_is_that_of_the_command_line(wooded: itin.Store, tmp_path: Path) -> None:
    path = wooded.profile([EYE, END], foliage=0.5, leaf_area="leaves")
    ends = ["--from", FROM, "--to", TO]
    outputs = [item for ending in ("csv", "svg", "geojson") for item in ("-o", tmp_path / f"theirs.{ending}")]
    document = json.loads(run("profile", wooded.path, *ends, "--foliage", "--leaf-area", "leaves", *outputs, "--json"))
    told = document["profiles"][0]["foliage"]
    assert path.foliage == itin.Foliage(told["length_m"], told["transmittance"])
    for ending in ("csv", "svg", "geojson"):
        path.write(tmp_path / f"ours.{ending}")
        same_bytes(tmp_path / f"ours.{ending}", tmp_path / f"theirs.{ending}")
    assert wooded.profile([EYE, END]).foliage is None


def test_features_are_left_out_as_the_command_line_does(wooded: itin.Store, tmp_path: Path) -> None:
    felled, names = "trees:Avenue", ["trees:Avenue", "buildings#3"]
    without = ["--without", "trees:Avenue;buildings#3"]
    ends = ["--from", f"{FROM},2", "--to", f"{TO},12"]
    line = wooded.line_of_sight((*EYE, 2), (*END, 12), without=names)
    document = json.loads(run("los", wooded.path, *ends, *without, "--json"))
    for name in ("verdict", "clearance_m", "obstructions", "surface"):
        assert line.document[name] == document[name]
    view = ["--observer", f"{FROM},3", "--target-height", "0", "--radius", "150", "--cell", "2", *without]
    run("viewshed", wooded.path, *view, "-o", tmp_path / "theirs.tif")
    seen = wooded.viewshed((*EYE, 3), radius=150, cell_size=2, without=names)
    seen.write(tmp_path / "ours.tif")
    same_bytes(tmp_path / "ours.tif", tmp_path / "theirs.tif")
    run("profile", wooded.path, "--from", FROM, "--to", TO, *without, "-o", tmp_path / "theirs.csv")
    wooded.profile([EYE, END], without=names).write(tmp_path / "ours.csv")
    same_bytes(tmp_path / "ours.csv", tmp_path / "theirs.csv")
    for links in (wooded.links([(*EYE, 2)], [(*END, 12)], without=names), wooded.links([(*EYE, 2)], [(*END, 12)])):
        assert links.verdict[0] in (0, 1)
    assert wooded.links([(*EYE, 2)], [(*END, 12)], without=names).verdict[0] == line.verdict
    area = itin.Window.box(321800, 4297640, 321840, 4297660)
    stands = wooded.triangulate(area, themes="all")
    assert 2 in stands.themes
    assert 2 not in wooded.triangulate(area, themes="all", without=felled).themes


def test_wrong_calls_name_the_argument(wooded: itin.Store) -> None:
    calls: tuple[tuple[str, dict[str, object]], ...] = (
        ("without", {"without": "trees:Elm"}),
        ("without", {"without": ["roads:1"]}),
        ("foliage", {"foliage": -1.0}),
        ("transmittance", {"foliage": 0.5, "transmittance": 2.0}),
        ("leaf_area", {"foliage": 0.5, "leaf_area": "density"}),
    )
    for field, arguments in calls:
        with pytest.raises(itin.InputError, match=f"`{field}`") as caught:
            wooded.line_of_sight((*EYE, 2), (*END, 12), **arguments)  # type: ignore[arg-type]
        assert caught.value.field == field
    with pytest.raises(itin.InputError) as caught:
        wooded.viewshed((*EYE, 3), radius=50, cell_size=2, foliage=0.5, mode="count")
    assert caught.value.field == "foliage"


def test_a_raster_beside_is_not_replaced(wooded: itin.Store, tmp_path: Path) -> None:
    (tmp_path / "seen-foliage.tif").write_text("mine")
    seen = wooded.viewshed((*EYE, 3), radius=50, cell_size=2, foliage=0.5)
    with pytest.raises(itin.FileError):
        seen.write(tmp_path / "seen.tif")
    assert [path.name for path in tmp_path.iterdir()] == ["seen-foliage.tif"]
