#!/usr/bin/python3
"""Compares a build of itin with an older one on the questions of benchmarks/README.md.

    benchmarks/peers/older.py OLD_PROGRAM NEW_PROGRAM [--runs N] [--only WORD]

Both programs run in turns, N times each (default 5), each on the stores that it has written itself.
Prints the medians of wall and processor time, the peak memory and the ratios new / old. questions.py says what it needs.
"""
import argparse
import os
import statistics
import subprocess
import sys
import time

import questions


def run(command):
    """Seconds by the clock, seconds of processor and peak megabytes of one run."""
    began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    message = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.monotonic() - began
    if status != 0:
        sys.exit(f"{' '.join(map(str, command))}\nfailed: {message.decode().strip()}")
    return seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def compare(name, commands, runs):
    """Runs the older program's command and the newer one's in turns and prints a line of figures."""
    figures = [[], []]
    for turn in range(runs):
        for which in ((0, 1) if turn % 2 == 0 else (1, 0)):
            questions.clear_results()
            figures[which].append(run([*commands[which], "--quiet"]))
    old, new = ([statistics.median(column) for column in zip(*runs_of)] for runs_of in figures)
    spread = max(max(t[1] for t in runs_of) / min(t[1] for t in runs_of) for runs_of in figures)
    print(f"{name:32} {old[0]:7.2f} {new[0]:7.2f} s {new[0] / old[0]:5.2f}   {old[1]:7.2f} {new[1]:7.2f} s of processor "
          f"{new[1] / old[1]:5.2f} (spread {spread:4.2f})   {old[2]:6.0f} {new[2]:6.0f} MB {new[2] / old[2]:5.2f}",
          flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--only", default="", help="rows whose name has this word")
    asked = parser.parse_args()
    programs = [(asked.old, questions.OUT), (asked.new, questions.WORK)]
    for name, commands in questions.commands(asked.only, *programs):
        compare(name, commands, asked.runs)


main()
