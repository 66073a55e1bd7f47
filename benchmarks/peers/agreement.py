#!/usr/bin/python3
"""How far two viewsheds on one grid agree: agreement.py A.tif B.tif

Prints the intersection over union of their visible cells (value 1), over the cells where both have data, and how many
cells differ.
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


transform_a, visible_a, data_a = read(sys.argv[1])
transform_b, visible_b, data_b = read(sys.argv[2])
if visible_a.shape != visible_b.shape or not np.allclose(transform_a, transform_b):
    sys.exit(f"{sys.argv[1]} and {sys.argv[2]} lie on different grids")
both = data_a & data_b
intersection = np.count_nonzero(visible_a & visible_b & both)
union = np.count_nonzero((visible_a | visible_b) & both)
differing = np.count_nonzero((visible_a != visible_b) & both)
iou = intersection / union if union else 1.0
print(f"IoU {iou:.4f}, {differing} of {np.count_nonzero(both)} cells differ")
