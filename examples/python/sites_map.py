"""Where to put three masts so that they serve the most, drawn on a map by matplotlib.

    sites_map.py cardiff.itin sites.png
"""

from __future__ import annotations

import sys

import matplotlib
import numpy as np

import itin

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def main(store_path: str, output: str) -> None:
    store = itin.Store(store_path)
    middle = np.reshape(store.bounds, (2, 2)).mean(axis=0)
    area = itin.Window.disc(middle[0], middle[1], 5000)
    plan = store.site(search_area=area, spacing=2500, masts=[(20, 1)], radius=5000, cell_size=100, count=3)

    west, south, east, north = plan.grid.bounds
    heights = store.height_raster(plan.grid, themes="none")
    is_served = (plan.best_server >= 1) & (plan.best_server <= len(plan.chosen))
    servers = np.where(is_served, plan.best_server, np.nan)
    figure, axes = plt.subplots(figsize=(8, 8))
    axes.imshow(heights, extent=(west, east, south, north), cmap="gray")
    axes.imshow(servers, extent=(west, east, south, north), cmap="tab10", alpha=0.6, vmin=1, vmax=10)
    for site in plan.chosen:
        axes.plot(site.x, site.y, "k^")
        axes.annotate(f"{site.name}: +{site.gain:g} cells", (site.x, site.y), (5, 5), textcoords="offset points")
    axes.set_title(f"{len(plan.chosen)} masts serve {plan.value:g} cells; no choice serves more than {plan.upper_bound:g}")
    figure.savefig(output, dpi=120)
    for site in plan.chosen:
        print(f"{site.name} at {site.x:.0f}, {site.y:.0f} serves {site.gain:g} further cells")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("sites_map.py STORE OUTPUT.png")
    try:
        main(*sys.argv[1:])
    except itin.Error as error:
        sys.exit(str(error))
