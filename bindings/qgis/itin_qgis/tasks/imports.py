"""Making stores: terrain, lines of the terrain or on it, and what stands on it."""

from __future__ import annotations

from . import shared
from .parameters import (
    Choice,
    Crs,
    Field,
    Files,
    Flag,
    Layer,
    NewStore,
    Number,
    Raster,
    Rasters,
    Store,
    Text,
)
from .task import Task

STORES = "Stores"

_NEW_STORE = NewStore(
    "STORE",
    "Store to make, or to add to",
    required=True,
    help="A file .itin. One that is there is added to, and keeps what it has",
)
_CRS = Crs("CRS", "CRS of the sources, in place of their own", "--crs", advanced=True)
_Z_FIELD = Field("Z_FIELD", "Field of heights; left blank: Z of the geometry", "--z-field", of="INPUT")
_NOTE = Text("SOURCE_NOTE", "Product, date and licence, for reports", "--source-note", advanced=True)
_OF_NEW_STORES = (
    Crs(
        "TO_CRS",
        "CRS of a new store",
        "--to-crs",
        advanced=True,
        help="Projected, in metres. Left blank: that of the sources if it is such a one, else their UTM zone",
    ),
    Text("LEVELS", "Tolerances of a new store's levels, as 1,2,4,8", "--levels", advanced=True),
    Number(
        "RESOLUTION",
        "Grid of a new store's coordinates",
        "--resolution",
        default=0.01,
        unit="m",
        minimum=0,
        advanced=True,
    ),
)
_OF_FEATURES = (
    Text("THEME", "Name of the theme; left blank: the kind", "--theme"),
    Field("ID_FIELD", "Field of ids", "--id-field", of="INPUT", advanced=True),
    Field("NAME_FIELD", "Field of names", "--name-field", of="INPUT", advanced=True),
    Text("ATTRIBUTES", "Fields to keep: names, or none; left blank: all", "--attributes", advanced=True),
)
_BAND = Number("BAND", "Band of rasters that holds heights", "--band", minimum=1, whole=True, advanced=True)
_MIXED = Flag(
    "ALLOW_MIXED_VERTICAL",
    "Take heights as they are, though sources have different vertical datums",
    "--allow-mixed-vertical",
    advanced=True,
)


class ImportTerrain(Task):
    """Terrain, from rasters, clouds and points."""

    name = "importterrain"
    title = "Import terrain"
    group = STORES
    verb = "import"
    guide = "importing.md"
    summary = (
        "Makes a store of terrain, or adds terrain to one. A store is one file, which all other algorithms read. "
        "Give raster layers, files, or a layer of points with heights."
    )
    parameters = (
        Rasters("RASTERS", "Raster layers of heights"),
        Files(
            "FILES",
            "Files of points or rasters",
            filter="Terrain (*.las *.laz *.csv *.xyz *.txt *.asc *.tif *.vrt *.zip);;All files (*)",
        ),
        Layer("INPUT", "Layer of points with heights", geometry="point", layer_option="--layer"),
        _Z_FIELD,
        _NEW_STORE,
        Flag(
            "REPLACE",
            "Take the place of coarser terrain where the sources are",
            "--replace",
            help="A new survey takes the place of an old one, and contours end where lidar begins",
        ),
        Number(
            "SEA_LEVEL",
            "Fill missing ground with the sea, at this elevation",
            "--sea-level",
            unit="m",
            help="Left blank: missing ground stays missing, and sight lines across it are undecided",
        ),
        Layer("SEA_AREA", "Fill within these polygons only", "--sea-area", geometry="polygon", advanced=True),
        _BAND,
        Text("CLASSES", "LAS and LAZ: only these classes, as 2,9", "--class", advanced=True),
        Number(
            "MAX_GAP",
            "Scattered points: no ground across wider gaps",
            "--max-gap",
            unit="m",
            minimum=0,
            advanced=True,
            help="Left blank: 100 times their mean spacing",
        ),
        _CRS,
        _MIXED,
        _NOTE,
        *_OF_NEW_STORES,
        *shared.running("4G"),
    )


