"""What a planner gives to an algorithm, as the plain values of a task."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
)

from . import enums, layers
from .tasks import parameters as asked
from .tasks.task import IN_CRS, Task


def crs_text(crs: QgsCoordinateReferenceSystem) -> str:
    """Returns the code of a CRS that has one, or else its well-known text."""
    code = crs.authid()
    return crs.toWkt(enums.WKT) if not code or code.upper().startswith("USER:") else code


def is_result(parameter: asked.Parameter) -> bool:
    """Says whether a parameter is a file or folder that the program makes."""
    return isinstance(parameter, (asked.Output, asked.NewStore))


class Given:
    """What one run of an algorithm was given."""

    def __init__(
        self,
        algorithm: QgsProcessingAlgorithm,
        given: dict[str, Any],
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> None:
        self._algorithm = algorithm
        self._given = given
        self._context = context
        self._feedback = feedback
        self._crs: Optional[QgsCoordinateReferenceSystem] = None

    def inputs(self, task: Task) -> dict[str, Any]:
        """Returns the value of each parameter that has one and is no result. Places and extents are in one CRS, that of
        the first of them, which is among the values."""
        values = {p.name: self._value(p) for p in task.parameters if not is_result(p) and self._is_given(p)}
        if self._crs is not None and self._crs.isValid():
            values[IN_CRS] = crs_text(self._crs)
        return values

    def results(self, task: Task) -> dict[str, str]:
        """Returns the file or folder of each result that is asked for."""
        paths = {p.name: self._value(p) for p in task.parameters if is_result(p)}
        return {name: path for name, path in paths.items() if path}

    def _is_given(self, parameter: asked.Parameter) -> bool:
        default = self._algorithm.parameterDefinition(parameter.name).defaultValue()
        return self._given.get(parameter.name, default) not in (None, "", [])

    def _value(self, parameter: asked.Parameter) -> Any:
        return _READERS[type(parameter)](self, parameter)

    def _as(self, kind: str, parameter: asked.Parameter) -> Any:
        """Returns the value by `parameterAs...` of the algorithm."""
        return getattr(self._algorithm, f"parameterAs{kind}")(self._given, parameter.name, self._context)

    def _text(self, parameter: asked.Parameter) -> str:
        return self._as("String", parameter)

    def _number(self, parameter: asked.Parameter) -> float:
        return self._as("Double", parameter)

    def _choice(self, parameter: asked.Parameter) -> str:
        return self._as("EnumString", parameter)

    def _flag(self, parameter: asked.Parameter) -> bool:
        return self._as("Boolean", parameter)

    def _file(self, parameter: asked.Parameter) -> str:
        return self._as("File", parameter)

    def _files(self, parameter: asked.Parameter) -> list[str]:
        return self._as("FileList", parameter)

    def _field(self, parameter: asked.Parameter) -> str:
        return self._as("Fields", parameter)[0]

    def _crs_of(self, parameter: asked.Parameter) -> str:
        return crs_text(self._as("Crs", parameter))

    def _rasters(self, parameter: asked.Parameter) -> list[str]:
        found = self._as("LayerList", parameter)
        given = self._given[parameter.name]
        if isinstance(given, (list, tuple)) and len(found) != len(given):
            raise QgsProcessingException(f"{parameter.label}: one of them is no raster that QGIS can read.")
        return [layers.raster_file(parameter.label, layer) for layer in found]

    def _raster(self, parameter: asked.Parameter) -> str:
        layer = self._as("RasterLayer", parameter)
        if layer is None:
            raise QgsProcessingException(self._algorithm.invalidRasterError(self._given, parameter.name))
        return layers.raster_file(parameter.label, layer)

    def _layer(self, parameter: asked.Layer) -> asked.LayerFile:
        crs_is_given = bool(self._given.get("CRS"))
        return layers.vector_file(self._algorithm, parameter, self._given, self._context, self._feedback, crs_is_given)

    def _point(self, parameter: asked.Parameter) -> asked.Place:
        crs = self._common_crs("PointCrs", parameter)
        point = self._algorithm.parameterAsPoint(self._given, parameter.name, self._context, crs)
        return asked.Place(point.x(), point.y())

    def _extent(self, parameter: asked.Parameter) -> asked.Box:
        crs = self._common_crs("ExtentCrs", parameter)
        box = self._algorithm.parameterAsExtent(self._given, parameter.name, self._context, crs)
        return asked.Box(box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum())

    def _common_crs(self, kind: str, parameter: asked.Parameter) -> QgsCoordinateReferenceSystem:
        """Returns the CRS of the first place or extent that was asked for."""
        if self._crs is None:
            self._crs = self._as(kind, parameter)
        return self._crs

    def _output_layer(self, parameter: asked.Parameter) -> str:
        return self._as("OutputLayer", parameter)

    def _output_file(self, parameter: asked.Parameter) -> str:
        return self._as("FileOutput", parameter)


_READERS: dict[type[asked.Parameter], Callable[[Given, Any], Any]] = {
    asked.Store: Given._file,
    asked.NewStore: Given._output_file,
    asked.File: Given._file,
    asked.Files: Given._files,
    asked.Rasters: Given._rasters,
    asked.Raster: Given._raster,
    asked.Layer: Given._layer,
    asked.Field: Given._field,
    asked.Number: Given._number,
    asked.Choice: Given._choice,
    asked.Flag: Given._flag,
    asked.Text: Given._text,
    asked.Texts: Given._text,
    asked.Further: Given._text,
    asked.Point: Given._point,
    asked.Extent: Given._extent,
    asked.Crs: Given._crs_of,
    asked.RasterOutput: Given._output_layer,
    asked.VectorOutput: Given._output_layer,
    asked.FileOutput: Given._output_file,
    asked.FolderOutput: Given._output_file,
}
