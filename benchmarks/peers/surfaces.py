#!/usr/bin/python3
"""Writes a surface on which viewsheds are compared: surfaces.py pillars OUT.tif | surfaces.py lidar OUT.tif LAS...

pillars: a plane of 2 km at 100 m with a pillar of 5 m by 5 m, 40 m high, every 50 m; cells of 1 m, EPSG:32630.
lidar: all returns of LAS files (Lambert 93), interpolated linearly in their Delaunay triangulation, cells of 1 m.
"""
import os
import sys

import numpy as np
from osgeo import gdal, osr

gdal.UseExceptions()
COMPRESSED = ["TILED=YES", "COMPRESS=DEFLATE", "PREDICTOR=3"]


def crs(epsg):
    reference = osr.SpatialReference()
    reference.ImportFromEPSG(epsg)
    return reference


def write_pillars(path):
    at = np.arange(2000) % 50 < 5
    heights = np.where(at[:, None] & at[None, :], 140, 100).astype(np.float32)
    raster = gdal.GetDriverByName("GTiff").Create(path, 2000, 2000, 1, gdal.GDT_Float32, COMPRESSED)
    raster.SetGeoTransform((500000, 1, 0, 6002000, 0, -1))
    raster.SetProjection(crs(32630).ExportToWkt())
    raster.GetRasterBand(1).WriteArray(heights)


def points_of(path):
    data = np.fromfile(path, np.uint8)
    first = data[96:100].view(np.uint32)[0]
    length = data[105:107].view(np.uint16)[0]
    scale_and_offset = data[131:179].view(np.float64)
    records = data[first:][: (len(data) - first) // length * length].reshape(-1, length)
    count = data[247:255].view(np.uint64)[0] or data[107:111].view(np.uint32)[0]
    units = np.ascontiguousarray(records[: int(count), :12]).view(np.int32)
    return units * scale_and_offset[:3] + scale_and_offset[3:]


def write_lidar(path, files):
    points = np.vstack([points_of(file) for file in files])
    np.savetxt(path + ".csv", points, fmt="%.3f", delimiter=",", header="x,y,z", comments="")
    table = ("<OGRVRTDataSource><OGRVRTLayer name='points'><SrcDataSource>{}.csv</SrcDataSource><SrcLayer>{}</SrcLayer>"
             "<GeometryType>wkbPoint25D</GeometryType><LayerSRS>EPSG:2154</LayerSRS>"
             "<GeometryField encoding='PointFromColumns' x='x' y='y' z='z'/></OGRVRTLayer></OGRVRTDataSource>")
    name = path.rsplit("/", 1)[-1]
    west, south = np.ceil(points[:, :2].min(axis=0))
    east, north = np.floor(points[:, :2].max(axis=0))
    gdal.Grid(path, table.format(path, name), format="GTiff", outputBounds=[west, north, east, south],
              width=int(east - west), height=int(north - south), outputSRS="EPSG:2154",
              algorithm="linear:radius=-1:nodata=-9999", outputType=gdal.GDT_Float32, creationOptions=COMPRESSED)
    os.remove(path + ".csv")


if sys.argv[1] == "pillars":
    write_pillars(sys.argv[2])
else:
    write_lidar(sys.argv[2], sys.argv[3:])
