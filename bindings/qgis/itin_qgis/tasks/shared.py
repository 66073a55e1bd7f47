"""Parameters that several tasks have, so that they have the same names everywhere."""

from __future__ import annotations

from .parameters import (
    Choice,
    File,
    FileOutput,
    Flag,
    Further,
    Number,
    Parameter,
    Raster,
    Store,
    Text,
)
from .task import LOAD

STORE = Store("STORE", "Store", required=True, help="The landscape: a file .itin that an import has made")

TOLERANCE = Number(
    "TOLERANCE", "Tolerance of the surface", "--tolerance", default=0, unit="m", minimum=0,
    help="How far the surface may be from the stored one, in height. 0: every stored point",
)
RINGS = Text(
    "RINGS", "Rings of tolerance, as 500:0,2000:1,10000:4", "--rings", advanced=True,
    help="A finer surface nearby: radius and tolerance of each ring, in metres, nearest first",
)
THEMES = Text(
    "THEMES", "Themes that stand on the ground", "--themes", default="all",
    help="all, none, or names with commas between them, as buildings,vegetation",
)
WITHOUT = Text(
    "WITHOUT",
    "What would be were these features not there, as buildings:12;woods:Long Wood",
    "--without",
    advanced=True,
    help="THEME:ID or THEME:NAME as reports print them, or THEME#NUMBER",
)
STANDING: tuple[Parameter, ...] = (THEMES, WITHOUT)
"""What of all that stands on the ground counts: what each verb with themes has."""
_SEEN_THROUGH = Flag(
    "FOLIAGE",
    "See through woods: metres of leaves, and the light that comes through",
    "--foliage",
    advanced=True,
)
_TRANSMITTANCE = Number(
    "TRANSMITTANCE",
    "The least share of the light by which something is seen",
    "--transmittance",
    default=0.5,
    minimum=0,
    advanced=True,
)
ON_PATHS: tuple[Parameter, ...] = (
    _SEEN_THROUGH,
    Text("LEAF_AREA", "Leaf area of woods: on, off (winter), or a field", "--leaf-area", advanced=True),
)
"""How much foliage is on a path."""
FOLIAGE: tuple[Parameter, ...] = (*ON_PATHS, _TRANSMITTANCE)
"""How woods are seen through, in one season."""
SEASONS: tuple[Parameter, ...] = (_SEEN_THROUGH, _TRANSMITTANCE)
"""How woods are seen through, in leaf and in winter alike."""
NODATA = Choice(
    "NODATA", "What ground without data does to sight lines", "--nodata", choices=("unknown", "block", "clear"),
    default="unknown", advanced=True, help="unknown: undecided unless known ground hides; block: hides; clear: lets pass",
)
CURVATURE = Choice(
    "CURVATURE", "Curvature of the earth", "--curvature", choices=("on", "off"), default="on", advanced=True
)
REFRACTION = Number(
    "REFRACTION", "Refraction coefficient k", "--refraction", default=0.13, advanced=True,
    help="drop = d² (1 - k) / (2 R). Light has 0.13; 0.075 in the form (1 - 2 k) is 0.15 here",
)
EFFECTIVE_EARTH = Text(
    "EFFECTIVE_EARTH", "Effective Earth factor K, as 4/3, in place of k", "--effective-earth", advanced=True,
    help="drop = d² / (2 K R), for radio",
)
EARTH_RADIUS = Number(
    "EARTH_RADIUS", "Radius of the earth", "--earth-radius", unit="m", minimum=0, advanced=True,
    help="Left blank: 6371000 m, or that of the Moon or Mars where the store is there",
)
EARTH = (CURVATURE, REFRACTION, EFFECTIVE_EARTH, EARTH_RADIUS)

ENGINE = Choice(
    "ENGINE", "Engine", "--engine", choices=("auto", "sweep", "rays"), default="auto", advanced=True,
    help="What decides sight lines. The result does not depend on it",
)
THREADS = Number(
    "THREADS", "Threads", "--threads", minimum=1, whole=True, advanced=True,
    help="Left blank: all cores. The result does not depend on it",
)
FURTHER = Further(
    "FURTHER", "Further options, as on the command line", advanced=True, help="For instance --allow-network"
)


