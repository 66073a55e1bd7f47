#!/usr/bin/python3
"""The terrain that benchmarks run on: rasters and stores, made once in build/peers (or ITIN_BENCHMARK_DIR).

    benchmarks/peers/terrain.py NAME...        makes NAME.tif; exits with 1 where its source is absent

Real terrain comes from ../shared/data (or ITIN_DATA_DIR) and scripts/demo-data.
"""
import os
import pathlib
import subprocess
import sys
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parents[2]
PEERS = ROOT / "benchmarks/peers"
WORK = pathlib.Path(os.environ.get("ITIN_BENCHMARK_DIR", ROOT / "build/peers"))
DATA = pathlib.Path(os.environ.get("ITIN_DATA_DIR", ROOT / "../shared/data"))
DEMO = ROOT / "scripts/demo-data"
LIDAR = DATA / "derived-las"
LIDAR_TILES = [LIDAR / "ign_0299_6802.las", LIDAR / "ign_0300_6802.las"]


class Place(NamedTuple):
    """A mast of 30 m at x, y, whose viewshed reaches as far as `radius`, or over the whole raster where that is 0."""
    name: str
    terrain: str
    x: float
    y: float
    radius: int = 0


PLACES = [
    Place("Wales, 10 km", "wales", 310375, 183525, 10000),
    Place("Cardiff", "cardiff", 310375, 183525),
    Place("Rainier", "rainier", 594475, 5189025),
    Place("Wales, 40 km", "wales", 310375, 183525, 40000),
    Place("lidar with trees", "lidar", 300000, 6801500),
    Place("pillars", "pillars", 501022, 6001022),
    Place("all of Wales", "wales", 310375, 183525),
    Place("fractal", "fractal", 420485, 6020485),
    Place("fractal of 8192 x 8192", "fractal-8192", 440485, 6040485),
]


def quietly(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def make_wales(path):
    tiles = sorted((DATA / "os-terrain50-wales/tiles").glob("*.zip"))
    table, mosaic = WORK / "wales.txt", WORK / "wales.vrt"
    table.write_text("".join(f"/vsizip/{tile}/{tile.stem.upper()}.asc\n" for tile in tiles))
    # The open sea has no tiles. Tiles on the coast have their sea at about height 0.
    quietly("gdalbuildvrt", "-q", "-a_srs", "EPSG:27700", "-vrtnodata", "-9999", "-input_file_list", table, mosaic)
    quietly("gdal_translate", "-q", "-co", "TILED=YES", "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=3", mosaic, path)


def make_rainier(path):
    quietly("gdalwarp", "-q", "-t_srs", "EPSG:32610", "-tr", "75", "75", "-r", "bilinear", "-dstnodata", "-32768", "-ot",
            "Float32", DATA / "srtm90-alpine/mt_rainier_90m.tif", path)


# The sources of each raster, and how it is made of them.
MADE = {
    "fractal": ([], lambda path: quietly(PEERS / "fractal.py", path)),
    "fractal-8192": ([], lambda path: quietly(PEERS / "fractal.py", path, "8192")),
    "pillars": ([], lambda path: quietly(PEERS / "surfaces.py", "pillars", path)),
    "lidar": (LIDAR_TILES, lambda path: quietly(PEERS / "surfaces.py", "lidar", path, *reversed(LIDAR_TILES))),
    "wales": ([DATA / "os-terrain50-wales/tiles"], make_wales),
    "rainier": ([DATA / "srtm90-alpine/mt_rainier_90m.tif"], make_rainier),
}


def raster(name):
    """Returns the path of the raster, which is made if it is not there yet; None where its sources are absent."""
    if name == "cardiff":
        return DEMO / "cardiff.tif"
    path = WORK / f"{name}.tif"
    if path.exists():
        return path
    sources, make = MADE[name]
    if not all(source.exists() for source in sources):
        return None
    WORK.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(".part.tif")
    make(part)
    part.rename(path)
    return path


def cut(place):
    """Returns the raster about a place that the peers read: the square that holds the circle, if the place has a radius."""
    whole = raster(place.terrain)
    if not whole or not place.radius:
        return whole
    path = WORK / f"{place.terrain}-{place.radius}.tif"
    if not path.exists():
        reach = place.radius + 100
        quietly("gdal_translate", "-q", "-projwin", *map(str, (place.x - reach, place.y + reach, place.x + reach,
                                                                place.y - reach)), whole, path)
    return path


DEFLATED = "deflated raster"  # what the rasters of benchmarks are, as most rasters that are handed on


def uncompressed(path):
    """Returns a copy of the raster that is read without inflating it; None where there is no raster."""
    if not path:
        return None
    copy = WORK / f"{path.stem}-uncompressed.tif"
    if not copy.exists():
        part = copy.with_suffix(".part.tif")
        quietly("gdal_translate", "-q", "-co", "TILED=YES", path, part)
        part.rename(copy)
    return copy


def sources_of(store_name):
    """Returns the files that the store of this name is imported from; None where they are absent."""
    if store_name == "lidar-all":
        return LIDAR_TILES if all(tile.exists() for tile in LIDAR_TILES) else None
    if store_name == "town":
        return [DEMO / "alexandria-dtm.tif"]
    if store_name == "contours":
        contours = DATA / "os-terrain50-contours-sk00/SK00.gml"
        return [contours] if contours.exists() else None
    path = raster(store_name)
    return path and [path]


def store(name, program, folder=WORK):
    """Returns the store of this name in the folder, which the program imports if needed; None without its sources."""
    path = folder / f"{name}.itin"
    if path.exists():
        return path
    sources = sources_of(name)
    if not sources:
        return None
    folder.mkdir(parents=True, exist_ok=True)
    quietly(program, "import", path, *sources, "--quiet")
    if name == "town":
        quietly(program, "import", path, DEMO / "alexandria-buildings.geojson", "--kind", "buildings", "--height-field",
                "HEIGHT", "--quiet")
    return path


if __name__ == "__main__":
    missing = [name for name in sys.argv[1:] if not raster(name)]
    if missing:
        sys.exit(f"{sys.argv[0]}: no terrain for {', '.join(missing)} in {DATA}")
