#!/usr/bin/python3
"""A town of Delft's real footprints, repeated with offsets, and places for cameras in its streets.

    town.py footprints DATA COLUMNS ROWS    as GeoJSON: each with its height above the ground, from the east of x = 0
    town.py places DATA COLUMNS ROWS COUNT  as CSV: so many positions that lie in no building, always the same ones

DATA is the folder ahn3-bgt-delft; of COLUMNS x ROWS copies each has 160 buildings. With 1 x 1 they lie where they are.
"""
import json
import sys

from osgeo import ogr

ogr.UseExceptions()
GAP = 12  # metres between copies


def heights(data):
    objects = json.load(open(f"{data}/output/testarea.json"))["CityObjects"].values()
    return {
        o["attributes"]["lokaalid"]: o["attributes"]["measuredHeight"] - o["attributes"]["min-height-surface"]
        for o in objects
        if o["type"] == "Building"
    }


def copies(data, columns, rows):
    """Returns the footprints with their heights, and their bounds (west, east, south, north)."""
    of_building = heights(data)
    dataset = ogr.Open(f"{data}/bgt/bgt_pand.sqlite")
    layer = dataset.GetLayer(0)
    west, east, south, north = layer.GetExtent()
    result = []
    for feature in layer:
        shape = ogr.ForceToMultiPolygon(feature.GetGeometryRef().GetLinearGeometry())
        for rings in json.loads(shape.ExportToJson())["coordinates"]:
            for row in range(rows):
                for column in range(columns):
                    dx, dy = column * (east - west + GAP), row * (north - south + GAP)
                    if columns * rows > 1:
                        dx, dy = dx - west + GAP, dy - south + GAP
                    moved = [[[round(p[0] + dx, 3), round(p[1] + dy, 3)] for p in ring] for ring in rings]
                    result.append((moved, round(of_building[feature["lokaalid"]], 2)))
    places = [p for rings, _ in result for p in rings[0]]
    x, y = [p[0] for p in places], [p[1] for p in places]
    return result, (min(x), max(x), min(y), max(y))


def footprints(data, columns, rows):
    features = [
        {"type": "Feature", "properties": {"h": height}, "geometry": {"type": "Polygon", "coordinates": rings}}
        for rings, height in copies(data, columns, rows)[0]
    ]
    print(json.dumps({"type": "FeatureCollection", "features": features}))


def places(data, columns, rows, count):
    buildings, (west, east, south, north) = copies(data, columns, rows)
    shapes = [ogr.CreateGeometryFromJson(json.dumps({"type": "Polygon", "coordinates": b[0]})) for b in buildings]
    envelopes = [shape.GetEnvelope() for shape in shapes]
    state, found = 12345, 0
    print("name,x,y")
    while found < count:
        place = []
        for low, high in ((west, east), (south, north)):
            state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
            place.append(round(low + (state >> 33) / 2**31 * (high - low), 1))
        point = ogr.Geometry(ogr.wkbPoint)
        point.AddPoint_2D(*place)
        near = point.Buffer(1)
        if any(
            e[0] < place[0] + 1 and e[1] > place[0] - 1 and e[2] < place[1] + 1 and e[3] > place[1] - 1
            and shape.Intersects(near)
            for shape, e in zip(shapes, envelopes)
        ):
            continue
        print(f"p{found},{place[0]},{place[1]}")
        found += 1


if __name__ == "__main__":
    {"footprints": footprints, "places": places}[sys.argv[1]](sys.argv[2], *map(int, sys.argv[3:]))
