"""The plugin as it is installed: its zip, what it says of itself, what it imports, and the names that QGIS 4 has."""

from __future__ import annotations

import ast
import configparser
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from conftest import PLUGINS, SOURCE

PACKAGE = PLUGINS / "itin_qgis"
MODULES = sorted(PACKAGE.rglob("*.py"))
GUIDE = SOURCE / "docs" / "qgis.md"


def package(source: Path, folder: Path) -> Path:
    command = [sys.executable, str(source / "scripts" / "package-qgis"), str(folder)]
    return Path(subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip())


def test_zip_has_the_same_bytes_from_another_copy(tmp_path: Path) -> None:
    copy = tmp_path / "copy"
    (copy / "scripts").mkdir(parents=True)
    shutil.copy(SOURCE / "scripts" / "package-qgis", copy / "scripts")
    shutil.copy(SOURCE / "LICENSE", copy)
    shutil.copytree(PACKAGE, copy / "bindings" / "qgis" / "itin_qgis")
    (copy / "bindings" / "qgis" / "itin_qgis" / "__pycache__").mkdir(exist_ok=True)
    (copy / "bindings" / "qgis" / "itin_qgis" / "__pycache__" / "x.pyc").write_text("")
    first, second = package(SOURCE, tmp_path / "a"), package(copy, tmp_path / "b")
    assert first.read_bytes() == second.read_bytes()


def test_zip_is_one_folder_with_all_that_qgis_needs(tmp_path: Path) -> None:
    names = zipfile.ZipFile(package(SOURCE, tmp_path)).namelist()
    assert {name.split("/")[0] for name in names} == {"itin_qgis"}
    for needed in ("__init__.py", "metadata.txt", "icon.svg", "LICENSE", "tasks/viewsheds.py"):
        assert f"itin_qgis/{needed}" in names
    assert not [name for name in names if "pycache" in name]


def test_metadata_is_whole_and_of_this_version() -> None:
    metadata = configparser.ConfigParser(interpolation=None)
    metadata.read(PACKAGE / "metadata.txt", encoding="utf-8")
    general = metadata["general"]
    for key in ("name", "description", "about", "author", "qgisMinimumVersion", "hasProcessingProvider"):
        assert general[key]
    project = re.search(r"project\(itin VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())
    assert project and general["version"] == project[1]
    assert (PACKAGE / general["icon"]).exists()


def test_tasks_and_program_need_no_qgis() -> None:
    """Whatever CI tests without QGIS has no way to it."""
    for path in [*(PACKAGE / "tasks").glob("*.py"), *(PACKAGE / "program").glob("*.py")]:
        for node in ast.walk(ast.parse(path.read_text())):
            names = [alias.name for alias in node.names] if isinstance(node, (ast.Import, ast.ImportFrom)) else []
            module = getattr(node, "module", "") or ""
            assert not [name for name in [*names, module] if name.split(".")[0] in ("qgis", "processing")], path


def test_members_of_enumerations_are_named_in_one_place() -> None:
    """QGIS 4 has other names for many: `enums.py` knows both, and nothing else names one."""
    constant = re.compile(r"^(Flag|Type|Layer|Distance)?[A-Z][A-Za-z]*$")
    for path in MODULES:
        if path.name == "enums.py":
            continue
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                of_qgis = re.match(r"^(Qgs|Qgis|Qt$|Q[A-Z])", node.value.id)
                known = node.value.id == "QgsProcessingContext" and node.attr == "LayerDetails"
                assert not (of_qgis and constant.match(node.attr)) or known, f"{path}: {node.value.id}.{node.attr}"


def test_types_of_pure_parts_hold() -> None:
    pytest.importorskip("mypy")
    options = ["--strict", "--follow-imports=silent", "--cache-dir=/dev/null"]
    command = [sys.executable, "-m", "mypy", *options, "-p", "itin_qgis.tasks", "-p", "itin_qgis.program"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=PLUGINS, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_guide_names_every_algorithm() -> None:
    from itin_qgis.tasks import TASKS

    text = GUIDE.read_text()
    for task in TASKS:
        assert f"**{task.title}**" in text, task.title
        assert f"`itin:{task.name}`" in text, task.name
        assert f"]({task.guide}" in text and (GUIDE.parent / task.guide).exists()


def test_guide_names_parameters_as_dialogs_do() -> None:
    from itin_qgis.tasks import TASKS

    labels = {parameter.label for task in TASKS for parameter in task.parameters}
    quoted = [re.sub(r"\s+", " ", text) for text in re.findall("“(.*?)”", GUIDE.read_text(), re.DOTALL)]
    assert len(quoted) > 15
    assert set(quoted) - labels == {"The program itin"}
