"""What calls ask for: values that several of them take, and how they are handed to the libraries."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, Literal, NamedTuple

from numpy.typing import ArrayLike

from . import _itin
from ._errors import InputError

Path = str | os.PathLike[str]
"""A file or folder."""

Progress = Callable[[str, float], object]
"""Called about every 50 ms with what a call is doing and the share that is done, 0 to 1. What it raises ends the call."""

Themes = str | Sequence[str]
"""Features that stand on the surface: ``"all"``, ``"none"``, or names."""

Features = str | Sequence[str]
"""Features that do not stand there: one, or several, by the names that reports print."""

NoData = Literal["unknown", "block", "clear"]
"""What ground without data does to sight lines: they are undecided unless known ground hides them, none pass, or all."""

Angles = tuple[float, float]
"""From, to, in degrees. Azimuths are clockwise from grid north, elevations above the horizontal."""


class Verdict(IntEnum):
    """The numbers in arrays of verdicts, and in rasters."""

    HIDDEN = 0
    VISIBLE = 1
    UNDECIDED = 2
    """At the detail asked for, or for want of ground."""
    ZONE_CUT = 3
    """In sight, but something rises into the Fresnel zone."""
    OUTSIDE = 255
    """Outside every field of view, or no ground; a link that could not be computed."""


class Bounds(NamedTuple):
    """An area, metres, in the order of rasterio's bounds."""

    xmin: float
    ymin: float
    xmax: float
    ymax: float


@dataclass(frozen=True)
class Earth:
    """Curvature and refraction: drop = d² (1 - k) / (2 R), or d² / (2 K R) with an effective Earth factor K.

    Attributes:
        curvature: Whether the Earth is curved.
        refraction: The coefficient k, below 1. Light has about 0.13.
        radius: R, metres. None: 6371000, or that of the Moon, Mars, ... where the store's CRS is of these.
        effective_factor: Radio's K, as ``4 / 3``, in place of k.
    """

    curvature: bool = True
    refraction: float = 0.13
    radius: float | None = None
    effective_factor: float | None = None

    @staticmethod
    def flat() -> Earth:
        """The plane."""
        return Earth(curvature=False)

    @staticmethod
    def effective_earth(factor: float) -> Earth:
        """Radio's Earth of this factor K."""
        return Earth(effective_factor=factor)


