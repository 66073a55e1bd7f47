"""The comparisons of benchmarks/peers/all: questions by name, each with its contestants, who answer it.

    for name, make in comparisons(program, grass=True):
        question = make()       # makes terrain, stores and tables; raises LeftOut where these cannot be made
"""
import shutil
from typing import NamedTuple

import questions
from tables import TIP, TURBINES, table
from terrain import DATA, DEFLATED, PEERS, PLACES, WORK, cut, quietly, raster, sources_of, store, uncompressed

FOLDER = WORK / "all"
REFRACTION = 0.13
TOLERANCES = (1, 2, 4, 8, 16)
GDAL, GRASS, NUMPY = "gdal_viewshed", "r.viewshed", "GDAL and NumPy"
GDAL_DEFLATED = f"{GDAL}, {DEFLATED}"
SITES, SITE_SAMPLE, TURBINE_SAMPLE = 500, 50, 5


class LeftOut(Exception):
    """Raised where a question or a contestant is left out; the text says why."""


class Contestant(NamedTuple):
    who: str
    commands: list  # run one after the other
    answer: object = None  # the file that is compared with that of the first contestant who has one
    part: float = 1  # how much of the question the commands answer: times are divided by it
    runs: int = 1000  # at most
    tool: str = ""  # what it needs: a program, or a module of Python
    store: object = None  # the store that it writes, whose size is told
    section: object = None  # the command that tells what is read for a section, as JSON


class Question(NamedTuple):
    contestants: list
    peers: tuple = ()  # whose times the others' are divided by; aims are of the first
    amount: int = 0  # how many of `unit` are answered
    unit: str = ""


def own(who):
    """A folder for what one contestant writes."""
    return FOLDER / who.replace(" ", "-").replace(",", "")


def itin(program, who, row, answer=None, **more):
    command = questions.command(program, WORK, own(who) / "result", row)
    if command is None:
        raise LeftOut(f"no terrain for {row.store} in {DATA}")
    return Contestant(who, [[*command, "--quiet"]], answer and own(who) / answer, **more)


def gdal_viewshed(dem, x, y, eye, target, radius, out):
    """Reads an uncompressed raster in three tenths of the time that a deflated one takes, whose predictor it undoes."""
    return [GDAL, "-q", "-ox", x, "-oy", y, "-oz", eye, "-tz", target, "-md", radius, "-vv", 1, "-iv", 0, "-ov", 255, "-cc",
            1 - REFRACTION, dem, out]


def gdal_rasters(dem):
    """Returns the names under which gdal_viewshed takes part, each with its raster."""
    return ((GDAL, uncompressed(dem) if shutil.which(GDAL) else dem), (GDAL_DEFLATED, dem))


def grass_viewshed(dem, eye, target, radius, out, *places):
    return [PEERS / "grass_viewshed.sh", dem, eye, target, radius, REFRACTION, out, *(f"{x},{y}" for x, y in places)]


def viewsheds(program, place, grass):
    def seen(who, *options):
        row = questions.Row(who, place.terrain, questions.seen_from(place, *options), place)
        return itin(program, who, row, "result.tif")

    exact = seen("exact", "--precise")  # first: the others are compared with it
    dem = cut(place)
    contestants = [exact, seen("certified at 32 m", "--mode", "certified", "--tolerance", "32"),
                   *(seen(f"tolerance {t} m", "--tolerance", str(t)) for t in TOLERANCES)]
    for who, heights in gdal_rasters(dem):
        out = own(who) / "result.tif"
        contestants.append(Contestant(
            who, [gdal_viewshed(heights, place.x, place.y, 30, 2, place.radius, out)], out, tool=GDAL))
    if grass:
        out = own(GRASS) / "result.tif"
        contestants.append(Contestant(
            GRASS, [grass_viewshed(dem, 30, 2, place.radius, out, (place.x, place.y))], out, runs=1, tool="grass"))
    return Question(contestants, (GDAL, GDAL_DEFLATED))


