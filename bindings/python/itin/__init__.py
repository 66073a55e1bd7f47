"""What can be seen from where over real terrain, with buildings and trees.

    >>> import itin
    >>> itin.import_terrain("cardiff.itin", "cardiff.tif")
    >>> store = itin.Store("cardiff.itin")
    >>> seen = store.viewshed((310375, 183525, 30), radius=20000, cell_size=25)
    >>> seen.verdict.mean(where=seen.verdict != itin.Verdict.OUTSIDE)
    >>> seen.write("mast.tif")

The results are those of the command line, to the byte. Positions are in the store's CRS, lengths in metres.
"""

from ._asked import Bounds, Earth, Grid, Observer, Place, Sector, Turbine, TurbinesToPlace, Verdict, Window
from ._errors import CorruptStore, Error, FileError, InputError
from ._imports import import_features, import_terrain
from ._itin import allow_network, set_thread_count, thread_count
from ._itin import version as __version__
from ._results import (
    ChosenSite,
    Dwelling,
    Dwellings,
    Facade,
    Foliage,
    ImportReport,
    Level,
    LineOfSight,
    LinkCounts,
    Links,
    PathProfile,
    Profile,
    ShadowFlicker,
    SitePlan,
    Theme,
    Tin,
    TurbineView,
    TurbineViews,
    Viewshed,
    WrittenFile,
    ZoneStudy,
)
from ._store import HeldSurface, Store, Surface

__all__ = [
    "Bounds",
    "ChosenSite",
    "CorruptStore",
    "Dwelling",
    "Dwellings",
    "Earth",
    "Error",
    "Facade",
    "FileError",
    "Foliage",
    "Grid",
    "HeldSurface",
    "ImportReport",
    "InputError",
    "Level",
    "LineOfSight",
    "LinkCounts",
    "Links",
    "Observer",
    "PathProfile",
    "Place",
    "Profile",
    "ShadowFlicker",
    "Sector",
    "SitePlan",
    "Store",
    "Surface",
    "Theme",
    "Tin",
    "Turbine",
    "TurbineView",
    "TurbineViews",
    "TurbinesToPlace",
    "Verdict",
    "Viewshed",
    "Window",
    "WrittenFile",
    "ZoneStudy",
    "__version__",
    "allow_network",
    "import_features",
    "import_terrain",
    "set_thread_count",
    "thread_count",
]
