#!/usr/bin/python3
"""Random stores, asked in several ways that must agree: precise, certified and plain viewsheds, zones of visibility of
turbines, coverage of sites, and sight lines.

    tests/fuzz/agreement.py FIRST_SEED COUNT      with build/dev/bin/itin, or ITIN_PROGRAM; needs gdal-bin python3-gdal

Every seed imports terrain (raster, contours or scattered points) and features in a random order, checks the store, looks
from three places, at turbines, and from the best of three sites. What disagrees, fails or takes ten minutes is printed; its folder in build/fuzz is kept.
"""
import csv
import json
import math
import os
import random
import shutil
import subprocess
import sys

import numpy as np
from osgeo import gdal, osr

gdal.UseExceptions()
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ITIN = os.environ.get("ITIN_PROGRAM", ROOT + "/build/dev/bin/itin")
X0, Y0 = 300000, 200000
VISIBLE, OUTSIDE, CERTAINLY_HIDDEN, CERTAINLY_VISIBLE = 1, 255, 1, 2
ROUNDING_M = 2e-6


class Failure(Exception):
    pass


class Refusal(Exception):
    """The program said plainly that it cannot: that is no fault."""


def itin(*arguments):
    call = [ITIN, *map(str, arguments)]
    done = subprocess.run(call, capture_output=True, text=True, timeout=600, check=False)
    if done.returncode in (1, 2):
        raise Refusal(done.stderr.strip()[-300:])
    if done.returncode != 0:
        raise Failure(f"status {done.returncode}: {' '.join(call)}: {done.stderr.strip()[-600:]}")
    return done.stdout


def fractal(side, rng, relief, roughness):
    """Midpoint displacement, cut to side x side."""
    size = 1 << (side - 1).bit_length()
    z = np.zeros((size + 1, size + 1))
    z[::size, ::size] = rng.normal(0, relief, (2, 2))
    step = size
    while step > 1:
        half, posts = step // 2, z[::step, ::step].copy()
        middle = (posts[:-1, :-1] + posts[1:, :-1] + posts[:-1, 1:] + posts[1:, 1:]) / 4
        z[half::step, half::step] = middle + rng.normal(0, relief, middle.shape)
        z[half::step, ::step] = (posts[:-1] + posts[1:]) / 2 + rng.normal(0, relief, posts[1:].shape)
        z[::step, half::step] = (posts[:, :-1] + posts[:, 1:]) / 2 + rng.normal(0, relief, posts[:, 1:].shape)
        step, relief = half, relief * roughness
    return z[:side, :side]


def write_raster(path, z, north_west, step):
    raster = gdal.GetDriverByName("GTiff").Create(path, z.shape[1], z.shape[0], 1, gdal.GDT_Float32)
    crs = osr.SpatialReference()
    crs.ImportFromEPSG(27700)
    raster.SetProjection(crs.ExportToWkt())
    raster.SetGeoTransform((north_west[0], step, 0, north_west[1], 0, -step))
    raster.GetRasterBand(1).SetNoDataValue(-9999)
    raster.GetRasterBand(1).WriteArray(np.where(np.isnan(z), -9999, z))


def write_features(path, kind, shapes):
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::27700"}}
    features = [{"type": "Feature", "properties": {"h": h}, "geometry": {"type": kind, "coordinates": c}} for c, h in shapes]
    with open(path, "w", encoding="ascii") as file:
        json.dump({"type": "FeatureCollection", "crs": crs, "features": features}, file)


