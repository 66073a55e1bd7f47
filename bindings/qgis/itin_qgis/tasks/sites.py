"""Sites for masts."""

from __future__ import annotations

from . import shared
from .parameters import (
    Choice,
    Field,
    File,
    Flag,
    FolderOutput,
    Layer,
    Number,
    Parameter,
    Point,
    Raster,
    Text,
)
from .task import Task

MASTS = "Masts"

SITES_LAYERS = ("sites.gpkg", "best-server.tif", "redundancy.tif", "coverage.tif")
"""Results of a choice of sites, the topmost first."""

CANDIDATES: tuple[Parameter, ...] = (
    Layer("CANDIDATES", "Layer of candidates", "--candidates", geometry="point", layer_option="--layer"),
    Layer("SEARCH_AREA", "Area to propose candidates in, instead", "--search-area", geometry="polygon"),
    Number(
        "SPACING",
        "Propose about two candidates in each square of this side",
        "--spacing",
        unit="m",
        minimum=0,
        help="Of turbines one, in its middle",
    ),
)

DEMAND: tuple[Parameter, ...] = (
    Layer("DEMAND_POINTS", "Points of demand", "--demand", geometry="point", help="Left blank: all cells within reach"),
    Raster("DEMAND_RASTER", "Raster of weights, instead", "--demand"),
    Field("WEIGHT_FIELD", "Field of the points' weights", "--weight-field", of="DEMAND_POINTS", advanced=True),
    Number("TARGET_HEIGHT", "Height of targets", "--target-height", unit="m", help="Left blank: the field height, or 2"),
    Number("CELL", "Size of the cells", "--cell", default=50, unit="m", minimum=0),
    *shared.STANDING,
)

CHOICE: tuple[Parameter, ...] = (
    Field("NAME_FIELD", "Field of candidates' names", "--name-field", of="CANDIDATES", advanced=True),
    Number("MIN_SPACING", "Least distance between chosen sites", "--min-spacing", unit="m", minimum=0, advanced=True),
    Layer("EXISTING", "Layer of those that stand already", "--existing", geometry="point", advanced=True),
    Layer("FORBIDDEN", "Layer of forbidden areas", "--forbidden", geometry="polygon", advanced=True),
    Choice(
        "EXACT_FINAL",
        "Coverage of the chosen sites is exact",
        "--exact-final",
        choices=("on", "off"),
        default="on",
        advanced=True,
    ),
    Choice(
        "SWAP", "Exchange chosen sites for better ones", "--swap", choices=("on", "off"), default="on", advanced=True
    ),
    Number(
        "TOLERANCE",
        "Tolerance of the first estimate",
        "--tolerance",
        unit="m",
        minimum=0,
        advanced=True,
        help="The choice is made on exact coverage all the same",
    ),
    File("PARAMS", "Options from a file", "--params", filter="JSON (*.json)", advanced=True),
    Flag("RESUME", "Go on where an earlier run was stopped", "--resume", advanced=True),
)


class SiteMasts(Task):
    """The few best of many sites."""

    name = "sitemasts"
    title = "Choose sites for masts"
    group = MASTS
    verb = "site"
    guide = "sites.md"
    summary = (
        "Chooses the few best of many sites, out of a layer of candidates or of places proposed in an area, with a "
        "bound on the best there is. Give how many, a budget, or the share of the demand that is to be served."
    )
    parameters = (
        shared.STORE,
        *CANDIDATES,
        Text("MAST_HEIGHT", "Height of masts [m], or several to choose from", "--mast-height", default="20"),
        Number("COUNT", "How many sites to choose", "--count", minimum=1, whole=True),
        Number("BUDGET", "Budget, instead", "--budget", minimum=0),
        Text("SHARE", "Share of the demand to be served, instead, as 80%", "--share"),
        Number("RADIUS", "How far a site serves", "--radius", default=10000, unit="m", minimum=0),
        *DEMAND,
        Number("FREQUENCY", "Frequency [GHz]", "--frequency", unit="GHz", minimum=0, help="Left blank: light"),
        shared.FRESNEL,
        *shared.LEVELS,
        shared.RAIN,
        Number(
            "MARGIN_DB",
            "Link budget: margin over the sensitivity that serves [dB]",
            "--margin-db",
            default=0,
            advanced=True,
        ),
        FolderOutput(
            "OUTPUT",
            "Folder of results",
            "--output",
            required=True,
            layers=SITES_LAYERS,
            seen=("sites", "links", "demand", "coverage.tif"),
            page="report.html",
        ),
        shared.OVERWRITE,
        shared.LOAD_RESULTS,
        Text("MAST_COST", "Costs of these heights", "--mast-cost", advanced=True),
        Field("HEIGHT_FIELD", "Field of candidates' heights", "--height-field", of="CANDIDATES", advanced=True),
        Field("COST_FIELD", "Field of candidates' costs", "--cost-field", of="CANDIDATES", advanced=True),
        Number(
            "K_COVER",
            "Sites that must serve a target",
            "--k-cover",
            default=1,
            minimum=1,
            whole=True,
            advanced=True,
        ),
        Flag("INTERVISIBLE", "Chosen sites reach each other by links", "--intervisible", advanced=True),
        Point("HUB", "Hub that chosen sites reach by links", "--hub", height="HUB_HEIGHT", advanced=True),
        Number("HUB_HEIGHT", "Height of the hub", unit="m", advanced=True),
        Flag("PREMISES", "The buildings of the themes are the demand", "--demand", means="premises", advanced=True),
        Number(
            "PLACE_SPACING",
            "Premises: distance between places of antennas",
            "--place-spacing",
            default=1,
            unit="m",
            minimum=0,
            advanced=True,
        ),
        Number("REVEAL", "Premises: antennas before walls", "--reveal", default=0.3, unit="m", minimum=0, advanced=True),
        Number(
            "STOREY", "Premises: storeys of antennas", "--storey", default=3, unit="m", minimum=0, advanced=True
        ),
        Text("POLE", "Premises: heights of poles on roofs [m]", "--pole", default="0,5", advanced=True),
        *CHOICE,
        shared.OBSERVER_ON,
        shared.TARGET_ON,
        shared.NODATA,
        *shared.EARTH,
        shared.ENGINE,
        *shared.PAPER_MAPS,
        *shared.running("1G"),
    )
