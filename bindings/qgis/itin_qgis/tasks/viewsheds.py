"""What observers see."""

from __future__ import annotations

from dataclasses import replace

from . import shared
from .parameters import (
    Choice,
    Field,
    FileOutput,
    Flag,
    FolderOutput,
    Layer,
    Number,
    Parameter,
    Point,
    RasterOutput,
    Text,
    VectorOutput,
)
from .task import Task
from .window import WINDOW, OfWindow

SIGHT = "Sight"

OBSERVERS: tuple[Parameter, ...] = (
    shared.STORE,
    Point("OBSERVER", "Observer", "--observer", help="A place on the map, unless there is a layer of observers"),
    Layer("OBSERVERS", "Layer of observers", "--observers", geometry="point", layer_option="--layer"),
    Number(
        "OBSERVER_HEIGHT",
        "Height of observers",
        "--observer-height",
        default=2,
        unit="m",
        help="Above the ground. A field “height” of the layer counts, unless another height than 2 is given here",
    ),
)
_HEIGHT_FIELD = Field("HEIGHT_FIELD", "Field of heights", "--height-field", of="OBSERVERS", advanced=True)
_NAME_FIELD = Field("NAME_FIELD", "Field of names", "--name-field", of="OBSERVERS", advanced=True)
_OF_THE_LAYER: tuple[Parameter, ...] = (
    _HEIGHT_FIELD,
    _NAME_FIELD,
    Field("TARGET_HEIGHT_FIELD", "Field of target heights", "--target-height-field", of="OBSERVERS", advanced=True),
    Field("RADIUS_FIELD", "Field of radii", "--radius-field", of="OBSERVERS", advanced=True),
    Field("MIN_RADIUS_FIELD", "Field of inner radii", "--min-radius-field", of="OBSERVERS", advanced=True),
    Text("AZIMUTH_FIELDS", "Fields of azimuths: from,to", "--azimuth-fields", advanced=True),
    Text("ELEVATION_FIELDS", "Fields of elevation angles: from,to", "--elevation-fields", advanced=True),
    Flag(
        "ARCGIS_FIELDS",
        "Take ArcGIS's fields: OFFSETA, SPOT, RADIUS2, ...",
        "--arcgis-fields",
        advanced=True,
    ),
    Flag("ABSOLUTE_HEIGHTS", "All heights are elevations", "--absolute-heights", advanced=True),
    Flag("OBSERVER_ABSOLUTE", "Heights of observers are elevations", "--observer-absolute", advanced=True),
    shared.OBSERVER_ON,
)
_RADIUS = Number(
    "RADIUS", "How far to look", "--radius", unit="m", minimum=0, help="Left blank: as far as there is ground"
)
_TARGETS: tuple[Parameter, ...] = (
    Number("TARGET_HEIGHT", "Height of targets", "--target-height", default=0, unit="m", help="Above the ground"),
    _RADIUS,
    Number(
        "CELL",
        "Size of the cells",
        "--cell",
        unit="m",
        minimum=0,
        help="Left blank: a round size, for at most 2048 cells on a side",
    ),
)
_FIELD_OF_VIEW: tuple[Parameter, ...] = (
    Number("MIN_RADIUS", "Leave out what is nearer", "--min-radius", default=0, unit="m", minimum=0, advanced=True),
    Text("AZIMUTH", "Field of view, degrees from grid north: from,to", "--azimuth", advanced=True),
    Text("ELEVATION", "Field of view, degrees above the horizontal: from,to", "--elevation", advanced=True),
    Flag("TARGET_ABSOLUTE", "Heights of targets are elevations", "--target-absolute", advanced=True),
    shared.TARGET_ON,
    shared.LIKE,
)
_DETAIL: tuple[Parameter, ...] = (shared.TOLERANCE, *shared.STANDING)
_MORE_DETAIL: tuple[Parameter, ...] = (shared.RINGS, shared.NODATA, *shared.EARTH, shared.ENGINE)
_FILES: tuple[Parameter, ...] = (
    VectorOutput("POLYGONS", "The same as polygons", "--output"),
    FileOutput("IMAGE", "Map as a picture", "--image", filter="PNG files (*.png);;JPEG files (*.jpg)", advanced=True),
    FolderOutput("EACH", "Rasters of each observer alone", "--each", advanced=True),
    RasterOutput("FEATURES", "Themes under the cells", "--features", advanced=True),
    *shared.PAPER_MAP,
)
_MODES = ("visible", "certified", "count", "which", "nearest", "angle", "height", "blocker", "probability")


class Viewshed(Task):
    """What is seen."""

    name = "viewshed"
    title = "Viewshed"
    group = SIGHT
    verb = "viewshed"
    guide = "viewsheds.md"
    summary = (
        "Tells which cells observers see, exactly for the stored surface. Modes: visible (whether any observer sees a "
        "cell), certified (certainly visible, certainly hidden, or undecided at a tolerance), count (how many see it), "
        "which (one bit for each), nearest, angle (of the sight line), height (least height at which a target is seen), "
        "blocker (what hides it), probability (where heights err)."
    )
    parameters = (
        *OBSERVERS,
        *_TARGETS,
        Choice(
            "MODE",
            "What each cell has",
            "--mode",
            choices=_MODES,
            default="visible",
        ),
        *_DETAIL,
        RasterOutput("OUTPUT", "Viewshed", "--output", required=True),
        *_OF_THE_LAYER,
        *_FIELD_OF_VIEW,
        Number(
            "VERTICAL_ERROR",
            "Mode probability: standard deviation of heights",
            "--vertical-error",
            unit="m",
            minimum=0,
            advanced=True,
        ),
        Number(
            "ERROR_CORRELATION",
            "Mode probability: errors are correlated over",
            "--error-correlation",
            unit="m",
            minimum=0,
            advanced=True,
        ),
        *shared.FOLIAGE,
        *_MORE_DETAIL,
        *_FILES,
        *shared.running("1G"),
    )


