"""A task as an algorithm of Processing: asks for its values, runs the program, and hands on what it made."""

from __future__ import annotations

import json
import os
import shlex
from typing import Any, Optional

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProcessingOutputHtml,
    QgsProcessingOutputString,
)
from qgis.PyQt.QtGui import QIcon

from . import results, settings
from .definitions import definition_of
from .program.find import NoProgram, find_program
from .program.progress import Caution, Progress, Said
from .program.run import Cancelled, Failed, run
from .tasks.parameters import FileOutput, FolderOutput, NewStore, Output, RasterOutput, VectorOutput
from .tasks.task import LOAD, Task
from .values import Given, is_result

PRINTED = "PRINTED"
PAGE = "PAGE"

_SHOWN = (".gpkg", ".geojson", ".2dm")
"""Endings of files that QGIS can show."""


class ItinAlgorithm(QgsProcessingAlgorithm):
    """The algorithm of a task."""

    def __init__(self, task: type[Task]) -> None:
        super().__init__()
        self._kind = task
        self._task = task()
        self._values: dict[str, Any] = {}
        self._crs: Optional[QgsCoordinateReferenceSystem] = None

    def createInstance(self) -> ItinAlgorithm:  # noqa: N802, as all names that QGIS calls
        return ItinAlgorithm(self._kind)

    def name(self) -> str:
        return self._task.name

    def displayName(self) -> str:  # noqa: N802
        return self._task.title

    def group(self) -> str:
        return self._task.group

    def groupId(self) -> str:  # noqa: N802
        return self._task.group.lower().replace(" ", "")

    def icon(self) -> QIcon:
        return settings.icon()

    def shortHelpString(self) -> str:  # noqa: N802
        return f"<p>{self._task.summary}</p><p>Guide: docs/{self._task.guide} of itin</p>"

    def tags(self) -> list[str]:
        return ["itin", self._task.verb]

    def initAlgorithm(self, configuration: Optional[dict[str, Any]] = None) -> None:  # noqa: N802
        for parameter in self._task.parameters:
            self.addParameter(definition_of(parameter))
            if isinstance(parameter, FolderOutput) and parameter.page:
                self.addOutput(QgsProcessingOutputHtml(PAGE, "Report"))
        if self._task.prints:
            self.addOutput(QgsProcessingOutputString(PRINTED, "What the program printed"))

    def prepareAlgorithm(  # noqa: N802
        self, parameters: dict[str, Any], context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> bool:
        # Layers may be looked at in this thread alone.
        self._values = Given(self, parameters, context, feedback).inputs(self._task)
        return True

    def processAlgorithm(  # noqa: N802
        self, parameters: dict[str, Any], context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> dict[str, Any]:
        # Of results that are to be loaded, QGIS remembers those that were asked for in this thread alone.
        self._values |= Given(self, parameters, context, feedback).results(self._task)
        self._make_folders()
        printed = _call(self._task.arguments(self._values), feedback)
        feedback.pushConsoleInfo(printed)
        made = {p.name: self._values[p.name] for p in self._results()}
        if any(path.endswith(".2dm") for path in made.values()):
            self._crs = _crs_of(self._values["STORE"], feedback)
        return {**made, **self._pages(), **({PRINTED: printed} if self._task.prints else {})}

    def postProcessAlgorithm(  # noqa: N802
        self, context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> dict[str, Any]:
        if context.project() is None:
            return {}
        for output in self._results():
            path = self._values[output.name]
            if isinstance(output, (RasterOutput, VectorOutput)):
                results.finish_output(path, context)
            elif isinstance(output, FolderOutput) and self._values.get(LOAD):
                results.load_folder(path, output, self._task.title, context)
            elif isinstance(output, FileOutput) and output.shown and path.endswith(_SHOWN):
                results.load_file(path, output.label, self._crs, context)
        return {}

    def _results(self) -> list[Output | NewStore]:
        """Returns the parameters that have become files or folders."""
        return [p for p in self._task.parameters if is_result(p) and p.name in self._values]

    def _make_folders(self) -> None:
        for output in self._results():
            if isinstance(output, FolderOutput) and output.suffix:
                os.makedirs(self._values[output.name], exist_ok=True)

    def _pages(self) -> dict[str, str]:
        """Returns the page of a folder that the results viewer shows."""
        for output in self._results():
            if isinstance(output, FolderOutput) and output.page:
                return {PAGE: os.path.join(self._values[output.name], output.page)}
        return {}


def _call(arguments: list[str], feedback: QgsProcessingFeedback) -> str:
    """Runs the program, and returns what it prints. Whatever goes wrong fails the algorithm."""
    stage = ""

    def told(said: Said) -> None:
        nonlocal stage
        if isinstance(said, Progress):
            feedback.setProgress(100 * said.share)
            if stage != (stage := said.stage):
                feedback.setProgressText(stage)  # a line of the log each
        elif isinstance(said, Caution):
            feedback.pushWarning(said.text)
        else:
            feedback.pushConsoleInfo(said.text)

    try:
        program = find_program(settings.program())
        feedback.pushCommandInfo(shlex.join(["itin", *arguments]))
        return run(program, arguments, told, feedback.isCanceled)
    except (NoProgram, Failed, Cancelled) as error:
        raise QgsProcessingException(str(error)) from error


def _crs_of(store: str, feedback: QgsProcessingFeedback) -> QgsCoordinateReferenceSystem:
    """Returns the CRS of a store, for files that cannot state it."""
    return QgsCoordinateReferenceSystem(json.loads(_call(["info", store, "--json"], feedback))["crs"])
