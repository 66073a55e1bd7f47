#!/usr/bin/python3
"""Premises by brute force, which `itin premises` must equal: places are found on the triangles that `itin tin` writes,
from the outlines in the file that was imported, and `itin los` judges every height of every place for every mast.

    tests/fuzz/premises.py STORE OUTLINES MASTS [--every N] [--radius R] [OPTION...]

with build/test/bin/itin, or ITIN_PROGRAM; needs python3-numpy, and python3-gdal for outlines that are not CityJSON.
OUTLINES are what the store's one theme of buildings was imported from, --crs their CRS where they name none. MASTS is a table with x and y, and maybe name
and height. Every N-th building is judged (default: 1). Other options go to `itin premises`: --spacing, --storey,
--reveal, --pole, --frequency, --fresnel, --effective-earth. Prints how many lines and rows were compared, and ends
with status 1 where any differs.
"""
import argparse
import csv
import json
import math
import os
import sqlite3
import subprocess
import sys
import tempfile

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ITIN = os.environ.get("ITIN_PROGRAM", ROOT + "/build/test/bin/itin")
LEAST_WALL, BEHIND = 2.5, 0.1  # metres; walls reach their height 0.05 m within the outline
MOST_SHOWN = 20


def itin(*arguments):
    return subprocess.run([ITIN, *map(str, arguments), "--quiet"], check=True, capture_output=True, text=True).stdout


def rounded(value):
    """To whole millimetres, halves away from zero."""
    return math.copysign(math.floor(abs(value) * 1000 + 0.5) / 1000, value)


class Surface:
    """Triangles of a PLY file, which are found by squares of a grid."""

    def __init__(self, path):
        with open(path, "rb") as file:
            sizes, themed = {}, False
            for line in iter(lambda: file.readline().strip(), b"end_header"):
                words = line.split()
                if words[0] == b"element":
                    element = words[1]
                    sizes[element] = int(words[2])
                elif words[0] == b"property" and element == b"face" and words[-1] == b"theme":
                    themed = True
            vertex = np.dtype([("p", "<f8", 3), ("id", "<u4", 2), ("source", "<u2")])
            face = np.dtype([("n", "u1"), ("v", "<i4", 3)] + ([("theme", "<u2")] if themed else []))
            points = np.fromfile(file, vertex, sizes[b"vertex"])["p"]
            faces = np.fromfile(file, face, sizes[b"face"])
        self.corners = points[faces["v"]]
        self.themes = faces["theme"] if themed else np.zeros(len(faces), np.uint16)
        self.low = points[:, :2].min(axis=0)
        extent = points[:, :2].max(axis=0) - self.low
        self.side = max(1e-9, math.sqrt(extent[0] * extent[1] / len(faces)))
        self.columns = int(extent[0] / self.side) + 1
        low, high = (self.square(limit(self.corners[:, :, :2], axis=1)) for limit in (np.min, np.max))
        wide, tall = (high - low + 1).T
        owner = np.repeat(np.arange(len(faces)), wide * tall)
        at = np.arange(len(owner)) - np.repeat(np.cumsum(wide * tall) - wide * tall, wide * tall)
        column, row = low[owner, 0] + at % wide[owner], low[owner, 1] + at // wide[owner]
        key = row * self.columns + column
        order = np.argsort(key, kind="stable")
        self.keys, self.owners = key[order], owner[order]

    def square(self, places):
        return np.floor((places - self.low) / self.side).astype(np.int64)

    def under(self, places):
        """Returns the heights and the themes under places; NaN where there is no triangle."""
        places = np.asarray(places, float).reshape(-1, 2)
        column, row = self.square(places).T
        key = np.where((column >= 0) & (column < self.columns) & (row >= 0), row * self.columns + column, -1)
        first, last = np.searchsorted(self.keys, key, "left"), np.searchsorted(self.keys, key, "right")
        asked = np.repeat(np.arange(len(places)), last - first)
        at = np.arange(len(asked)) - np.repeat(np.cumsum(last - first) - (last - first), last - first)
        triangle = self.owners[first[asked] + at]
        a, b, c = (self.corners[triangle, i] for i in range(3))
        p = places[asked]
        cross = lambda u, v: u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        area = cross(b[:, :2] - a[:, :2], c[:, :2] - a[:, :2])
        with np.errstate(divide="ignore", invalid="ignore"):
            wb, wc = cross(p - a[:, :2], c[:, :2] - a[:, :2]) / area, cross(b[:, :2] - a[:, :2], p - a[:, :2]) / area
        wa = 1 - wb - wc
        inside = np.minimum(np.minimum(wa, wb), wc)
        height = wa * a[:, 2] + wb * b[:, 2] + wc * c[:, 2]
        order = np.lexsort((inside, asked))  # of each place the triangle that holds it best comes last
        heights, themes = np.full(len(places), np.nan), np.zeros(len(places), np.uint16)
        held = order[inside[order] > -1e-9]
        heights[asked[held]], themes[asked[held]] = height[held], self.themes[triangle[held]]
        return heights, themes


