#!/usr/bin/env python3
"""Draws how long jobs take by the number of workers: measured, and simulated from the times of their tasks.

    benchmarks/peers/job_workers.py FIGURES.jsonl OUT.svg      # benchmarks/peers/jobs.sh does so

Each line of the figures is a job: `name`, `job` (its folder, answered by one worker), the seconds `alone` (the call by
itself), `one` and `two` (workers), and `merge`. More workers than were measured are simulated: each takes the next task of
the job's order, which takes as long as it took the one worker, once it has started, which takes what the one worker needed
besides its tasks. Memory and disks that workers of one machine share are not simulated.
"""

import heapq
import json
import pathlib
import sys

WORKERS = [1, 2, 4, 8, 16, 32, 64, 128]


def times_of_tasks(job):
    """Returns the seconds of each task, in the order in which workers take them."""
    lines = (pathlib.Path(job) / "tasks.jsonl").read_text(encoding="utf-8").splitlines()
    names = [json.loads(line)["id"] for line in lines]
    stats = pathlib.Path(job) / "stats"
    return [json.loads((stats / f"{name}.json").read_text(encoding="utf-8"))["seconds"] for name in names]


def simulated(tasks, workers, start):
    """Returns when the last of the workers ends."""
    ends = [start] * workers
    for seconds in tasks:
        heapq.heappush(ends, heapq.heappop(ends) + seconds)
    return max(ends)


def curve(job):
    """Returns how long the job takes, its merge included, for each number of workers."""
    tasks = times_of_tasks(job["job"])
    start = max(0, job["one"] - sum(tasks))
    return [simulated(tasks, workers, start) + job["merge"] for workers in WORKERS]


def draw(jobs, path):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5 * len(jobs), 4.6), layout="constrained")
    for axes, job in zip(figure.subplots(1, len(jobs), squeeze=False)[0], jobs):
        seconds = curve(job)
        axes.plot(WORKERS, seconds, "o-", mfc="white", label="simulated from the times of tasks, with the merge")
        axes.plot(WORKERS, [seconds[0] / workers for workers in WORKERS], ":", color="grey", label="one worker's time, divided")
        measured = [job["one"] + job["merge"], job["two"] + job["merge"]]
        axes.plot([1, 2], measured, "s", color="black", label="measured on two cores, with the merge")
        axes.axhline(job["merge"], ls="--", color="tab:red", label="the merge alone, measured")
        axes.axhline(job["alone"], ls="-.", color="tab:green", label="the call by itself on two threads, measured")
        axes.set(xscale="log", yscale="log", title=job["name"], xlabel="workers of one thread", ylabel="seconds")
        axes.set_xticks(WORKERS, [str(workers) for workers in WORKERS])
        axes.minorticks_off()
        axes.legend(fontsize="x-small")
    figure.suptitle("Jobs by their number of workers: more than two are simulated, not measured")
    figure.savefig(path)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    jobs = [json.loads(line) for line in pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").splitlines()]
    for job in jobs:
        times = ", ".join(f"{workers}: {seconds:.1f} s" for workers, seconds in zip(WORKERS, curve(job)))
        print(f"{job['name']}: by workers, the merge of {job['merge']:.1f} s included, simulated: {times}")
    draw(jobs, sys.argv[2])


if __name__ == "__main__":
    main()