class RadioCoverage(Task):
    """What a radio reaches."""

    name = "radiocoverage"
    title = "Radio coverage"
    group = SIGHT
    verb = "viewshed"
    guide = "viewsheds.md"
    summary = (
        "Tells where the first Fresnel zone about the line to a mast is clear, where it is cut, and what is hidden; "
        "or the path loss to each cell by diffraction (ITU-R P.526) and in free space, in dB; or, with a link "
        "budget, the level that a receiver in each cell gets, in dBm. The first end is then the mast, the second the "
        "receiver, and polygons have the levels by their margins over the sensitivity. Each cell has "
        "the answer that a line of sight to it has."
    )
    parameters = (
        *OBSERVERS,
        *_TARGETS,
        Number("FREQUENCY", "Frequency [GHz]", "--frequency", required=True, unit="GHz", minimum=0),
        shared.FRESNEL,
        Flag("LOSS", "Write losses in dB instead of zones", "--loss"),
        replace(shared.EFFECTIVE_EARTH, advanced=False),
        *_DETAIL,
        RasterOutput("OUTPUT", "Radio coverage", "--output", required=True),
        shared.POLARISATION,
        shared.OVER_SEA,
        *shared.LEVELS,
        shared.RAIN,
        Text(
            "MARGIN_DB",
            "Margins over the sensitivity that polygons tell apart [dB]",
            "--margin-db",
            default="0",
            advanced=True,
            help="Several with commas between, such as 0,10,20",
        ),
        *_OF_THE_LAYER,
        *_FIELD_OF_VIEW,
        *(parameter for parameter in _MORE_DETAIL if parameter is not shared.EFFECTIVE_EARTH),
        *_FILES,
        *shared.running("1G"),
    )


class Skyline(Task):
    """The horizon."""

    name = "skyline"
    title = "Sky line"
    group = SIGHT
    verb = "viewshed"
    guide = "viewsheds.md"
    summary = (
        "Writes an observer's sky line as a table (azimuth, elevation angle, distance) and as a drawn panorama, with "
        "named places in line of sight or hidden."
    )
    parameters = (
        *OBSERVERS,
        _RADIUS,
        Layer("HORIZON_TARGETS", "Places to mark on the horizon", "--horizon-targets", geometry="point"),
        Field(
            "HORIZON_NAME_FIELD", "Field of their names", "--horizon-name-field", of="HORIZON_TARGETS", advanced=True
        ),
        Field(
            "HORIZON_HEIGHT_FIELD",
            "Field of their heights",
            "--horizon-height-field",
            of="HORIZON_TARGETS",
            advanced=True,
        ),
        Number("STEP", "Between azimuths [degrees]", "--horizon-step", default=0.1, unit="deg", minimum=0),
        *_DETAIL,
        FileOutput("OUTPUT", "Sky line", "--horizon", required=True, filter="CSV files (*.csv);;JSON files (*.json)"),
        FileOutput(
            "PANORAMA",
            "Panorama",
            "--horizon",
            default=True,
            filter="SVG files (*.svg);;PNG files (*.png);;PDF files (*.pdf)",
        ),
        _HEIGHT_FIELD,
        _NAME_FIELD,
        shared.OBSERVER_ON,
        *_MORE_DETAIL,
        *shared.running("1G"),
    )


class Visibility(OfWindow):
    """Where most is seen from."""

    name = "visibility"
    title = "Visibility of everywhere (total viewshed)"
    group = SIGHT
    verb = "visibility"
    guide = "viewsheds.md"
    summary = (
        "Tells of every place in an area how much of the ground around is seen from there, with its standard error, and "
        "how much is undecided for want of data. High places for masts, and places that are hidden, show at a glance."
    )
    parameters = (
        shared.STORE,
        *WINDOW,
        Number("CELL", "Distance between observers", "--cell", unit="m", minimum=0, required=True),
        Number("RADIUS", "How far observers look", "--radius", unit="m", minimum=0, required=True),
        Number("OBSERVER_HEIGHT", "Height of observers", "--observer-height", default=2, unit="m"),
        Number("TARGET_HEIGHT", "Height of targets", "--target-height", default=0, unit="m"),
        Number(
            "RAYS",
            "Rays from every observer",
            "--rays",
            default=128,
            minimum=8,
            whole=True,
            advanced=True,
            help="Over a raster at full detail, of whose own cells these are a multiple; elsewhere targets lie at random",
        ),
        Number(
            "TARGETS",
            "Targets at random for every observer, in place of rays",
            "--targets",
            minimum=1,
            whole=True,
            advanced=True,
            help="Left blank: 128, where there can be no rays. Four times as many halve the standard error",
        ),
        *_DETAIL,
        RasterOutput("OUTPUT", "Visibility", "--output", required=True),
        shared.NODATA,
        *shared.EARTH,
        *shared.PAPER_MAP,
        *shared.running("1G"),
    )
