"""What a task asks for, as parameters of Processing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from qgis.core import (
    QgsProcessingParameterBoolean,
    QgsProcessingParameterCrs,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterDistance,
    QgsProcessingParameterEnum,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingParameterFile,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterNumber,
    QgsProcessingParameterPoint,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
    QgsProcessingParameterVectorDestination,
)

from . import enums
from .tasks import parameters as asked

STORES = "Stores of itin (*.itin)"
ALL_FILES = "All files (*)"

_GEOMETRIES = {
    "point": [enums.VECTOR_POINT],
    "line": [enums.VECTOR_LINE],
    "polygon": [enums.VECTOR_POLYGON],
    "line or polygon": [enums.VECTOR_LINE, enums.VECTOR_POLYGON],
    "line or table": [enums.VECTOR],
    "any": [enums.VECTOR],
}


def definition_of(parameter: asked.Parameter) -> QgsProcessingParameterDefinition:
    """Returns the parameter that the dialog shows, and that models and scripts give."""
    may_be_blank = not parameter.required and _default_of(parameter) is None
    definition = _MAKERS[type(parameter)](parameter, may_be_blank)
    if parameter.advanced:
        definition.setFlags(definition.flags() | enums.ADVANCED)
    definition.setHelp(_help_of(parameter))
    return definition


def _default_of(parameter: asked.Parameter) -> Any:
    """Returns what a parameter has unless something else is given; None where that is nothing."""
    if isinstance(parameter, (asked.Number, asked.Choice, asked.Flag, asked.Text)):
        return None if parameter.default == "" else parameter.default
    return None


def _help_of(parameter: asked.Parameter) -> str:
    """Returns the tip. It names the option, since messages of the program do."""
    return "\n".join(text for text in (parameter.help, parameter.option) if text)


def _store(p: asked.Store, optional: bool) -> QgsProcessingParameterFile:
    return QgsProcessingParameterFile(p.name, p.label, optional=optional, fileFilter=f"{STORES};;{ALL_FILES}")


def _new_store(p: asked.NewStore, optional: bool) -> QgsProcessingParameterFileDestination:
    return QgsProcessingParameterFileDestination(p.name, p.label, STORES, None, optional)


def _file(p: asked.File, optional: bool) -> QgsProcessingParameterFile:
    return QgsProcessingParameterFile(p.name, p.label, optional=optional, fileFilter=p.filter or ALL_FILES)


def _files(p: asked.Files, optional: bool) -> QgsProcessingParameterMultipleLayers:
    return QgsProcessingParameterMultipleLayers(p.name, p.label, enums.FILE, None, optional)


def _rasters(p: asked.Rasters, optional: bool) -> QgsProcessingParameterMultipleLayers:
    return QgsProcessingParameterMultipleLayers(p.name, p.label, enums.RASTER, None, optional)


def _raster(p: asked.Raster, optional: bool) -> QgsProcessingParameterRasterLayer:
    return QgsProcessingParameterRasterLayer(p.name, p.label, None, optional)


def _layer(p: asked.Layer, optional: bool) -> QgsProcessingParameterFeatureSource:
    return QgsProcessingParameterFeatureSource(p.name, p.label, _GEOMETRIES[p.geometry], None, optional)


def _field(p: asked.Field, optional: bool) -> QgsProcessingParameterField:
    return QgsProcessingParameterField(p.name, p.label, None, p.of, optional=optional)


def _number(p: asked.Number, optional: bool) -> QgsProcessingParameterNumber:
    limits: dict[str, Any] = {}
    if p.minimum is not None:
        limits["minValue"] = p.minimum
    if p.maximum is not None:
        limits["maxValue"] = p.maximum
    if p.unit == "m":
        distance = QgsProcessingParameterDistance(p.name, p.label, p.default, "", optional, **limits)
        distance.setDefaultUnit(enums.METRES)
        return distance
    kind = enums.INTEGER if p.whole else enums.DOUBLE
    return QgsProcessingParameterNumber(p.name, p.label, kind, p.default, optional, **limits)


def _choice(p: asked.Choice, optional: bool) -> QgsProcessingParameterEnum:
    return QgsProcessingParameterEnum(
        p.name,
        p.label,
        list(p.choices),
        defaultValue=p.default,
        optional=optional,
        usesStaticStrings=True,
    )


def _flag(p: asked.Flag, optional: bool) -> QgsProcessingParameterBoolean:
    return QgsProcessingParameterBoolean(p.name, p.label, p.default, optional)


def _text(p: asked.Text, optional: bool) -> QgsProcessingParameterString:
    return QgsProcessingParameterString(p.name, p.label, p.default or None, optional=optional)


def _further(p: asked.Further, optional: bool) -> QgsProcessingParameterString:
    return QgsProcessingParameterString(p.name, p.label, None, optional=optional)


def _point(p: asked.Point, optional: bool) -> QgsProcessingParameterPoint:
    return QgsProcessingParameterPoint(p.name, p.label, None, optional)


def _extent(p: asked.Extent, optional: bool) -> QgsProcessingParameterExtent:
    return QgsProcessingParameterExtent(p.name, p.label, None, optional)


def _crs(p: asked.Crs, optional: bool) -> QgsProcessingParameterCrs:
    return QgsProcessingParameterCrs(p.name, p.label, None, optional)


def _raster_output(p: asked.RasterOutput, optional: bool) -> QgsProcessingParameterRasterDestination:
    return QgsProcessingParameterRasterDestination(p.name, p.label, None, optional, p.required or p.default)


def _vector_output(p: asked.VectorOutput, optional: bool) -> QgsProcessingParameterVectorDestination:
    return QgsProcessingParameterVectorDestination(p.name, p.label, enums.VECTOR, None, optional, p.required or p.default)


def _file_output(p: asked.FileOutput, optional: bool) -> QgsProcessingParameterFileDestination:
    return QgsProcessingParameterFileDestination(p.name, p.label, p.filter, None, optional, p.required or p.default)


def _folder_output(p: asked.FolderOutput, optional: bool) -> QgsProcessingParameterFolderDestination:
    return QgsProcessingParameterFolderDestination(p.name, p.label, None, optional, p.required or p.default)


_MAKERS: dict[type[asked.Parameter], Callable[[Any, bool], QgsProcessingParameterDefinition]] = {
    asked.Store: _store,
    asked.NewStore: _new_store,
    asked.File: _file,
    asked.Files: _files,
    asked.Rasters: _rasters,
    asked.Raster: _raster,
    asked.Layer: _layer,
    asked.Field: _field,
    asked.Number: _number,
    asked.Choice: _choice,
    asked.Flag: _flag,
    asked.Text: _text,
    asked.Texts: _text,
    asked.Further: _further,
    asked.Point: _point,
    asked.Extent: _extent,
    asked.Crs: _crs,
    asked.RasterOutput: _raster_output,
    asked.VectorOutput: _vector_output,
    asked.FileOutput: _file_output,
    asked.FolderOutput: _folder_output,
}
