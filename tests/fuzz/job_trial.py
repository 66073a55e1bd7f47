"""What trials of jobs share: a visibility index of the demo's terrain, by itself and as a job."""

import argparse
import filecmp
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DASK = ROOT / "bindings/dask/itin-dask"
TERRAIN = ROOT / "scripts/demo-data/cardiff.tif"
QUESTION = ["visibility", "c.itin", "--bbox", "308000,180000,314000,186000", "--cell", "60", "--radius", "3000"]


def call(*arguments):
    return subprocess.run(arguments, check=True, stdout=subprocess.PIPE).stdout.decode()


def trial_parser(about, kills, every, targets, tasks):
    """The options that all trials have, with these defaults."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--kills", type=int, default=kills)
    parser.add_argument("--every", type=float, default=every, help="seconds between kills, on average")
    parser.add_argument("--targets", default=targets, help="how much work a task is")
    parser.add_argument("--tasks", default=tasks, help="about how many tasks the job has")
    parser.add_argument("--dask", action="store_true")
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 30))
    return parser


def answer_alone(options):
    """Makes the store, and alone.tif of it."""
    call(options.program, "import", "c.itin", TERRAIN, "--quiet")
    call(options.program, *QUESTION, "--targets", options.targets, "-o", "alone.tif", "--quiet")


def plan(options, job):
    question = [*QUESTION, "--targets", options.targets, "-o", job + ".tif"]
    call(options.program, "job", "plan", job, "--tasks", options.tasks, *question)


def merge(options, job):
    """Merges the job, and ends the trial where that gives other bytes than alone.tif has. Returns its status."""
    status = call(options.program, "job", "status", job).splitlines()[0]
    call(options.program, "job", "merge", job, "--quiet")
    if not filecmp.cmp("alone.tif", job + ".tif", shallow=False):
        sys.exit("the merged index has other bytes than the index by itself")
    return status
