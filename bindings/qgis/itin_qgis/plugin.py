"""The plugin: it adds the provider to Processing."""

from __future__ import annotations

from typing import Any

from qgis.core import QgsApplication

from .provider import Provider


class Plugin:
    """Made by QGIS, with windows or without."""

    def __init__(self, iface: Any) -> None:
        self._provider: Provider | None = None

    def initProcessing(self) -> None:  # noqa: N802, as all names that QGIS calls
        self._provider = Provider()
        QgsApplication.processingRegistry().addProvider(self._provider)

    def initGui(self) -> None:  # noqa: N802
        self.initProcessing()

    def unload(self) -> None:
        if self._provider is not None:
            QgsApplication.processingRegistry().removeProvider(self._provider)
            self._provider = None
