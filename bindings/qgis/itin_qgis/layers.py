"""Layers of QGIS as files that the program can read: as they are, written to a file first, or refused in a sentence."""

from __future__ import annotations

import os
from typing import Any

from qgis.core import (
    QgsFeatureSource,
    QgsMapLayer,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProviderRegistry,
    QgsVectorLayer,
    QgsWkbTypes,
)

from . import enums
from .tasks.parameters import Layer, LayerFile

_READ = ["gpkg", "shp", "geojson", "json", "csv", "tsv", "gml", "kml", "fgb", "sqlite", "tab"]
"""Endings of vector files that the program reads as QGIS does."""


def vector_file(
    algorithm: QgsProcessingAlgorithm,
    parameter: Layer,
    given: dict[str, Any],
    context: QgsProcessingContext,
    feedback: QgsProcessingFeedback,
    crs_is_given: bool,
) -> LayerFile:
    """Returns the file of a vector layer. What is selected, filtered, edited, in memory, in a database or on the web is
    written to a GeoPackage first; a table without places, to CSV."""
    source = algorithm.parameterAsSource(given, parameter.name, context)
    if source is None:
        raise QgsProcessingException(algorithm.invalidSourceError(given, parameter.name))
    is_table = QgsWkbTypes.geometryType(source.wkbType()) == enums.NO_GEOMETRY
    if not is_table and not crs_is_given:
        _require_crs(parameter, source)
    layer = algorithm.parameterAsVectorLayer(given, parameter.name, context)
    read = [] if layer is not None and _has_more_than_its_file(layer, parameter) else _READ
    path, name = algorithm.parameterAsCompatibleSourceLayerPathAndLayerName(
        given, parameter.name, context, read, "csv" if is_table else "gpkg", feedback
    )
    if not os.path.exists(path):
        raise QgsProcessingException(f"{parameter.label}: {source.sourceName()} could not be written to a file.")
    return LayerFile(path, name if layer is not None and path == _path_of(layer) else "")


def _path_of(layer: QgsVectorLayer) -> str:
    """Returns the file that a layer is in. One that was written for the program has a layer of another name."""
    return QgsProviderRegistry.instance().decodeUri(layer.providerType(), layer.source()).get("path") or ""


def _require_crs(parameter: Layer, source: QgsFeatureSource) -> None:
    if not source.sourceCrs().isValid():
        raise QgsProcessingException(
            f"{parameter.label}: {source.sourceName()} has no CRS. Give it one (Layer > Set CRS of Layer(s)), "
            "and run again."
        )


def _has_more_than_its_file(layer: QgsVectorLayer, parameter: Layer) -> bool:
    """Says whether QGIS knows of the layer what the program would not read in its file."""
    provider = layer.dataProvider()
    return (
        layer.isModified()
        or layer.fields().names() != provider.fields().names()
        or layer.crs() != provider.crs()
        or (not parameter.layer_option and provider.subLayerCount() > 1)
    )


def raster_file(label: str, layer: QgsMapLayer) -> str:
    """Returns the file of a raster layer."""
    path = layer.source()
    if not os.path.isfile(path):
        raise QgsProcessingException(
            f"{label}: {layer.name()} is no raster file on this computer. Save it as a GeoTIFF (Export > Save As), "
            "and run again with that."
        )
    if layer.crs() != layer.dataProvider().crs():
        raise QgsProcessingException(
            f"{label}: {layer.name()} has another CRS in QGIS than in its file. Write the CRS into the file "
            "(Raster > Projections > Assign Projection), and run again."
        )
    return path
