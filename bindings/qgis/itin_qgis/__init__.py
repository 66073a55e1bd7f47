"""itin in QGIS: viewsheds, lines of sight, radio links, sites for masts and wind turbines, as algorithms of Processing."""


def classFactory(iface):  # noqa: N802, the name that QGIS calls
    """Returns the plugin."""
    from .plugin import Plugin

    return Plugin(iface)