def running(memory: str = "") -> tuple[Parameter, ...]:
    """Returns what says how the program runs. `memory` is its default; blank where that depends on something."""
    return (
        Text("MEMORY", "Memory to work in, as 2G", "--memory", default=memory, advanced=True),
        THREADS,
        FURTHER,
    )


OVERWRITE = Flag(
    "OVERWRITE", "Replace the results of an earlier run in that folder", "--overwrite",
    help="Without it, a folder that has results already is refused",
)
LOAD_RESULTS = Flag(LOAD, "Show the results as layers, in a group", default=True)

TITLE_BLOCK = (
    Text("PROJECT", "Project, for title blocks", "--project", advanced=True),
    Text("DATE", "Date, for title blocks", "--date", advanced=True, help="Left blank: today"),
)
_OF_MAPS = (
    Number("SHEET_SCALE", "Scale of maps on paper: 1 to", "--sheet-scale", minimum=1, advanced=True),
    Raster("BASEMAP", "Picture below maps on paper", "--basemap", advanced=True),
    *TITLE_BLOCK,
)
PAPER_MAP = (
    FileOutput("SHEET", "Map on paper", "--sheet", filter="PDF files (*.pdf);;PNG files (*.png)", advanced=True),
    Choice("PAPER", "Size of the paper", "--paper", choices=("A3", "A1"), default="A3", advanced=True),
    *_OF_MAPS,
)
PAPER_MAPS = (
    Text("SHEETS", "Maps on paper: A3, A1, or A3,A1", "--sheets", default="none", advanced=True),
    *_OF_MAPS,
)

LEVELS: tuple[Parameter, ...] = (
    Number("POWER_DBM", "Power of the transmitter [dBm], for a link budget", "--power-dbm", advanced=True),
    Number("EIRP_DBM", "EIRP of the first end [dBm], in place of the power", "--eirp-dbm", advanced=True),
    Text(
        "GAIN_DBI",
        "Gain of both antennas [dBi], or of each with a comma between",
        "--gain-dbi",
        advanced=True,
        help="With an EIRP, of the second antenna alone",
    ),
    Text("FEEDER_LOSS_DB", "Losses of feeders [dB], likewise", "--feeder-loss-db", advanced=True),
    Number("SENSITIVITY_DBM", "Sensitivity of the receiver [dBm]", "--sensitivity-dbm", advanced=True),
    File(
        "FROM_ANTENNA",
        "Pattern of the antenna at the first end",
        "--from-antenna",
        advanced=True,
        filter="Patterns of antennas (*.msi *.pln *.ant)",
    ),
    File(
        "TO_ANTENNA",
        "Pattern of the antenna at the second end",
        "--to-antenna",
        advanced=True,
        filter="Patterns of antennas (*.msi *.pln *.ant)",
    ),
    Text(
        "ANTENNA_AZIMUTH",
        "Azimuth of the antenna at the first end, or of both with a comma between",
        "--antenna-azimuth",
        advanced=True,
        help="Degrees from grid north; aim, or nothing, for the other end",
    ),
    Text("ANTENNA_TILT", "Tilt of these antennas below the horizontal", "--antenna-tilt", advanced=True),
)
RAIN = Number(
    "RAIN_RATE_MM_H",
    "Rate of rain exceeded for 0.01 % of the year [mm/h]",
    "--rain-rate-mm-h",
    minimum=0,
    advanced=True,
)
FRESNEL = Number(
    "FRESNEL", "Share of the first Fresnel zone that must be clear", "--fresnel", default=0.6, minimum=0, maximum=1
)
POLARISATION = Choice(
    "POLARISATION", "Polarisation", "--polarisation", choices=("h", "v"), default="h", advanced=True
)
OVER_SEA = Number(
    "OVER_SEA", "Share of the path over sea", "--over-sea", default=0, minimum=0, maximum=1, advanced=True
)


def on(name: str, label: str, option: str) -> Choice:
    """Returns the choice of what something stands on."""
    return Choice(
        name, label, option, choices=("ground", "surface"), default="ground", advanced=True,
        help="surface: with the roofs and tops of the themes",
    )


OBSERVER_ON = on("OBSERVER_ON", "Observers stand on", "--observer-on")
TARGET_ON = on("TARGET_ON", "Targets stand on", "--target-on")
LIKE = Raster("LIKE", "Take the cells of this raster", "--like", advanced=True)
