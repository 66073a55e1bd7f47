"""The pure parts of the plugin, which need no QGIS, and the program that they call."""

from __future__ import annotations

import os
import sys
from pathlib import Path

PLUGINS = Path(__file__).resolve().parents[2]
SOURCE = PLUGINS.parents[1]
PROGRAM = os.environ["ITIN_PROGRAM"]

# The plugin's own package imports QGIS only when QGIS asks for the plugin.
sys.path.insert(0, str(PLUGINS))
