"""Types: the package, its examples and these tests under mypy, the stub against the module, documentation of all."""

from __future__ import annotations

import inspect
import os
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import SOURCE

import itin

HERE = Path(__file__).parent
PACKAGES = str(Path(itin.__file__).parents[1])


def check(*command: object) -> None:
    environment = os.environ | {"MYPYPATH": PACKAGES, "MYPY_CACHE_DIR": os.devnull}
    done = subprocess.run(
        [sys.executable, "-m", *map(str, command)], capture_output=True, text=True, env=environment, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_hold_throughout() -> None:
    pytest.importorskip("mypy")
    files = sorted(HERE.glob("*.py")) + sorted((SOURCE / "examples" / "python").glob("*.py"))
    check("mypy", "--strict", "--ignore-missing-imports", "-p", "itin")
    check("mypy", "--strict", "--ignore-missing-imports", "--no-warn-unused-ignores", *files)


def test_are_those_of_the_module() -> None:
    pytest.importorskip("mypy")
    check("mypy.stubtest", "itin._itin", "--allowlist", HERE / "stubtest_allowlist", "--ignore-unused-allowlist")


def test_everything_public_is_documented() -> None:
    for name in itin.__all__:
        thing = getattr(itin, name)
        if not inspect.isclass(thing) or thing is itin.Window:
            continue
        assert thing.__doc__, name
        for member, value in vars(thing).items():
            if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                assert inspect.getdoc(value), f"{name}.{member}"
