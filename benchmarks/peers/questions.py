"""The questions of benchmarks/README.md that builds of itin are compared on, by name, with their terrain and stores.

Run precise.sh, section.sh and site.sh first: they make the terrain in build/peers.
"""
import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = pathlib.Path(os.environ.get("ITIN_BENCHMARK_DIR", ROOT / "build/peers"))
OUT = WORK / "older"
DEMO = ROOT / "scripts/demo-data"
LIDAR = pathlib.Path(os.environ.get("ITIN_DATA_DIR", ROOT / "../shared/data")) / "derived-las"


def viewshed(*options):
    return ["viewshed", "{store}", *options, "-o", "{out}.tif"]


def exact(eye, *options):
    return viewshed("--observer", eye, "--target-height", "2", "--nodata", "clear", "--precise", *options)


CARDIFF_MAST = "310375,183525,30"


def whole(raster):
    return ["--radius", "1e6", "--like", str(raster)]


def cardiff(*options):
    return viewshed("--observer", CARDIFF_MAST, *whole(DEMO / "cardiff.tif"), *options)


def fractal(*options):
    return viewshed("--observer", "420485,6020485,30", "--target-height", "10", *whole(WORK / "fractal.tif"), *options)


# Name, store, and the arguments after the program's name.
ROWS = [
    ("Wales, 10 km, exact", "wales", exact(CARDIFF_MAST, "--radius", "10000")),
    ("Cardiff, exact", "cardiff", exact(CARDIFF_MAST, *whole(DEMO / "cardiff.tif"))),
    ("Rainier, exact", "rainier", exact("594475,5189025,30", *whole(WORK / "rainier.tif"))),
    ("Wales, 40 km, exact", "wales", exact(CARDIFF_MAST, "--radius", "40000")),
    ("lidar with trees, exact", "lidar", exact("300000,6801500,30", *whole(WORK / "lidar.tif"))),
    ("pillars, exact", "pillars", exact("501022,6001022,30", *whole(WORK / "pillars.tif"))),
    ("all of Wales, exact", "wales", exact(CARDIFF_MAST, *whole(WORK / "wales.tif"))),
    ("fractal, exact", "fractal", fractal("--precise")),
    ("fractal, exact, --memory 100M", "fractal", fractal("--precise", "--memory", "100M")),
    ("fractal, tolerance 2 m", "fractal", fractal("--tolerance", "2")),
    ("fractal, tolerance 8 m", "fractal", fractal("--tolerance", "8")),
    ("fractal, certified at 32 m", "fractal", fractal("--mode", "certified", "--tolerance", "32")),
    ("Cardiff, tolerance 4 m", "cardiff", cardiff("--tolerance", "4")),
    ("Cardiff, least heights", "cardiff", cardiff("--mode", "height")),
    ("Cardiff, angles", "cardiff", cardiff("--mode", "angle")),
    ("Cardiff, probability", "cardiff", cardiff("--mode", "probability", "--vertical-error", "2")),
    ("Cardiff, map", "cardiff", cardiff("--image", "{out}.png")),
    ("lidar TIN, exact", "lidar-all", exact("300000,6801500,30", "--cell", "1", "--radius", "1000")),
    ("town, all themes, exact", "town", exact("321800,4297750,2", "--cell", "1", "--radius", "500", "--themes", "all")),
    ("seen from everywhere, Cardiff", "cardiff",
     ["visibility", "{store}", "--all", "--cell", "500", "--radius", "5000", "-o", "{out}.tif"]),
    ("triangles of Cardiff", "cardiff", ["tin", "{store}", "--all", "-o", "{out}.ply"]),
    ("one section", "wales",
     ["profile", "{store}", "--from", "280000,240000", "--to", "286000,248000", "-o", "{out}.csv"]),
    ("links within 30 km", "wales", ["los", "{store}", "--links", "{links}", "-o", "{out}.csv"]),
    ("links over all of Wales", "wales", ["los", "{store}", "--links", "{far_links}", "-o", "{out}.csv"]),
    ("links at 6 GHz", "wales",
     ["los", "{store}", "--links", "{links}", "--frequency", "6", "--effective-earth", "4/3", "-o", "{out}.csv"]),
    ("10 sites of 500", "wales",
     ["site", "{store}", "--candidates", "{candidates}", "--name-field", "name", "--mast-height", "20", "--count", "10",
      "--swap", "off", "--memory", "4G", "--radius", "10000", "--cell", "50", "--target-height", "2", "-o", "{out}"]),
    ("zone of 75 turbines", "wales",
     ["ztv", "{store}", "--turbines", "{turbines}", "--radius", "40000", "--cell", "50", "--observer-height", "2", "-o",
      "{out}"]),
    ("75 observers, count", "wales",
     ["viewshed", "{store}", "--radius", "40000", "--cell", "50", "--nodata", "clear", "--observers", "{masts}",
      "--height-field", "h", "--mode", "count", "-o", "{out}.tif"]),
    ("75 observers, least heights", "wales",
     ["viewshed", "{store}", "--radius", "40000", "--cell", "50", "--nodata", "clear", "--observers", "{masts}",
      "--height-field", "h", "--mode", "height", "-o", "{out}.tif"]),
    ("import, Cardiff", None, ["import", "{out}.itin", str(DEMO / "cardiff.tif")]),
    ("import, lidar", None, ["import", "{out}.itin", str(LIDAR / "ign_0299_6802.las")]),
]

