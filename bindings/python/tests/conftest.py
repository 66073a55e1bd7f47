"""A store of the terrain about Cardiff and one of a town with houses, made once; and the command line to compare with."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import pytest

import itin

SOURCE = Path(__file__).resolve().parents[3]
DATA = SOURCE / "scripts" / "demo-data"
PROGRAM = os.environ["ITIN_PROGRAM"]


def run(*arguments: object) -> str:
    """Runs the command line, and returns what it prints."""
    done = subprocess.run([PROGRAM, *map(str, arguments), "--quiet"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def cardiff_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("cardiff") / "cardiff.itin"
    itin.import_terrain(path, DATA / "cardiff.tif")
    return path


@pytest.fixture(scope="session")
def cardiff(cardiff_file: Path) -> itin.Store:
    return itin.Store(cardiff_file)


@pytest.fixture(scope="session")
def wooded(tmp_path_factory: pytest.TempPathFactory) -> itin.Store:
    """The town's houses, and among them an avenue of trees and a grove, both with leaf areas of their own."""
    path = tmp_path_factory.mktemp("wooded") / "wooded.itin"
    itin.import_terrain(path, DATA / "alexandria-dtm.tif")
    itin.import_features(path, DATA / "alexandria-buildings.geojson", kind="buildings", height_field="HEIGHT")
    boxes = (("Avenue", 0.4, 321810, 4297600, 321830, 4297780), ("Lime Grove", 2, 321760, 4297690, 321800, 4297720))
    features = [
        {
            "type": "Feature",
            "properties": {"name": name, "leaves": leaves},
            "geometry": {"type": "Polygon", "coordinates": [[[a, b], [c, b], [c, d], [a, d], [a, b]]]},
        }
        for name, leaves, a, b, c, d in boxes
    ]
    trees = path.with_name("trees.geojson")
    trees.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    itin.import_features(
        path,
        trees,
        crs="EPSG:26918",
        kind="vegetation",
        theme="trees",
        height=15,
        name_field="name",
        attributes=["leaves"],
    )
    return itin.Store(path)


@pytest.fixture(scope="session")
def town(tmp_path_factory: pytest.TempPathFactory) -> itin.Store:
    path = tmp_path_factory.mktemp("town") / "town.itin"
    itin.import_terrain(path, DATA / "alexandria-dtm.tif")
    itin.import_features(path, DATA / "alexandria-buildings.geojson", kind="buildings", height_field="HEIGHT")
    return itin.Store(path)
