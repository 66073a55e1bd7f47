#!/usr/bin/python3
"""Runs the questions of benchmarks/README.md with one thread and with two, and tells what many would give.

    benchmarks/peers/threads.py PROGRAM [--runs N] [--only WORD] [--least SECONDS]

One thread and two run in turns, N times each (default 3), on the same store. Prints the medians by the clock and how many
times faster two threads are; first of the whole command, then of each stage that its progress names and that takes SECONDS
(default 0.5) or more with one thread.

Where itin_traced is beside the program (ITIN_BUILD_BENCHMARKS), the command is traced, too, and its tasks are scheduled on
2 to 32 workers (schedule.py says what that leaves out). The ratio of 2 shows how far to trust the others. Last comes what
stands in the way of 32: where most time is lost.
"""
import argparse
import pathlib
import statistics

import obstacles
import questions
from measure import Failed
from schedule import makespan, work
from stages import timed
from terrain import WORK
from trace import trace

WORKERS = (2, 4, 8, 16, 32)


def measure(command, runs):
    """Returns the medians of one thread and of two, for each stage that every run has shown."""
    found = ([], [])
    for _ in range(runs):
        for threads in (1, 2):
            questions.clear_results()
            found[threads - 1].append(timed([*command, "--threads", str(threads)]))
    stages = [stage for stage in found[0][0] if all(stage in run for of in found for run in of)]
    return [{stage: statistics.median(run[stage] for run in of) for stage in stages} for of in found]


def print_measured(name, one, two, least):
    print(f"{name:40} {one['']:8.2f} {two['']:8.2f} s {one[''] / two['']:6.2f}", flush=True)
    for stage in one:
        if stage and one[stage] >= least:
            print(f"  {stage:38} {one[stage]:8.2f} {two[stage]:8.2f} s {one[stage] / two[stage]:6.2f}")


def print_scheduled(traced):
    alone = work(traced.root) + traced.others
    ratios = [alone / (makespan(traced.root, workers) + traced.others / workers) for workers in WORKERS]
    print(f"  {'scheduled on ' + ', '.join(map(str, WORKERS)):38} {alone:8.2f} s          " +
          " ".join(f"{ratio:6.2f}" for ratio in ratios))
    print("    " + obstacles.line("one thread alone", obstacles.of_one_thread(traced.serial)))
    print("    " + obstacles.line(f"loops too short for {WORKERS[-1]}", obstacles.of_loops(traced.root, WORKERS[-1])))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", default="", help="rows whose name has this word")
    parser.add_argument("--least", type=float, default=0.5, help="the shortest stage that is printed")
    asked = parser.parse_args()
    program = asked.program.resolve()
    traced = program.parent / "itin_traced"
    if not traced.exists():
        print(f"nothing is scheduled: {traced} is not built (ITIN_BUILD_BENCHMARKS)")
    print(f"{'':40} {'one':>8} {'two':>8}    ratio")
    for name, (command,) in questions.commands(asked.only, (program, WORK)):
        try:
            print_measured(name, *measure(command, asked.runs), asked.least)
            if traced.exists():
                questions.clear_results()
                print_scheduled(trace(traced, command))
        except Failed as failed:
            raise SystemExit(str(failed)) from failed


main()
