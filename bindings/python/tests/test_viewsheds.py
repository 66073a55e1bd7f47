"""Viewsheds: the command line's bytes, views without copies, threads, surfaces that are held."""

from __future__ import annotations

import json
import time
import tracemalloc
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import run

import itin

HILL = (310375.0, 183525.0, 30.0)
FARM = (312000.0, 185000.0, 12.0)
STREET = (321800.0, 4297750.0, 2.0)

# What is asked of the package, and of the command line.
QUESTIONS: list[tuple[dict[str, Any], list[str]]] = [
    ({}, []),
    ({"tolerance": 4}, ["--tolerance", "4"]),
    ({"mode": "certified", "tolerance": 16}, ["--mode", "certified", "--tolerance", "16"]),
    ({"mode": "count"}, ["--mode", "count"]),
    ({"mode": "which"}, ["--mode", "which"]),
    ({"mode": "angle"}, ["--mode", "angle"]),
    ({"mode": "nearest"}, ["--mode", "nearest"]),
    ({"mode": "blocker"}, ["--mode", "blocker"]),
    ({"mode": "height"}, ["--mode", "height"]),
    (
        {"mode": "probability", "vertical_error": 1.5, "error_correlation": 30},
        ["--mode", "probability", "--vertical-error", "1.5", "--error-correlation", "30"],
    ),
    ({"mode": "fresnel", "frequency_ghz": 5.8}, ["--frequency", "5.8"]),
    ({"mode": "loss", "frequency_ghz": 5.8, "polarisation": "v"}, ["--frequency", "5.8", "--loss", "--polarisation", "v"]),
    (
        {"mode": "level", "frequency_ghz": 18, "eirp_dbm": 43, "gain_dbi": 12, "sensitivity_dbm": -78, "margins_db": [0, 10]}
        | {"rain_rate_mm_h": 28, "feeder_loss_db": 1},
        ["--frequency", "18", "--eirp-dbm", "43", "--gain-dbi", "12", "--sensitivity-dbm", "-78", "--margin-db", "0,10"]
        + ["--rain-rate-mm-h", "28", "--feeder-loss-db", "1"],
    ),
    ({"azimuth": (350, 80), "elevation": (-3, 2)}, ["--azimuth", "350,80", "--elevation=-3,2"]),
    ({"earth": itin.Earth.effective_earth(4 / 3)}, ["--effective-earth", "4/3"]),
    ({"earth": itin.Earth.flat(), "nodata": "block"}, ["--curvature", "off", "--nodata", "block"]),
]


@pytest.mark.parametrize("asked, options", QUESTIONS, ids=lambda value: " ".join(value) if isinstance(value, list) else "")
def test_writes_the_command_line_s_bytes(
    cardiff: itin.Store, tmp_path: Path, asked: dict[str, Any], options: list[str]
) -> None:
    seen = cardiff.viewshed([HILL, FARM], target_height=2, radius=4000, cell_size=50, **asked)
    seen.write(tmp_path / "ours.tif")
    places = ["--observer", "310375,183525,30", "--observer", "312000,185000,12"]
    window = ["--target-height", "2", "--radius", "4000", "--cell", "50"]
    run("viewshed", cardiff.path, *places, *window, *options, "-o", tmp_path / "theirs.tif")
    assert (tmp_path / "ours.tif").read_bytes() == (tmp_path / "theirs.tif").read_bytes()
    styles = [tmp_path / "ours.qml", tmp_path / "theirs.qml"]
    assert styles[0].exists() == styles[1].exists()
    if styles[0].exists():
        assert styles[0].read_bytes() == styles[1].read_bytes()


def test_writes_the_command_line_s_polygons(town: itin.Store, tmp_path: Path) -> None:
    seen = town.viewshed(STREET, radius=150, observers_on_surface=True, targets_on_surface=True)
    seen.write(tmp_path / "ours.gpkg")
    options = ["--radius", "150", "--observer-on", "surface", "--target-on", "surface"]
    run("viewshed", town.path, "--observer", "321800,4297750,2", *options, "-o", tmp_path / "theirs.gpkg")
    ours, theirs = (tmp_path / name for name in ("ours.gpkg", "theirs.gpkg"))
    assert ours.read_bytes() == theirs.read_bytes()


def test_tells_what_the_command_line_tells(town: itin.Store, tmp_path: Path) -> None:
    seen = town.viewshed(STREET, radius=150, cell_size=2)
    command = ["viewshed", town.path, "--observer", "321800,4297750,2", "--radius", "150", "--cell", "2"]
    document = json.loads(run(*command, "-o", tmp_path / "a.tif", "--json"))
    for name in ("visible", "hidden", "undecided", "outside"):
        assert seen.cells[name] == document["cells"][name] == seen.document["cells"][name]
        assert (seen.verdict == itin.Verdict[name.upper()]).sum() == seen.cells[name]
    assert seen.document["surface"] == document["surface"]
    assert seen.ground == pytest.approx([town.heights([STREET[:2]], themes="none")[0]])
    assert seen.warnings == ()


