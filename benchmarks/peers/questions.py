"""The questions of benchmarks/README.md that builds of itin are compared on, by name, with their terrain and stores."""
import re
import shutil
from typing import NamedTuple

from tables import table
from terrain import DEMO, LIDAR, PLACES, WORK, Place, cut, store

OUT = WORK / "older"
CARDIFF_MAST = "310375,183525,30"


def viewshed(*options):
    return ["viewshed", "{store}", *options, "-o", "{out}.tif"]


def seen_from(place, *options):
    """Returns the arguments of a viewshed of the mast at a place, on the cells of the raster that the peers read."""
    return viewshed("--observer", f"{place.x},{place.y},30", "--target-height", "2", "--nodata", "clear", "--radius",
                    str(place.radius or "1e6"), "--like", "{cells}", *options)


def cardiff(*options):
    return viewshed("--observer", CARDIFF_MAST, "--radius", "1e6", "--like", str(DEMO / "cardiff.tif"), *options)


def fractal(*options):
    return viewshed("--observer", "420485,6020485,30", "--target-height", "10", "--radius", "1e6", "--like",
                    str(WORK / "fractal.tif"), *options)


def around(eye, radius, *options):
    return viewshed("--observer", eye, "--target-height", "2", "--nodata", "clear", "--precise", "--cell", "1", "--radius",
                    radius, *options)


def observers(mode):
    return ["viewshed", "{store}", "--radius", "40000", "--cell", "50", "--nodata", "clear", "--observers", "{masts}",
            "--height-field", "h", "--mode", mode, "-o", "{out}.tif"]


LINKS = ["los", "{store}", "--links", "{links}", "-o", "{out}.csv"]
FAR_LINKS = ["los", "{store}", "--links", "{far_links}", "-o", "{out}.csv"]
SECTION = ["profile", "{store}", "--from", "280000,240000", "--to", "286000,248000", "-o", "{out}.csv"]
SITES = ["site", "{store}", "--candidates", "{candidates}", "--name-field", "name", "--mast-height", "20", "--count", "10",
         "--swap", "off", "--memory", "4G", "--radius", "10000", "--cell", "50", "--target-height", "2", "-o", "{out}"]
ZONE = ["ztv", "{store}", "--turbines", "{turbines}", "--radius", "40000", "--cell", "50", "--observer-height", "2", "-o",
        "{out}"]

class Row(NamedTuple):
    """`arguments` come after the program's name; what is in braces is filled in."""
    name: str
    store: str | None
    arguments: list
    place: Place | None = None


ROWS = [
    *(Row(f"{place.name}, exact", place.terrain, seen_from(place, "--precise"), place) for place in PLACES),
    Row("fractal, exact, --memory 150M", "fractal", fractal("--precise", "--memory", "150M")),
    Row("fractal, tolerance 2 m", "fractal", fractal("--tolerance", "2")),
    Row("fractal, tolerance 8 m", "fractal", fractal("--tolerance", "8")),
    Row("fractal, certified at 32 m", "fractal", fractal("--mode", "certified", "--tolerance", "32")),
    Row("Cardiff, tolerance 4 m", "cardiff", cardiff("--tolerance", "4")),
    Row("Cardiff, least heights", "cardiff", cardiff("--mode", "height")),
    Row("Cardiff, angles", "cardiff", cardiff("--mode", "angle")),
    Row("Cardiff, probability", "cardiff", cardiff("--mode", "probability", "--vertical-error", "2")),
    Row("Cardiff, map", "cardiff", cardiff("--image", "{out}.png")),
    Row("lidar TIN, exact", "lidar-all", around("300000,6801500,30", "1000")),
    Row("town, all themes, exact", "town", around("321800,4297750,2", "500", "--themes", "all")),
    Row("seen from everywhere, Cardiff", "cardiff",
        ["visibility", "{store}", "--all", "--cell", "500", "--radius", "5000", "-o", "{out}.tif"]),
    Row("triangles of Cardiff", "cardiff", ["tin", "{store}", "--all", "-o", "{out}.ply"]),
    Row("one section", "wales", SECTION),
    Row("links within 30 km", "wales", LINKS),
    Row("links over all of Wales", "wales", FAR_LINKS),
    Row("links at 6 GHz", "wales", [*LINKS, "--frequency", "6", "--effective-earth", "4/3"]),
    Row("10 sites of 500", "wales", SITES),
    Row("zone of 75 turbines", "wales", ZONE),
    Row("75 observers, count", "wales", observers("count")),
    Row("75 observers, least heights", "wales", observers("height")),
    Row("import, Cardiff", None, ["import", "{out}.itin", str(DEMO / "cardiff.tif")]),
    Row("import, lidar", None, ["import", "{out}.itin", str(LIDAR / "ign_0299_6802.las")]),
]


def clear_results(folder=OUT):
    """Removes what the last command wrote."""
    for left in folder.glob("result*"):
        shutil.rmtree(left) if left.is_dir() else left.unlink()


def command(program, folder, out, row):
    """Returns the program with the row's arguments, over the stores in the folder; None where the terrain is absent."""
    path = row.store and store(row.store, program, folder)
    if row.store and not path:
        return None
    known = {"store": path, "out": out, "cells": row.place and cut(row.place)}
    named = {name for argument in row.arguments for name in re.findall(r"{(\w+)}", argument)}
    values = {name: known[name] if name in known else table(name) for name in named}
    return [program, *(argument.format(**values) for argument in row.arguments)]


def commands(word, *programs):
    """Yields (name, commands) of each question whose name has this word. There is one command for each (program, folder);
    the folder has the program's stores. A question whose terrain is absent is left out, which is printed."""
    OUT.mkdir(parents=True, exist_ok=True)
    for row in ROWS:
        if word not in row.name:
            continue
        made = [command(program, folder, OUT / "result", row) for program, folder in programs]
        if None in made:
            print(f"{row.name:32} left out: no terrain for {row.store}")
        else:
            yield row.name, made
