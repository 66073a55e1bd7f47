"""Single lines: sections of the surface, lines of sight, radio links."""

from __future__ import annotations

from . import shared
from .parameters import (
    FileOutput,
    Flag,
    FolderOutput,
    Layer,
    Number,
    Parameter,
    Point,
    Text,
    Texts,
    VectorOutput,
)
from .task import Task

LINES = "Lines and links"

_RADIO: tuple[Parameter, ...] = (
    Number("FREQUENCY", "Frequency [GHz]", "--frequency", unit="GHz", minimum=0, help="Left blank: light, no radio"),
    Texts(
        "CRITERIA",
        "Criteria of clearance, as 4/3:0.6 1:0.3",
        "--criterion",
        help="An effective Earth factor K and the share of the first Fresnel zone that must be clear there; ke for the "
        "factor of the worst month",
    ),
    shared.EFFECTIVE_EARTH,
    Number(
        "EFFECTIVE_EARTH_KM",
        "Radius of the effective Earth [km], in place of K",
        "--effective-earth-km",
        unit="km",
        minimum=0,
        advanced=True,
    ),
    shared.POLARISATION,
    shared.OVER_SEA,
)
_BUDGET: tuple[Parameter, ...] = (
    *shared.LEVELS,
    shared.RAIN,
    Number("GEOCLIMATIC_FACTOR", "Geoclimatic factor K of P.530-17", "--geoclimatic-factor", minimum=0, advanced=True),
    Number(
        "REFRACTIVITY_GRADIENT",
        "Gradient of refractivity dN1 [N/km], in place of K",
        "--refractivity-gradient",
        advanced=True,
        help="Not exceeded for 1 % of an average year in the lowest 65 m; negative",
    ),
)
_EARTH: tuple[Parameter, ...] = (shared.CURVATURE, shared.REFRACTION, shared.EARTH_RADIUS)
_ENDS: tuple[Parameter, ...] = (
    shared.OBSERVER_ON,
    shared.TARGET_ON,
    Flag("ABSOLUTE_HEIGHTS", "Heights of both ends are elevations", "--absolute-heights", advanced=True),
    Flag("OBSERVER_ABSOLUTE", "The first end's height is an elevation", "--observer-absolute", advanced=True),
    Flag("TARGET_ABSOLUTE", "The second end's height is an elevation", "--target-absolute", advanced=True),
)
_OBJECT = Text(
    "VISIBLE_HEIGHT",
    "How much is seen of an object this tall at the second end",
    "--visible-height",
    advanced=True,
    help="Its tip in metres; of a turbine hub,tip",
)
_REPORTS: tuple[Parameter, ...] = (
    Text("TITLE", "Title of the report", "--title", advanced=True),
    Text("PROJECT", "Project, for the head of the report", "--project", advanced=True),
    Text("OPERATOR", "Who answers for the report", "--operator", advanced=True),
    Text("DATE", "Date of the report", "--date", advanced=True, help="For a day, magnetic azimuths are given"),
    Text(
        "TABLE_SPACING",
        "Metres between rows of the profile in reports, or none",
        "--table-spacing",
        advanced=True,
    ),
)
_MEMORY = shared.running()


