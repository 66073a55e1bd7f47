"""QGIS without windows, with the plugin as it is unpacked in the folder ITIN_QGIS_PLUGINS. The program is in PATH.

    headless.py SCRIPT      runs a Python script as QGIS's console does
"""

from __future__ import annotations

import os
import runpy
import sys
from collections.abc import Iterator
from contextlib import contextmanager

os.environ["QT_QPA_PLATFORM"] = "offscreen"
sys.path[:0] = ["/usr/share/qgis/python/plugins", os.environ["ITIN_QGIS_PLUGINS"]]

from qgis.core import QgsApplication  # noqa: E402


@contextmanager
def running_qgis() -> Iterator[QgsApplication]:
    """QGIS with Processing and the plugin."""
    application = QgsApplication([], False)
    application.initQgis()
    from itin_qgis import classFactory
    from processing.core.Processing import Processing
    from qgis.analysis import QgsNativeAlgorithms

    Processing.initialize()
    if application.processingRegistry().providerById("native") is None:
        application.processingRegistry().addProvider(QgsNativeAlgorithms())
    plugin = classFactory(None)
    plugin.initProcessing()
    yield application
    plugin.unload()
    application.exitQgis()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with running_qgis():
        runpy.run_path(sys.argv[1])
