"""Runs commands in turns and tells what they cost.

    exact, peer = in_turns([[exact_command], [peer_command]], runs=5)
    exact.seconds, exact.processor, exact.megabytes       medians
"""
import os
import statistics
import subprocess
import time
from typing import NamedTuple


class Failed(Exception):
    """Raised where a command ended with an error; the text says which command and what it wrote."""


class Cost(NamedTuple):
    seconds: float  # by the clock
    processor: float  # seconds of all processors
    megabytes: float  # peak of the largest process
    spread: float = 1  # the longest of several runs by the clock, divided by the shortest
    output: str = ""  # what the last run wrote to its standard output


def run_once(commands):
    """Runs the commands one after the other and returns their cost.

    A process counts at least the memory that this one occupies, since the kernel counts from before the program is
    loaded. So nothing large is imported here, and output is not kept where nobody reads it.
    """
    began, processor, peak, output = time.monotonic(), 0.0, 0, ""
    for command in commands:
        process = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        output = process.stdout.read().decode(errors="replace")
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        process.stdout.close()
        if process.returncode != 0:
            raise Failed(f"{' '.join(map(str, command))} failed: {' '.join(output.split())[-300:]}")
        processor += usage.ru_utime + usage.ru_stime
        peak = max(peak, usage.ru_maxrss)
    return Cost(time.monotonic() - began, processor, peak / 1024, output=output)


def median(costs):
    middle = [statistics.median(column) for column in zip(*(cost[:3] for cost in costs))]
    times = [cost.seconds for cost in costs]
    return Cost(*middle, spread=max(times) / max(min(times), 1e-3), output=costs[-1].output)


def in_turns(contestants, runs, before_each=lambda which: None):
    """Returns the medians of each contestant, who is a list of commands. Every other round goes through the contestants
    backwards, so that none always runs after the same one. Calls before_each(which) before each run."""
    costs = [[] for _ in contestants]
    for turn in range(runs):
        order = range(len(contestants))
        for which in order if turn % 2 == 0 else reversed(order):
            before_each(which)
            costs[which].append(run_once(contestants[which]))
    return [median(each) for each in costs]
