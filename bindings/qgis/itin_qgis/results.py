"""Results as layers: in the program's colours, and what belongs together in a group."""

from __future__ import annotations

import os
from typing import NamedTuple, Optional

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsMapLayer,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingLayerPostProcessorInterface,
    QgsProject,
    QgsProviderRegistry,
)

from . import enums
from .tasks.parameters import FolderOutput

_RANK = "itin/rank"


class Place(NamedTuple):
    """Where a layer goes: in which group, below how many others, and whether it is switched on."""

    group: str
    rank: int
    seen: bool


class Finish(QgsProcessingLayerPostProcessorInterface):
    """What is done to a layer once it is in the project: its style, its CRS, and its place among the layers."""

    # QGIS keeps no reference to these, and Python would delete them before they are called.
    _kept: list[Finish] = []

    def __init__(self, place: Optional[Place] = None, crs: Optional[QgsCoordinateReferenceSystem] = None) -> None:
        super().__init__()
        self._place = place
        self._crs = crs
        Finish._kept = [*Finish._kept[-500:], self]

    @property
    def group(self) -> str:
        """The group that the layer goes to; empty where it goes to none."""
        return self._place.group if self._place else ""

    def postProcessLayer(  # noqa: N802, the name that QGIS calls
        self, layer: QgsMapLayer, context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> None:
        """Finishes the layer."""
        _style(layer)
        if self._crs is not None and not layer.crs().isValid():
            layer.setCrs(self._crs)
        if self._place is not None and context.project() is not None:
            _put(context.project(), layer, self._place)


def _style(layer: QgsMapLayer) -> None:
    """Gives a raster the style beside its file, and any other layer the default style within it."""
    name, ending = os.path.splitext(layer.source())
    if ending == ".tif" and os.path.exists(f"{name}.qml"):
        layer.loadNamedStyle(f"{name}.qml")
    else:
        layer.loadDefaultStyle()
    layer.triggerRepaint()


def _put(project: QgsProject, layer: QgsMapLayer, place: Place) -> None:
    """Moves a layer to its place. A QGIS that has not put it anywhere yet has been told the group otherwise."""
    root = project.layerTreeRoot()
    node = root.findLayer(layer.id())
    if node is None:
        return
    group = root.findGroup(place.group) or root.insertGroup(0, place.group)
    moved = node.clone()
    moved.setCustomProperty(_RANK, place.rank)
    moved.setItemVisibilityChecked(place.seen)
    moved.setExpanded(place.seen)
    above = [child for child in group.children() if int(child.customProperty(_RANK, 0)) <= place.rank]
    group.insertChildNode(len(above), moved)
    node.parent().removeChildNode(node)


def finish_output(path: str, context: QgsProcessingContext) -> None:
    """Has a result finished, if QGIS is to load it."""
    if context.willLoadLayerOnCompletion(path):
        context.layerToLoadOnCompletionDetails(path).setPostProcessor(Finish())


def load_file(path: str, title: str, crs: Optional[QgsCoordinateReferenceSystem], context: QgsProcessingContext) -> None:
    """Has a file loaded that Processing does not take for layers by itself."""
    if path.endswith(".2dm"):
        _load(path, title, enums.MESH_HINT, Finish(crs=crs), context)
        return
    layers = _layers_in(path)
    for rank, (uri, name) in enumerate(layers):
        place = Place(_group_of(path, title), rank, seen=True) if len(layers) > 1 else None
        _load(uri, name if place else title, enums.VECTOR_HINT, Finish(place), context)


def load_folder(folder: str, output: FolderOutput, title: str, context: QgsProcessingContext) -> None:
    """Has the layers of a folder loaded."""
    rank = 0
    for file in output.layers_of(os.listdir(folder)):
        path = os.path.join(folder, file)
        is_raster = file.endswith(".tif")
        hint = enums.RASTER_HINT if is_raster else enums.VECTOR_HINT
        for uri, name in [(path, file[: -len(".tif")])] if is_raster else _layers_in(path):
            rank += 1
            place = Place(_group_of(folder, title), rank, output.is_seen(file if is_raster else name))
            _load(uri, name, hint, Finish(place), context)


def _group_of(path: str, title: str) -> str:
    return f"{title}: {os.path.basename(path.rstrip('/' + os.sep))}"


def _layers_in(path: str) -> list[tuple[str, str]]:
    """Returns the address and name of each layer of a file that holds something to see."""
    return [
        (found.uri(), found.name())
        for found in QgsProviderRegistry.instance().querySublayers(path, enums.COUNTED)
        if found.name() != "layer_styles" and found.featureCount() != 0
    ]


def _load(uri: str, name: str, hint: object, finish: Finish, context: QgsProcessingContext) -> None:
    details = QgsProcessingContext.LayerDetails(name, context.project(), name, hint)
    details.forceName = True
    if finish.group and hasattr(details, "groupName"):
        details.groupName = finish.group
    details.setPostProcessor(finish)
    context.addLayerToLoadOnCompletion(uri, details)
