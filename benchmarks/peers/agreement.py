#!/usr/bin/python3
"""How far two viewsheds on one grid agree: agreement.py A.tif B.tif

Prints the intersection over union of their visible cells (value 1), over the cells where both have data, and how many
cells differ. One may be cut from the other's grid, as gdal_viewshed cuts its raster to the radius.
"""
import sys

import numpy as np
from osgeo import gdal

gdal.UseExceptions()


def read(path):
    raster = gdal.Open(path)
    band = raster.GetRasterBand(1)
    cells = band.ReadAsArray()
    nodata = band.GetNoDataValue()
    has_data = np.ones(cells.shape, bool) if nodata is None else cells != nodata
    return raster.GetGeoTransform(), cells == 1, has_data


def common(a, b):
    """The parts of two rasters that lie over each other."""
    (grid_a, visible_a, data_a), (grid_b, visible_b, data_b) = a, b
    shift = np.array([(grid_b[0] - grid_a[0]) / grid_a[1], (grid_b[3] - grid_a[3]) / grid_a[5]])
    if not np.allclose(grid_a[1::4], grid_b[1::4]) or not np.allclose(shift, np.rint(shift), atol=1e-3):
        sys.exit(f"{sys.argv[1]} and {sys.argv[2]} lie on different grids")
    column, row = np.rint(shift).astype(int)
    rows = slice(max(row, 0), min(visible_a.shape[0], visible_b.shape[0] + row))
    columns = slice(max(column, 0), min(visible_a.shape[1], visible_b.shape[1] + column))
    there = slice(rows.start - row, rows.stop - row), slice(columns.start - column, columns.stop - column)
    return visible_a[rows, columns], data_a[rows, columns], visible_b[there], data_b[there]


visible_a, data_a, visible_b, data_b = common(read(sys.argv[1]), read(sys.argv[2]))
both = data_a & data_b
intersection = np.count_nonzero(visible_a & visible_b & both)
union = np.count_nonzero((visible_a | visible_b) & both)
differing = np.count_nonzero((visible_a != visible_b) & both)
iou = intersection / union if union else 1.0
print(f"IoU {iou:.4f}, {differing} of {np.count_nonzero(both)} cells differ")
