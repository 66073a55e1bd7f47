"""What can be seen from a place, as a NumPy array that rasterio writes.

    viewshed_raster.py cardiff.itin 310375 183525 seen.tif
"""

from __future__ import annotations

import sys

import numpy as np
import rasterio

import itin


def main(store_path: str, x: str, y: str, output: str) -> None:
    store = itin.Store(store_path)
    seen = store.viewshed((float(x), float(y), 20), target_height=2, radius=10000, cell_size=25, mode="height")
    for warning in seen.warnings:
        print(warning, file=sys.stderr)

    # The least height at which a target is seen, as steps of 10 m: views of the result, no copies.
    least = seen.values["height_m"]
    steps = np.where(np.isnan(least), 255, np.minimum(least // 10, 254)).astype(np.uint8)
    rows, columns = seen.grid.shape
    with rasterio.open(
        output,
        "w",
        driver="GTiff",
        height=rows,
        width=columns,
        count=1,
        dtype="uint8",
        crs=seen.crs,
        transform=rasterio.Affine(*seen.grid.transform),
        nodata=255,
        compress="deflate",
    ) as raster:
        raster.write(steps, 1)
    in_view = seen.verdict != itin.Verdict.OUTSIDE
    print(f"{100 * (seen.verdict[in_view] == itin.Verdict.VISIBLE).mean():.1f} % is in sight")


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit("viewshed_raster.py STORE EASTING NORTHING OUTPUT.tif")
    try:
        main(*sys.argv[1:])
    except itin.Error as error:
        sys.exit(str(error))
