"""Enumerations, by the names that QGIS 4 has and by those that QGIS 3.22 has: nothing else here names a member of one."""

from __future__ import annotations

from functools import reduce
from typing import Any

from qgis import core


def _first(*names: str) -> Any:
    """Returns what the first of these names of `qgis.core` stands for that this QGIS has."""
    for name in names:
        try:
            return reduce(getattr, name.split("."), core)
        except AttributeError:
            continue
    raise ImportError(f"This QGIS has none of {', '.join(names)}.")


def _source(name: str) -> Any:
    return _first(f"Qgis.ProcessingSourceType.{name}", f"QgsProcessing.SourceType.Type{name}")


VECTOR_POINT = _source("VectorPoint")
VECTOR_LINE = _source("VectorLine")
VECTOR_POLYGON = _source("VectorPolygon")
VECTOR = _source("Vector")
RASTER = _source("Raster")
FILE = _source("File")

ADVANCED = _first("Qgis.ProcessingParameterFlag.Advanced", "QgsProcessingParameterDefinition.Flag.FlagAdvanced")
INTEGER = _first("Qgis.ProcessingNumberParameterType.Integer", "QgsProcessingParameterNumber.Type.Integer")
DOUBLE = _first("Qgis.ProcessingNumberParameterType.Double", "QgsProcessingParameterNumber.Type.Double")
METRES = _first("Qgis.DistanceUnit.Meters", "QgsUnitTypes.DistanceUnit.DistanceMeters")

RASTER_HINT = _first("QgsProcessingUtils.LayerHint.Raster")
VECTOR_HINT = _first("QgsProcessingUtils.LayerHint.Vector")
MESH_HINT = _first("QgsProcessingUtils.LayerHint.Mesh")
WKT = _first("Qgis.CrsWktVariant.Preferred", "QgsCoordinateReferenceSystem.WktVariant.WKT_PREFERRED")
NO_GEOMETRY = _first("Qgis.GeometryType.Null", "QgsWkbTypes.GeometryType.NullGeometry")
COUNTED = _first("Qgis.SublayerQueryFlag.CountFeatures")
