"""Pictures of QGIS with the plugin, for people to look at: run by `qgis --code` under Xvfb, as scripts/qgis-test does.

It opens the dialog of each algorithm, runs three of them in real dialogs with real buttons, and keeps pictures of the dialogs,
of the map and its layers, of a failure, and of the setting, in ITIN_PICTURES.
"""

import os
import sys
import time
import traceback

from qgis.core import QgsApplication, QgsCoordinateReferenceSystem, QgsProject, QgsRasterLayer
from qgis.PyQt.QtCore import QTimer
from qgis.PyQt.QtWidgets import QApplication, QTreeView
from qgis.utils import iface

PICTURES = os.environ["ITIN_PICTURES"]
STORES = os.environ["ITIN_STORES"]  # a folder with cardiff.itin, town.itin, and layers
GARTH = "310375,183525 [EPSG:27700]"
BAY = "320000,176000 [EPSG:27700]"


def wait(seconds, until=lambda: False):
    """Lets QGIS work for so long, or until something is so."""
    end = time.monotonic() + seconds
    while time.monotonic() < end and not until():
        QApplication.processEvents()
        time.sleep(0.02)


def keep(widget, name):
    wait(0.5)
    widget.grab().save(os.path.join(PICTURES, f"{name}.png"))


def dialog_of(name, values):
    import processing

    dialog = processing.createAlgorithmDialog(f"itin:{name}", values)
    dialog.resize(900, 760)
    dialog.show()
    wait(0.5)
    return dialog


def run_in_dialog(name, values, picture):
    """Presses Run, waits for the end, and keeps the log."""
    dialog = dialog_of(name, values)
    keep(dialog, f"{picture}-dialog")
    finished = []
    dialog.algorithmFinished.connect(lambda *how: finished.append(how))
    dialog.runButton().click()
    wait(1)
    wait(60, lambda: bool(finished) or dialog.runButton().isEnabled())
    wait(1)
    keep(dialog, f"{picture}-log")
    results = dialog.results()
    dialog.close()
    return results


def map_of(name):
    iface.mapCanvas().setExtent(iface.mapCanvas().fullExtent())
    iface.mapCanvas().refreshAllLayers()
    wait(20, lambda: not iface.mapCanvas().isDrawing())
    iface.layerTreeView().expandAllNodes()
    wait(1)
    iface.messageBar().clearWidgets()
    keep(iface.mainWindow(), name)


def fresh():
    """A project with the terrain alone."""
    QgsProject.instance().clear()
    QgsProject.instance().setCrs(QgsCoordinateReferenceSystem("EPSG:27700"))
    QgsProject.instance().addMapLayer(QgsRasterLayer(f"{STORES}/cardiff.tif", "Terrain about Cardiff"))


def pictures():
    window = iface.mainWindow()
    window.resize(1500, 950)
    provider = QgsApplication.processingRegistry().providerById("itin")
    for algorithm in provider.algorithms():
        dialog = dialog_of(algorithm.name(), {"STORE": f"{STORES}/cardiff.itin"})
        keep(dialog, f"dialog-{algorithm.name()}")
        dialog.close()

    fresh()
    store = {"STORE": f"{STORES}/cardiff.itin"}
    viewshed = {"OBSERVER": GARTH, "OBSERVER_HEIGHT": 20, "TARGET_HEIGHT": 2, "RADIUS": 15000, "CELL": 50}
    made = run_in_dialog("viewshed", {**store, **viewshed}, "run-viewshed")
    assert os.path.exists(made["OUTPUT"]), made
    assert len(QgsProject.instance().mapLayers()) == 2, "the viewshed is not loaded"
    map_of("map-viewshed")

    fresh()
    ends = {"FROM": GARTH, "FROM_HEIGHT": 20, "TO": BAY, "TO_HEIGHT": 10, "OUTPUT": f"{STORES}/out/line.gpkg"}
    run_in_dialog("lineofsight", {**store, **ends, "REPORT": f"{STORES}/out/line.html"}, "run-lineofsight")
    map_of("map-lineofsight")

    fresh()
    sites = {"SEARCH_AREA": f"{STORES}/area.gpkg", "SPACING": 3000, "COUNT": 3, "RADIUS": 8000, "CELL": 100}
    run_in_dialog("sitemasts", {**store, **sites, "OUTPUT": f"{STORES}/out/masts"}, "run-sitemasts")
    map_of("map-sitemasts")

    fresh()
    zones = {"TURBINES": f"{STORES}/turbines.gpkg", "RADIUS": 15000, "CELL": 100, "OUTPUT": f"{STORES}/out/ztv"}
    run_in_dialog("ztv", {**store, **zones}, "run-ztv")
    map_of("map-ztv")

    QgsProject.instance().clear()
    masts = {"STORE": f"{STORES}/town.itin", "MASTS": f"{STORES}/masts.gpkg", "RADIUS": 300}
    run_in_dialog("premises", {**masts, "OUTPUT": f"{STORES}/out/premises"}, "run-premises")
    map_of("map-premises")

    wrong = {"OBSERVER": "0,0 [EPSG:27700]", "OUTPUT": f"{STORES}/out/wrong.tif"}
    run_in_dialog("viewshed", {**store, **wrong}, "run-failure")
    toolbox(window)
    setting()


def toolbox(window):
    """The toolbox, with the algorithms of the plugin open."""
    from processing.gui.ProcessingToolbox import ProcessingToolbox

    box = window.findChild(ProcessingToolbox)
    box.show()
    tree = box.findChild(QTreeView)
    for row in range(tree.model().rowCount()):
        index = tree.model().index(row, 0)
        if str(index.data()).startswith("itin"):
            tree.expandRecursively(index)
            tree.scrollTo(index, QTreeView.ScrollHint.PositionAtTop)
    keep(box, "toolbox")


def setting():
    """The setting, in the dialog of Processing's options."""
    from processing.gui.ConfigDialog import ConfigDialog

    dialog = ConfigDialog()
    dialog.resize(900, 500)
    dialog.show()
    wait(0.5)
    open_setting(dialog.tree)
    keep(dialog, "setting")
    dialog.close()


def open_setting(tree):
    model = tree.model()
    for row in range(model.rowCount()):
        group = model.index(row, 0)
        if str(group.data()) != "Providers":
            continue
        tree.expand(group)
        for of in range(model.rowCount(group)):
            provider = model.index(of, 0, group)
            if str(provider.data()) == "itin":
                tree.expand(provider)
                tree.scrollTo(provider, QTreeView.ScrollHint.PositionAtTop)


def main():
    try:
        wait(2)
        pictures()
        status = 0
    except Exception:
        traceback.print_exc()
        status = 1
    sys.stderr.flush()
    os._exit(status)


QTimer.singleShot(3000, main)