class Trial:
    def __init__(self, seed):
        self.random, self.rng = random.Random(seed), np.random.default_rng(seed)
        self.folder = f"{ROOT}/build/fuzz/{seed}"
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        self.store, self.standing, self.faults = self.path("s.itin"), [], []
        r = self.random
        self.step, self.posts = r.choice([1, 2, 5, 10, 50]), r.choice([33, 50, 80, 120])
        self.side = self.step * self.posts
        self.relief = self.side * r.choice([0, 0.01, 0.05, 0.15])
        self.unit = self.side / r.choice([25, 60, 150])

    def path(self, name):
        return f"{self.folder}/{name}"

    def log(self, *what):
        with open(self.path("log.txt"), "a", encoding="utf-8") as file:
            print(*what, file=file)

    def place(self, margin=0.12):
        within = lambda: self.side * self.random.uniform(margin, 1 - margin)
        return round(X0 + within(), 3), round(Y0 + within(), 3)

    def import_terrain(self):
        r, n = self.random, self.posts
        self.z = np.round(fractal(n, self.rng, self.relief, r.choice([0.45, 0.6])), r.choice([0, 1, 2]))
        if r.random() < 0.35:
            rows, columns = np.mgrid[:n, :n]
            hole = (columns - n * r.random()) ** 2 + (rows - n * r.random()) ** 2 < (n * r.uniform(0.05, 0.25)) ** 2
            self.z[hole] = np.nan
        write_raster(self.path("t.tif"), self.z, (X0, Y0 + self.side), self.step)
        how = r.choice(["raster", "contours", "scattered"])
        self.log(how, "step", self.step, "posts", n, "relief", self.relief)
        if how == "contours" and np.nanmax(self.z) - np.nanmin(self.z) > 2:
            interval = (np.nanmax(self.z) - np.nanmin(self.z)) / 12
            subprocess.run(["gdal_contour", "-q", "-a", "z", "-i", str(interval), self.path("t.tif"), self.path("c.gpkg")],
                           check=True)
            itin("import", self.store, self.path("c.gpkg"), "--kind", "contours", "--z-field", "z", "--quiet")
        elif how == "scattered":
            with open(self.path("p.csv"), "w", encoding="ascii") as file:
                print("x,y,z", file=file)
                for x, y in self.rng.uniform(0, self.side, (n * n // 2, 2)):
                    z = self.z[min(int((self.side - y) / self.step), n - 1), min(int(x / self.step), n - 1)]
                    if not np.isnan(z):
                        print(f"{X0 + x:.3f},{Y0 + y:.3f},{z:.2f}", file=file)
            itin("import", self.store, self.path("p.csv"), "--crs", "EPSG:27700", "--quiet")
        else:
            itin("import", self.store, self.path("t.tif"), "--quiet")

    def rectangle(self):
        r, (x, y), a = self.random, self.place(), self.random.uniform(0, 3)
        w, h = self.unit * r.uniform(0.3, 1.5), self.unit * r.uniform(0.3, 1)
        turned = lambda u, v: (x + u * math.cos(a) - v * math.sin(a), y + u * math.sin(a) + v * math.cos(a))
        return [[turned(-w, -h), turned(w, -h), turned(w, h), turned(-w, h), turned(-w, -h)]]

    def blob(self):
        (x, y), n, size = self.place(0.2), self.random.randint(3, 14), self.unit * self.random.uniform(1, 4)
        radii = [size * self.random.uniform(0.4, 1) for _ in range(n)]
        ring = [(x + q * math.cos(2 * math.pi * i / n), y + q * math.sin(2 * math.pi * i / n)) for i, q in enumerate(radii)]
        return [ring + ring[:1]]

    def line(self, with_heights=False):
        places = [self.place() for _ in range(self.random.randint(2, 6))]
        return [(*p, self.random.uniform(-1, 1) * self.relief) for p in places] if with_heights else places

    def add(self, what):
        r, path = self.random, self.path(what + ".geojson")
        many = range(r.choice([1, 5, 20]))
        self.log("add", what)
        options = ["--quiet"]
        if what == "buildings":
            write_features(path, "Polygon", [(self.rectangle(), r.uniform(2, 20)) for _ in many])
            options += ["--height-field", "h", "--roof", r.choice(["flat", "gabled", "hipped", "skeleton"])]
        elif what == "vegetation":
            write_features(path, "Polygon", [(self.blob(), 0) for _ in many])
            options += ["--height", r.choice([3, 15])]
        elif what == "walls":
            write_features(path, "LineString", [(self.line(), 0) for _ in many])
            options += ["--height", r.choice([1.5, 6]), "--thickness", r.choice([0.3, 1])]
        elif what == "replace":
            path, posts = self.path("replace.tif"), self.posts // 2
            corner = X0 + self.side * r.uniform(0, 0.6), Y0 + self.side * r.uniform(0.4, 1)
            write_raster(path, fractal(posts, self.rng, self.relief + 1, 0.5), corner, self.step / r.choice([1, 2, 3.7]))
            options += r.choice([["--replace"], []])
        else:
            write_features(path, "LineString", [(self.line(what != "roads"), 0) for _ in many])
        try:
            itin("import", self.store, path, *([] if what == "replace" else ["--kind", what]), *options)
        except Refusal as refusal:
            self.log("refused:", refusal)
        else:
            self.standing += [what] if what in ("buildings", "vegetation", "walls") else []

    def raster(self, name):
        return gdal.Open(self.path(name)).ReadAsArray()

    def shared_options(self):
        r = self.random
        themes = r.choice(["none", "all"] + self.standing)
        return ["--themes", themes, "--nodata", r.choice(["clear", "block"]), "--refraction", r.choice([0, 0.13, 0.25])]

    def cell_size(self):
        return f"{max(self.side / self.random.choice([60, 110]), 0.05):.4f}"

    def drawn(self, cells, count):
        return cells[self.rng.choice(len(cells), min(count, len(cells)), replace=False)]

    def look(self):
        r = self.random
        bounds = json.loads(itin("info", self.store, "--json"))["bounds"]
        eye = round(r.uniform(bounds["xmin"], bounds["xmax"]), 3), round(r.uniform(bounds["ymin"], bounds["ymax"]), 3)
        height, target = r.choice([0, 1.5, 2, 30]), r.choice([0, 1.5, 10])
        shared = self.shared_options()
        shared += ["--target-on", r.choice(["ground", "surface"]), "--observer-on", r.choice(["ground", "surface"])]
        call = ["viewshed", self.store, "--observer", f"{eye[0]},{eye[1]},{height}", "--target-height", target,
                "--cell", self.cell_size(), "--overwrite", "--quiet", *shared]
        self.log(*call)
        itin(*call, "--precise", "--memory", r.choice(["4M", "20M", "1G"]), "-o", self.path("precise.tif"))
        itin(*call, "--tolerance", 0, "-o", self.path("plain.tif"))
        itin(*call, "--mode", "certified", "--tolerance", r.choice([0, 0.5, 2, 8]), "-o", self.path("certified.tif"))
        precise, plain, certified = map(self.raster, ("precise.tif", "plain.tif", "certified.tif"))
        wrong = (certified == CERTAINLY_VISIBLE) & (precise != VISIBLE) | (certified == CERTAINLY_HIDDEN) & (precise == VISIBLE)
        if wrong.any():
            self.faults.append(f"certified: {wrong.sum()} cells")
        cells = np.argwhere(precise != OUTSIDE)
        if len(cells) == 0:
            return
        if (precise != plain).any():
            self.faults.append(f"plain: {(precise != plain).sum()} cells")
        self.look_for_heights(call, target, precise)
        cells = self.drawn(cells, 250)
        targets = self.centres("precise.tif", cells)
        for (row, column), (sees, clearance) in zip(cells, self.lines([(eye, height, t, target) for t in targets], shared)):
            if (precise[row, column] == VISIBLE) != sees:
                self.faults.append(f"cell {row},{column}: precise {precise[row, column]}, los clears by {clearance}")

    def look_for_heights(self, call, target, precise):
        """The least height seen must say what is seen at the target's, however little memory it is found in."""
        heights = []
        for name, options in ("plain-heights.tif", ["--tolerance", 0]), ("heights.tif", ["--precise", "--memory", "4M"]):
            try:
                itin(*call, "--mode", "height", *options, "-o", self.path(name))
            except Refusal as refusal:
                self.log("refused:", refusal)
            else:
                heights.append(self.raster(name))
        for least in heights:
            wrong = (precise != OUTSIDE) & (abs(least - target) > 1e-4 * (1 + target)) & ((least < target) != (precise == VISIBLE))
            if wrong.any():
                self.faults.append(f"heights: {wrong.sum()} cells")
        if not np.allclose(heights[0], heights[-1], 1e-6, 1e-5, equal_nan=True):
            self.faults.append("heights differ with the memory")

    def look_at_turbines(self):
        r = self.random
        turbines = [(self.place(0.05), r.choice([2, 30, 120])) for _ in range(r.choice([1, 3, 40]))]
        self.write_sites("turbines.csv", "x,y,tip_height", [(*place, tip) for place, tip in turbines])
        radius, shared = self.side * r.choice([0.2, 0.6, 2]), self.shared_options()
        call = ["ztv", self.store, "--turbines", self.path("turbines.csv"), "--radius", radius, "--cell", self.cell_size(),
                "--observer-height", 2, "--memory", r.choice(["5M", "20M", "2G"]), "-o", self.path("ztv"), "--overwrite",
                "--quiet", *shared]
        self.log(*call)
        itin(*call)
        name = "ztv/turbines.tif" if shared[1] == "none" else "ztv/turbines-screened.tif"
        seen, counted = np.atleast_3d(self.raster(name).T).T, self.raster("ztv/tip-count.tif")
        cells = self.drawn(np.argwhere(counted != 65535), 60)
        lines, where = [], []
        for (row, column), eye in zip(cells, self.centres(name, cells)):
            for k in r.sample(range(len(turbines)), min(len(turbines), 4)):
                if math.dist(eye, turbines[k][0]) < radius:
                    lines.append((eye, 2, *turbines[k]))
                    where.append((row, column, k))
        for (row, column, k), line in zip(where, self.lines(lines, shared)):
            if line is None:  # a turbine without ground
                continue
            sees, clearance = line
            if bool(seen[k // 32, row, column] >> k % 32 & 1) != sees and abs(clearance) > ROUNDING_M:
                self.faults.append(f"cell {row},{column}: ztv sees turbine {k}: {not sees}, los clears by {clearance}")

    def choose_site(self):
        r = self.random
        self.write_sites("candidates.csv", "name,x,y", [(f"c{i}", *self.place(0.05)) for i in range(3)])
        shared = [*self.shared_options(), "--target-on", r.choice(["ground", "surface"])]
        looks = ["--target-height", r.choice([0, 1.5, 10]), "--radius", self.side * r.choice([0.2, 0.6]), "--overwrite",
                 "--quiet", *shared]
        call = ["site", self.store, "--candidates", self.path("candidates.csv"), "--name-field", "name", "--mast-height", 15,
                "--count", 1, "--cell", self.cell_size(), "--memory", r.choice(["5M", "1G"]), *looks, "-o", self.path("site")]
        call += r.choice([[], ["--tolerance", r.choice([0, 2])]])
        self.log(*call)
        itin(*call)
        with open(self.path("site/sites.csv"), encoding="utf-8") as file:
            site = next(csv.DictReader(file))
        itin("viewshed", self.store, "--precise", "--observer", f"{site['x']},{site['y']},15", "--like",
             self.path("site/coverage.tif"), *looks, "-o", self.path("of-site.tif"))
        served, precise = self.raster("site/coverage.tif"), self.raster("of-site.tif")
        wrong = np.count_nonzero((served == VISIBLE) != (precise == VISIBLE))
        if wrong:
            self.faults.append(f"site: {wrong} cells are served otherwise than precise")

    def write_sites(self, name, header, rows):
        with open(self.path(name), "w", encoding="ascii") as file:
            print(header, *(",".join(map(str, row)) for row in rows), sep="\n",
                  file=file)

    def centres(self, name, cells):
        west, size, _, north, _, down = gdal.Open(self.path(name)).GetGeoTransform()
        return [(west + (column + 0.5) * size, north + (row + 0.5) * down) for row, column in cells]

    def lines(self, ends, options):
        """Of each (place, height, place, height): whether it is a line of sight, and its clearance in metres."""
        with open(self.path("links.csv"), "w", encoding="ascii") as file:
            print("id,x1,y1,h1,x2,y2,h2", file=file)
            for i, (a, up, b, over) in enumerate(ends):
                print(f"{i},{a[0]!r},{a[1]!r},{up},{b[0]!r},{b[1]!r},{over}", file=file)
        try:
            itin("los", self.store, "--links", self.path("links.csv"), "-o", self.path("los.csv"), "--overwrite", "--quiet",
                 *options)
        except Refusal as refusal:  # some ends without ground, which the table names
            self.log("refused:", refusal)
        with open(self.path("los.csv"), encoding="utf-8") as file:
            links = {int(link["id"]): link for link in csv.DictReader(file)}
        return [(link["verdict"] == "visible", float(link["clearance_m"] or "nan")) if link["verdict"] else None
                for link in (links[i] for i in range(len(ends)))]

    def run(self):
        self.import_terrain()
        kinds = ["buildings", "walls", "vegetation", "breaklines", "roads", "water", "replace"]
        for what in self.random.sample(kinds, self.random.randint(0, 5)):
            self.add(what)
        itin("check", self.store, "--quiet")
        for ask in [self.look] * 3 + [self.look_at_turbines, self.choose_site]:
            try:
                ask()
            except Refusal as refusal:
                self.log("refused:", refusal)


def main():
    first, count = int(sys.argv[1]), int(sys.argv[2])
    failed = 0
    for seed in range(first, first + count):
        trial = Trial(seed)
        try:
            trial.run()
        except (Failure, Refusal, subprocess.TimeoutExpired) as error:
            trial.faults.append(str(error))
        if trial.faults:
            failed += 1
            print(f"seed {seed}: {len(trial.faults)} faults, the first: {'; '.join(trial.faults[:3])}", flush=True)
        else:
            shutil.rmtree(trial.folder)
    print(f"{failed} of {count} seeds failed")
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
