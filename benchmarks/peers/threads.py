#!/usr/bin/python3
"""Runs the questions of benchmarks/README.md with one thread and with two.

    benchmarks/peers/threads.py PROGRAM [--runs N] [--only WORD] [--least SECONDS]

Both run in turns, N times each (default 3), on the same store. Prints the medians by the clock and how many times faster
two threads are, first of the whole command, then of each stage that its progress names and that takes SECONDS (default
0.5) or more with one thread. The last column is what 32 threads would make of it by Amdahl's law: what two threads leave
undivided stays undivided. Stages are timed as they are shown, ten times a second. questions.py says what it needs.
"""
import argparse
import os
import pty
import re
import statistics
import subprocess
import sys
import time

import questions

STAGE = re.compile(r"(.*\D) +\d+ %")


def stage_in(line):
    """The stage that a line of progress names, without the file that it is about; None in other lines."""
    found = STAGE.fullmatch(re.sub(r"\x1b\[K|, .* left$", "", line).strip())
    return found and re.sub(r" \S*[/.]\S*$", "", found[1].strip())


def run(command):
    """Seconds by the clock of the whole command under "" and of its stages by their names."""
    questions.clear_results()
    terminal, side = pty.openpty()
    began = stage_began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=side)
    os.close(side)
    seconds, stage, text = {}, None, ""
    while True:
        try:
            text += os.read(terminal, 65536).decode(errors="replace")
        except OSError:  # the program has closed its end
            break
        *lines, text = re.split(r"[\r\n]", text)
        for named in filter(None, map(stage_in, lines + [text])):
            now = time.monotonic()
            if named != stage:
                if stage:
                    seconds[stage] = seconds.get(stage, 0) + now - stage_began
                stage, stage_began = named, now
    os.close(terminal)
    if process.wait() != 0:
        sys.exit(f"{' '.join(map(str, command))}\nfailed: {text.strip()}")
    now = time.monotonic()
    if stage:
        seconds[stage] = seconds.get(stage, 0) + now - stage_began
    seconds[""] = now - began
    return seconds


def print_row(name, one, two):
    undivided = min(max(2 * two - one, 0), one)
    many = undivided + (one - undivided) / 32
    print(f"{name:40} {one:8.2f} {two:8.2f} s {one / max(two, 0.001):5.2f}   {one / max(many, 0.001):5.1f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", default="", help="rows whose name has this word")
    parser.add_argument("--least", type=float, default=0.5, help="the shortest stage that is printed")
    asked = parser.parse_args()
    print(f"{'':40} {'one':>8} {'two':>8}   {'ratio':>5}   {'of 32':>5}")
    for name, (command,) in questions.commands(asked.only, (asked.program, questions.WORK)):
        runs = [[run([*command, "--threads", str(threads)]) for threads in (1, 2)] for _ in range(asked.runs)]
        one, two = ({stage: statistics.median(r[which].get(stage, 0) for r in runs) for stage in runs[0][0]}
                    for which in (0, 1))
        print_row(name, one[""], two[""])
        for stage in one:
            if stage and one[stage] >= asked.least:
                print_row("  " + stage, one[stage], two[stage])


main()
