"""What the program writes on stderr: lines of progress, warnings, and the one line of an error."""

from __future__ import annotations

import json
from typing import NamedTuple, Optional, Union

_CAUTION = "itin: warning: "
_ERROR = "itin: error: "


class Progress(NamedTuple):
    """How far the program is."""

    stage: str
    share: float
    """From 0 to 1."""
    seconds_left: Optional[int]


class Caution(NamedTuple):
    """What the planner should know of a result."""

    text: str


class Error(NamedTuple):
    """Why there is no result: what, where, what to do."""

    text: str


class Remark(NamedTuple):
    """Any other line."""

    text: str


Said = Union[Progress, Caution, Remark]
"""What a line says that is not an error."""


def read_line(line: str) -> Said | Error:
    """Returns what a line of stderr says."""
    if line.startswith("{"):
        try:
            told = json.loads(line)
            return Progress(told["stage"], told["share"], told["seconds_left"])
        except (ValueError, KeyError, TypeError):
            return Remark(line)
    if line.startswith(_CAUTION):
        return Caution(line[len(_CAUTION) :])
    if line.startswith(_ERROR):
        return Error(line[len(_ERROR) :])
    return Remark(line)
