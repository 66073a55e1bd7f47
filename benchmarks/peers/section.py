#!/usr/bin/python3
"""What users do without itin: profiles sampled from a raster, and a line cut with a whole explicit TIN.

section.py links RASTER.tif SIDE COUNT LENGTH OUT.csv   links of LENGTH m within a square of SIDE m on high ground
section.py raster RASTER.tif LINKS.csv OUT.csv          each link's verdict by GDAL and NumPy, one core
section.py tin TIN.ply LINKS.csv                        reads a binary PLY whole, cuts it with the first link
"""
import csv
import sys
import time

import numpy as np


def read_links(path):
    with open(path) as file:
        return np.array([[float(row[k]) for k in ("x1", "y1", "h1", "x2", "y2", "h2")] for row in csv.DictReader(file)])


def write_links(raster, side, count, length, out):
    from osgeo import gdal

    gdal.UseExceptions()
    dataset = gdal.Open(raster)
    x0, step, _, y0, _, down = dataset.GetGeoTransform()
    heights = dataset.ReadAsArray()
    nodata = dataset.GetRasterBand(1).GetNoDataValue()
    ground = np.ones(heights.shape, bool) if nodata is None else heights != nodata
    random = np.random.default_rng(1)
    rows, columns = heights.shape
    cells = int(side / step)
    if cells < min(rows, columns):
        # Takes, out of a thousand squares with data all over, the one whose mean is highest.
        best, r, c = -1e9, 0, 0
        for _ in range(1000):
            i, j = random.integers(0, rows - cells), random.integers(0, columns - cells)
            if ground[i : i + cells : 20, j : j + cells : 20].all():
                mean = heights[i : i + cells : 20, j : j + cells : 20].mean()
                if mean > best:
                    best, r, c = mean, i, j
        box = (x0 + c * step, y0 + (r + cells) * down, x0 + (c + cells) * step, y0 + r * down)
    else:
        box = (x0, y0 + rows * down, x0 + columns * step, y0)

    def has_ground(x, y):
        i, j = int((y - y0) / down), int((x - x0) / step)
        return 1 <= i < rows - 1 and 1 <= j < columns - 1 and ground[i - 1 : i + 2, j - 1 : j + 2].all()

    with open(out, "w") as file:
        file.write("id,x1,y1,h1,x2,y2,h2\n")
        made = 0
        while made < count:
            x, y = random.uniform(box[0], box[2]), random.uniform(box[1], box[3])
            azimuth = random.uniform(0, 2 * np.pi)
            u, v = x + length * np.sin(azimuth), y + length * np.cos(azimuth)
            if box[0] < u < box[2] and box[1] < v < box[3] and has_ground(x, y) and has_ground(u, v):
                file.write(f"{made},{x:.2f},{y:.2f},10,{u:.2f},{v:.2f},10\n")
                made += 1


def heights_around(raster, links):
    """Returns the heights of the rectangle that holds the links, where the first height lies, and how far apart they are."""
    from osgeo import gdal

    gdal.UseExceptions()
    dataset = gdal.Open(raster)
    x0, step, _, y0, _, down = dataset.GetGeoTransform()
    columns, rows = (links[:, [0, 3]] - x0) / step, (links[:, [1, 4]] - y0) / down
    left, top = max(int(columns.min()) - 2, 0), max(int(rows.min()) - 2, 0)
    right, bottom = min(int(columns.max()) + 3, dataset.RasterXSize), min(int(rows.max()) + 3, dataset.RasterYSize)
    heights = dataset.ReadAsArray(left, top, right - left, bottom - top).astype(np.float64)
    return heights, x0 + left * step, y0 + top * down, step, down


def sample_raster(raster, links, out):
    """Writes whether each link is clear over the effective Earth: bilinear, a sample for each cell, the heights in memory."""
    heights, x0, y0, step, down = heights_around(raster, links)
    with open(out, "w") as file:
        file.write("id,verdict\n")
        for i, (x1, y1, h1, x2, y2, h2) in enumerate(links):
            length = np.hypot(x2 - x1, y2 - y1)
            t = np.linspace(0, 1, int(length / step) + 2)
            column, row = (x1 + t * (x2 - x1) - x0) / step - 0.5, (y1 + t * (y2 - y1) - y0) / down - 0.5
            i0, j0 = row.astype(int), column.astype(int)
            v, u = row - i0, column - j0
            z = (heights[i0, j0] * (1 - u) + heights[i0, j0 + 1] * u) * (1 - v) + (
                heights[i0 + 1, j0] * (1 - u) + heights[i0 + 1, j0 + 1] * u
            ) * v
            ray = (z[0] + h1) * (1 - t) + (z[-1] + h2) * t
            clearance = ray - z - length**2 * t * (1 - t) * (1 - 0.13) / (2 * 6371000)
            file.write(f"{i},{'visible' if clearance.min() >= 0 else 'hidden'}\n")


def cut_tin(path, link):
    start = time.perf_counter()
    with open(path, "rb") as file:
        counts, sizes, current, types = {}, {}, None, {}
        kinds = {"double": "<f8", "float": "<f4", "int": "<i4", "uint": "<u4", "ushort": "<u2", "uchar": "u1"}
        while (line := file.readline().decode().split())[0] != "end_header":
            if line[0] == "element":
                current = line[1]
                counts[current], types[current] = int(line[2]), []
            elif line[0] == "property" and line[1] == "list":
                types[current] += [(line[4] + "_count", kinds[line[2]]), (line[4], kinds[line[3]], 3)]
            elif line[0] == "property":
                types[current].append((line[2], kinds[line[1]]))
        vertices = np.fromfile(file, np.dtype(types["vertex"]), counts["vertex"])
        faces = np.fromfile(file, np.dtype(types["face"]), counts["face"])
    read = time.perf_counter()
    x1, y1, _, x2, y2, _ = link
    x, y = vertices["x"], vertices["y"]
    side = (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1)
    along = ((x - x1) * (x2 - x1) + (y - y1) * (y2 - y1)) / ((x2 - x1) ** 2 + (y2 - y1) ** 2)
    corners = faces[[n for n in faces.dtype.names if faces.dtype[n].shape == (3,)][0]]
    sides, places = side[corners], along[corners]
    crossed = (sides.min(1) <= 0) & (sides.max(1) >= 0) & (places.max(1) >= 0) & (places.min(1) <= 1)
    done = time.perf_counter()
    print(
        f"{len(vertices)} vertices, {len(faces)} triangles: read in {read - start:.2f} s, cut in {done - read:.2f} s, "
        f"about {np.count_nonzero(crossed)} triangles crossed"
    )


if __name__ == "__main__":
    what = sys.argv[1]
    if what == "links":
        write_links(sys.argv[2], float(sys.argv[3]), int(sys.argv[4]), float(sys.argv[5]), sys.argv[6])
    elif what == "raster":
        sample_raster(sys.argv[2], read_links(sys.argv[3]), sys.argv[4])
    else:
        cut_tin(sys.argv[2], read_links(sys.argv[3])[0])
