"""Finding and running the program `itin`, without QGIS."""
