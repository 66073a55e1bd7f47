"""What calls return. Arrays over a grid are views of what the result holds: no values are copied, none can be changed."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _itin
from ._asked import Grid, Path, Progress, Verdict, given

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class Level:
    """A level of detail of a store.

    Attributes:
        tolerance: Metres; 0 is the full surface.
        vertices: Vertices whose coarsest level this is.
        certified_error: The full surface lies within these bounds of the level's, (lowest, highest), metres.
    """

    tolerance: float
    vertices: int
    certified_error: tuple[float, float]


@dataclass(frozen=True)
class Theme:
    """A theme of a store: buildings, contours, ...

    Attributes:
        name: As in ``themes=``.
        kind: ``"buildings"``, ``"vegetation"``, ``"contours"``, ...
        features: How many of them the store has.
        stands: Whether its features stand on the ground.
        left_out: How many further features its imports left out, outside the terrain, say, or without a height. It is 0
            for themes that do not stand.
    """

    name: str
    kind: str
    features: int
    stands: bool
    left_out: int


@dataclass(frozen=True)
class Tin:
    """Triangles of the surface.

    Attributes:
        vertices: Easting, northing and elevation, metres; shape (n, 3).
        triangles: Indices into ``vertices``, counterclockwise seen from above; shape (m, 3).
        themes: The theme that each triangle is part of, from 1 in the order of ``Store.themes``; 0: ground; shape (m,).
        sources: The number of each vertex's source, from 0; shape (n,).
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    themes: NDArray[np.uint16]
    sources: NDArray[np.uint16]


@dataclass(frozen=True)
class Profile:
    """The surface along a path: every crossing of a triangle's edge, nothing sampled. All arrays have the shape (n,).

    Attributes:
        length: Metres.
        distance: Metres along the path, ascending.
        x: Easting, metres.
        y: Northing, metres.
        z: Elevation, metres.
        theme: The theme that stands there, from 1; 0: ground.
        gaps: Parts without ground, (from, to), metres along the path; shape (k, 2).
    """

    length: float
    distance: NDArray[np.float64]
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    z: NDArray[np.float64]
    theme: NDArray[np.uint16]
    gaps: NDArray[np.float64]


@dataclass(frozen=True)
class Foliage:
    """The foliage on a line of sight, or along a path.

    Attributes:
        length: Metres.
        transmittance: The share of the light that comes through, or would come along all of the path; 0 to 1.
    """

    length: float
    transmittance: float


def _foliage(told: tuple[float, float] | None) -> Foliage | None:
    return None if told is None else Foliage(*told)


class PathProfile(Profile):
    """The surface along a path, which can be written."""

    _core: _itin.PathProfiles

    def __init__(self, core: _itin.PathProfiles) -> None:
        super().__init__(*core.profile)
        object.__setattr__(self, "_core", core)

    @property
    def foliage(self) -> Foliage | None:
        """The foliage on the path, which keeps to the ground: its length in plan. None where woods were not asked for."""
        return _foliage(self._core.foliage)

    def write(self, path: Path, *, overwrite: bool = False) -> None:
        """Writes what ``itin profile -o`` writes: .csv, .json, .geojson, .txt, or a chart: .svg, .pdf, .png.

        The bytes are those of ``itin profile``, but for .json, which has no call.

        Raises:
            InputError: Another ending.
            FileError: The place cannot be written, or the file exists and ``overwrite`` is false.
        """
        self._core.write(os.fspath(path), overwrite)


@dataclass(frozen=True)
class Links:
    """What was found of many links, in their order. All arrays have the shape (n,); NaN: there is no such value.

    Attributes:
        verdict: ``Verdict`` numbers, uint8; OUTSIDE where a link could not be computed.
        distance: Metres.
        clearance: The least height of the ray above the surface between the ends, metres; negative where it is cut.
        critical: Where the ray is cut deepest, or nearest to being cut: metres from the first end.
        fresnel_fraction: The least clearance as a fraction of the first Fresnel zone's radius; with a frequency.
        diffraction_db: Delta-Bullington diffraction (ITU-R P.526); with a frequency.
        free_space_db: With a frequency.
        gap: How much of the line is without ground data, metres.
        messages: Why a link could not be computed, by its index.
    """

    verdict: NDArray[np.uint8]
    distance: NDArray[np.float64]
    clearance: NDArray[np.float64]
    critical: NDArray[np.float64]
    fresnel_fraction: NDArray[np.float64]
    diffraction_db: NDArray[np.float64]
    free_space_db: NDArray[np.float64]
    gap: NDArray[np.float64]
    messages: Mapping[int, str]


