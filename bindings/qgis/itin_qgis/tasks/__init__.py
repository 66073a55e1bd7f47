"""The tasks of planners, without QGIS: what each asks for, and the call of the program that it becomes."""

from __future__ import annotations

from .imports import ImportFeatures, ImportLines, ImportTerrain
from .lines import LineOfSight, Links, Profile
from .premises import Premises
from .sites import SiteMasts
from .stores import Check, Info
from .surfaces import SurfaceMesh, SurfaceRaster
from .task import Task
from .turbines import Dwellings, SiteTurbines, Ztv
from .viewsheds import RadioCoverage, Skyline, Viewshed, Visibility

TASKS: tuple[type[Task], ...] = (
    ImportTerrain,
    ImportLines,
    ImportFeatures,
    Info,
    Check,
    SurfaceRaster,
    SurfaceMesh,
    Viewshed,
    RadioCoverage,
    Skyline,
    Visibility,
    LineOfSight,
    Links,
    Profile,
    SiteMasts,
    Premises,
    Ztv,
    Dwellings,
    SiteTurbines,
)
"""All of them, in the order of the guide."""
