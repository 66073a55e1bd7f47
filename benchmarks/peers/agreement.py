#!/usr/bin/python3
"""How far two answers agree: agreement.py A B prints it as JSON.

`iou` is the intersection over union of what is visible, `differing` how many verdicts differ of `all`. A and B are rasters
on one grid (0: hidden, 1: visible, else not compared; one may be cut from the other's grid, as gdal_viewshed cuts its
raster to the radius) or tables of links (columns id and verdict).
"""
import csv
import json
import sys


def counts_of_links(path_a, path_b):
    """Returns how many links are visible in both, visible in at least one, and compared."""
    a, b = ({row["id"]: row["verdict"] == "visible" for row in csv.DictReader(open(path))} for path in (path_a, path_b))
    both = a.keys() & b.keys()
    return sum(a[i] and b[i] for i in both), sum(a[i] or b[i] for i in both), len(both)


def read(path):
    from osgeo import gdal

    gdal.UseExceptions()
    raster = gdal.Open(path)
    return raster.GetGeoTransform(), raster.ReadAsArray()


def counts_of_cells(path_a, path_b):
    import numpy as np

    (grid_a, a), (grid_b, b) = read(path_a), read(path_b)
    shift = np.array([(grid_b[0] - grid_a[0]) / grid_a[1], (grid_b[3] - grid_a[3]) / grid_a[5]])
    if not np.allclose(grid_a[1::4], grid_b[1::4]) or not np.allclose(shift, np.rint(shift), atol=1e-3):
        sys.exit(f"{path_a} and {path_b} lie on different grids")
    column, row = np.rint(shift).astype(int)
    rows = slice(max(row, 0), min(a.shape[0], b.shape[0] + row))
    columns = slice(max(column, 0), min(a.shape[1], b.shape[1] + column))
    a, b = a[rows, columns], b[rows.start - row:rows.stop - row, columns.start - column:columns.stop - column]
    both = (a <= 1) & (b <= 1)
    visible_a, visible_b = (a == 1) & both, (b == 1) & both
    return tuple(int(np.count_nonzero(cells)) for cells in (visible_a & visible_b, visible_a | visible_b, both))


def agreement(path_a, path_b):
    counts = counts_of_links if path_a.endswith(".csv") else counts_of_cells
    intersection, union, compared = counts(path_a, path_b)
    iou = round(intersection / union, 6) if union else 1.0
    return {"iou": iou, "differing": union - intersection, "all": compared}


print(json.dumps(agreement(*sys.argv[1:3])))