class ImportLines(Task):
    """Lines that are part of the terrain, or lie on it."""

    name = "importlines"
    title = "Import lines"
    group = STORES
    verb = "import"
    guide = "importing.md"
    summary = (
        "Adds lines to a store. Contours, breaklines and the outlines of water have heights and become part of the "
        "terrain; a store may be made of contours alone. Roads lie on the terrain and change no height."
    )
    parameters = (
        Layer(
            "INPUT", "Layer of lines or polygons", geometry="line or polygon", required=True, layer_option="--layer"
        ),
        Choice(
            "KIND",
            "What the lines are",
            "--kind",
            choices=("contours", "breaklines", "water", "roads"),
            required=True,
        ),
        _Z_FIELD,
        _NEW_STORE,
        *_OF_FEATURES,
        Flag(
            "STAY",
            "Stay where finer terrain has taken the place of lines",
            "--stay",
            advanced=True,
            help="For kerbs surveyed on the ground, within lidar that was imported with “take the place”",
        ),
        Flag("REPLACE", "Take the place of coarser lines with heights", "--replace", advanced=True),
        Flag("NO_REPAIR", "Contours: infer no points where triangles would be flat", "--no-repair", advanced=True),
        Number(
            "MAX_GAP", "Contours: no ground across wider gaps", "--max-gap", unit="m", minimum=0, advanced=True
        ),
        _CRS,
        _MIXED,
        _NOTE,
        *_OF_NEW_STORES,
        *shared.running("4G"),
    )


class ImportFeatures(Task):
    """Buildings, walls, woods."""

    name = "importfeatures"
    title = "Import buildings, vegetation and walls"
    group = STORES
    verb = "import"
    guide = "importing.md"
    summary = (
        "Adds to a store what stands on its terrain: footprints or lines with heights, rasters of heights above the "
        "ground, a digital surface model (surface), or CityJSON. All queries count them in, unless their themes are "
        "left out."
    )
    parameters = (
        Layer("INPUT", "Layer of footprints or lines", geometry="line or polygon", layer_option="--layer"),
        Rasters("RASTERS", "Raster layers of heights above the ground, or a surface model"),
        Files("FILES", "Files of CityJSON", filter="CityJSON (*.json *.jsonl);;All files (*)"),
        Choice(
            "KIND",
            "What they are",
            "--kind",
            choices=("buildings", "terraces", "walls", "vegetation", "surface"),
            required=True,
        ),
        Field("HEIGHT_FIELD", "Field of heights above the base", "--height-field", of="INPUT"),
        Raster("HEIGHT_FROM", "Surface model that gives heights", "--height-from", advanced=True),
        Number(
            "HEIGHT_PERCENTILE",
            "Which of its cells within a footprint counts [%]",
            "--height-percentile",
            default=50,
            minimum=0,
            maximum=100,
            advanced=True,
        ),
        Number("HEIGHT", "Height of those that have none in the field", "--height", unit="m", minimum=0),
        Store("STORE", "Store to add to", required=True),
        *_OF_FEATURES,
        Field("EAVES_FIELD", "Buildings: field of the height of eaves", "--eaves-field", of="INPUT", advanced=True),
        Field("BASE_FIELD", "Buildings: field of the base's elevation", "--base-field", of="INPUT", advanced=True),
        Choice(
            "BASE",
            "Buildings: heights are measured from this ground under the footprint",
            "--base",
            choices=("minimum", "mean", "maximum", "terrain-following"),
            advanced=True,
        ),
        Choice(
            "FOUNDATION",
            "Buildings: how they meet the ground",
            "--foundation",
            choices=("walls", "flat"),
            advanced=True,
        ),
        Choice(
            "ROOF",
            "Buildings: roofs",
            "--roof",
            choices=("flat", "gabled", "hipped", "skeleton"),
            advanced=True,
        ),
        Number(
            "STOREY",
            "Fields of heights count storeys of this height",
            "--storey",
            unit="m",
            minimum=0,
            advanced=True,
            help="For building:levels of OpenStreetMap, about 3",
        ),
        Number(
            "THICKNESS",
            "Thickness of walls and hedges given as lines",
            "--thickness",
            default=0.3,
            unit="m",
            minimum=0,
            advanced=True,
        ),
        Number(
            "WALL_OFFSET", "How far walls lean inwards", "--wall-offset", unit="m", minimum=0, advanced=True
        ),
        Number(
            "HEIGHT_STEP",
            "Rasters: cells stand in multiples of",
            "--height-step",
            default=2,
            unit="m",
            minimum=0,
            advanced=True,
        ),
        Number(
            "HEIGHT_THRESHOLD",
            "Rasters: lower cells do not stand",
            "--height-threshold",
            default=2,
            unit="m",
            minimum=0,
            advanced=True,
        ),
        Choice(
            "HEIGHT_ROUNDING",
            "Rasters: steps are rounded",
            "--height-rounding",
            choices=("nearest", "up", "down"),
            advanced=True,
        ),
        _BAND,
        _CRS,
        _MIXED,
        _NOTE,
        *shared.running("4G"),
    )
