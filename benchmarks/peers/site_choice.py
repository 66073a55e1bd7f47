#!/usr/bin/python3
"""Candidates for benchmarks/peers/site.sh, and, for town.sh as well, the greedy choice by brute force on exact viewsheds.

    site_choice.py candidates                          500 of them, as CSV
    site_choice.py compare CANDIDATES FOLDER SITES     exits with 1 where the choices differ
"""
import csv
import sys


def candidates():
    print("name,x,y")
    state = 12345
    for i in range(500):
        place = []
        for low, width in ((283000, 40000), (181000, 32000)):
            state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
            place.append(low + (state >> 33) / 2**31 * width)
        print(f"c{i},{place[0]:.1f},{place[1]:.1f}")


def cells_seen(path):
    """Returns the cells with value 1, each as a number: its row and column on the grid of all multiples of the cell size."""
    import numpy
    from osgeo import gdal

    gdal.UseExceptions()
    raster = gdal.Open(path)
    x, width, _, y, _, height = raster.GetGeoTransform()
    rows, columns = numpy.nonzero(raster.ReadAsArray() == 1)
    return (round(-y / -height) + rows.astype(numpy.int64)) * 2**20 + round(x / width) + columns


def compare(table, folder, sites):
    import numpy

    names = [row["name"] for row in csv.DictReader(open(table))]
    seen = [cells_seen(f"{folder}/{name}.tif") for name in names]
    every, index = numpy.unique(numpy.concatenate(seen), return_inverse=True)
    ends = numpy.cumsum([len(s) for s in seen])
    seen = numpy.split(index, ends[:-1])
    open_cells = numpy.ones(len(every), bool)
    brute = []
    chosen = [(row["id"], int(float(row["gain"]))) for row in csv.DictReader(open(sites))]
    for _ in chosen:
        gains = [int(open_cells[s].sum()) for s in seen]
        best = int(numpy.argmax(gains))  # the first of several
        brute.append((names[best], gains[best]))
        open_cells[seen[best]] = False
    for a, b in zip(brute, chosen):
        print(f"  brute force {a[0]:>5} +{a[1]:<7} itin site {b[0]:>5} +{b[1]}")
    print("  the same choice" if brute == chosen else "  DIFFERENT choices")
    return 0 if brute == chosen else 1


if __name__ == "__main__":
    if sys.argv[1] == "candidates":
        candidates()
    else:
        sys.exit(compare(*sys.argv[2:5]))