def outlines_of_city_model(path):
    """The outlines of the tops of the buildings: edges that have a top on one side alone, from the first vertex on."""
    model = json.load(open(path))
    vertices = model["vertices"]
    for identifier, city_object in model["CityObjects"].items():
        if city_object["type"] != "Building":
            continue
        edges = set()
        for shell in city_object["geometry"][0]["boundaries"]:
            for (ring,) in shell:
                a, b, c = (np.array(vertices[v]) for v in ring)
                normal = np.cross(b - a, c - a)
                if normal[2] <= 0.01 * np.linalg.norm(normal):
                    continue
                for edge in zip(ring, ring[1:] + ring[:1]):
                    edges.discard(edge[::-1]) if edge[::-1] in edges else edges.add(edge)
        rings = []
        while edges:
            edge, ring = min(edges), []
            while edge:
                edges.remove(edge)
                ring.append(tuple(vertices[edge[0]][:2]))
                edge = min((e for e in edges if e[0] == edge[1]), default=None)
            rings.append(ring)
        yield identifier, rings


def outlines_of_layer(path, crs, crs_of_store):
    """The rings of each feature of a vector file; `crs` is that of the file where it does not say so itself."""
    from osgeo import ogr, osr

    ogr.UseExceptions()
    dataset = ogr.Open(path)
    layer = dataset.GetLayer(0)
    systems = [osr.SpatialReference(), osr.SpatialReference()]
    for system, text in zip(systems, (crs or layer.GetSpatialRef().ExportToWkt(), crs_of_store)):
        system.SetFromUserInput(text)
        system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    turn = osr.CoordinateTransformation(*systems)
    for number, feature in enumerate(layer):
        shape = ogr.ForceToMultiPolygon(feature.GetGeometryRef())
        if not systems[0].IsSame(systems[1]):
            shape.Transform(turn)
        polygons = json.loads(shape.ExportToJson(["COORDINATE_PRECISION=15"]))["coordinates"]
        yield str(number), [[p[:2] for p in ring] for polygon in polygons for ring in polygon]


def closed(ring):
    return ring if ring[0] == ring[-1] else ring + [ring[0]]


def holds(rings, x, y):
    """The even-odd rule."""
    odd = False
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, ring[1:]):
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                odd = not odd
    return odd


