"""Wind turbines: where they are seen from, and where they are seen least."""

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
    Point,
    Text,
)
from .sites import CANDIDATES, CHOICE, DEMAND, SITES_LAYERS
from .task import Task

TURBINES = "Wind turbines"

# The turbines of a layer, and the fields that tell of them.
GIVEN_TURBINES = (
    Layer("TURBINES", "Layer of turbines", "--turbines", geometry="point", required=True, layer_option="--layer"),
    Number("HUB_HEIGHT", "Hub height of those that give none", "--hub-height", unit="m", minimum=0),
    Number("ROTOR_DIAMETER", "Rotor diameter of those that give none", "--rotor-diameter", unit="m", minimum=0),
    Number("TIP_HEIGHT", "Tip height of those that give none", "--tip-height", unit="m", minimum=0),
)
ABOUT_TURBINES = (
    Field("NAME_FIELD", "Field of names", "--name-field", of="TURBINES", advanced=True),
    Field("HUB_HEIGHT_FIELD", "Field of hub heights", "--hub-height-field", of="TURBINES", advanced=True),
    Field(
        "ROTOR_DIAMETER_FIELD",
        "Field of rotor diameters",
        "--rotor-diameter-field",
        of="TURBINES",
        advanced=True,
    ),
    Field("TIP_HEIGHT_FIELD", "Field of tip heights", "--tip-height-field", of="TURBINES", advanced=True),
    Field("FARM_FIELD", "Field of farms", "--farm-field", of="TURBINES", advanced=True),
    Field(
        "STATUS_FIELD",
        "Field that says proposed, consented or existing",
        "--status-field",
        of="TURBINES",
        advanced=True,
    ),
    Text("PROPOSAL", "Farm that is the proposal, where others are in planning", "--proposal", advanced=True),
    Text("FARM", "Farm of those that give none", "--farm", advanced=True),
)


class Ztv(Task):
    """Zones of theoretical visibility."""

    name = "ztv"
    title = "Zone of theoretical visibility"
    group = TURBINES
    verb = "ztv"
    guide = "turbines.md"
    summary = (
        "Fills a folder with what is certainly seen of wind turbines: hub and tip counts, visible heights, angles, "
        "combinations of farms, areas, and for viewpoints tables and wirelines. The turbines have the fields "
        "hub_height and rotor_diameter, or tip_height; farm; name."
    )
    parameters = (
        shared.STORE,
        *GIVEN_TURBINES,
        Number(
            "RADIUS",
            "Radius about each turbine",
            "--radius",
            unit="m",
            minimum=0,
            help="Left blank: by its tip height, 15 to 45 km",
        ),
        Number("CELL", "Size of the cells", "--cell", default=50, unit="m", minimum=0),
        Number("OBSERVER_HEIGHT", "Height of eyes", "--observer-height", default=2, unit="m"),
        shared.TOLERANCE,
        *shared.STANDING,
        Layer("VIEWPOINTS", "Layer of viewpoints, for tables and wirelines", "--viewpoints", geometry="point"),
        FolderOutput(
            "OUTPUT",
            "Folder of results",
            "--output",
            required=True,
            layers=(
                "layers.gpkg",
                "hub-count.gpkg",
                "tip-count.gpkg",
                "tip-count*.tif",
                "hub-count*.tif",
                "visible-height*.tif",
            ),
            seen=("turbines", "viewpoints", "study_area", "tip-count.tif"),
        ),
        shared.OVERWRITE,
        shared.LOAD_RESULTS,
        Layer("ROUTE", "Layer of roads or paths", "--route", geometry="line", advanced=True),
        Number("EVERY", "Distance between places along them", "--every", default=100, unit="m", advanced=True),
        Layer(
            "LINKS",
            "Radio links that rotors must stay clear of",
            "--links",
            geometry="line or table",
            advanced=True,
        ),
        Number("FREQUENCY", "Frequency of these links [GHz]", "--frequency", unit="GHz", minimum=0, advanced=True),
        Point("RADAR", "Radar", "--radar", height="RADAR_HEIGHT", advanced=True),
        Number("RADAR_HEIGHT", "Height of the radar above the ground", unit="m", advanced=True),
        *ABOUT_TURBINES,
        Text("BANDS", "Numbers of turbines in bands of maps, as 1,5,10", "--bands", advanced=True),
        File("RADIUS_PRESET", "Radii by tip height", "--radius-preset", filter="JSON (*.json)", advanced=True),
        Number(
            "WIRELINE_FIELD",
            "Least width of a wireline [degrees]",
            "--wireline-field",
            default=53.5,
            unit="deg",
            advanced=True,
        ),
        Number(
            "WIRELINE_BEARING",
            "Bearing of every wireline's middle [degrees]",
            "--wireline-bearing",
            unit="deg",
            advanced=True,
        ),
        Flag("WIRELINE_HIDDEN", "Draw hidden parts dashed in wirelines", "--wireline-hidden", advanced=True),
        Text(
            "WIRELINE_BLADES",
            "Blades are turned from upright by degrees, or random",
            "--wireline-blades",
            default="0",
            advanced=True,
        ),
        Text("WIRELINE_PAIRS", "Sheets in pairs: this farm alone above", "--wireline-pairs", advanced=True),
        Text("WIRELINES", "Wirelines from these viewpoints only", "--wirelines", advanced=True),
        Flag("NO_WIRELINES", "Tables of viewpoints, without wirelines", "--no-wirelines", advanced=True),
        shared.LIKE,
        *shared.SEASONS,
        shared.NODATA,
        *shared.EARTH,
        *shared.PAPER_MAPS,
        *shared.running("no limit"),
    )


