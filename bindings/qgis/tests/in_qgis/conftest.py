"""QGIS without windows, with the plugin as it is installed from its zip, and stores of demo data."""

from __future__ import annotations

import io
import os
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Optional

import pytest

SOURCE = Path(__file__).resolve().parents[4]
DATA = SOURCE / "scripts" / "demo-data"
PROGRAM = os.environ["ITIN_PROGRAM"]
PLUGINS = os.environ["ITIN_QGIS_PLUGINS"]  # the folder that the zip was unpacked in

TURBINES = "x,y,name,hub_height,rotor_diameter,farm\n318000,190000,a,80,90,Caerphilly\n325000,200000,b,60,60,Ebbw\n"
VIEWPOINTS = "x,y,name\n320000,176000,Cardiff Bay\n"
LINKS = "id,x1,y1,h1,x2,y2,h2\na,310375,183525,20,312000,185000,12\nb,310375,183525,20,308000,181000,12\n"
SITES = "x,y,name\n310375,183525,Garth\n322300,190000,East\n314200,177800,South\n"
MASTS = "name,x,y,height\nchurch,321790,4297662,18\nmill,321900,4297850,12\n"
BOX = (308000, 181000, 314000, 187000)

# The program is in PATH, and imports are told one time.
os.environ["PATH"] = f"{Path(PROGRAM).parent}{os.pathsep}{os.environ['PATH']}"
os.environ["SOURCE_DATE_EPOCH"] = "0"

from headless import running_qgis
from qgis.core import (
    QgsApplication,
    QgsProcessingAlgRunnerTask,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
)


class Feedback(QgsProcessingFeedback):
    """Keeps what is told."""

    def __init__(self) -> None:
        super().__init__()
        self.errors: list[str] = []
        self.warnings: list[str] = []
        self.commands: list[str] = []
        self.printed: list[str] = []

    def reportError(self, error: str, fatalError: bool = False) -> None:  # noqa: N802, N803
        self.errors.append(error)

    def pushWarning(self, warning: str) -> None:  # noqa: N802
        self.warnings.append(warning)

    def pushCommandInfo(self, info: str) -> None:  # noqa: N802
        self.commands.append(info)

    def pushConsoleInfo(self, info: str) -> None:  # noqa: N802
        self.printed.append(info)


class Qgis:
    """Runs algorithms."""

    def __init__(self) -> None:
        self.project = QgsProject.instance()

    def run(self, name: str, values: dict[str, Any], feedback: Optional[Feedback] = None) -> dict[str, Any]:
        """Runs an algorithm, which must succeed, and returns its results."""
        import processing

        return processing.run(f"itin:{name}", values, feedback=feedback or Feedback())

    def failure(self, name: str, values: dict[str, Any]) -> str:
        """Runs an algorithm, which must fail, and returns what it says."""
        feedback = Feedback()
        with pytest.raises(QgsProcessingException) as failed:
            self.run(name, values, feedback)
        return "\n".join([*feedback.errors, str(failed.value)])

    def load(self, name: str, values: dict[str, Any]) -> dict[str, Any]:
        """Runs an algorithm in the background, and loads its results, as the dialog does."""
        from processing.gui.Postprocessing import handleAlgorithmResults

        algorithm = QgsApplication.processingRegistry().createAlgorithmById(f"itin:{name}")
        context, feedback = self.context(), Feedback()
        for definition in algorithm.destinationParameterDefinitions():
            if definition.name() in values and definition.type() in ("rasterDestination", "vectorDestination"):
                output = QgsProcessingOutputLayerDefinition(values[definition.name()], self.project)
                values = {**values, definition.name(): output}
        done: list[tuple[bool, dict[str, Any]]] = []
        task = QgsProcessingAlgRunnerTask(algorithm, values, context, feedback)
        task.executed.connect(lambda ok, results: done.append((ok, results)))
        QgsApplication.taskManager().addTask(task)
        end = time.monotonic() + 60
        while not done and time.monotonic() < end:
            QgsApplication.processEvents()
        assert done and done[0][0], feedback.errors
        assert handleAlgorithmResults(algorithm, context, feedback), feedback.errors
        return done[0][1]

    def context(self) -> QgsProcessingContext:
        context = QgsProcessingContext()
        context.setProject(self.project)
        return context


@pytest.fixture(scope="session")
def application() -> Iterator[QgsApplication]:
    with running_qgis() as application:
        yield application


@pytest.fixture
def qgis(application: QgsApplication) -> Iterator[Qgis]:
    QgsProject.instance().clear()
    yield Qgis()
    QgsProject.instance().clear()


def run_program(*words: object) -> str:
    """Runs the command line, which must succeed, and returns what it prints."""
    done = subprocess.run([PROGRAM, *map(str, words), "--quiet"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def cardiff(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("stores") / "cardiff.itin"
    run_program("import", path, DATA / "cardiff.tif")
    return path


@pytest.fixture(scope="session")
def town(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("stores") / "town.itin"
    run_program("import", path, DATA / "alexandria-dtm.tif")
    run_program("import", path, DATA / "alexandria-buildings.geojson", "--kind=buildings", "--height-field=HEIGHT")
    return path


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Layers as planners have them."""
    folder = tmp_path_factory.mktemp("layers")
    (folder / "links.csv").write_text(LINKS)
    for name, text, code in (
        ("sites", SITES, 27700),
        ("turbines", TURBINES, 27700),
        ("viewpoints", VIEWPOINTS, 27700),
        ("masts", MASTS, 26918),
    ):
        write_points(folder / f"{name}.gpkg", text, code)
    write_area(folder / "area.gpkg", *BOX)
    return folder


def write_points(path: Path, table: str, code: int) -> None:
    import geopandas
    import pandas

    rows = pandas.read_csv(io.StringIO(table))
    points = geopandas.points_from_xy(rows.pop("x"), rows.pop("y"))
    geopandas.GeoDataFrame(rows, geometry=points, crs=code).to_file(path, layer=path.stem, driver="GPKG")


def write_area(path: Path, *box: float) -> None:
    import geopandas
    from shapely.geometry import box as box_of

    geopandas.GeoDataFrame(geometry=[box_of(*box)], crs=27700).to_file(path, driver="GPKG")