class Building:
    def __init__(self, identifier, rings):
        self.id, self.rings = identifier, [closed(ring) for ring in rings]
        xs, ys = zip(*(p for ring in self.rings for p in ring))
        self.box = min(xs), min(ys), max(xs), max(ys)
        self.walls, self.roof = [], []  # (x, y, ground, least, most); (x, y, roof)

    def steps(self, spacing):
        """Yields the middles of stretches and the direction of the outline there."""
        for ring in self.rings:
            sides = [(a, b, math.dist(a, b)) for a, b in zip(ring, ring[1:]) if a != b]
            length = math.fsum(side for _, _, side in sides)
            if not length > 0:
                continue
            count = max(1, math.floor(length / spacing + 0.5))
            for i in range(count):
                left = (i + 0.5) * length / count
                for (ax, ay), (bx, by), side in sides:
                    if left < side:
                        break
                    left -= side
                u, v = (bx - ax) / side, (by - ay) / side
                yield ax + left * u, ay + left * v, u, v

    def find_places(self, options, surface, ground, theme):
        tried = []
        for x, y, u, v in self.steps(options.spacing):
            sides = []
            for side in (1, -1):
                before = rounded(x - side * options.reveal * v), rounded(y + side * options.reveal * u)
                behind = x + side * BEHIND * v, y - side * BEHIND * u
                sides.append((before, behind, holds(self.rings, *behind)))
            tried.append(sides)
        flat = [side for sides in tried for side in sides]
        if flat:
            before, behind = [s[0] for s in flat], [s[1] for s in flat]
            tops, grounds = surface.under(behind)[0], ground.under(before)[0]
            own, own_theme = surface.under(before)
            feet = np.where(own_theme == theme, own, grounds)
            for i in range(0, len(flat), 2):
                for k in (i, i + 1):
                    if flat[k][2] and tops[k] - feet[k] > LEAST_WALL:
                        g = grounds[k]
                        self.walls.append((*before[k], g, max(0, feet[k] - g), tops[k] - g))
                        break
        s = options.spacing
        columns = range(math.floor(self.box[0] / s), math.floor(self.box[2] / s) + 1)
        rows = range(math.floor(self.box[1] / s), math.floor(self.box[3] / s) + 1)
        inner = [(rounded((c + 0.5) * s), rounded((r + 0.5) * s)) for r in rows for c in columns]
        inner = [p for p in inner if holds(self.rings, *p)]
        if inner:
            tops, themes = surface.under(inner)
            self.roof = [(*p, top) for p, top, t in zip(inner, tops, themes) if t == theme and top == top]

    def mountings(self, options):
        """Yields all antennas: what they are on, x, y, what that is above, and all heights."""
        for x, y, ground, least, most in self.walls:
            heights = [k * options.storey for k in range(1, int(most / options.storey) + 2)]
            heights = [h for h in heights if least < h <= most] or [math.floor(most * 100) / 100]
            yield "wall", x, y, ground, heights
        for x, y, roof in self.roof:
            yield "roof", x, y, roof, options.poles


