"""Stores, and what is asked of them."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _itin
from ._asked import (
    Angles,
    Bounds,
    Earth,
    Features,
    Grid,
    NoData,
    Observer,
    Path,
    Place,
    Progress,
    Themes,
    Turbine,
    TurbinesToPlace,
    Window,
    fields_of,
    given,
    list_of,
    names_of,
    tuple_of,
)
from ._errors import InputError
from ._results import (
    Dwellings,
    Level,
    LineOfSight,
    LinkCounts,
    Links,
    PathProfile,
    SitePlan,
    Theme,
    Tin,
    Viewshed,
    ZoneStudy,
)

Mode = Literal[
    "visible",
    "certified",
    "count",
    "which",
    "angle",
    "nearest",
    "blocker",
    "height",
    "probability",
    "fresnel",
    "loss",
    "level",
]
"""What each cell has, as ``itin viewshed --mode``; ``fresnel``, ``loss`` and ``level`` are what ``--frequency``, ``--loss``
and ``--power-dbm`` ask."""

Engine = Literal["auto", "sweep", "rays"]
"""The algorithm; the result never depends on it."""

Polarisation = Literal["h", "v"]

ObserverLike = Observer | tuple[float, float] | tuple[float, float, float]
"""An observer, or (x, y) or (x, y, height)."""


_PLACES = ("candidates", "existing", "demand", "hub")
"""Fields of a choice of sites that are places."""


def _numbers(values: ArrayLike) -> NDArray[np.float64]:
    return np.ascontiguousarray(values, dtype=np.float64)


def _surface(tolerance: float, themes: Themes) -> dict[str, Any]:
    return {"tolerance": float(tolerance), "themes": names_of(themes)}


def _observers(observers: ObserverLike | Sequence[ObserverLike]) -> list[dict[str, Any]]:
    single = isinstance(observers, Observer) or (len(observers) > 0 and not isinstance(observers[0], (Observer, tuple)))
    several = [cast(ObserverLike, observers)] if single else cast(Sequence[ObserverLike], observers)
    return [fields_of(o if isinstance(o, Observer) else Observer(*o)) for o in several]


def _rings(
    rings: Sequence[tuple[float, float]], tolerance: float, observers: Sequence[Mapping[str, Any]]
) -> dict[str, Any]:
    """Returns the fields of rings about the one observer."""
    if not rings:
        return {}
    if tolerance != 0:
        raise InputError("`rings`: they have tolerances of their own; leave out `tolerance`", "rings")
    if len(observers) != 1:
        raise InputError("`rings`: they lie about one observer; for several give `tolerance`", "rings")
    (observer,) = observers
    return {
        "centre": (observer["x"], observer["y"]),
        "rings": [(float(radius), float(limit)) for radius, limit in rings],
    }


def _place(place: Place) -> dict[str, Any]:
    return fields_of(place) | {"sectors": [fields_of(sector) for sector in place.sectors]}


def _places(places: Iterable[Place] | None) -> list[dict[str, Any]] | None:
    return None if places is None else [_place(place) for place in places]


def _named(places: Iterable[Place] | None) -> list[dict[str, Any]] | None:
    """Places that have the numbers of their rows for names, where they have none."""
    fields = _places(places)
    for number, place in enumerate(fields or []):
        place["name"] = place["name"] or str(number)
    return fields


def _this_year() -> int:
    """Returns the year that ``itin`` takes where none is given."""
    return time.gmtime(float(os.environ.get("SOURCE_DATE_EPOCH", time.time()))).tm_year


class _InMemory:
    """A surface that is in memory."""

    _core: _itin.HeldSurface | _itin.Surface
    _surface: dict[str, Any]

    def viewshed(
        self,
        observers: ObserverLike | Sequence[ObserverLike],
        *,
        target_height: float = 0.0,
        target_absolute: bool = False,
        radius: float | None = None,
        min_radius: float = 0.0,
        azimuth: Angles | None = None,
        elevation: Angles | None = None,
        cell_size: float | None = None,
        grid: Grid | None = None,
        earth: Earth = Earth(),
        observers_on_surface: bool = False,
        targets_on_surface: bool = False,
        nodata: NoData = "unknown",
        engine: Engine = "auto",
        mode: Mode = "visible",
        progress: Progress | None = None,
    ) -> Viewshed:
        """Computes what ``Store.viewshed()`` does, equal to the last bit, on this surface.

        Raises:
            InputError: Also where sight lines leave the area that a store's surface is held of.
        """
        fields = given({k: v for k, v in locals().items() if k not in ("self", "observers", "progress")})
        fields["observers"] = _observers(observers)
        return Viewshed(self._core.viewshed(fields | self._surface, progress))


class HeldSurface(_InMemory):
    """The surface of an area, read once for many viewsheds. Safe in threads."""

    _core: _itin.HeldSurface

    def __init__(self, core: _itin.HeldSurface, tolerance: float, themes: Themes) -> None:
        self._core = core
        self._surface = _surface(tolerance, themes)

    @property
    def bytes(self) -> int:
        """About how much memory it takes."""
        return self._core.bytes


class Surface(_InMemory):
    """The surface through an array of heights, for viewsheds without a store. Safe in threads.

    Its triangles lie between the centres of the grid's cells, as those of a store of that raster do.

    Args:
        heights: Metres, shape (rows, columns), from north to south; NaN where there is no ground.
        grid: The cells.
        crs: The CRS, as WKT, for what is written; empty where it is not known.
        resolution: Heights, and distances from the first cell, are rounded to it, metres.

    Raises:
        InputError: Another shape than the grid's, a resolution that does not suit it, or no ground.
    """

    _core: _itin.Surface

    def __init__(self, heights: ArrayLike, grid: Grid, *, crs: str = "", resolution: float = 0.01) -> None:
        array = np.ascontiguousarray(heights, dtype=np.float32)
        if array.shape != grid.shape:
            raise InputError(f"`heights`: the shape is {array.shape}, where the grid has {grid.shape}", "heights")
        self._core = _itin.Surface(array, tuple_of(grid), crs, resolution)
        self._surface = _surface(0.0, "none")


class Store:
    """A landscape: one file, open for reading. It does not change, and is safe in threads.

    Every call that takes long releases the interpreter's lock, hears Ctrl-C within half a second, and tells
    ``progress``. Positions are in the store's CRS, lengths in metres. ``tolerance`` is that of the surface: 0 is every
    stored point. ``themes`` are the features that stand on it. ``without`` leaves out some of them, by the names that
    reports print, as ``itin --without`` does: ``"woods:17"``, ``"woods:Lime Grove"``, ``"woods#16"``.

    ``foliage`` sees through themes of vegetation, as ``itin --foliage`` does. It is the extinction k, 0.5 for leaves
    turned at random; None takes woods as solid. ``leaf_area`` is that of woods: ``"on"``, 1 square metre of leaves in
    each cubic metre; ``"off"``, a tenth of that, for a winter without a source; or the field that features have theirs
    in. What less than ``transmittance`` of the light comes from is hidden.

    Raises:
        FileError: The file is missing, or no store.
        CorruptStore: It is damaged.
    """

    def __init__(self, path: Path, *, cache_bytes: int = 256 << 20) -> None:
        """Opens a store. ``cache_bytes`` bounds what it keeps of what was read, and changes the speed only."""
        self._core = _itin.Store(os.fspath(path), cache_bytes)

    @property
    def path(self) -> str:
        """The file."""
        return self._core.path

    @property
    def crs(self) -> str:
        """The CRS as ``"EPSG:27700"``, or as WKT where it has no code."""
        return self._core.crs

    @property
    def crs_wkt(self) -> str:
        """The CRS as WKT."""
        return self._core.crs_wkt

    @property
    def bounds(self) -> Bounds:
        """The box about all vertices, metres."""
        return Bounds(*self._core.bounds)

    @property
    def resolution(self) -> float:
        """The step of the grid that all coordinates lie on, metres."""
        return self._core.resolution

    @property
    def vertices(self) -> int:
        """How many vertices are stored."""
        return self._core.vertices

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels of detail, the full surface first."""
        return tuple(Level(t, n, (lo, hi)) for t, n, lo, hi in self._core.levels)

    @property
    def themes(self) -> tuple[Theme, ...]:
        """The themes, those of the terrain first."""
        return tuple(Theme(*theme) for theme in self._core.themes)

    def content_digest(self, *, progress: Progress | None = None) -> str:
        """Returns 32 hexadecimal digits that equal stores share, whenever and wherever they were imported.

        Reads the whole store. ``itin info --digest`` prints the same.
        """
        return self._core.content_digest(progress)

    def heights(
        self,
        xy: ArrayLike,
        *,
        tolerance: float = 0.0,
        themes: Themes = "all",
        progress: Progress | None = None,
    ) -> NDArray[np.float64]:
        """Returns the elevation of the surface under positions.

        Args:
            xy: Positions, shape (n, 2).

        Returns:
            Metres, shape (n,); NaN where there is no ground.

        Raises:
            InputError: Another shape, numbers that are not finite, or a theme that the store does not have.
        """
        return self._core.heights(_numbers(xy), _surface(tolerance, themes), progress)

    def height_raster(
        self,
        grid: Grid,
        *,
        tolerance: float = 0.0,
        themes: Themes = "all",
        progress: Progress | None = None,
    ) -> NDArray[np.float32]:
        """Returns the elevation under the centres of cells: metres, shape (rows, columns); NaN without ground."""
        return self._core.height_raster(tuple_of(grid), _surface(tolerance, themes), progress)

    def triangulate(
        self,
        window: Window,
        *,
        tolerance: float = 0.0,
        themes: Themes = "none",
        without: Features = (),
        progress: Progress | None = None,
    ) -> Tin:
        """Returns exactly those triangles of the whole store's triangulation that meet the window."""
        fields = _surface(tolerance, themes) | {"without": list_of(without)}
        return Tin(*self._core.triangulate(window, fields, progress))

    def profile(
        self,
        corners: ArrayLike,
        *,
        tolerance: float = 0.0,
        themes: Themes = "all",
        without: Features = (),
        foliage: float | None = None,
        leaf_area: str = "on",
        progress: Progress | None = None,
    ) -> PathProfile:
        """Returns the surface along a path.

        Args:
            corners: The path's corners, at least two; shape (n, 2).
            foliage: Tells the foliage on the path, too; see ``PathProfile.foliage``.
        """
        fields = _surface(tolerance, themes) | {"without": list_of(without), "leaf_area": leaf_area}
        return PathProfile(self._core.profile(_numbers(corners), fields | given({"foliage": foliage}), progress))

    def line_of_sight(
        self,
        start: Sequence[float],
        end: Sequence[float],
        *,
        from_is_elevation: bool = False,
        to_is_elevation: bool = False,
        from_on_surface: bool = False,
        to_on_surface: bool = False,
        frequency_ghz: float | None = None,
        polarisation: Polarisation = "h",
        over_sea: float = 0.0,
        power_dbm: float | None = None,
        eirp_dbm: float | None = None,
        gain_dbi: float | tuple[float, float] | None = None,
        feeder_loss_db: float | tuple[float, float] | None = None,
        sensitivity_dbm: float | None = None,
        rain_rate_mm_h: float | None = None,
        geoclimatic_factor: float | None = None,
        refractivity_gradient: float | None = None,
        from_antenna: Path | None = None,
        to_antenna: Path | None = None,
        antenna_azimuth: float | tuple[float | None, float | None] | None = None,
        antenna_tilt: float | tuple[float | None, float | None] | None = None,
        criteria: Sequence[tuple[float, float]] = (),
        earth: Earth = Earth(),
        tolerance: float = 0.0,
        themes: Themes = "all",
        without: Features = (),
        foliage: float | None = None,
        leaf_area: str = "on",
        transmittance: float = 0.5,
        nodata: NoData = "unknown",
        progress: Progress | None = None,
    ) -> LineOfSight:
        """Judges one line of sight, and all that a report says about it.

        Args:
            start: (x, y, height), the height above what it stands on.
            end: Likewise.
            frequency_ghz: Gives Fresnel clearances and losses.
            power_dbm: Of the transmitter at the first end; gives a link budget, in ``document["radio"]["budget"]``.
            eirp_dbm: What the first end radiates, instead.
            gain_dbi: Of both antennas, or of each; with ``eirp_dbm``, of the second alone.
            feeder_loss_db: Likewise.
            sensitivity_dbm: The least level that the receiver works with; gives the margin for fades.
            rain_rate_mm_h: Exceeded for 0.01 % of an average year; gives the outage by rain.
            geoclimatic_factor: K of P.530-17; gives the outage by multipath.
            refractivity_gradient: dN1 of P.453, N-units per km, from which K is made.
            from_antenna: The file of the pattern of the first end's antenna, .msi or .ant.
            to_antenna: Likewise of the second end.
            antenna_azimuth: Where the first antenna points, degrees from grid north, or both; None: at the other end.
            antenna_tilt: Likewise, degrees below the horizontal.
            criteria: Rules of two-criterion planning, (K, fraction of F1).
            foliage: Sees through woods; see ``LineOfSight.foliage`` and ``document["foliage"]``.

        Raises:
            InputError: No ground under an end (``field`` is ``"from"`` or ``"to"``), a height below the ground, ...
        """
        fields = given({k: v for k, v in locals().items() if k not in ("self", "start", "end", "progress")})
        fields["themes"] = names_of(themes)
        fields["without"] = list_of(without)
        fields["criteria"] = list(criteria)
        return LineOfSight(self._core.line_of_sight(_numbers([start, end]), fields, progress))

    def links(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        from_on_surface: bool = False,
        to_on_surface: bool = False,
        frequency_ghz: float | None = None,
        polarisation: Polarisation = "h",
        over_sea: float = 0.0,
        earth: Earth = Earth(),
        tolerance: float = 0.0,
        themes: Themes = "all",
        without: Features = (),
        nodata: NoData = "unknown",
        progress: Progress | None = None,
    ) -> Links:
        """Judges many links, in parallel. The answers are those of ``line_of_sight()`` to the last bit.

        Args:
            start: First ends, (x, y, height above what they stand on); shape (n, 3).
            end: Second ends, likewise.

        Raises:
            InputError: Another shape, or numbers that are not finite. A link without ground under an end is a row with
                the verdict OUTSIDE.
        """
        fields = given({k: v for k, v in locals().items() if k not in ("self", "start", "end", "progress")})
        fields["themes"] = names_of(themes)
        fields["without"] = list_of(without)
        return Links(*self._core.links(_numbers(start), _numbers(end), fields, progress))

    def link_table(
        self,
        path: Path,
        outputs: Path | Sequence[Path],
        *,
        heights: tuple[float, float] = (2.0, 2.0),
        layer: str = "",
        where: str = "",
        crs: str = "",
        from_on_surface: bool = False,
        to_on_surface: bool = False,
        frequency_ghz: float | None = None,
        polarisation: Polarisation = "h",
        over_sea: float = 0.0,
        power_dbm: float | None = None,
        eirp_dbm: float | None = None,
        gain_dbi: float | tuple[float, float] | None = None,
        feeder_loss_db: float | tuple[float, float] | None = None,
        sensitivity_dbm: float | None = None,
        rain_rate_mm_h: float | None = None,
        geoclimatic_factor: float | None = None,
        refractivity_gradient: float | None = None,
        from_antenna: Path | None = None,
        to_antenna: Path | None = None,
        antenna_azimuth: float | tuple[float | None, float | None] | None = None,
        antenna_tilt: float | tuple[float | None, float | None] | None = None,
        earth: Earth = Earth(),
        tolerance: float = 0.0,
        themes: Themes = "all",
        without: Features = (),
        nodata: NoData = "unknown",
        overwrite: bool = False,
        progress: Progress | None = None,
    ) -> LinkCounts:
        """Judges the links of a file and writes the tables that ``itin los --links`` writes, to the byte.

        Args:
            path: A table ``id,x1,y1,h1,x2,y2,h2`` (.csv), or a file of lines.
            outputs: Files to write: .csv, .gpkg, .kml, .pdf.
            heights: Of the two ends of lines, whose file gives none, metres.
            layer: The layer of a file of lines; empty: all.
            where: Only lines that this SQL condition holds for.
            crs: The CRS of a file that states none; empty: the store's.
            power_dbm: Gives link budgets, as do the fields after it; see ``line_of_sight()``.
        """
        fields = given({k: v for k, v in locals().items() if k not in ("self", "path", "outputs", "progress")})
        fields["themes"] = names_of(themes)
        fields["without"] = list_of(without)
        several = [outputs] if isinstance(outputs, (str, os.PathLike)) else outputs
        texts = [os.fspath(output) for output in several]
        return LinkCounts(*self._core.link_table(os.fspath(path), texts, fields, progress))

    def viewshed(
        self,
        observers: ObserverLike | Sequence[ObserverLike],
        *,
        target_height: float = 0.0,
        target_absolute: bool = False,
        radius: float | None = None,
        min_radius: float = 0.0,
        azimuth: Angles | None = None,
        elevation: Angles | None = None,
        cell_size: float | None = None,
        grid: Grid | None = None,
        earth: Earth = Earth(),
        tolerance: float = 0.0,
        rings: Sequence[tuple[float, float]] = (),
        themes: Themes = "all",
        without: Features = (),
        foliage: float | None = None,
        leaf_area: str = "on",
        transmittance: float = 0.5,
        observers_on_surface: bool = False,
        targets_on_surface: bool = False,
        nodata: NoData = "unknown",
        engine: Engine = "auto",
        mode: Mode = "visible",
        vertical_error: float | None = None,
        error_correlation: float = 0.0,
        frequency_ghz: float | None = None,
        fresnel: float = 0.6,
        polarisation: Polarisation = "h",
        over_sea: float = 0.0,
        power_dbm: float | None = None,
        eirp_dbm: float | None = None,
        gain_dbi: float | tuple[float, float] | None = None,
        feeder_loss_db: float | tuple[float, float] | None = None,
        sensitivity_dbm: float | None = None,
        rain_rate_mm_h: float | None = None,
        from_antenna: Path | None = None,
        to_antenna: Path | None = None,
        antenna_azimuth: float | tuple[float | None, float | None] | None = None,
        antenna_tilt: float | tuple[float | None, float | None] | None = None,
        margins_db: Sequence[float] = (),
        memory_bytes: int = 1 << 30,
        progress: Progress | None = None,
    ) -> Viewshed:
        """Computes which cells observers see, exactly for the surface asked for.

        Args:
            observers: One or several; (x, y) and (x, y, height) stand for an observer, who is 2 m high by default.
            target_height: Of the target in every cell, metres above the ground; an elevation with ``target_absolute``.
            radius: How far to look. None: as far as there is ground.
            min_radius: Leaves out what is nearer.
            azimuth: The field of view, degrees clockwise from grid north; may pass through north, (350, 10).
            elevation: The field of view, degrees above the horizontal.
            cell_size: Of the raster's cells. None: a round size for at most 2048 cells on a side.
            grid: The cells, in place of ``cell_size``.
            rings: Of one observer, radius and tolerance in metres, nearest first, in place of ``tolerance``:
                ((500, 0), (2000, 1), (10000, 4)). Beyond the last ring its tolerance still holds.
            observers_on_surface: Observers stand on the roofs and tops of ``themes``.
            targets_on_surface: Targets do.
            mode: What each cell has, besides its verdict; see ``Viewshed.values``. ``certified`` says what is certain of
                the full surface at this tolerance.
            vertical_error: Standard deviation of heights, metres; with the mode ``probability``.
            error_correlation: L: errors x apart are correlated as exp(-x / L), metres.
            frequency_ghz: With the modes ``fresnel``, ``loss`` and ``level``.
            fresnel: The share of the first Fresnel zone's radius that must be clear.
            power_dbm: Of the observers' transmitter; with the mode ``level``, as are the fields after it. The first end
                of a link is the observer, the second the receiver in a cell; see ``line_of_sight()``.
            antenna_azimuth: An observer's antenna with a pattern needs it, and ``antenna_tilt``: it cannot aim at all
                cells.
            margins_db: Margins over the sensitivity by which polygons and styles tell levels apart, ascending.
            memory_bytes: Bounds the memory; the result does not depend on it.
            foliage: Sees through woods, with the mode ``visible`` alone; see ``Viewshed.values``.

        Raises:
            InputError: An observer off the data, an unusable radius, cell size or angle; ``field`` has its name.
            CorruptStore: A damaged block.

        The result, and so ``Viewshed.write()``, is that of ``itin viewshed`` with the options of the same names.
        """
        fields = given({k: v for k, v in locals().items() if k not in ("self", "observers", "progress")})
        radio = ("fresnel", "loss", "level")
        if mode in radio and frequency_ghz is None:
            raise InputError(f"`frequency_ghz`: the mode {mode} needs a frequency", "frequency_ghz")
        if mode not in radio and frequency_ghz is not None:
            raise InputError(f"`mode`: {mode} needs no frequency; give fresnel, loss or level", "mode")
        if mode != "level" and (power_dbm is not None or eirp_dbm is not None):
            raise InputError(f"`mode`: {mode} needs no link budget; give level", "mode")
        fields["observers"] = _observers(observers)
        fields["themes"] = names_of(themes)
        fields["without"] = list_of(without)
        fields |= _rings(fields.pop("rings"), tolerance, fields["observers"])
        return Viewshed(self._core.viewshed(fields, progress))

    def hold(
        self,
        area: Sequence[float],
        *,
        tolerance: float = 0.0,
        themes: Themes = "all",
        memory_bytes: int = 1 << 30,
        progress: Progress | None = None,
    ) -> HeldSurface:
        """Reads the surface of an area, for many viewsheds in it.

        Args:
            area: (xmin, ymin, xmax, ymax).

        Raises:
            InputError: The area takes more than ``memory_bytes``.
        """
        fields = _surface(tolerance, themes) | {"memory_bytes": memory_bytes}
        return HeldSurface(self._core.hold(Bounds(*area), fields, progress), tolerance, themes)

    def site(
        self,
        candidates: Iterable[Place] | None = None,
        *,
        search_area: Window | None = None,
        spacing: float = 1000.0,
        masts: Sequence[tuple[float, float]] = ((20.0, 1.0),),
        turbines: TurbinesToPlace | None = None,
        on_surface: bool = False,
        forbidden: Window | None = None,
        existing: Iterable[Place] | None = None,
        demand: Iterable[Place] | tuple[Grid, ArrayLike] | None = None,
        target_height: float = 2.0,
        targets_on_surface: bool = False,
        radius: float = 10000.0,
        cell_size: float = 50.0,
        frequency_ghz: float | None = None,
        fresnel: float = 0.6,
        power_dbm: float | None = None,
        eirp_dbm: float | None = None,
        gain_dbi: float | tuple[float, float] | None = None,
        feeder_loss_db: float | tuple[float, float] | None = None,
        sensitivity_dbm: float | None = None,
        rain_rate_mm_h: float | None = None,
        from_antenna: Path | None = None,
        to_antenna: Path | None = None,
        antenna_azimuth: float | tuple[float | None, float | None] | None = None,
        antenna_tilt: float | tuple[float | None, float | None] | None = None,
        margin_db: float = 0.0,
        count: int | None = None,
        budget: float | None = None,
        share: float | None = None,
        min_spacing: float | None = None,
        cover: int = 1,
        intervisible: bool = False,
        hub: Place | None = None,
        earth: Earth = Earth(),
        themes: Themes = "all",
        without: Features = (),
        nodata: NoData = "unknown",
        memory_bytes: int = 1 << 30,
        progress: Progress | None = None,
    ) -> SitePlan:
        """Chooses the few of many sites that serve the most, with a bound on the best choice.

        Args:
            candidates: Where a mast may stand; or None, and candidates are proposed in ``search_area``.
            search_area: Two candidates or so are proposed from the terrain in each square of ``spacing``.
            masts: Heights and costs of masts to choose from, (metres, cost).
            turbines: Places wind turbines instead, as ``itin site --turbines``: those that are seen least. ``demand`` is
                then who sees them.
            on_surface: Sites stand on the roofs and tops of ``themes``.
            forbidden: Where no site may stand.
            existing: Sites that serve already.
            demand: What is to be served: points, or a grid and the weights of its cells, shape (rows, columns). None:
                all cells with ground within the radius of a candidate.
            target_height: Metres above what targets stand on, for points without a height and for cells.
            radius: How far a site serves.
            cell_size: Of the cells of the demand and of the rasters.
            frequency_ghz: Serve only what is in sight with ``fresnel`` of its first Fresnel zone clear.
            power_dbm: Of the sites' transmitters; gives a link budget, as do the fields after it (see
                ``line_of_sight()``). Then a target is served, in sight or not, where it gets the sensitivity and more.
            rain_rate_mm_h: Tells outages by rain in the files of the plan; no choice depends on it.
            margin_db: How much more than ``sensitivity_dbm`` serves.
            count: How many sites to choose. The choice ends at the first of ``count``, ``budget`` and ``share``.
            budget: The most that the sites may cost together.
            share: The part of the demand that is to be served, 0 to 1.
            cover: How many sites must serve a target.
            intervisible: Chosen sites reach each other by links in sight.
            hub: Chosen sites reach this place by such links.

        Raises:
            InputError: A request that makes no sense; ``field`` has its name.
            Error: No choice is possible.
        """
        fields = given({k: v for k, v in locals().items() if k not in _PLACES and k not in ("self", "progress")})
        fields["themes"] = names_of(themes)
        fields["without"] = list_of(without)
        fields["masts"] = [(float(height), float(cost)) for height, cost in masts]
        if turbines is not None:
            fields["turbines"] = fields_of(turbines)
            if turbines.dwellings is not None:
                fields["turbines"]["dwellings"] = _numbers(turbines.dwellings)
        fields |= given({"candidates": _named(candidates), "existing": _named(existing), "hub": hub and _place(hub)})
        if isinstance(demand, tuple) and len(demand) == 2 and isinstance(demand[0], Grid):
            fields["demand_grid"] = tuple_of(demand[0])
            fields["demand_weights"] = _numbers(cast(ArrayLike, demand[1]))
        elif demand is not None:
            fields["demand"] = _places(cast(Iterable[Place], demand))
        return SitePlan(self._core.site(fields, progress))

    def ztv(
        self,
        turbines: Path | Iterable[Turbine],
        *,
        turbine_crs: str = "",
        viewpoints: Path | Iterable[Place] | None = None,
        viewpoint_height: float = 2.0,
        routes: Path | Mapping[str, ArrayLike] | None = None,
        route_step: float = 100.0,
        radar: tuple[float, float, float] | None = None,
        radius: float | None = None,
        observer_height: float = 2.0,
        cell_size: float | None = None,
        grid: Grid | None = None,
        earth: Earth = Earth(),
        tolerance: float = 0.0,
        themes: Themes = "all",
        without: Features = (),
        nodata: NoData = "unknown",
        foliage: float | None = None,
        transmittance: float = 0.5,
        memory_bytes: int | None = None,
        progress: Progress | None = None,
    ) -> ZoneStudy:
        """Studies where wind turbines are visible from.

        Args:
            turbines: Turbines, or a file of them as ``itin ztv --turbines`` takes it.
            turbine_crs: The CRS of a file that states none.
            viewpoints: Places, or a file of them, from which each turbine is looked at.
            viewpoint_height: Of eyes there, metres above the ground, where a place has none of its own.
            routes: Roads and paths by name, the corners of each of shape (n, 2); or a file of lines.
            route_step: The greatest distance between the places along a route that are looked from.
            radar: (x, y, height above the bare ground): a radar whose horizon is computed; see ``ZoneStudy.radar_height_m``.
            radius: How far turbines are looked for, metres. None: by their tips, or each turbine's own.
            observer_height: Of the eyes above the bare ground.
            cell_size: Metres; 50 where neither it nor ``grid`` is given.
            foliage: The extinction k by which themes of vegetation are seen through in summer and in winter, as in
                ``itin ztv --foliage``; 0.5 for leaves turned at random. None: they are solid. See ``ZoneStudy.seasons``.
            transmittance: The least share of the light by which something is seen through woods.

        Raises:
            InputError: No turbine that can be used, an unusable size, ...
        """
        fields = given({k: v for k, v in locals().items() if k not in ("self", "turbines", "progress")})
        fields["themes"] = names_of(themes)
        fields["without"] = list_of(without)
        if cell_size is None and grid is None:
            fields["cell_size"] = 50.0
        if isinstance(turbines, (str, os.PathLike)):
            fields["turbines"] = os.fspath(turbines)
        else:
            fields["turbines"] = [fields_of(t) | given({"radius": t.radius or radius}) for t in turbines]
        if isinstance(viewpoints, (str, os.PathLike)):
            fields["viewpoints"] = os.fspath(viewpoints)
        elif viewpoints is not None:
            fields["viewpoints"] = _places(viewpoints)
        if isinstance(routes, (str, os.PathLike)):
            fields["routes"] = os.fspath(routes)
        elif routes is not None:
            fields["routes"] = [(name, _numbers(corners)) for name, corners in routes.items()]
        return ZoneStudy(self._core.ztv(fields, progress))

    def dwellings(
        self,
        turbines: Path | Iterable[Turbine],
        *,
        crs: str = "",
        dwellings: Path | Iterable[Place] | None = None,
        dwelling_theme: str = "",
        radius: float = 2000.0,
        eye_height: float = 2.0,
        year: int | None = None,
        utc_offset_minutes: int = 0,
        limit_minutes_year: float = 1800.0,
        limit_minutes_day: float = 30.0,
        months: Path | Sequence[tuple[float, float]] | None = None,
        least_elevation_deg: float = 3.0,
        reach_diameters: float = 10.0,
        blade_width: float | None = None,
        earth: Earth = Earth(),
        themes: Themes = "all",
        without: Features = (),
        nodata: NoData = "unknown",
        foliage: float | None = None,
        transmittance: float = 0.5,
        memory_bytes: int = 1 << 30,
        progress: Progress | None = None,
    ) -> Dwellings:
        """Tells what dwellings see of wind turbines, facade by facade, and when their shadows flicker there.

        Args:
            turbines: Turbines, or a file of them as ``itin dwellings --turbines`` takes it.
            crs: The CRS of files that state none.
            dwellings: Places, or a file of points. One that lies on a building of ``themes`` is that building, any other
                a place in the open. None: all buildings of ``themes``.
            dwelling_theme: The theme whose buildings are dwellings; empty: any.
            radius: Dwellings are studied up to this distance from a turbine, metres, and wherever its shadow reaches.
            eye_height: Metres above the bare ground.
            year: The year of the sun, 1950 to 2100. None: the current one.
            utc_offset_minutes: How far the clock of the calendar is ahead of UTC, summer and winter.
            limit_minutes_year: How much flicker a dwelling may have in the year, in the worst case.
            limit_minutes_day: How much on a day.
            months: Tells the likely flicker, too, by the shares, 0 to 1, of each month's daylight in which the sun
                shines and of its time in which the turbines turn: twelve pairs, or a table as
                ``itin dwellings --months`` takes it.
            least_elevation_deg: A lower sun throws no shadow.
            reach_diameters: How far a turbine's shadow reaches, in diameters of its rotor.
            blade_width: The mean width of a blade, metres; shadows reach 687 times as far, instead.
            foliage: Tells what is seen through woods in summer and in winter, too. Flicker takes them as solid.

        Raises:
            InputError: No turbine that can be used, one within a building, no dwelling within reach, ...; ``field`` has
                the argument's name.
        """
        fields = given({k: v for k, v in locals().items() if k not in ("self", "crs", "progress")})
        fields["turbine_crs"] = crs
        fields["themes"] = names_of(themes)
        fields["without"] = list_of(without)
        fields["year"] = _this_year() if year is None else year
        if not isinstance(turbines, (str, os.PathLike)):
            fields["turbines"] = [fields_of(turbine) | {"radius": radius} for turbine in turbines]
        if dwellings is not None and not isinstance(dwellings, (str, os.PathLike)):
            fields["dwellings"] = _places(dwellings)
        return Dwellings(self._core.dwellings(fields, progress))
