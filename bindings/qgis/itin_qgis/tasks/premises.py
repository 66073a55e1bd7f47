"""Premises that masts serve."""

from __future__ import annotations

from . import shared
from .parameters import Field, FolderOutput, Layer, Number, Text
from .sites import MASTS
from .task import Task


class Premises(Task):
    """Which buildings masts serve."""

    name = "premises"
    title = "Premises that masts serve"
    group = MASTS
    verb = "premises"
    guide = "premises.md"
    summary = (
        "Tells which buildings of the store given masts serve, from which height on which wall or from which pole on "
        "the roof, and what stands in the way of the rest."
    )
    parameters = (
        shared.STORE,
        Layer("MASTS", "Layer of masts", "--masts", geometry="point", required=True, layer_option="--layer"),
        Number("MAST_HEIGHT", "Height of masts that give none", "--mast-height", default=20, unit="m", minimum=0),
        Number("RADIUS", "How far a mast serves", "--radius", default=1000, unit="m", minimum=0),
        Number("FREQUENCY", "Frequency [GHz]", "--frequency", unit="GHz", minimum=0, help="Left blank: light"),
        shared.FRESNEL,
        shared.EFFECTIVE_EARTH,
        *shared.STANDING,
        FolderOutput(
            "OUTPUT",
            "Folder of results",
            "--output",
            required=True,
            layers=("premises.gpkg",),
            seen=("facades", "premises", "masts"),
        ),
        shared.OVERWRITE,
        shared.LOAD_RESULTS,
        Field("HEIGHT_FIELD", "Field of heights", "--height-field", of="MASTS", advanced=True),
        Field("NAME_FIELD", "Field of names", "--name-field", of="MASTS", advanced=True),
        Number("SPACING", "Distance between places", "--spacing", default=1, unit="m", minimum=0, advanced=True),
        Number("REVEAL", "Antennas before walls", "--reveal", default=0.3, unit="m", minimum=0, advanced=True),
        Number("STOREY", "Storeys of antennas", "--storey", default=3, unit="m", minimum=0, advanced=True),
        Text("POLE", "Heights of poles on roofs [m]", "--pole", default="0,5", advanced=True),
        Number(
            "SETBACK",
            "How far before its walls the street lies",
            "--setback",
            unit="m",
            minimum=0,
            advanced=True,
            help="Adds roofs.csv: how high poles must be to see the street",
        ),
        *shared.TITLE_BLOCK,
        shared.OBSERVER_ON,
        shared.NODATA,
        shared.CURVATURE,
        shared.REFRACTION,
        shared.EARTH_RADIUS,
        *shared.running("1G"),
    )