class LineOfSight(Task):
    """One line."""

    name = "lineofsight"
    title = "Line of sight"
    group = LINES
    verb = "los"
    prints = True
    guide = "lines.md"
    summary = (
        "Says whether two places see each other, what hides them, which heights would be needed, and with a frequency "
        "the clearance of the Fresnel zone and the loss by diffraction; as a report and as a layer."
    )
    parameters = (
        shared.STORE,
        Point("FROM", "First end", "--from", required=True, height="FROM_HEIGHT"),
        Number("FROM_HEIGHT", "Height of the first end", default=2, unit="m"),
        Point("TO", "Second end", "--to", required=True, height="TO_HEIGHT"),
        Number("TO_HEIGHT", "Height of the second end", default=2, unit="m"),
        *_RADIO,
        *_BUDGET,
        shared.TOLERANCE,
        *shared.STANDING,
        FileOutput(
            "OUTPUT", "Line of sight", "--report", required=True, shown=True, filter="GeoPackages (*.gpkg)"
        ),
        FileOutput("REPORT", "Report", "--report", default=True, filter="HTML files (*.html)"),
        FileOutput(
            "FURTHER_REPORT",
            "The report in another form",
            "--report",
            filter="PDF files (*.pdf);;SVG files (*.svg);;PNG files (*.png);;CSV files (*.csv);;JSON files (*.json);;"
            "KML files (*.kml);;Text files (*.txt)",
        ),
        _OBJECT,
        Text("FROM_NAME", "What the first end is called", "--from-name", advanced=True),
        Text("TO_NAME", "What the second end is called", "--to-name", advanced=True),
        *_REPORTS,
        *_ENDS,
        *shared.FOLIAGE,
        shared.RINGS,
        shared.NODATA,
        *_EARTH,
        *_MEMORY,
    )


class Links(Task):
    """Many lines."""

    name = "links"
    title = "Links"
    group = LINES
    verb = "los"
    guide = "lines.md"
    summary = (
        "Judges many links at once: each line of a layer, or each row of a table id,x1,y1,h1,x2,y2,h2. Fails, after "
        "all are written, where one of them could not be judged."
    )
    parameters = (
        shared.STORE,
        Layer(
            "LINKS",
            "Layer of lines, or a table of links",
            "--links",
            geometry="line or table",
            required=True,
            layer_option="--layer",
        ),
        Number(
            "LINK_HEIGHT",
            "Height of both ends of lines",
            "--link-height",
            unit="m",
            help="Left blank: 2. A table has heights of its own",
        ),
        *_RADIO,
        *_BUDGET,
        shared.TOLERANCE,
        *shared.STANDING,
        VectorOutput("OUTPUT", "Links", "--output", required=True),
        FileOutput("TABLE", "Table of links", "--output", filter="CSV files (*.csv)"),
        FileOutput(
            "SUMMARY",
            "Page that sums them up",
            "--output",
            filter="PDF files (*.pdf);;KML files (*.kml)",
        ),
        FolderOutput("REPORTS", "Reports of each link (PDF)", "--report", suffix="/{id}.pdf", advanced=True),
        _OBJECT,
        *_REPORTS,
        *_ENDS,
        shared.NODATA,
        *_EARTH,
        *_MEMORY,
    )


class Profile(Task):
    """A section of the surface."""

    name = "profile"
    title = "Profile"
    group = LINES
    verb = "profile"
    guide = "lines.md"
    summary = (
        "Writes the cross-section of the surface between two places or along the line of a layer: every edge of a "
        "triangle that is crossed, with nothing sampled. Several tolerances give several profiles side by side."
    )
    parameters = (
        shared.STORE,
        Point("FROM", "Where the line begins", "--from"),
        Point("TO", "Where it ends", "--to"),
        Layer("PATH", "Layer with one line, instead", "--path", geometry="line"),
        Texts(
            "TOLERANCES",
            "Tolerances of the surface [m], with blanks between them",
            "--tolerance",
            default="0",
            help="0: every stored point",
        ),
        *shared.STANDING,
        FileOutput("OUTPUT", "Profile", "--output", required=True, shown=True, filter="GeoJSON (*.geojson)"),
        FileOutput(
            "CHART",
            "Chart",
            "--output",
            default=True,
            filter="SVG files (*.svg);;PNG files (*.png);;PDF files (*.pdf)",
        ),
        FileOutput("TABLE", "Table", "--output", filter="CSV files (*.csv);;JSON files (*.json);;Text files (*.txt)"),
        FileOutput(
            "TRIANGLES",
            "Triangles that the line crosses",
            "--triangles",
            advanced=True,
            filter="GeoPackages (*.gpkg);;GeoJSON (*.geojson);;Mesh layers (*.2dm)",
        ),
        *shared.ON_PATHS,
        shared.RINGS,
        *_MEMORY,
    )
