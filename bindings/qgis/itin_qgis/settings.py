"""What is set once: where the program is."""

from __future__ import annotations

import os
import shutil

from qgis.PyQt.QtGui import QIcon

from .program.find import NoProgram, find_program, version_of

GROUP = "itin"
PROGRAM = "ITIN_PROGRAM"


def icon() -> QIcon:
    """Returns the icon of the provider and of its algorithms."""
    return QIcon(os.path.join(os.path.dirname(__file__), "icon.svg"))


def program() -> str:
    """Returns what the setting says; blank where it says nothing."""
    from processing.core.ProcessingConfig import ProcessingConfig

    return ProcessingConfig.getSetting(PROGRAM) or ""


def add() -> None:
    """Adds the setting to those of Processing."""
    from processing.core.ProcessingConfig import ProcessingConfig, Setting

    found = shutil.which("itin")
    ProcessingConfig.settingIcons[GROUP] = icon()
    ProcessingConfig.addSetting(
        Setting(
            GROUP,
            PROGRAM,
            "The program itin",
            "",
            valuetype=Setting.FILE,
            validator=_test,
            placeholder=f"Left blank: {found}" if found else "Not in PATH: name it here",
        )
    )
    ProcessingConfig.readSettings()


def remove() -> None:
    """Takes the setting away."""
    from processing.core.ProcessingConfig import ProcessingConfig

    ProcessingConfig.removeSetting(PROGRAM)


def _test(value: str) -> None:
    """Runs what is to be the program, and refuses what is not."""
    if not value:
        return
    try:
        version_of(find_program(value))
    except NoProgram as error:
        raise ValueError(str(error)) from error
