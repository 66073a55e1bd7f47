"""Reads what itin_traced (benchmarks/trace) writes: the tasks of a run, with the sources that they come from by name."""
import collections
import json
import os
import pathlib
import re
import subprocess
import tempfile
from typing import NamedTuple

from measure import Failed
from schedule import Loop

# The sources that all loops pass through, which say nothing about a loop.
SEAMS = re.compile(r"benchmarks/trace/|/base/|/progress/|/usr/|<")
SOURCE = re.compile(r"(?:libitin|viewshed|profile|cli)/.*")


class Trace(NamedTuple):
    root: list  # a task of schedule.py
    serial: dict  # seconds outside loops by source
    others: float  # seconds of threads that the loops do not know, such as those of GDAL


def sources_of(program, addresses):
    """Returns the source of each address, for a program with line numbers."""
    addresses = sorted(addresses)
    told = subprocess.run(["addr2line", "-e", program], input="".join(f"{a:#x}\n" for a in addresses), text=True,
                          capture_output=True, check=True).stdout.splitlines()
    return dict(zip(addresses, told))


def name_of(frames, sources):
    """Returns the innermost source of the project that is no seam."""
    for frame in frames:
        found = SOURCE.search(os.path.normpath(sources[frame].rsplit(":", 1)[0]))
        if found and not SEAMS.search(found[0]):
            return found[0]
    return "elsewhere"


def all_frames(task):
    """Yields the addresses in a task that is given as JSON."""
    if isinstance(task, list):
        for item in task:
            if isinstance(item, dict):
                yield from item["at"]
                for inner in item["tasks"]:
                    yield from all_frames(inner)


def named(task, sources):
    """Returns the task of schedule.py that JSON stands for."""
    if not isinstance(task, list):
        return task
    return [Loop(name_of(item["at"], sources), [named(inner, sources) for inner in item["tasks"]])
            if isinstance(item, dict) else item for item in task]


def read(document, program):
    frames = set(all_frames(document["root"])).union(*document["serial"])
    sources = sources_of(program, frames)
    root = named(document["root"], sources)
    if not isinstance(root, list):
        root = [root]
    samples = collections.Counter(name_of(frames, sources) for frames in document["serial"])
    alone = sum(item for item in root if not isinstance(item, Loop))
    return Trace(root, {name: alone * count / samples.total() for name, count in samples.most_common()}, document["others"])


def trace(program, command):
    """Runs the command with the traced program."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "trace.json"
        done = subprocess.run([program, *command[1:], "--quiet"], env={**os.environ, "ITIN_TRACE": str(path)},
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            raise Failed(f"{program} {' '.join(command[1:])} failed: {done.stderr.strip()}")
        return read(json.loads(path.read_text()), program)