@dataclass(frozen=True)
class Grid:
    """The cells of a raster: north is up, row 0 is the northernmost.

    Attributes:
        west: Easting of the western edge, metres.
        north: Northing of the northern edge, metres.
        cell_width: Metres.
        cell_height: Metres, positive.
        columns: Cells from west to east.
        rows: Cells from north to south.
    """

    west: float
    north: float
    cell_width: float
    cell_height: float
    columns: int
    rows: int

    @staticmethod
    def from_transform(transform: Sequence[float], width: int, height: int) -> Grid:
        """Makes the grid of rasterio's ``transform``, ``width`` and ``height``. Raises InputError for one that is turned."""
        a, b, c, d, e, f = tuple(transform)[:6]
        if b != 0 or d != 0 or a <= 0 or e >= 0:
            raise InputError("`transform`: its rows do not run from west to east and north to south", "transform")
        return Grid(c, f, a, -e, width, height)

    @property
    def transform(self) -> tuple[float, float, float, float, float, float]:
        """The six numbers of rasterio's transform: ``rasterio.Affine(*grid.transform)``."""
        return (self.cell_width, 0.0, self.west, 0.0, -self.cell_height, self.north)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows, columns: the shape of arrays over the grid."""
        return (self.rows, self.columns)

    @property
    def bounds(self) -> Bounds:
        """The outer edges."""
        return Bounds(
            self.west,
            self.north - self.rows * self.cell_height,
            self.west + self.columns * self.cell_width,
            self.north,
        )


@dataclass(frozen=True)
class Observer:
    """An observer of a viewshed.

    Attributes:
        x: Easting, in the store's CRS, metres.
        y: Northing, metres.
        height: Metres above the ground; an elevation where ``absolute``.
        name: For messages and the names of bands.
        absolute: Whether ``height`` is an elevation.
        target_height: The height of this observer's targets, where it is not that of the call. So are
            ``radius``, ``min_radius``, ``azimuth`` and ``elevation``.
        antenna: In mode ``level``, the file of the pattern of this observer's antenna, where it is not that of the
            call. So are ``antenna_azimuth`` and ``antenna_tilt``, degrees.
    """

    x: float
    y: float
    height: float = 2.0
    name: str = ""
    absolute: bool = False
    target_height: float | None = None
    radius: float | None = None
    min_radius: float | None = None
    azimuth: Angles | None = None
    elevation: Angles | None = None
    antenna: Path | None = None
    antenna_azimuth: float | None = None
    antenna_tilt: float | None = None


@dataclass(frozen=True)
class Sector:
    """An antenna of a mast that has several, for link budgets. What it does not have is that of the call.

    Attributes:
        name: For tables.
        antenna: The file of its pattern, .msi or .ant.
        antenna_azimuth: Where it points, degrees from grid north.
        antenna_tilt: Degrees below the horizontal.
    """

    name: str = ""
    antenna: Path | None = None
    antenna_azimuth: float | None = None
    antenna_tilt: float | None = None


@dataclass(frozen=True)
class Place:
    """A candidate for a site, an existing site, or a point of the demand.

    Attributes:
        x: Easting, in the store's CRS, metres.
        y: Northing, metres.
        name: For tables and messages. Candidates without one have their numbers, from 0.
        height: Metres above what it stands on. None: the height of the call.
        cost: The cost of a candidate's place, without its mast.
        weight: The weight of a point of the demand.
        sectors: The antennas of a candidate or an existing site that has its own.
    """

    x: float
    y: float
    name: str = ""
    height: float | None = None
    cost: float = 0.0
    weight: float = 1.0
    sectors: Sequence[Sector] = ()


@dataclass(frozen=True)
class Turbine:
    """A wind turbine. Two of its sizes imply the third; heights are metres above the ground at its foot.

    Attributes:
        x: Easting, in the store's CRS, metres.
        y: Northing, metres.
        tip_height: Metres.
        hub_height: Metres.
        rotor_diameter: Metres.
        name: For tables.
        farm: The wind farm that it is part of.
        radius: How far away it is looked for, metres. None: by its tip, as ``itin ztv`` has it.
    """

    x: float
    y: float
    tip_height: float | None = None
    hub_height: float | None = None
    rotor_diameter: float | None = None
    name: str = ""
    farm: str = ""
    radius: float | None = None


@dataclass(frozen=True)
class TurbinesToPlace:
    """The wind turbines that ``Store.site()`` places where they are seen least. Two of their sizes imply the third.

    Attributes:
        tip_height: Metres above the ground at their feet, as ``hub_height`` is.
        hub_height: Metres.
        rotor_diameter: Metres.
        minimise: What is to be least: the demand that sees a tip, or a hub; or the visible height of all turbines.
        spacing: No turbine stands within an ellipse about another: half its axes along and across the wind, metres, and
            the direction that the wind comes from, degrees.
        dwellings: Positions, shape (n, 2), that turbines keep ``setback`` metres away from.
        setback: Metres.
        farm: The farm's name in tables.
    """

    tip_height: float | None = None
    hub_height: float | None = None
    rotor_diameter: float | None = None
    minimise: Literal["tips", "hubs", "height"] = "tips"
    spacing: tuple[float, float, float] | None = None
    dwellings: ArrayLike | None = None
    setback: float = 0.0
    farm: str = "proposed"


Window = _itin.Window


def fields_of(value: object) -> dict[str, Any]:
    """Returns the fields of a dataclass that are not None."""
    return given(vars(value))


def given(fields: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the fields that are not None, in the form that the libraries' fields are read from."""
    return {name: _plain(value) for name, value in fields.items() if value is not None}


def _plain(value: Any) -> Any:
    if isinstance(value, Earth):
        return (value.curvature, value.refraction, value.radius, value.effective_factor)
    if isinstance(value, Grid):
        return tuple_of(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value


def tuple_of(grid: Grid) -> tuple[float, float, float, float, int, int]:
    """Returns a grid as the libraries' grids are made from."""
    return (grid.west, grid.north, grid.cell_width, grid.cell_height, grid.columns, grid.rows)


def list_of(features: Features) -> list[str]:
    """Returns the names of features."""
    return [features] if isinstance(features, str) else list(features)


def names_of(themes: Themes) -> str:
    """Returns the text of a choice of themes."""
    return themes if isinstance(themes, str) else ",".join(themes) or "none"
