"""Viewsheds of rasters that xarray holds, without a store.

``viewshed`` takes what ``xrspatial.viewshed`` takes, and answers in its terms; see there for what differs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._asked import Earth, Grid, Observer, Verdict
from ._errors import InputError
from ._store import Surface

if TYPE_CHECKING:
    import xarray


def _spacing(values: NDArray[np.float64], axis: str) -> float:
    """Returns the step from one coordinate to the next, negative where they fall."""
    if values.ndim != 1 or len(values) < 2 or not np.isfinite(values).all():
        raise InputError(f"`raster`: its coordinates {axis} must be two or more finite numbers", "raster")
    step = (values[-1] - values[0]) / (len(values) - 1)
    if step == 0 or not np.allclose(np.diff(values), step, rtol=1e-6, atol=0):
        raise InputError(f"`raster`: its coordinates {axis} are not equally far apart", "raster")
    return float(step)


def _nearest(values: NDArray[np.float64], at: float, axis: str) -> int:
    if not values.min() <= at <= values.max():
        raise InputError(f"`{axis}`: {at} is outside of the raster, {values.min()} to {values.max()}", axis)
    return int(np.abs(values - at).argmin())


def viewshed(
    raster: xarray.DataArray,
    x: float,
    y: float,
    observer_elev: float = 0.0,
    target_elev: float = 0.0,
) -> xarray.DataArray:
    """Tells which cells of a raster of heights an observer sees, on a flat Earth, by the angles at which they are seen.

    The surface is that of ``Surface``: triangles between the centres of cells. ``xrspatial.viewshed`` interpolates between
    the cells that a line passes instead, so that cells that are barely seen or hidden may differ.

    Args:
        raster: Heights, shape (y, x), in the units of its coordinates, which are equally far apart; NaN where there is no
            ground. Ground without data hides nothing.
        x: Where the observer stands: at the centre of the nearest cell.
        y: Likewise.
        observer_elev: The height of the eye above that cell.
        target_elev: The height of the targets above theirs.

    Returns:
        Degrees from the nadir, float64: 90 for what is level with the eye, 180 for the observer's own cell; -1 where a
        cell is hidden, or has no height. Coordinates and attributes are the raster's.

    Raises:
        InputError: Another shape, coordinates at unequal steps, or an observer outside of the raster or without ground.
    """
    if raster.ndim != 2:
        raise InputError(f"`raster`: it has {raster.ndim} dimensions; give one of (y, x)", "raster")
    ys, xs = (np.asarray(raster[dim].values, dtype=np.float64) for dim in raster.dims)
    step_x, step_y = _spacing(xs, "x"), _spacing(ys, "y")
    row, column = _nearest(ys, y, "y"), _nearest(xs, x, "x")
    # A grid has its rows from north to south, and its columns from west to east.
    turned = (slice(None, None, 1 if step_y < 0 else -1), slice(None, None, 1 if step_x > 0 else -1))
    width, height = abs(step_x), abs(step_y)
    grid = Grid(xs.min() - width / 2, ys.max() + height / 2, width, height, len(xs), len(ys))
    heights = np.asarray(raster.values, dtype=np.float32)
    seen = Surface(heights[turned], grid, resolution=min(width, height) / 4096).viewshed(
        Observer(xs[column], ys[row], observer_elev),
        target_height=target_elev,
        grid=grid,
        earth=Earth.flat(),
        nodata="clear",
        mode="angle",
    )
    angles = np.where(seen.verdict == Verdict.VISIBLE, seen.values["angle_deg"].astype(np.float64) + 90.0, -1.0)[turned]
    angles[row, column] = 180.0
    return raster.copy(data=angles)
