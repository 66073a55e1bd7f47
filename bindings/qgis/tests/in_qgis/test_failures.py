"""Whatever goes wrong fails the algorithm, with the program's own line; and what is cancelled ends within two seconds."""

from __future__ import annotations

import json
import os
import subprocess
import threading
import time
from pathlib import Path
from typing import Any

import pytest
from conftest import DATA, PLUGINS, Feedback, Qgis
from qgis.core import QgsProcessingException

from itin_qgis.tasks import TASKS
from itin_qgis.tasks.parameters import (
    Choice,
    FileOutput,
    FolderOutput,
    Layer,
    NewStore,
    Number,
    Output,
    Point,
    RasterOutput,
    Store,
)
from itin_qgis.tasks.task import Task


GARTH = "310375,183525 [EPSG:27700]"
CONTOURS = str(DATA / "garth-contours.geojson")
BESIDES: dict[str, dict[str, Any]] = {
    "importterrain": {"RASTERS": [str(DATA / "cardiff.tif")]},
    "importfeatures": {"INPUT": CONTOURS, "HEIGHT": 3},
    "surfaceraster": {"CELL": 50},
    "viewshed": {"OBSERVER": GARTH},
    "radiocoverage": {"OBSERVER": GARTH},
    "skyline": {"OBSERVER": GARTH},
    "profile": {"PATH": CONTOURS},
    "sitemasts": {"CANDIDATES": CONTOURS, "COUNT": 1},
    "siteturbines": {"CANDIDATES": CONTOURS, "COUNT": 1, "HUB_HEIGHT": 60, "ROTOR_DIAMETER": 80},
}
"""What verbs ask for although no single option is required."""


def least_values(task: type[Task], store: str, folder: Path) -> dict[str, Any]:
    """Returns the least that a task can be given."""
    values: dict[str, Any] = {}
    for parameter in task.parameters:
        if isinstance(parameter, (Store, NewStore)):
            values[parameter.name] = store
        elif not parameter.required:
            continue
        elif isinstance(parameter, Point):
            values[parameter.name] = GARTH
        elif isinstance(parameter, Layer):
            values[parameter.name] = CONTOURS
        elif isinstance(parameter, Number):
            values[parameter.name] = 100
        elif isinstance(parameter, Choice):
            values[parameter.name] = parameter.choices[0]
        elif isinstance(parameter, Output):
            values[parameter.name] = str(folder / f"out{ending(parameter)}")
    return {**values, **BESIDES.get(task.name, {})}


def ending(output: Output) -> str:
    if isinstance(output, FolderOutput):
        return ""
    if isinstance(output, FileOutput):
        return "." + output.filter.split("*.")[1].split(")")[0].split(" ")[0]
    return ".tif" if isinstance(output, RasterOutput) else ".gpkg"


@pytest.mark.parametrize("task", TASKS, ids=lambda task: task.name)
def test_every_algorithm_fails_where_the_store_is_none(qgis: Qgis, task: type[Task], tmp_path: Path) -> None:
    store = tmp_path / "broken.itin"
    store.write_text("no store")
    said = qgis.failure(task.name, least_values(task, str(store), tmp_path))
    assert "broken.itin" in said
    assert [path.name for path in tmp_path.iterdir()] == ["broken.itin"]


def test_without_the_program_the_remedy_is_told(qgis: Qgis, cardiff: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    assert "Settings > Options > Processing > Providers > itin" in qgis.failure("info", {"STORE": str(cardiff)})


def test_setting_takes_no_other_program(qgis: Qgis) -> None:
    from processing.core.ProcessingConfig import ProcessingConfig

    with pytest.raises(ValueError, match="is not itin"):
        ProcessingConfig.setSettingValue("ITIN_PROGRAM", "/bin/ls")
    assert not ProcessingConfig.getSetting("ITIN_PROGRAM")


def test_what_the_program_refuses_is_told_in_its_words(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    values = {"STORE": str(cardiff), "OBSERVER": "0,0 [EPSG:27700]", "OUTPUT": str(tmp_path / "o.tif")}
    said = qgis.failure("viewshed", values)
    assert "0,0" in said and "itin: error" not in said
    assert not (tmp_path / "o.tif").exists()


def test_links_that_cannot_be_judged_fail_after_all_are_written(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    (tmp_path / "links.csv").write_text("id,x1,y1,h1,x2,y2,h2\na,310375,183525,20,312000,185000,12\nb,0,0,1,1,1,1\n")
    out = tmp_path / "o.gpkg"
    qgis.failure("links", {"STORE": str(cardiff), "LINKS": str(tmp_path / "links.csv"), "OUTPUT": str(out)})
    assert out.exists()


def test_folder_of_other_things_is_left_alone(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "thesis.txt").write_text("years")
    turbines = tmp_path / "t.csv"
    turbines.write_text("x,y,tip_height\n318000,190000,125\n")
    values = {"STORE": str(cardiff), "TURBINES": str(turbines), "RADIUS": 3000, "CELL": 200, "OUTPUT": str(folder)}
    for overwrite in (False, True):
        qgis.failure("ztv", {**values, "OVERWRITE": overwrite})
    assert (folder / "thesis.txt").read_text() == "years"


def test_cancel_is_heard_within_two_seconds(qgis: Qgis, cardiff: Path, tmp_path: Path) -> None:
    feedback = Feedback()
    asked: list[float] = []

    def cancel() -> None:
        asked.append(time.monotonic())
        feedback.cancel()

    timer = threading.Timer(1, cancel)
    timer.start()
    out = tmp_path / "o.tif"
    values = {"STORE": str(cardiff), "OBSERVER": "310375,183525 [EPSG:27700]", "CELL": 5, "OUTPUT": str(out)}
    with pytest.raises(QgsProcessingException, match="Cancelled"):
        qgis.run("viewshed", values, feedback)
    assert asked and time.monotonic() - asked[0] < 2
    assert list(tmp_path.iterdir()) == []


@pytest.fixture(scope="module")
def process(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """`qgis_process`, in a profile where the plugin has just been switched on. Debian's script of that name is broken."""
    profile = tmp_path_factory.mktemp("profile")
    environment = os.environ | {"QGIS_PLUGINPATH": PLUGINS, "QGIS_CUSTOM_CONFIG_PATH": str(profile)}

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        command = ["qgis_process.bin", *words]
        return subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=120)

    assert run("plugins", "enable", "itin_qgis").returncode == 0
    return run


def test_qgis_process_runs_algorithms(process: Any, cardiff: Path, tmp_path: Path) -> None:
    out = tmp_path / "o.tif"
    values = [f"STORE={cardiff}", "OBSERVER=310375,183525", "RADIUS=3000", "CELL=100", f"OUTPUT={out}"]
    done = process("run", "itin:viewshed", "--json", "--", *values)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["results"]["OUTPUT"] == str(out)
    assert out.exists()


def test_qgis_process_tells_failures(process: Any, cardiff: Path, tmp_path: Path) -> None:
    out = tmp_path / "o.tif"
    done = process("run", "itin:viewshed", "--", f"STORE={cardiff}", "OBSERVER=0,0", f"OUTPUT={out}")
    assert done.returncode != 0
    assert not out.exists()