INPUTS = {
    "links": WORK / "section/links-30000.csv",
    "far_links": WORK / "section/links-1000000.csv",
    "candidates": WORK / "site/candidates.csv",
    "turbines": OUT / "turbines.csv",
    "masts": OUT / "masts.csv",
}


def make_tables():
    with open(INPUTS["turbines"], "w") as table:
        table.write("x,y,hub_height,rotor_diameter,farm\n")
        for i in range(75):
            table.write(f"{285025 + 500 * (i % 9)},{280025 + 500 * (i // 9)},90,110,bench\n")
    with open(INPUTS["masts"], "w") as table:
        table.write("x,y,h\n")
        for i in range(75):
            table.write(f"{270000 + 40000 * (i * 0.618 % 1):.1f},{250000 + 40000 * (i * 0.382 % 1):.1f},100\n")


def store(name, program, folder):
    """The store of this name in folder, written by the program where it is not there yet; None without its terrain."""
    path = folder / f"{name}.itin"
    if path.exists():
        return path
    sources = {"cardiff": [DEMO / "cardiff.tif"],
               "lidar-all": [LIDAR / "ign_0299_6802.las", LIDAR / "ign_0300_6802.las"],
               "town": [DEMO / "alexandria-dtm.tif"]}.get(name, [WORK / f"{name}.tif"])
    if not all(source.exists() for source in sources):
        return None
    subprocess.run([program, "import", path, *sources, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    if name == "town":
        subprocess.run([program, "import", path, DEMO / "alexandria-buildings.geojson", "--kind", "buildings",
                        "--height-field", "HEIGHT", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return path


def clear_results():
    """Removes what the last command wrote."""
    for left in OUT.glob("result*"):
        shutil.rmtree(left) if left.is_dir() else left.unlink()


def commands(word, *programs):
    """Yields (name, commands) of each question whose name has this word, one command for each (program, folder), where
    folder is that of its stores. A question whose terrain is absent is left out, which is printed."""
    OUT.mkdir(parents=True, exist_ok=True)
    make_tables()
    for name, source, arguments in ROWS:
        if word not in name:
            continue
        stores = [source and store(source, program, folder) for program, folder in programs]
        needed = {key: file for key, file in INPUTS.items() if any(f"{{{key}}}" in a for a in arguments)}
        absent = [str(file) for file in needed.values() if not file.exists()]
        if (source and None in stores) or absent:
            print(f"{name:32} left out: {', '.join(absent) or 'no terrain for ' + source}")
            continue
        yield name, [[program] + [str(a).format(store=path, out=OUT / "result", **needed) for a in arguments]
                     for (program, _), path in zip(programs, stores)]
