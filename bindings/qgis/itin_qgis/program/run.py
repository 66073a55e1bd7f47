"""Running the program: with a list of arguments and no shell, telling how far it is, and stopping it when asked."""

from __future__ import annotations

import queue
import subprocess
import threading
from collections.abc import Callable, Sequence
from typing import IO, Optional

from .progress import Error, Remark, Said, read_line
from .windows import WITHOUT_WINDOW

Told = Callable[[Said], None]
"""Hears each line that is not an error."""

_LOOK = 0.1  # seconds between looks whether to stop
_GRACE = 1.5  # seconds for the program to stop by itself


class Failed(Exception):
    """The program did not do what it was asked. The message is its own line."""


class Cancelled(Exception):
    """The program was stopped, and has left no unfinished result."""


def run(program: str, arguments: Sequence[str], told: Told, cancelled: Callable[[], bool]) -> str:
    """Runs the program, and returns what it prints."""
    try:
        process = subprocess.Popen(
            [program, *arguments],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
            creationflags=WITHOUT_WINDOW,
        )
    except OSError as error:
        raise Failed(f"{program} cannot be run: {error}.") from error
    assert process.stdout is not None and process.stderr is not None
    printed: list[str] = []
    lines: queue.Queue[Optional[str]] = queue.Queue()
    readers = [
        threading.Thread(target=_read_all, args=(process.stdout, printed), daemon=True),
        threading.Thread(target=_read_lines, args=(process.stderr, lines), daemon=True),
    ]
    for reader in readers:
        reader.start()
    try:
        last_words = _follow(lines, told, cancelled)
    except BaseException:
        _stop(process)
        raise
    process.wait()
    for reader in readers:
        reader.join()
    if process.returncode != 0:
        raise Failed(last_words or f"itin ended without a word, with status {process.returncode}.")
    return "".join(printed)


def _follow(lines: queue.Queue[Optional[str]], told: Told, cancelled: Callable[[], bool]) -> str:
    """Passes lines on until there are no more. Returns the error among them; if none is, the last other line."""
    error = remark = ""
    while True:
        if cancelled():
            raise Cancelled("Cancelled.")
        try:
            line = lines.get(timeout=_LOOK)
        except queue.Empty:
            continue
        if line is None:
            return error or remark
        said = read_line(line)
        if isinstance(said, Error):
            error = said.text
            continue
        if isinstance(said, Remark):
            remark = said.text
        told(said)


def _stop(process: subprocess.Popen[str]) -> None:
    """Asks the program to stop, which leaves nothing unfinished behind; one that does not hear it is ended."""
    process.terminate()
    try:
        process.wait(_GRACE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _read_all(stream: IO[str], into: list[str]) -> None:
    with stream:
        into.append(stream.read())


def _read_lines(stream: IO[str], into: queue.Queue[Optional[str]]) -> None:
    with stream:
        for line in stream:
            into.put(line.rstrip("\r\n"))
    into.put(None)