def sampled(links):
    """The contestant that answers the links by sampling the raster."""
    out = own(NUMPY) / "result.csv"
    return Contestant(NUMPY, [[PEERS / "section.py", "raster", raster("wales"), table(links), out]], out, tool="numpy")


def links(program, name):
    row = questions.Row(name, "wales", ["los", "{store}", "--links", f"{{{name}}}", "-o", "{out}.csv"])
    return Question([itin(program, "los", row, "result.csv"), sampled(name)], (NUMPY,), 10000, "links")


def section(program):
    one = itin(program, "profile", questions.Row("section", "wales", questions.SECTION))
    told = questions.command(program, WORK, own("profile") / "told", questions.Row("section", "wales", questions.SECTION))
    one = one._replace(section=[*told, "--json", "--quiet", "--overwrite"])
    whole = WORK / "section/wales.ply"
    if not whole.exists():
        whole.parent.mkdir(parents=True, exist_ok=True)
        quietly(program, "tin", store("wales", program), "--all", "--quiet", "-o", whole)
    tin = Contestant("explicit TIN in NumPy", [[PEERS / "section.py", "tin", whole, table("one_link")]], runs=1, tool="numpy")
    return Question([one, sampled("one_link"), tin], (NUMPY,))


def zone(program, grass):
    dem = raster("wales")
    contestants = [itin(program, "ztv", questions.Row("zone", "wales", questions.ZONE))]
    for who, heights in gdal_rasters(dem):
        contestants.append(Contestant(
            who, [gdal_viewshed(heights, x, y, TIP, 2, 40000, own(who) / f"{x}-{y}.tif") for x, y in TURBINES], tool=GDAL))
    if grass:
        some = TURBINES[::len(TURBINES) // TURBINE_SAMPLE]
        contestants.append(Contestant(GRASS, [grass_viewshed(dem, TIP, 2, 40000, own(GRASS) / "result.tif", *some)],
                                      part=len(some) / len(TURBINES), runs=1, tool="grass"))
    return Question(contestants, (GDAL, GDAL_DEFLATED))


def sites(program):
    chosen = itin(program, "site", questions.Row("sites", "wales", questions.SITES))
    places = [line.split(",") for line in table("candidates").read_text().splitlines()[1:SITE_SAMPLE + 1]]
    single = "single viewsheds"
    out = own(single) / "result.tif"
    commands = [[program, "viewshed", store("wales", program), "--quiet", "--overwrite", "--precise", "--observer",
                 f"{x},{y},20", "--radius", 10000, "--cell", 50, "--target-height", 2, "-o", out] for _, x, y in places]
    return Question([chosen, Contestant(single, commands, part=SITE_SAMPLE / SITES)], (single,))


def imported(program, name, *options):
    sources = sources_of(name)
    if not sources:
        raise LeftOut(f"no terrain for {name} in {DATA}")
    path = own("import") / "result.itin"
    command = [program, "import", path, *sources, *options, "--memory", "2G", "--quiet"]
    return Question([Contestant("import", [command], store=path)], unit="points")


def comparisons(program, grass):
    """Yields (group, name, make) of each question."""
    for place in PLACES:
        yield "viewshed", place.name, lambda place=place: viewsheds(program, place, grass)
    for name, what in (("links", "within 30 km"), ("far_links", "over all of Wales")):
        yield "10,000 links", what, lambda name=name: links(program, name)
    yield "section", "10 km in Wales", lambda: section(program)
    yield "zone", "75 turbines, 40 km", lambda: zone(program, grass)
    yield "sites", "10 of 500, 10 km", lambda: sites(program)
    for name in ("cardiff", "fractal", "wales", "lidar-all"):
        yield "import", name, lambda name=name: imported(program, name)
    yield "import", "contours", lambda: imported(program, "contours", "--kind", "contours", "--layer", "ContourLine",
                                                 "--z-field", "propertyValue", "--no-repair")


def emptied(contestant):
    """Makes room for what a contestant writes."""
    shutil.rmtree(own(contestant.who), ignore_errors=True)
    own(contestant.who).mkdir(parents=True)