def test_rasters_have_the_arrays(cardiff: itin.Store, tmp_path: Path) -> None:
    rasterio = pytest.importorskip("rasterio")
    for mode, name in (("visible", None), ("count", "count"), ("height", "height_m")):
        seen = cardiff.viewshed(HILL, radius=2000, cell_size=40, mode=mode)  # type: ignore[arg-type]
        seen.write(tmp_path / f"{mode}.tif")
        with rasterio.open(tmp_path / f"{mode}.tif") as raster:
            np.testing.assert_array_equal(raster.read(1), seen.values[name] if name else seen.verdict)
            assert raster.transform == rasterio.Affine(*seen.grid.transform)
            assert raster.crs == rasterio.crs.CRS.from_wkt(seen.crs)


def test_datasets_of_xarray_are_views(cardiff: itin.Store) -> None:
    pytest.importorskip("xarray")
    seen = cardiff.viewshed([HILL, FARM], radius=2000, cell_size=40, mode="which")
    data = seen.to_xarray()
    assert data["words"].dims == ("band", "y", "x") and data["verdict"].dims == ("y", "x")
    assert address(data["verdict"].values) == address(seen.verdict)
    row, column = np.argwhere(seen.verdict == itin.Verdict.VISIBLE)[0]
    cell = data["verdict"][row, column]
    alone = cardiff.viewshed([HILL, FARM], grid=itin.Grid(float(cell.x) - 1, float(cell.y) + 1, 2, 2, 1, 1))
    assert alone.verdict[0, 0] == itin.Verdict.VISIBLE
    assert data.attrs["crs"] == seen.crs


def test_takes_the_cells_of_a_grid(cardiff: itin.Store) -> None:
    grid = itin.Grid(308000, 186000, 25, 50, 120, 60)
    seen = cardiff.viewshed(HILL, grid=grid)
    assert seen.grid == grid
    assert seen.verdict.shape == (60, 120)


def address(array: np.ndarray[Any, Any]) -> int:
    at: int = array.__array_interface__["data"][0]
    return at


def test_arrays_are_views(cardiff: itin.Store) -> None:
    seen = cardiff.viewshed(HILL, radius=15000, cell_size=10, mode="angle")
    assert seen.verdict.size > 7_000_000
    assert address(seen.verdict) == address(seen.verdict)
    assert address(seen.values["angle_deg"]) == address(seen.values["angle_deg"])
    assert seen.verdict.dtype == np.uint8 and not seen.verdict.flags.owndata
    with pytest.raises(ValueError):
        seen.verdict[0, 0] = 1
    tracemalloc.start()
    times = []
    for _ in range(20):
        start = time.perf_counter()
        views = [seen.verdict, *seen.values.values()]
        times.append(time.perf_counter() - start)
    assert tracemalloc.get_traced_memory()[1] < 100_000
    tracemalloc.stop()
    assert min(times) < 200e-6
    del views


def test_views_outlive_what_they_are_of(town: itin.Store) -> None:
    store = itin.Store(town.path)
    verdict = store.viewshed(STREET, radius=100, cell_size=1).verdict
    expected = town.viewshed(STREET, radius=100, cell_size=1).verdict
    del store
    np.testing.assert_array_equal(verdict, expected)


def test_threads_give_equal_results(cardiff: itin.Store) -> None:
    def verdict(_: int) -> bytes:
        return cardiff.viewshed(HILL, radius=5000, cell_size=25).verdict.tobytes()

    with ThreadPoolExecutor(4) as pool:
        assert len(set(pool.map(verdict, range(8)))) == 1


def test_results_do_not_depend_on_the_number_of_threads(cardiff: itin.Store) -> None:
    all_cores = cardiff.viewshed(HILL, radius=5000, cell_size=25).verdict.tobytes()
    itin.set_thread_count(1)
    try:
        assert itin.thread_count() == 1
        assert cardiff.viewshed(HILL, radius=5000, cell_size=25).verdict.tobytes() == all_cores
    finally:
        itin.set_thread_count(0)


def test_a_held_surface_gives_the_same(town: itin.Store) -> None:
    held = town.hold((321600, 4297550, 322000, 4297950))
    assert held.bytes > 0
    for x in (321750.0, 321800.0, 321850.0):
        ours = held.viewshed((x, 4297750, 2), radius=100, cell_size=2)
        np.testing.assert_array_equal(ours.verdict, town.viewshed((x, 4297750, 2), radius=100, cell_size=2).verdict)
    with pytest.raises(itin.InputError) as caught:
        held.viewshed(STREET, radius=5000)
    assert caught.value.field == "radius"


def test_an_observer_has_a_view_of_its_own(cardiff: itin.Store) -> None:
    near = itin.Observer(*HILL, name="hill", radius=500)
    both = cardiff.viewshed([near, FARM], radius=1500, cell_size=50, mode="count")
    alone = cardiff.viewshed(near, grid=both.grid)
    assert alone.cells["visible"] + alone.cells["hidden"] == pytest.approx(np.pi * 10**2, rel=0.1)
    assert (both.values["count"][alone.verdict == itin.Verdict.VISIBLE] >= 1).all()
