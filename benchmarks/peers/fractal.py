#!/usr/bin/python3
"""Writes a synthetic terrain of fixed seed: fractal.py OUT.tif [POSTS]

A square of POSTS x POSTS posts (default 4096), 10 m apart, EPSG:32630, heights 0-1000 m to 0.1 m: Gaussian noise whose
amplitude falls with frequency to the power of -2, the roughness of weathered hills.
"""
import sys

import numpy as np
from osgeo import gdal, osr

gdal.UseExceptions()
path = sys.argv[1]
posts = int(sys.argv[2]) if len(sys.argv) > 2 else 4096

rng = np.random.default_rng(1994)
spectrum = np.fft.rfft2(rng.standard_normal((posts, posts)))
frequency = np.hypot(np.fft.fftfreq(posts)[:, None], np.fft.rfftfreq(posts)[None, :])
frequency[0, 0] = np.inf
heights = np.fft.irfft2(spectrum * frequency**-2.0, s=(posts, posts))
heights = 1000 * (heights - heights.min()) / (heights.max() - heights.min())
heights = np.round(heights, 1).astype(np.float32)

raster = gdal.GetDriverByName("GTiff").Create(
    path, posts, posts, 1, gdal.GDT_Float32, ["TILED=YES", "COMPRESS=DEFLATE", "PREDICTOR=3"])
raster.SetGeoTransform((400000, 10, 0, 6000000 + 10 * posts, 0, -10))
crs = osr.SpatialReference()
crs.ImportFromEPSG(32630)
raster.SetProjection(crs.ExportToWkt())
raster.GetRasterBand(1).WriteArray(heights)
