#!/usr/bin/python3
"""Random stores, asked in several ways that must agree: precise, certified and plain viewsheds, zones of visibility of
turbines, coverage of sites, and sight lines.

    tests/fuzz/agreement.py FIRST_SEED COUNT      with build/test/bin/itin, or ITIN_PROGRAM; needs gdal-bin python3-gdal

Every seed imports terrain (raster, contours or scattered points) and features in a random order, checks the store, looks
from three places, by radio from two, at turbines, and from the best of three sites, and in every mode from cell centres,
posts, corners of what stands and the data's edge, or a little beside them. Tables have separators, decimal commas,
quotes and encodings of many kinds. What disagrees, fails or takes ten minutes is printed; its folder in build/fuzz is
kept.
"""
import csv
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys

import numpy as np
from osgeo import gdal, osr

gdal.UseExceptions()
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ITIN = os.environ.get("ITIN_PROGRAM", ROOT + "/build/test/bin/itin")
X0, Y0 = 300000, 200000
HIDDEN, VISIBLE, UNDECIDED, ZONE_CUT, OUTSIDE = 0, 1, 2, 3, 255
VERDICTS = {"hidden": HIDDEN, "visible": VISIBLE, "undecided": UNDECIDED}
COUNT_OUTSIDE, NO_BLOCKER = 65535, 0xffffffff
ROUNDING_M = 2e-6
GRID_STEP_M = 0.01
SAME_PLACE_M = 0.999 * GRID_STEP_M
STEPS_BESIDE = [0, 0, 1e-9, 1e-5, 0.4, 0.9, 1.1, 3]


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
        self.store, self.raised, self.faults, self.corners = self.path("s.itin"), [], [], []
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

    def beside(self, place):
        """Nearer than a step of the store's grid, or a little more."""
        distance, turn = GRID_STEP_M * self.random.choice(STEPS_BESIDE), self.random.uniform(0, 2 * math.pi)
        return place[0] + distance * math.sin(turn), place[1] + distance * math.cos(turn)

    def centred(self, place, cell):
        """Beside the centre of the cell that holds a place."""
        return self.beside(tuple((math.floor(v / float(cell)) + 0.5) * float(cell) for v in place))

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

    def rectangle(self, about=None):
        r, (x, y), a = self.random, about or self.place(), self.random.uniform(0, 3)
        w, h = self.unit * r.uniform(0.3, 1.5), self.unit * r.uniform(0.3, 1)
        turned = lambda u, v: (x + u * math.cos(a) - v * math.sin(a), y + u * math.sin(a) + v * math.cos(a))
        return [[turned(-w, -h), turned(w, -h), turned(w, h), turned(-w, h), turned(-w, -h)]]

    def parts(self):
        """Rectangles that cross, or lie within each other; one may come twice."""
        place = self.place(0.2)
        parts = [self.rectangle(place) for _ in range(self.random.randint(1, 3))]
        return parts + parts[: self.random.randint(0, 1)]

    def blob(self):
        (x, y), n, size = self.place(0.2), self.random.randint(3, 14), self.unit * self.random.uniform(1, 4)
        radii = [size * self.random.uniform(0.4, 1) for _ in range(n)]
        ring = [(x + q * math.cos(2 * math.pi * i / n), y + q * math.sin(2 * math.pi * i / n)) for i, q in enumerate(radii)]
        return [ring + ring[:1]]

    def line(self, with_heights=False):
        places = [self.place() for _ in range(self.random.randint(2, 6))]
        if with_heights and self.random.random() < 0.5:  # through posts of the raster
            post = lambda v, low: low + (math.floor((v - low) / self.step) + 0.5) * self.step
            places = [(post(x, X0), post(y, Y0)) for x, y in places]
        return [(*p, self.random.uniform(-1, 1) * self.relief) for p in places] if with_heights else places

    def add(self, what):
        r, path = self.random, self.path(what + ".geojson")
        many = range(r.choice([1, 5, 20]))
        self.log("add", what)
        options = ["--quiet"]
        if what == "buildings":
            kind, shape = r.choice([("Polygon", self.rectangle), ("MultiPolygon", self.parts)])
            write_features(path, kind, [(shape(), r.uniform(2, 20)) for _ in many])
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
        self.corners += self.corners_in(path)
        try:
            itin("import", self.store, path, *([] if what == "replace" else ["--kind", what]), *options)
        except Refusal as refusal:
            self.log("refused:", refusal)
        else:
            self.raised += [what] if what in ("buildings", "vegetation", "walls") else []

    def corners_in(self, path):
        """Of walls, houses and other lines the corners and the middles between them."""
        if not path.endswith("json"):
            return []
        with open(path, encoding="ascii") as file:
            shapes = [feature["geometry"]["coordinates"] for feature in json.load(file)["features"]]
        rings = lambda shape: [shape] if not isinstance(shape[0][0], list) else [line for part in shape for line in rings(part)]
        lines = [line for shape in shapes for line in rings(shape)]
        pairs = [(a, b) for line in lines for a, b in zip(line, line[1:])]
        return [(a[0], a[1]) for a, _ in pairs] + [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in pairs]

    def raster(self, name):
        return gdal.Open(self.path(name)).ReadAsArray()

    def shared_options(self):
        r = self.random
        themes = r.choice(["none", "all"] + self.raised)
        return ["--themes", themes, "--nodata", r.choice(["unknown", "clear", "block"]), "--refraction", r.choice([0, 0.13, 0.25])]

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
        wrong = (certified != UNDECIDED) & (certified != precise)
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
        for (row, column), (verdict, clearance) in zip(cells, self.lines([(eye, height, t, target) for t in targets], shared)):
            if precise[row, column] != verdict:
                self.faults.append(f"cell {row},{column}: precise {precise[row, column]}, los clears by {clearance}")

    def look_at_radio(self):
        """Zones and losses of cells must be those of the lines to them, however little memory they are found in."""
        r = self.random
        bounds = json.loads(itin("info", self.store, "--json"))["bounds"]
        eye = round(r.uniform(bounds["xmin"], bounds["xmax"]), 3), round(r.uniform(bounds["ymin"], bounds["ymax"]), 3)
        height, target, fraction = r.choice([1.5, 6, 30]), r.choice([1.5, 10]), r.choice([0.3, 0.6, 1])
        shared = self.shared_options()
        shared += ["--target-on", r.choice(["ground", "surface"]), "--observer-on", r.choice(["ground", "surface"])]
        shared += ["--frequency", r.choice([0.15, 0.9, 6])]
        call = ["viewshed", self.store, "--observer", f"{eye[0]},{eye[1]},{height}", "--target-height", target,
                "--cell", self.cell_size(), "--overwrite", "--quiet", *shared]
        self.log(*call)
        itin(*call, "--fresnel", fraction, "--memory", r.choice(["8M", "20M", "1G"]), "-o", self.path("zones.tif"))
        itin(*call, "--loss", "--memory", r.choice(["20M", "1G"]), "-o", self.path("losses.tif"))
        zones, (losses, in_free_space) = self.raster("zones.tif"), self.raster("losses.tif")
        cells = np.argwhere(zones != OUTSIDE)
        if len(cells) == 0:
            return
        cells = self.drawn(cells, 250)
        targets = self.centres("zones.tif", cells)
        needs_ground = shared[shared.index("--nodata") + 1] != "clear"
        for (row, column), link in zip(cells, self.links([(eye, height, t, target) for t in targets], shared)):
            clear = float(link["fresnel_fraction"] or "inf")
            expected = VERDICTS.get(link["verdict"])
            if expected == VISIBLE and clear < fraction:
                expected = ZONE_CUT
            if zones[row, column] != expected and abs(clear - fraction) > 1e-4:
                self.faults.append(f"zone of cell {row},{column}: {zones[row, column]}, los {link['verdict']} {clear}")
            known = link["ld_db"] and not (needs_ground and float(link["gap_m"]) > 0)
            said = [float(link[name]) if known else math.nan for name in ("ld_db", "free_space_db")]
            if not np.allclose([losses[row, column], in_free_space[row, column]], said, 0, 0.006, equal_nan=True):
                self.faults.append(f"loss of cell {row},{column}: {losses[row, column]}, los {link['ld_db']}")

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

    def place_of_a_kind(self):
        """Anywhere, on a post, on the data's edge, or on what has been added."""
        r, bounds = self.random, json.loads(itin("info", self.store, "--json"))["bounds"]
        post = lambda: (r.randrange(self.posts) + 0.5) * self.step
        kind = r.choice(["anywhere", "post", "edge", "rim", "feature", "feature"])
        if kind == "edge":
            return r.choice([bounds["xmin"], bounds["xmax"]]), Y0 + post()
        if kind == "rim" and np.isnan(self.z).any():
            empty = np.isnan(self.z)
            rows, columns = np.nonzero(~empty & (np.roll(empty, 1, 0) | np.roll(empty, 1, 1)))
            if len(rows):
                i = r.randrange(len(rows))
                return X0 + (columns[i] + 0.5) * self.step, Y0 + self.side - (rows[i] + 0.5) * self.step
        if kind == "feature" and self.corners:
            return r.choice(self.corners)
        return (X0 + post(), Y0 + post()) if kind == "post" else self.place()

    def refine(self):
        """In every mode on a few cells about the observer, who stands on the middle one's centre or a little beside."""
        r, place = self.random, self.place_of_a_kind()
        eye, height, target = self.beside(place), r.choice([0, 1.5, 2, 30]), r.choice([0, 0, 1.5, 10])
        cell, side = r.choice([GRID_STEP_M, 0.13, 3.37, 7.93, self.step]), 15
        north_west = place[0] - side / 2 * cell, place[1] + side / 2 * cell
        write_raster(self.path("like.tif"), np.zeros((side, side)), north_west, cell)
        ends = {"--target-on": r.choice(["ground", "surface"]), "--observer-on": r.choice(["ground", "surface"])}
        shared = self.shared_options()
        call = ["viewshed", self.store, "--observer", f"{eye[0]!r},{eye[1]!r},{height}", "--target-height", target, "--like",
                self.path("like.tif"), "--overwrite", "--quiet", *shared, *sum(ends.items(), ())]
        self.log(*call)

        def seen(name, *options):
            itin(*call, *options, "-o", self.path(name))
            return self.raster(name)

        precise = seen("precise.tif", "--precise", "--memory", r.choice(["4M", "20M", "1G"]))
        visible, hidden, outside = precise == VISIBLE, precise == HIDDEN, precise == OUTSIDE
        certified = seen("certified.tif", "--mode", "certified", "--tolerance", r.choice([0, 0.5, 2, 8]))
        angle, height_seen = seen("angle.tif", "--mode", "angle"), seen("height.tif", "--mode", "height")
        (distance, number), blocker = seen("nearest.tif", "--mode", "nearest"), seen("blocker.tif", "--mode", "blocker")[0]
        probability, as_is = seen("probability.tif", "--mode", "probability", "--vertical-error", 0.001)
        count, which = seen("count.tif", "--mode", "count"), seen("which.tif", "--mode", "which")
        lower, near = height_seen < target, abs(height_seen - target) <= 1e-4 * (1 + target)
        unseen = np.isnan(height_seen)
        agree = {
            "plain": seen("plain.tif", "--tolerance", 0) == precise,
            "certified": (certified == UNDECIDED) | (certified == precise),
            "count": count == np.where(outside, COUNT_OUTSIDE, visible), "which": which == visible,
            "angle": np.isfinite(angle) == visible, "nearest": np.isfinite(distance) == visible,
            "number": (number == 1) == visible, "blocker": (blocker != NO_BLOCKER) == hidden,
            "probability": np.isfinite(probability) == (visible | hidden),
            "probability's": np.where(np.isnan(as_is), OUTSIDE, as_is) == precise,
            "height": ~np.isinf(height_seen) & (near | np.where(unseen, ~visible, lower == visible)),
        }
        own = np.array([[math.dist(eye, at) < SAME_PLACE_M - 1e-7 for at in row] for row in self.centre_rows("like.tif", side)])
        own &= ~outside
        agree["own place"] = ~own | visible & (height_seen == 0) & (distance == 0) & (probability == 1)
        agree["own angle"] = ~own | (angle == 0) | (abs(angle) == 90)
        self.faults += [f"{name} about {place}: {(~a).sum()} cells" for name, a in agree.items() if not a.all()]
        cells = self.drawn(np.argwhere(~outside), 120)
        targets = self.centres("like.tif", cells)
        there = self.lines([(eye, height, t, target) for t in targets], [*shared, *sum(ends.items(), ())])
        back = self.lines([(t, target, eye, height) for t in targets],
                          [*shared, "--target-on", ends["--observer-on"], "--observer-on", ends["--target-on"]])
        for at, line, mirrored in zip(cells, there, back):
            if not line[0] == mirrored[0] == precise[tuple(at)]:
                self.faults.append(f"cell {at} about {place}: precise {precise[tuple(at)]}, los {line}, back {mirrored}")

    def look_at_turbines(self):
        r = self.random
        cell = self.cell_size()
        turbines = [(self.centred(self.place(0.05), cell) if r.random() < 0.5 else self.place(0.05), r.choice([2, 30, 120]))
                    for _ in range(r.choice([1, 3, 40]))]
        self.write_table("turbines.csv", ["x", "y", "tip_height"], [(*map(float, place), tip) for place, tip in turbines])
        radius, shared = self.side * r.choice([0.2, 0.6, 2]), self.shared_options()
        call = ["ztv", self.store, "--turbines", self.path("turbines.csv"), "--radius", radius, "--cell", cell,
                "--observer-height", 2, "--memory", r.choice(["5M", "20M", "2G"]), "-o", self.path("ztv"), "--overwrite",
                "--quiet", *shared]
        self.log(*call)
        itin(*call)
        name = "ztv/turbines-screened.tif"
        if not os.path.exists(self.path(name)):  # nothing stands
            name = "ztv/turbines.tif"
        seen, counted = np.atleast_3d(self.raster(name).T).T, self.raster("ztv/tip-count.tif")
        cells = self.drawn(np.argwhere(counted != COUNT_OUTSIDE), 60)
        lines, where = [], []
        for (row, column), eye in zip(cells, self.centres(name, cells)):
            for k in r.sample(range(len(turbines)), min(len(turbines), 4)):
                if math.dist(eye, turbines[k][0]) < radius:
                    lines.append((eye, 2, *turbines[k]))
                    where.append((row, column, k))
        for (row, column, k), line in zip(where, self.lines(lines, shared)):
            verdict, clearance = line
            sees = verdict == VISIBLE
            if bool(seen[k // 32, row, column] >> k % 32 & 1) != sees and abs(clearance) > ROUNDING_M:
                self.faults.append(f"cell {row},{column}: ztv sees turbine {k}: {not sees}, los clears by {clearance}")

    def choose_site(self):
        r = self.random
        cell = self.cell_size()
        sites = {self.odd_name(i).replace("\n", " "): self.centred(self.place(0.05), cell) for i in range(3)}
        self.write_table("candidates.csv", ["name", "x", "y"], [(name, *place) for name, place in sites.items()])
        shared = [*self.shared_options(), "--target-on", r.choice(["ground", "surface"])]
        looks = ["--target-height", r.choice([0, 1.5, 10]), "--radius", self.side * r.choice([0.2, 0.6]), "--overwrite",
                 "--quiet", *shared]
        call = ["site", self.store, "--candidates", self.path("candidates.csv"), "--name-field", "name", "--mast-height", 15,
                "--count", 1, "--cell", cell, "--memory", r.choice(["5M", "1G"]), *looks, "-o", self.path("site")]
        call += r.choice([[], ["--tolerance", r.choice([0, 2])]])
        self.log(*call)
        itin(*call)
        with open(self.path("site/sites.csv"), encoding="utf-8", newline="") as file:
            site = next(csv.DictReader(file))
        name = site.get("id", site.get("name"))
        if name not in sites or math.dist(sites[name], (float(site["x"]), float(site["y"]))) > GRID_STEP_M:
            self.faults.append(f"site: no candidate {site} among {sites}")
        itin("viewshed", self.store, "--precise", "--observer", f"{site['x']},{site['y']},15", "--like",
             self.path("site/coverage.tif"), *looks, "-o", self.path("of-site.tif"))
        served, precise = self.raster("site/coverage.tif"), self.raster("of-site.tif")
        wrong = np.count_nonzero((served == VISIBLE) != (precise == VISIBLE))
        if wrong:
            self.faults.append(f"site: {wrong} cells are served otherwise than precise")

    def odd_name(self, number):
        return str(number) + self.random.choice(
            ["", " M\u00fcllers H\u00f6he", ' the "Old" Mast', " Pen-y-Fan, west", " a;b", " Ca\u00f1\u00f3n #5", " two\nlines"])

    def write_table(self, name, header, rows):
        """A table as people have them: separators, decimal commas, quotes, encodings and rows that say nothing."""
        r = self.random
        separator, comma = r.choice([(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", ",")])
        always_quoted, ending = r.random() < 0.2, r.choice(["\n", "\r\n"])

        def cell(value):
            text = value if isinstance(value, str) else re.sub(r"^(-?[1-9]\d{0,2},\d{3})$", r"\g<1>0", repr(value).replace(".", comma))
            quoted = always_quoted or any(mark in text for mark in separator + '"\n')
            return '"' + text.replace('"', '""') + '"' if quoted else text

        lines = [separator.join(map(cell, row)) for row in [header, *rows]]
        nothing = ["", separator * (len(header) - 1), "# no row"]
        for _ in range(r.choice([0, 0, 3])):
            lines.insert(r.randint(0, len(lines)), r.choice(nothing))
        if r.random() < 0.1:
            lines.insert(0, "sep=" + separator)
        with open(self.path(name), "wb") as file:
            file.write((ending.join(lines) + r.choice([ending, ""])).encode(r.choice(["utf-8", "utf-8-sig", "utf-16", "cp1252"])))

    def centre_rows(self, name, side):
        return [self.centres(name, [(row, column) for column in range(side)]) for row in range(side)]

    def centres(self, name, cells):
        west, size, _, north, _, down = gdal.Open(self.path(name)).GetGeoTransform()
        return [(west + (column + 0.5) * size, north + (row + 0.5) * down) for row, column in cells]

    def links(self, ends, options):
        """What is said of each (place, height, place, height), as rows of a table."""
        names = [self.odd_name(i) for i in range(len(ends))]
        self.write_table("links.csv", ["id", "x1", "y1", "h1", "x2", "y2", "h2"],
                         [(name, *map(float, a), up, *map(float, b), over) for name, (a, up, b, over) in zip(names, ends)])
        if os.path.exists(self.path("los.csv")):
            os.remove(self.path("los.csv"))
        try:
            itin("los", self.store, "--links", self.path("links.csv"), "-o", self.path("los.csv"), "--overwrite", "--quiet",
                 *options)
        except Refusal as refusal:  # some ends without ground, which the table names
            if not os.path.exists(self.path("los.csv")):
                raise
            self.log("refused:", refusal)
        with open(self.path("los.csv"), encoding="utf-8", newline="") as file:
            links = {link["id"]: link for link in csv.DictReader(file)}
        return [links[name.replace("\n", " ")] for name in names]

    def lines(self, ends, options):
        """Of each (place, height, place, height): its verdict as rasters have it, none of an error, and its clearance in
        metres."""
        return [(VERDICTS.get(link["verdict"]), float(link["clearance_m"] or "nan")) for link in self.links(ends, options)]

    def run(self):
        self.import_terrain()
        kinds = ["buildings", "walls", "vegetation", "breaklines", "roads", "water", "replace"]
        for what in self.random.sample(kinds, self.random.randint(0, 5)):
            self.add(what)
        itin("check", self.store, "--quiet")
        for ask in [self.look] * 3 + [self.look_at_radio] * 2 + [self.refine] * 3 + [self.look_at_turbines, self.choose_site]:
            try:
                ask()
            except Refusal as refusal:
                self.log("refused:", refusal)
                if ".csv" in str(refusal):  # every table is a right one
                    self.faults.append(str(refusal))


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
