"""Which radio links are in sight: the lines of a layer, judged as a GeoDataFrame.

    links_table.py cardiff.itin links.gpkg judged.gpkg
"""

from __future__ import annotations

import sys

import geopandas
import numpy as np

import itin


def main(store_path: str, lines_path: str, output: str) -> None:
    store = itin.Store(store_path)
    lines = geopandas.read_file(lines_path).to_crs(store.crs)
    starts = np.array([line.coords[0][:2] + (20.0,) for line in lines.geometry])
    ends = np.array([line.coords[-1][:2] + (12.0,) for line in lines.geometry])

    links = store.links(starts, ends, frequency_ghz=7.5, earth=itin.Earth.effective_earth(4 / 3))
    lines["verdict"] = [itin.Verdict(v).name.lower() for v in links.verdict]
    lines["clearance_m"] = links.clearance.round(2)
    lines["fresnel_fraction"] = links.fresnel_fraction.round(3)
    lines["diffraction_db"] = links.diffraction_db.round(2)
    lines.to_file(output, driver="GPKG")
    print(lines.drop(columns="geometry").to_string(index=False))
    for number, message in links.messages.items():
        print(f"link {number}: {message}", file=sys.stderr)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("links_table.py STORE LINES OUTPUT.gpkg")
    try:
        main(*sys.argv[1:])
    except itin.Error as error:
        sys.exit(str(error))