class Dwellings(Task):
    """What turbines are to dwellings."""

    name = "dwellings"
    title = "Wind turbines at dwellings"
    group = TURBINES
    verb = "dwellings"
    guide = "dwellings.md"
    summary = (
        "Tells what dwellings see of wind turbines, facade by facade, over the bare ground and past what stands on it, and "
        "when their shadows flicker there, minute by minute of a year: hours, worst days, a calendar, and what exceeds "
        "the limits. The turbines have the fields hub_height and rotor_diameter; name."
    )
    parameters = (
        shared.STORE,
        *GIVEN_TURBINES,
        Layer(
            "DWELLINGS",
            "Layer of dwellings",
            "--dwellings",
            geometry="point",
            help="Left blank: all buildings of the store",
        ),
        Number("RADIUS", "How far from a turbine dwellings are studied", "--radius", default=2000, unit="m", minimum=0),
        Number("YEAR", "Year", "--year", minimum=1950, whole=True, help="Left blank: the year of the run"),
        Text("TIME_ZONE", "Hours that the clock is ahead of UTC, as +1", "--time-zone", default="UTC"),
        Text("LIMITS", "Limits for a year and for a day", "--limits", default="30h,30min"),
        File("MONTHS", "Shares of sunshine and operation by month", "--months", filter="CSV (*.csv)"),
        *shared.STANDING,
        FolderOutput(
            "OUTPUT",
            "Folder of results",
            "--output",
            required=True,
            layers=("dwellings.gpkg",),
            seen=("dwellings", "turbines"),
        ),
        shared.OVERWRITE,
        shared.LOAD_RESULTS,
        Text("DWELLING_THEME", "Theme whose buildings are dwellings", "--dwelling-theme", advanced=True),
        Number("OBSERVER_HEIGHT", "Height of eyes", "--observer-height", default=2, unit="m", advanced=True),
        Number(
            "SUN_ELEVATION",
            "Least elevation of the sun [degrees]",
            "--sun-elevation",
            default=3,
            unit="deg",
            minimum=1,
            advanced=True,
        ),
        Number("FLICKER_REACH", "Reach of shadows, in diameters of the rotor", "--flicker-reach", default=10, advanced=True),
        Number("BLADE_WIDTH", "Mean width of a blade, for the reach instead", "--blade-width", unit="m", advanced=True),
        *ABOUT_TURBINES,
        Text("SHEETS_OF", "Sheets of these dwellings only: names or ids", "--sheets-of", advanced=True),
        *shared.SEASONS,
        shared.NODATA,
        *shared.EARTH,
        *shared.PAPER_MAPS,
        *shared.running("1G"),
    )


class SiteTurbines(Task):
    """Where turbines are seen least."""

    name = "siteturbines"
    title = "Place wind turbines where they are seen least"
    group = TURBINES
    verb = "site"
    guide = "turbines.md"
    summary = (
        "Chooses places for wind turbines, out of a layer of candidates or an area, so that the demand sees least of "
        "them, with a bound on the best there is. Keeps away from dwellings and from each other."
    )
    words = ("--turbines",)
    parameters = (
        shared.STORE,
        *CANDIDATES,
        Number("HUB_HEIGHT", "Hub height", "--hub-height", unit="m", minimum=0),
        Number("ROTOR_DIAMETER", "Rotor diameter", "--rotor-diameter", unit="m", minimum=0),
        Number("TIP_HEIGHT", "Tip height, in place of these", "--tip-height", unit="m", minimum=0),
        Number("COUNT", "How many turbines to place", "--count", minimum=1, whole=True),
        Choice("MINIMISE", "What is to be least", "--minimise", choices=("tips", "hubs", "height")),
        Text(
            "ROTOR_SPACING",
            "Rotor diameters between turbines: along the wind x across it, as 5x3",
            "--rotor-spacing",
        ),
        Number("WIND_FROM", "Where the wind comes from [degrees]", "--wind-from", unit="deg"),
        Layer("DWELLINGS", "Dwellings to keep away from", "--dwellings", geometry="any"),
        Number("SETBACK", "Distance from dwellings", "--setback", unit="m", minimum=0),
        Number(
            "RADIUS", "How far turbines are looked for", "--radius", unit="m", minimum=0, help="Left blank: by their tips"
        ),
        *DEMAND,
        FolderOutput(
            "OUTPUT",
            "Folder of results",
            "--output",
            required=True,
            layers=("turbines.gpkg", *SITES_LAYERS),
            seen=("turbines", "coverage.tif"),
            page="report.html",
        ),
        shared.OVERWRITE,
        shared.LOAD_RESULTS,
        Text("FARM", "Name of the farm", "--farm", default="proposed", advanced=True),
        *CHOICE,
        shared.NODATA,
        *shared.EARTH,
        shared.ENGINE,
        *shared.PAPER_MAPS,
        *shared.running("1G"),
    )