class Survey:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        info = json.loads(itin("info", options.store, "--json"))
        (theme,) = [i + 1 for i, t in enumerate(info["themes"]) if t["kind"] == "buildings"]
        for name, themes in (("all", "all"), ("bare", "none")):
            itin("tin", options.store, "--all", "--themes", themes, "-o", f"{folder}/{name}.ply")
        surface, ground = Surface(f"{folder}/all.ply"), Surface(f"{folder}/bare.ply")
        rows = csv.DictReader(open(options.masts))
        self.masts = [(row.get("name") or str(i), float(row["x"]), float(row["y"]), float(row.get("height") or 20))
                      for i, row in enumerate(rows)]
        feet = (outlines_of_city_model(options.outlines) if options.outlines.endswith(".json")
                else outlines_of_layer(options.outlines, options.crs, info["crs"]))
        self.buildings = [Building(*foot) for i, foot in enumerate(feet) if i % options.every == 0]
        for building in self.buildings:
            building.find_places(options, surface, ground, theme)

    def judge(self):
        """Asks `itin los` for all heights of all places within reach of a mast."""
        self.links = []  # (building, mast, on, x, y, base, height, distance, verdict)
        for building in self.buildings:
            for m, (_, mx, my, _) in enumerate(self.masts):
                for on, x, y, base, heights in building.mountings(self.options):
                    distance = math.hypot(x - mx, y - my)
                    if distance <= self.options.radius:
                        self.links += [[building.id, m, on, x, y, base, h, distance, None] for h in heights]
        for on, stands, column in (("wall", "ground", "ground2_m"), ("roof", "surface", "stands_on2_m")):
            asked = [link for link in self.links if link[2] == on]
            if not asked:
                continue
            table, answers = f"{self.folder}/{on}.csv", f"{self.folder}/{on}-seen.csv"
            with open(table, "w") as file:
                file.write("id,x1,y1,h1,x2,y2,h2\n")
                for i, (_, m, _, x, y, _, h, _, _) in enumerate(asked):
                    _, mx, my, mh = self.masts[m]
                    file.write(f"{i},{mx!r},{my!r},{mh!r},{x:.3f},{y:.3f},{h!r}\n")
            radio = self.options.frequency
            itin("los", self.options.store, "--links", table, "--target-on", stands, "-o", answers, *self.earth(),
                 *(["--frequency", radio] if radio else []))
            with open(answers) as file:
                for link, row in zip(asked, csv.DictReader(file), strict=True):
                    # Tables have heights in millimetres.
                    assert abs(float(row[column]) - link[5]) < 0.51e-3, (link, row[column])
                    link[8] = self.verdict(row)

    def verdict(self, row):
        if row["verdict"] != "visible":
            return row["verdict"]
        if self.options.frequency and float(row["fresnel_fraction"]) < self.options.fresnel:
            return "zone cut"
        return "served"

    def earth(self):
        return ["--effective-earth", self.options.effective_earth] if self.options.effective_earth else []

    def told(self):
        """What the program tells: the rows of premises and links by building, and the walls by their antennas."""
        o, out = self.options, f"{self.folder}/out"
        given = [f"--{name}={getattr(o, name)}" for name in ("radius", "spacing", "storey", "reveal", "pole")]
        radio = ["--frequency", o.frequency, "--fresnel", o.fresnel] if o.frequency else []
        itin("premises", o.store, "--masts", o.masts, *given, *radio, *self.earth(), "-o", out)
        read = lambda name: list(csv.DictReader(open(f"{out}/{name}.csv")))
        facades = sqlite3.connect(f"{out}/premises.gpkg").execute(
            "SELECT x, y, service, mast, least_height_m FROM facades").fetchall()
        return read("premises"), read("links"), {(round(x, 3), round(y, 3)): told for x, y, *told in facades}


def least(links, rank):
    return min(links, key=rank, default=None)


def antenna(link):
    """Of a link: what the antenna is on, where, its height, and the distance to the mast."""
    return link and (link[2], round(link[3], 3), round(link[4], 3), link[6], round(link[7], 3))


class Comparison:
    def __init__(self):
        self.compared = self.different = 0

    def expect(self, what, told, found):
        self.compared += 1
        if told == found:
            return
        self.different += 1
        if self.different <= MOST_SHOWN:
            print(f"{what}: told {told}, but found {found}", file=sys.stderr)


def told_antenna(row):
    return row["on"] and (row["on"], *(float(row[k]) for k in ("x", "y", "height_m", "distance_m"))) or None


def best_of_mast(links):
    """The verdict, the least wall height, the least pole, and the antenna that a row of links.csv must have."""
    near = lambda link: (link[6], link[7])
    wall, roof = (least([l for l in links if l[2] == on and l[8] == "served"], near) for on in ("wall", "roof"))
    told = wall or roof
    verdict = "served"
    if not told:
        # The greatest height of each place; of these the highest place, the undecided ones first.
        greatest = {}
        for link in links:
            greatest[tuple(link[2:5])] = link
        open_ones = [l for l in greatest.values() if l[8] == "undecided"]
        told = least(open_ones or greatest.values(), lambda l: (-round(l[5] + l[6], 6), l[7]))
        verdict = told[8]
    return verdict, wall and wall[6], roof and roof[6], antenna(told)


