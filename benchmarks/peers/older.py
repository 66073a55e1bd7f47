#!/usr/bin/python3
"""Compares a build of itin with an older one on the questions of benchmarks/README.md.

    benchmarks/peers/older.py OLD_PROGRAM NEW_PROGRAM [--runs N] [--only WORD]

Both programs run in turns, N times each (default 5), each on the stores that it has written itself.
Prints the medians of wall and processor time, the peak memory and the ratios new / old. questions.py says what it needs.
"""
import argparse

import questions
from measure import Failed, in_turns
from terrain import WORK


def compare(name, commands, runs):
    """Runs the older program's command and the newer one's in turns and prints a line of figures."""
    old, new = in_turns([[[*command, "--quiet"]] for command in commands], runs,
                        lambda which: questions.clear_results())
    print(f"{name:32} {old.seconds:7.2f} {new.seconds:7.2f} s {new.seconds / old.seconds:5.2f}   "
          f"{old.processor:7.2f} {new.processor:7.2f} s of processor {new.processor / old.processor:5.2f} "
          f"(spread {max(old.spread, new.spread):4.2f})   "
          f"{old.megabytes:6.0f} {new.megabytes:6.0f} MB {new.megabytes / old.megabytes:5.2f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--only", default="", help="rows whose name has this word")
    asked = parser.parse_args()
    programs = [(asked.old, questions.OUT), (asked.new, WORK)]
    for name, commands in questions.commands(asked.only, *programs):
        try:
            compare(name, commands, asked.runs)
        except Failed as failed:
            raise SystemExit(str(failed)) from failed


main()
