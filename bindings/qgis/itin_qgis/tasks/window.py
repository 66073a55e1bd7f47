"""The window that a task is about."""

from __future__ import annotations

from .parameters import Extent, Layer, Number, Point, Text
from .task import Task

WINDOW = (
    Extent("EXTENT", "Extent", "--bbox", help="Left blank, with no other window: everything that the store covers"),
    Layer("AREA", "Area, instead of an extent", "--polygon", geometry="polygon", help="A layer of polygons"),
    Point("CENTRE", "Centre of a disc, instead of an extent", "--disc", radius="DISC_RADIUS", advanced=True),
    Number("DISC_RADIUS", "Radius of that disc", unit="m", minimum=0, advanced=True),
    Text(
        "WEDGE", "Sector, instead of an extent: x,y,azimuth,width,radius", "--wedge", advanced=True,
        help="Azimuth of its axis and its width in degrees",
    ),
    Text("CORRIDOR", "Strip, instead of an extent: x0,y0,x1,y1,width", "--corridor", advanced=True),
)
"""The window that a task is about. Everything, where none is given."""


class OfWindow(Task):
    """A task about a window of the surface: all of it, unless a window is given."""

    def _implied(self, call: list[str]) -> list[str]:
        options = tuple(parameter.option for parameter in WINDOW if parameter.option)
        return [] if any(word.startswith(options) for word in call) else ["--all"]
