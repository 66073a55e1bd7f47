"""Where the program `itin` is."""

from __future__ import annotations

import os
import shutil
import subprocess

from .windows import WITHOUT_WINDOW

REMEDY = (
    "Install itin, or name its program in Settings > Options > Processing > Providers > itin, "
    "as “The program itin”."
)


class NoProgram(Exception):
    """The program is not there, or it is another one. The message says what to do."""


def find_program(setting: str) -> str:
    """Returns the path of the program: what the setting names, or else the one in PATH."""
    setting = setting.strip()
    if setting:
        path = shutil.which(os.path.expanduser(setting))
        if path is None:
            raise NoProgram(f"{setting} is no program that can be run. {REMEDY}")
        return path
    path = shutil.which("itin")
    if path is None:
        raise NoProgram(f"The program itin was not found in PATH. {REMEDY}")
    return path


def version_of(program: str) -> str:
    """Returns the version that the program states, as `0.1.0`."""
    try:
        done = subprocess.run(
            [program, "--version"],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            timeout=10,
            check=False,
            creationflags=WITHOUT_WINDOW,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoProgram(f"{program} cannot be run: {error}. {REMEDY}") from error
    name, _, version = done.stdout.strip().partition(" ")
    if done.returncode != 0 or name != "itin" or not version:
        raise NoProgram(f"{program} is not itin. {REMEDY}")
    return version
