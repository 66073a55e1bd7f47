"""The surface itself: as a raster, as a mesh."""

from __future__ import annotations

from . import shared
from .parameters import FileOutput, Flag, Number, RasterOutput, Text
from .window import WINDOW, OfWindow

SURFACE = "Surface"


class SurfaceRaster(OfWindow):
    """Heights of the surface."""

    name = "surfaceraster"
    title = "Surface as a raster"
    group = SURFACE
    verb = "tin"
    guide = "triangulations.md"
    summary = "Writes the heights of the surface, at a tolerance and with what stands on it, as a raster."
    parameters = (
        shared.STORE,
        *WINDOW,
        Number("CELL", "Size of the cells", "--cell", unit="m", minimum=0),
        shared.LIKE,
        shared.TOLERANCE,
        shared.RINGS,
        *shared.STANDING,
        RasterOutput("OUTPUT", "Heights of the surface", "--output", required=True),
        *shared.running("no limit"),
    )


class SurfaceMesh(OfWindow):
    """Triangles of the surface."""

    name = "surfacemesh"
    title = "Surface as a mesh"
    group = SURFACE
    verb = "tin"
    guide = "triangulations.md"
    summary = (
        "Writes the triangles of the surface as a mesh layer (.2dm), which QGIS shows in 2D and 3D, or as .gpkg, "
        ".ply, .obj, .glb or .geojson; or lines of themes, simplified as the surface is."
    )
    parameters = (
        shared.STORE,
        *WINDOW,
        shared.TOLERANCE,
        shared.RINGS,
        *shared.STANDING,
        Text(
            "LINES",
            "Lines of these themes, in place of triangles",
            "--lines",
            advanced=True,
            help="Names with commas between them; to a file .gpkg or .geojson",
        ),
        Text(
            "TOPOLOGY", "Structure of the triangulation, to a file .json", "--topology", advanced=True,
            help="triangle, vertex or edge",
        ),
        FileOutput(
            "OUTPUT",
            "Triangles",
            "--output",
            required=True,
            shown=True,
            filter="Mesh layers (*.2dm);;GeoPackages (*.gpkg);;GeoJSON (*.geojson);;PLY (*.ply);;OBJ (*.obj);;"
            "GLB (*.glb);;Topology (*.json)",
        ),
        FileOutput("IMAGE", "Picture of the surface", "--image", filter="PNG files (*.png);;JPEG files (*.jpg)"),
        Flag("EDGES", "Draw the triangles into the picture", "--edges", advanced=True),
        Text(
            "EYE",
            "Draw the picture as seen from x,y,height",
            "--eye",
            advanced=True,
            help="Height above the ground. Left blank: seen from afar",
        ),
        Text("LOOK", "Where the picture's viewer looks: azimuth,degrees", "--look", default="340,40", advanced=True),
        Number("FIELD", "Width of a view from an eye [degrees]", "--field", default=60, unit="deg", advanced=True),
        *shared.running("no limit"),
    )