@dataclass(frozen=True)
class LinkCounts:
    """How many links of a table are visible, hidden, undecided or could not be computed, and what there is to say."""

    visible: int
    hidden: int
    undecided: int
    error: int
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class ChosenSite:
    """A site of a choice.

    Attributes:
        name: Of its place.
        x: Easting, metres.
        y: Northing, metres.
        height: Of its mast, metres above what it stands on.
        gain: What it adds to what the sites before it serve.
        cumulative: What it and those before it serve.
    """

    name: str
    x: float
    y: float
    height: float
    gain: float
    cumulative: float


@dataclass(frozen=True)
class WrittenFile:
    """A file that was written, and what is in it."""

    path: str
    what: str


@dataclass(frozen=True)
class ImportReport:
    """What an import did.

    Attributes:
        crs: The name of the store's CRS.
        vertices: How many the store has now.
        features: Lines that were read, or features that stand now.
        refused: Features that could not stand; warnings say why.
        voids: Posts without data.
        seconds: How long it took.
        warnings: One line each.
    """

    crs: str
    vertices: int
    features: int
    refused: int
    voids: int
    seconds: float
    warnings: tuple[str, ...]


def _document(text: str) -> dict[str, Any]:
    document: dict[str, Any] = json.loads(text)
    return document


class _OverGrid:
    """A result over the cells of a grid."""

    _core: _itin.Viewshed | _itin.SitePlan | _itin.ZoneStudy

    @property
    def grid(self) -> Grid:
        """The cells. A cell's value is decided at its centre."""
        return Grid(*self._core.grid)

    @property
    def crs(self) -> str:
        """The CRS of the grid, as WKT."""
        return self._core.crs_wkt

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be minded, a line each."""
        return tuple(self._core.warnings)

    @property
    def document(self) -> dict[str, Any]:
        """The JSON document that the command line prints, without the call and its outputs."""
        return _document(self._core.json)


class Viewshed(_OverGrid):
    """Which cells of a raster observers see."""

    _core: _itin.Viewshed

    def __init__(self, core: _itin.Viewshed) -> None:
        self._core = core

    @property
    def verdict(self) -> NDArray[np.uint8]:
        """``Verdict`` numbers of the cells, in every mode; a view of shape (rows, columns)."""
        return self._core.verdict

    @property
    def values(self) -> dict[str, NDArray[Any]]:
        """What the mode tells besides, by name; views of shape (rows, columns).

        - ``count``: ``count``, uint16: how many observers certainly see the cell; 65535 outside
        - ``which``: ``words``, uint32 of shape (bands, rows, columns): bit i % 32 of band i // 32 for observer i
        - ``angle``: ``angle_deg``, float32, NaN where hidden
        - ``nearest``: ``number``, uint32 from 1, 0 where none sees; ``distance_m``, float32
        - ``blocker``: ``theme`` and ``feature``, uint32
        - ``height``: ``height_m``, float32: the least height at which a target is seen
        - ``probability``: ``probability``, float32
        - ``loss``: ``diffraction_db`` and ``free_space_db``, float32
        - ``level``: ``level_dbm``, float32; with rain and a sensitivity also ``outage_minutes`` a year, float32;
          ``observer``, uint32: the number, from 1, of the one that serves the cell best, 0 where no level is known
        - ``visible`` through foliage: ``foliage_m``, float32, the metres of foliage on the line, NaN where something
          else hides the cell; ``transmittance``, float32, the share of the light that comes through, 0 there
        """
        return self._core.values

    @property
    def cells(self) -> dict[str, int]:
        """How many cells are ``visible``, ``hidden``, ``undecided``, ``outside`` and ``zone_cut``."""
        return self._core.cells

    @property
    def ground(self) -> tuple[float, ...]:
        """The elevation of what each observer stands on, metres."""
        return tuple(self._core.ground_m)

    def to_xarray(self) -> xarray.Dataset:
        """Returns ``verdict`` and ``values`` over the centres of cells, ``y`` from north to south; views, no copies.

        Raises:
            ImportError: There is no xarray.
        """
        import xarray

        grid = self.grid
        x = grid.west + (np.arange(grid.columns) + 0.5) * grid.cell_width
        y = grid.north - (np.arange(grid.rows) + 0.5) * grid.cell_height
        arrays = {"verdict": self.verdict} | self.values
        return xarray.Dataset(
            {name: (("band", "y", "x")[-values.ndim :], values) for name, values in arrays.items()},
            coords={"x": x, "y": y},
            attrs={"crs": self.crs},
        )

    def write(self, path: Path, *, overwrite: bool = False, progress: Progress | None = None) -> None:
        """Writes the bytes that ``itin viewshed -o`` writes.

        A GeoTIFF (.tif), with a QGIS style beside it (.qml) but for the modes angle, height and nearest; or the regions
        of its classes as polygons (.gpkg, .geojson). Through foliage, NAME-foliage.tif and NAME-transmittance.tif lie
        beside NAME.tif.

        Raises:
            InputError: Another ending.
            FileError: The place cannot be written, or the file exists and ``overwrite`` is false.
        """
        self._core.write(os.fspath(path), overwrite, progress)

    def __repr__(self) -> str:
        rows, columns = self.grid.shape
        return f"<itin.Viewshed of {rows} x {columns} cells, {self.cells['visible']} visible>"


class LineOfSight:
    """The report on one line of sight."""

    def __init__(self, core: _itin.LineOfSight) -> None:
        self._core = core

    @property
    def verdict(self) -> Verdict:
        """VISIBLE, HIDDEN or UNDECIDED."""
        return Verdict(self._core.verdict)

    @property
    def distance(self) -> float:
        """Metres between the ends."""
        return self._core.distance

    @property
    def clearance(self) -> float | None:
        """The least height of the ray above the surface between the ends, metres; negative where it is cut."""
        return self._core.clearance

    @property
    def profile(self) -> Profile:
        """The surface under the line; without its woods where these are seen through."""
        return Profile(*self._core.profile)

    @property
    def foliage(self) -> Foliage | None:
        """The foliage on the line, and the light that comes through. None where woods are solid."""
        return _foliage(self._core.foliage)

    @property
    def document(self) -> dict[str, Any]:
        """The JSON document that ``itin los --json`` prints, without the call and its outputs."""
        return _document(self._core.json)

    def write(self, path: Path, *, overwrite: bool = False) -> None:
        """Writes a report: .pdf, .html, .svg, .png, .csv, .txt, .json, .kml or .gpkg.

        Raises:
            InputError: Another ending.
            FileError: The place cannot be written, or the file exists and ``overwrite`` is false.
        """
        self._core.write(os.fspath(path), overwrite)

    def __repr__(self) -> str:
        return f"<itin.LineOfSight of {self.distance:.0f} m, {self.verdict.name.lower()}>"


class SitePlan(_OverGrid):
    """A choice of sites, and what they serve."""

    _core: _itin.SitePlan

    def __init__(self, core: _itin.SitePlan) -> None:
        self._core = core

    @property
    def chosen(self) -> tuple[ChosenSite, ...]:
        """The sites in the order of the choice."""
        return tuple(ChosenSite(*site) for site in self._core.chosen)

    @property
    def value(self) -> float:
        """What the choice serves: the sum of the weights of points, or a number of cells."""
        return self._core.value

    @property
    def upper_bound(self) -> float:
        """No choice of as many sites, or within the budget, serves more than this."""
        return self._core.upper_bound

    @property
    def redundancy(self) -> NDArray[np.uint16]:
        """How many sites serve a cell; 65535 beyond reach or data; a view of shape (rows, columns)."""
        return self._core.rasters["redundancy"]

    @property
    def best_server(self) -> NDArray[np.uint16]:
        """The site that serves a cell best: the nearest or, with a link budget, the one of the greatest level.

        Sites are numbered from 1 in the order of the choice, and then existing ones; each sector of a mast has a number
        of its own. 0: none; 65535 outside; a view.
        """
        return self._core.rasters["best_server"]

    @property
    def level(self) -> NDArray[np.float32] | None:
        """With a link budget the greatest level that a site gives a cell, dBm; NaN where none is known; a view."""
        return self._core.rasters.get("level_dbm")

    @property
    def served(self) -> NDArray[np.uint8]:
        """``Verdict`` numbers: VISIBLE where enough sites serve the cell; a view of shape (rows, columns)."""
        return self._core.rasters["served"]

    def write(
        self, folder: Path, *, overwrite: bool = False, progress: Progress | None = None
    ) -> tuple[WrittenFile, ...]:
        """Writes tables, layers, rasters and maps into a folder, which is made where it is not there.

        Raises:
            FileError: The place cannot be written, or a file exists and ``overwrite`` is false.
        """
        return _written(self._core.write(os.fspath(folder), overwrite, progress))

    def __repr__(self) -> str:
        return f"<itin.SitePlan of {len(self._core.chosen)} sites, value {self.value:g}>"


class ZoneStudy(_OverGrid):
    """Where wind turbines are visible from."""

    _core: _itin.ZoneStudy

    def __init__(self, core: _itin.ZoneStudy) -> None:
        self._core = core

    @property
    def bare(self) -> dict[str, NDArray[Any]]:
        """What is certainly seen over bare ground, by name; views of shape (rows, columns).

        ``hub_count``, ``tip_count``: uint16, 65535 outside. ``turbines``: uint32 of shape (bands, rows, columns), a bit
        for each tip. ``visible_height_m``, ``vertical_angle_deg``, ``horizontal_angle_deg``, ``share``, ``nearest_m``:
        float32, NaN outside.
        """
        return self._core.visibility(False) or {}

    @property
    def screened(self) -> dict[str, NDArray[Any]] | None:
        """The same with the features that stand on the ground; None where no theme was asked for."""
        return self._core.visibility(True)

    @property
    def seasons(self) -> dict[str, dict[str, NDArray[np.uint16]]] | None:
        """What is seen through woods in ``summer`` and in ``winter``; None where they are solid.

        Each has ``hub_count`` and ``tip_count``, as ``bare`` has them.
        """
        return self._core.seasons

    @property
    def radar_height_m(self) -> NDArray[np.float32] | None:
        """The least height above the ground that the radar sees, a view of shape (rows, columns); None without a radar.

        NaN above 1000 m, and where there is no ground.
        """
        return self._core.radar_height_m

    def write(
        self, folder: Path, *, overwrite: bool = False, progress: Progress | None = None
    ) -> tuple[WrittenFile, ...]:
        """Writes the folder that ``itin ztv`` writes: rasters, polygons, tables, a text on methods.

        The folder appears complete or not at all.

        Raises:
            FileError: The place cannot be written, or holds files and ``overwrite`` is false.
        """
        return _written(self._core.write(os.fspath(folder), overwrite, progress))


@dataclass(frozen=True)
class TurbineView:
    """What a dwelling, or one of its facades, sees of the wind turbines before it.

    Attributes:
        turbines: How many are before it.
        tips: How many blade tips are seen.
        hubs: How many hubs are; None where no hub's height is known.
        tips_undecided: How many more only ground without data could hide.
        hubs_undecided: Likewise.
        nearest: The number of the nearest turbine that is seen, by its row from 1; None where none is.
        arc: The smallest part of the horizon that holds the rotors whose tips are seen: its anticlockwise end and its
            width, degrees clockwise from grid north. None where none is seen.
        vertical_angle: The greatest angle that the visible part of a turbine takes up, degrees.
    """

    turbines: int
    tips: int
    hubs: int | None
    tips_undecided: int
    hubs_undecided: int | None
    nearest: int | None
    arc: tuple[float, float] | None
    vertical_angle: float


@dataclass(frozen=True)
class TurbineViews:
    """What is seen of wind turbines over four surfaces; None where no turbine is before the eye, or none was asked for.

    Attributes:
        bare: The bare ground.
        screened: The surface with its features, woods solid; None where nothing stands on the ground.
        summer: The same, through woods in leaf; None without ``foliage``.
        winter: The same, through woods in winter; None without ``foliage``.
    """

    bare: TurbineView | None
    screened: TurbineView | None
    summer: TurbineView | None
    winter: TurbineView | None


@dataclass(frozen=True)
class ShadowFlicker:
    """The shadow flicker at a dwelling in the worst case: the sun shines all day, and rotors turn and face it.

    Attributes:
        minutes: In the year. A minute counts once, however many turbines flicker in it.
        days: Days with flicker.
        worst_day: The day of the year with the most minutes, from 0; the first of several.
        worst_minutes: On that day.
        likely: The likely minutes in the year; None without ``months``.
        over_year: Whether the limit of the year is exceeded.
        over_day: Whether the limit of a day is.
        calendar: Stretches of minutes, turbine by turbine, shape (n, 3): the turbine's number, the first minute of the
            year, from 0, and how many.
    """

    minutes: int
    days: int
    worst_day: int
    worst_minutes: int
    likely: float | None
    over_year: bool
    over_day: bool
    calendar: NDArray[np.uint32]


@dataclass(frozen=True)
class Facade:
    """An eye before a straight run of walls, or in the open.

    Attributes:
        x: Easting, metres.
        y: Northing, metres.
        ground: Elevation of the bare ground there, metres.
        outward: Where the facade looks, degrees clockwise from grid north; None in the open.
        length: Of the facade, metres.
        views: What is seen of the turbines before it.
    """

    x: float
    y: float
    ground: float
    outward: float | None
    length: float
    views: TurbineViews


@dataclass(frozen=True)
class Dwelling:
    """A dwelling, and what wind turbines are to it.

    Attributes:
        name: Of the place that was given, or of the building.
        id: Of the building.
        x: Easting of the place, or of the middle of the building's box, metres.
        y: Northing, metres.
        nearest: The number of the nearest turbine, by its row from 1.
        nearest_distance: Metres.
        views: What its facades see together: a turbine is seen where one of them sees it.
        flicker: Shadow flicker at any of its facades.
        facades: One eye before each, or one in the open.
    """

    name: str
    id: str
    x: float
    y: float
    nearest: int
    nearest_distance: float
    views: TurbineViews
    flicker: ShadowFlicker
    facades: tuple[Facade, ...]


def _views(told: _itin._Views) -> TurbineViews:
    return TurbineViews(*(None if view is None else TurbineView(*view) for view in told))


def _facade(told: _itin._Facade) -> Facade:
    x, y, ground, outward, length, views = told
    return Facade(x, y, ground, outward, length, _views(views))


def _dwelling(told: _itin._Dwelling) -> Dwelling:
    name, identifier, x, y, nearest, distance, views, flicker, calendar, facades = told
    return Dwelling(
        name,
        identifier,
        x,
        y,
        nearest,
        distance,
        _views(views),
        ShadowFlicker(*flicker, calendar),
        tuple(map(_facade, facades)),
    )


class Dwellings:
    """What wind turbines are to the dwellings about them."""

    def __init__(self, core: _itin.Dwellings) -> None:
        self._core = core

    @property
    def dwellings(self) -> tuple[Dwelling, ...]:
        """The dwellings, in the order of ``dwellings.csv``."""
        return tuple(map(_dwelling, self._core.dwellings))

    @property
    def crs(self) -> str:
        """The CRS, as WKT."""
        return self._core.crs_wkt

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be minded, a line each."""
        return tuple(self._core.warnings)

    @property
    def document(self) -> dict[str, Any]:
        """The JSON document that ``itin dwellings --json`` prints, without the call and its outputs."""
        return _document(self._core.json)

    def write(
        self,
        folder: Path,
        *,
        sheets: Sequence[Literal["A3", "A1"]] = (),
        sheets_of: Sequence[str] = (),
        scale: float | None = None,
        basemap: Path | None = None,
        project: str = "",
        date: str = "",
        overwrite: bool = False,
        progress: Progress | None = None,
    ) -> tuple[WrittenFile, ...]:
        """Writes the folder that ``itin dwellings`` writes: tables, layers, a map, calendars.

        The folder appears complete or not at all. Its bytes are those of the program, but for ``dwellings.json``, which
        has no call.

        Args:
            sheets: Papers of a sheet for each dwelling, as PDF and PNG.
            sheets_of: Sheets only of the dwellings with these names or ids, or of these rows of ``dwellings.csv``.
            scale: Of the sheets' maps, 10000 for 1:10,000. None: the largest usual one that shows all.
            basemap: A georeferenced picture below these maps, in place of the shaded relief.
            project: The project's name in title blocks.
            date: The date in title blocks.

        Raises:
            InputError: No dwelling has a name of ``sheets_of``, or the scale is too large.
            FileError: The place cannot be written, or holds files and ``overwrite`` is false.
        """
        fields: dict[str, Any] = {"sheets": list(sheets), "sheets_of": list(sheets_of), "overwrite": overwrite}
        fields |= {"project": project, "date": date} | given({"scale": scale, "basemap": basemap})
        return _written(self._core.write(os.fspath(folder), fields, progress))

    def __repr__(self) -> str:
        return f"<itin.Dwellings of {len(self._core.dwellings)} dwellings>"


def _written(files: Sequence[tuple[str, str]]) -> tuple[WrittenFile, ...]:
    return tuple(WrittenFile(*file) for file in files)