def compare_links(survey, rows, result):
    by_pair = {}
    for link in survey.links:
        by_pair.setdefault((link[0], link[1]), []).append(link)
    names, judged = [name for name, *_ in survey.masts], {building.id for building in survey.buildings}
    told = {}
    for row in rows:
        if row["id"] in judged:
            told[row["id"], names.index(row["mast"])] = row
    result.expect("buildings and masts", sorted(told), sorted(by_pair))
    number = lambda text: float(text) if text else None
    for pair in told.keys() & by_pair.keys():
        row, found = told[pair], best_of_mast(by_pair[pair])
        result.expect(f"building {pair[0]}, mast {names[pair[1]]}",
                      (row["verdict"], number(row["wall_height_m"]), number(row["pole_m"])), found[:3])
        result.expect(f"its antenna, building {pair[0]}, mast {names[pair[1]]}", told_antenna(row), found[3])


def compare_premises(survey, rows, result):
    rank = lambda l: (l[2] == "roof", l[6], l[7])
    told = {row["id"]: row for row in rows}
    for building in survey.buildings:
        served = survey.served.get(building.id, [])
        row = told.get(building.id)
        if row is None:
            result.expect(f"building {building.id}, left out: places", 0, len(building.walls) + len(building.roof))
            continue
        best = least(served, rank)
        if best:
            result.expect(f"building {building.id}", (row["mast"], told_antenna(row)),
                          (survey.masts[best[1]][0], antenna(best)))
        else:
            result.expect(f"building {building.id}", row["verdict"] == "served", False)
        if row["masts_in_reach"] != "0":
            result.expect(f"walls of building {building.id}", int(row["walls"]), len(building.walls))


def compare_walls(survey, facades, result):
    by_wall = {}
    for link in survey.links:
        if link[2] == "wall":
            by_wall.setdefault((link[0], round(link[3], 3), round(link[4], 3)), []).append(link)
    for (building, *place), links in by_wall.items():
        best = least([l for l in links if l[8] == "served"], lambda l: (l[6], l[7]))
        found = [survey.masts[best[1]][0], best[6]] if best else [None, None]
        told = facades.get(tuple(place))
        result.expect(f"wall at {place} of building {building}", told and told[1:], found)


def parsed_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("store", "outlines", "masts"):
        parser.add_argument(name)
    parser.add_argument("--crs")
    parser.add_argument("--every", type=int, default=1)
    for name, default in (("radius", 1000.0), ("spacing", 1.0), ("storey", 3.0), ("reveal", 0.3), ("fresnel", 0.6)):
        parser.add_argument("--" + name, type=float, default=default)
    parser.add_argument("--pole", default="0,5")
    parser.add_argument("--frequency", type=float)
    parser.add_argument("--effective-earth")
    options = parser.parse_args()
    options.poles = sorted({float(h) for h in options.pole.split(",")})
    if options.frequency:
        options.poles = [h for h in options.poles if h > 0]
    return options


def main():
    options = parsed_options()
    with tempfile.TemporaryDirectory() as folder:
        survey = Survey(options, folder)
        survey.judge()
        survey.served = {}
        for link in survey.links:
            if link[8] == "served":
                survey.served.setdefault(link[0], []).append(link)
        premises, links, facades = survey.told()
    result = Comparison()
    compare_premises(survey, premises, result)
    compare_links(survey, links, result)
    compare_walls(survey, facades, result)
    walls, roofs = (sum(len(getattr(b, kind)) for b in survey.buildings) for kind in ("walls", "roof"))
    print(f"{len(survey.buildings)} buildings, {walls} places before walls and {roofs} on roofs, {len(survey.masts)} "
          f"masts: {len(survey.links)} lines of sight; {result.compared} rows compared, {result.different} differ")
    sys.exit(result.different > 0)


if __name__ == "__main__":
    main()
