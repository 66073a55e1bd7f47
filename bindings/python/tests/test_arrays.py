"""Surfaces through arrays, against stores of the same heights; viewsheds in xarray-spatial's terms."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import itin

pytest.importorskip("xarray")
import xarray  # noqa: E402

import itin.xarray  # noqa: E402

GRID = itin.Grid(318000, 176000, 10, 10, 40, 30)


def hills(seed: int = 1) -> NDArray[np.float32]:
    random = np.random.default_rng(seed)
    heights: NDArray[np.float32] = np.cumsum(random.normal(0, 3, (30, 40)), axis=1).round(2).astype(np.float32)
    heights[random.random((30, 40)) < 0.03] = np.nan
    heights[15, 20] = 5
    return heights


def raster_of(heights: NDArray[np.float32]) -> xarray.DataArray:
    y = GRID.north - GRID.cell_height * (np.arange(GRID.rows) + 0.5)
    x = GRID.west + GRID.cell_width * (np.arange(GRID.columns) + 0.5)
    return xarray.DataArray(heights, dims=("y", "x"), coords={"y": y, "x": x}, attrs={"units": "m"})


@pytest.mark.parametrize("mode", ["visible", "angle", "height"])
def test_is_the_surface_of_a_store(tmp_path: Path, mode: str) -> None:
    rasterio = pytest.importorskip("rasterio")
    heights = hills()
    profile = {"driver": "GTiff", "width": 40, "height": 30, "count": 1, "dtype": "float32", "nodata": np.nan}
    transform = rasterio.Affine(*GRID.transform)
    with rasterio.open(tmp_path / "a.tif", "w", crs="EPSG:27700", transform=transform, **profile) as raster:
        raster.write(heights, 1)
    itin.import_terrain(tmp_path / "a.itin", tmp_path / "a.tif")
    asked: dict[str, Any] = {"target_height": 1.5, "grid": GRID, "mode": mode}
    stored = itin.Store(tmp_path / "a.itin").viewshed((318205, 175845, 2), **asked)
    ours = itin.Surface(heights, GRID).viewshed((318205, 175845, 2), **asked)
    assert (ours.verdict == stored.verdict).all()
    assert ours.cells == stored.cells
    for name, values in stored.values.items():
        np.testing.assert_array_equal(ours.values[name], values)
    ours.write(tmp_path / "ours.tif")
    assert (tmp_path / "ours.tif").exists() and ours.document["crs"] is not None


def test_says_what_is_wrong_with_an_array() -> None:
    with pytest.raises(itin.InputError, match="the shape is") as error:
        itin.Surface(np.zeros((3, 3)), GRID)
    assert error.value.field == "heights"
    with pytest.raises(itin.InputError) as error:
        itin.Surface(hills(), GRID, resolution=0)
    assert error.value.field == "resolution"


def test_has_the_terms_of_xarray_spatial() -> None:
    # The example of its documentation; y ascends.
    heights = np.array([[0, 0, 1, 0, 0], [1, 3, 0, 0, 0], [10, 2, 5, 2, -1], [11, 1, 2, 9, 0]], dtype=float)
    terrain = xarray.DataArray(heights, dims=("y", "x"), coords={"y": np.arange(1.0, 5), "x": np.arange(1.0, 6)})
    seen = itin.xarray.viewshed(terrain, x=3, y=2)
    theirs = np.array(
        [
            [-1, 90, 135, 90, -1],
            [-1, 161.56505118, 180, 90, 90],
            [167.39561735, 144.73561032, 168.69006753, 144.73561032, -1],
            [165.57993189, -1, -1, 166.0472636, -1],
        ]
    )
    both = (seen.values >= 0) & (theirs >= 0)
    np.testing.assert_allclose(seen.values[both], theirs[both], atol=0.01)
    assert both.sum() >= 10
    assert seen.dims == terrain.dims and seen.dtype == np.float64
    assert seen.sel(x=3, y=2) == 180


def test_does_not_mind_how_a_raster_is_turned() -> None:
    raster = raster_of(np.nan_to_num(hills(2), nan=3.0))
    seen = itin.xarray.viewshed(raster, 318207, 175843, observer_elev=3, target_elev=1)
    assert seen.attrs == {"units": "m"}
    assert 0.05 < (seen >= 0).mean() < 0.95
    for turned in (raster[::-1], raster[:, ::-1], raster[::-1, ::-1]):
        again = itin.xarray.viewshed(turned, 318207, 175843, observer_elev=3, target_elev=1)
        xarray.testing.assert_equal(again.sortby("x").sortby("y", ascending=False), seen)


def test_of_xarray_says_what_is_wrong() -> None:
    raster = raster_of(hills())
    with pytest.raises(itin.InputError) as error:
        itin.xarray.viewshed(raster, 0, 175843)
    assert error.value.field == "x"
    with pytest.raises(itin.InputError, match="not equally far apart"):
        itin.xarray.viewshed(raster[[0, 1, 3]], 318205, 175985)


def test_rings_are_about_one_observer(cardiff: itin.Store) -> None:
    asked: dict[str, Any] = {"radius": 5000, "cell_size": 100}
    one = cardiff.viewshed((310375, 183525, 30), rings=[(8000, 4)], **asked)
    assert one.cells == cardiff.viewshed((310375, 183525, 30), tolerance=4, **asked).cells
    rings = [(500, 0), (2000, 1), (10000, 4)]
    several = cardiff.viewshed((310375, 183525, 30), rings=rings, **asked)
    assert [ring["tolerance_m"] for ring in several.document["surface"]["rings"]] == [0, 1, 4]
    with pytest.raises(itin.InputError) as error:
        cardiff.viewshed([(310375, 183525), (312000, 185000)], rings=rings, **asked)
    assert error.value.field == "rings"
    with pytest.raises(itin.InputError) as error:
        cardiff.viewshed((310375, 183525), tolerance=2, rings=rings, **asked)
    assert error.value.field == "rings"
