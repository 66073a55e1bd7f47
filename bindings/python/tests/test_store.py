"""Stores: what they hold, heights, triangles, profiles, imports."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import DATA, run

import itin


def test_tells_what_it_holds(town: itin.Store) -> None:
    info = json.loads(run("info", town.path, "--json"))
    assert town.crs == info["crs"] == "EPSG:26918"
    assert town.vertices == info["vertices"]
    assert town.bounds == tuple(info["bounds"][side] for side in ("xmin", "ymin", "xmax", "ymax"))
    assert [level.tolerance for level in town.levels] == [level["tolerance_m"] for level in info["levels"]]
    assert [(t.name, t.kind, t.features, t.left_out) for t in town.themes] == [
        (t["name"], t["kind"], t["features"], t["left_out"]) for t in info["themes"]
    ]
    assert town.themes[0].stands


def test_counts_the_features_that_imports_left_out(tmp_path: Path) -> None:
    path, towers = tmp_path / "towers.itin", tmp_path / "towers.csv"
    itin.import_terrain(path, DATA / "cardiff.tif")
    x, y = itin.Store(path).bounds[:2]
    corners = ((318000, 178000), (x - 999, y))
    rings = [f"(({w} {s}, {w + 20} {s}, {w + 20} {s + 20}, {w} {s + 20}, {w} {s}))" for w, s in corners]
    towers.write_text("WKT,h\n" + "".join(f'"POLYGON {ring}",9\n' for ring in rings))
    itin.import_features(path, towers, kind="buildings", height_field="h", crs="EPSG:27700")
    (theme,) = itin.Store(path).themes
    assert (theme.features, theme.left_out) == (1, 1)


def test_digest_is_the_command_line_s(town: itin.Store) -> None:
    assert town.content_digest() == json.loads(run("info", town.path, "--digest", "--json"))["digest"]


def test_heights_are_those_of_triangles(town: itin.Store) -> None:
    tin = town.triangulate(itin.Window.disc(321700, 4297700, 60), themes="all")
    corners = tin.vertices[tin.triangles]
    inner = corners.mean(axis=1)
    heights = town.heights(inner[:, :2])
    np.testing.assert_allclose(heights, inner[:, 2], atol=2e-3)
    assert set(tin.themes) == {0, 1}


def test_heights_are_nan_off_the_data(cardiff: itin.Store) -> None:
    assert np.isnan(cardiff.heights([(0, 0)])).all()
    assert cardiff.heights(np.empty((0, 2))).shape == (0,)


def test_height_raster_is_that_of_the_source(cardiff: itin.Store) -> None:
    rasterio = pytest.importorskip("rasterio")
    with rasterio.open(DATA / "cardiff.tif") as source:
        grid = itin.Grid.from_transform(source.transform, source.width, source.height)
        posts = source.read(1)
        assert rasterio.Affine(*grid.transform) == source.transform
        assert grid.bounds == source.bounds
    heights = cardiff.height_raster(grid)
    assert heights.shape == grid.shape == posts.shape
    assert heights.dtype == np.float32
    known = ~np.isnan(heights)
    assert known.mean() > 0.5
    np.testing.assert_allclose(heights[known], posts[known], atol=0.006)


def test_profile_is_the_command_line_s(town: itin.Store) -> None:
    ends = [(321590, 4297655), (321790, 4297662)]
    profile = town.profile(ends)
    texts = [f"{x},{y}" for x, y in ends]
    document = json.loads(run("profile", town.path, "--from", texts[0], "--to", texts[1], "--json"))
    points = document["profiles"][0]["breakpoints"]
    assert profile.length == document["length_m"]
    np.testing.assert_array_equal(profile.distance, [p["distance_m"] for p in points])
    np.testing.assert_array_equal(profile.z, [p["z"] for p in points])
    assert profile.gaps.shape == (0, 2)


def test_imports_what_the_command_line_imports(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    report = itin.import_terrain(tmp_path / "a.itin", DATA / "alexandria-dtm.tif", tolerances=[1, 4])
    run("import", tmp_path / "b.itin", DATA / "alexandria-dtm.tif", "--levels", "1,4")
    assert (tmp_path / "a.itin").read_bytes() == (tmp_path / "b.itin").read_bytes()
    assert report.vertices == itin.Store(tmp_path / "a.itin").vertices
    assert [level.tolerance for level in itin.Store(tmp_path / "a.itin").levels] == [0, 1, 4]
