"""Imports into stores."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Literal

from . import _itin
from ._asked import Path, Progress, given
from ._results import ImportReport

ThemeKind = Literal[
    "contours", "breaklines", "water", "roads", "walls", "buildings", "terraces", "vegetation", "surface"
]
"""What lines, footprints or rasters of heights stand for."""


def _import(store: Path, sources: Path | Sequence[Path], fields: dict[str, Any], progress: Progress | None) -> ImportReport:
    several = [sources] if isinstance(sources, (str, os.PathLike)) else sources
    fields["sources"] = [os.fspath(source) for source in several]
    crs, vertices, features, refused, voids, seconds, warnings = _itin.import_into(os.fspath(store), fields, progress)
    return ImportReport(crs, vertices, features, refused, voids, seconds, tuple(warnings))


def import_terrain(
    store: Path,
    sources: Path | Sequence[Path],
    *,
    crs: str = "",
    to_crs: str = "",
    z_field: str = "",
    layer: str = "",
    where: str = "",
    band: int | None = None,
    classes: Sequence[int] = (),
    max_gap: float = 0.0,
    allow_mixed_vertical: bool = False,
    source_note: str = "",
    sea_level: float | None = None,
    sea_area: str = "",
    replace: bool = False,
    tolerances: Sequence[float] = (),
    resolution: float = 0.01,
    memory_bytes: int = 4 << 30,
    progress: Progress | None = None,
) -> ImportReport:
    """Imports terrain, into a new store or into one that is there.

    Args:
        store: The store's file.
        sources: Rasters, LAS, LAZ, point files: one or several.
        crs: The CRS of sources that do not name one; overrides those that do.
        to_crs: The CRS of a new store. By default that of the first source if it is metric, else a UTM zone.
        z_field: The height attribute of point layers and CSV.
        layer: The layer of a vector file.
        where: Only points that this SQL condition holds for.
        band: The band of rasters that holds heights, from 1.
        classes: LAS classes to keep; empty: all but noise.
        max_gap: Ground is not triangulated over longer edges between scattered points, metres; 0: 100 times the spacing.
        allow_mixed_vertical: Take heights as they are, though they refer to different vertical datums.
        source_note: Product, date and licence, for reports.
        sea_level: Missing ground becomes level ground at this elevation, metres.
        sea_area: Polygons, as text or a file, that the sea stays in.
        replace: These sources take the place of others that are no finer.
        tolerances: Of a new store's levels, metres, ascending; empty: 0.5, 1, 2, ..., 32.
        resolution: Of a new store, metres.
        memory_bytes: Bounds the memory.

    Raises:
        InputError: ``field`` names the argument. Whatever is raised, the store stays as it was.
        FileError: A source cannot be read, or the store cannot be written.
    """
    fields = given({k: v for k, v in locals().items() if k not in ("store", "sources", "progress")})
    fields["classes"], fields["tolerances"] = list(classes), list(tolerances)
    return _import(store, sources, fields, progress)


def import_features(
    store: Path,
    sources: Path | Sequence[Path],
    *,
    kind: ThemeKind,
    theme: str = "",
    crs: str = "",
    layer: str = "",
    where: str = "",
    z_field: str = "",
    height_field: str = "",
    eaves_field: str = "",
    height_from: Path = "",
    height_percentile: float | None = None,
    height: float | None = None,
    base_field: str = "",
    base: Literal["minimum", "mean", "maximum", "terrain-following"] | None = None,
    roof: Literal["flat", "gabled", "hipped", "skeleton"] | None = None,
    storey: float | None = None,
    thickness: float | None = None,
    wall_offset: float | None = None,
    height_step: float | None = None,
    height_threshold: float | None = None,
    height_rounding: Literal["nearest", "up", "down"] | None = None,
    id_field: str = "",
    name_field: str = "",
    attributes: Sequence[str] | None = None,
    repair: bool = True,
    stay: bool = False,
    remove: Sequence[str] = (),
    memory_bytes: int = 4 << 30,
    progress: Progress | None = None,
) -> ImportReport:
    """Imports lines, footprints or rasters of standing heights into a theme of a store. They need ground to lie on.

    Args:
        kind: What they stand for.
        theme: The theme's name; empty: the kind.
        height_field: The field of the height of the highest point above the base. With it, ``eaves_field`` or
            ``height`` buildings, vegetation and walls stand on the ground; else they are lines on it.
        eaves_field: The field of the height of the eaves.
        height_from: A raster of a digital surface model in the store's CRS, over the terrain. Features that have no
            height in a field have theirs from it.
        height_percentile: Which of the model's cells within a footprint counts, 0 to 100; None: 50, their median.
        height: Of features that have none in the fields and from the model, metres.
        base_field: The field of the elevation of the base.
        base: What heights count from, of the terrain under a footprint.
        roof: The kind of roof.
        storey: ``height_field`` counts storeys of this height, metres.
        thickness: Of features that stand on lines, metres.
        wall_offset: How far within their outlines walls reach their full height, metres.
        height_step: Cells of rasters stand in multiples of it, metres.
        height_threshold: Lower cells do not stand, metres.
        height_rounding: How heights become steps.
        id_field: The field of the features' ids.
        name_field: The field of their names.
        attributes: Fields to keep. None: all with numbers, texts, dates and times.
        repair: Infer points where the triangles of contours are flat.
        stay: Lines stay within the coverage of sources that replace others.
        remove: Features that stand to take out first: themes, or files by the names that the store has.

    The other arguments are those of ``import_terrain()``, and it raises the same.
    """
    fields = given({k: v for k, v in locals().items() if k not in ("store", "sources", "progress")})
    fields["height_from"] = os.fspath(height_from)
    if attributes is not None:
        fields["attributes"] = list(attributes)
    return _import(store, sources, fields, progress)
