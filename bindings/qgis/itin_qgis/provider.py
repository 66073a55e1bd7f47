"""The provider of Processing."""

from __future__ import annotations

from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from . import settings
from .algorithm import ItinAlgorithm
from .tasks import TASKS


class Provider(QgsProcessingProvider):
    """All algorithms, whether or not the program is there: without it they say where to get it."""

    def id(self) -> str:
        return "itin"

    def name(self) -> str:
        return "itin"

    def longName(self) -> str:  # noqa: N802, as all names that QGIS calls
        return "itin: viewsheds, links, masts, wind turbines"

    def icon(self) -> QIcon:
        return settings.icon()

    def load(self) -> bool:
        settings.add()
        self.refreshAlgorithms()
        return True

    def unload(self) -> None:
        settings.remove()

    def loadAlgorithms(self) -> None:  # noqa: N802
        for task in TASKS:
            self.addAlgorithm(ItinAlgorithm(task))

    def supportedOutputRasterLayerExtensions(self) -> list[str]:  # noqa: N802
        return ["tif"]

    def supportedOutputVectorLayerExtensions(self) -> list[str]:  # noqa: N802
        return ["gpkg"]

    def supportsNonFileBasedOutput(self) -> bool:  # noqa: N802
        return False
