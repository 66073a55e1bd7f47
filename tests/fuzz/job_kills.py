#!/usr/bin/env python3
"""Kills the runners of a job, again and again, and compares the merged outputs with those of the call by itself.

    tests/fuzz/job_kills.py PROGRAM [--kills 200] [--seed N]             # two runners: itin job run
    tests/fuzz/job_kills.py PROGRAM --dask [--kills 200] [--seed N]      # two workers of Dask, and its scheduler at times

The job is a visibility index of the demo's terrain in many tasks. Runners are killed by SIGKILL at random moments, and
stopped at times for longer than others wait for them. In the end every task has one answer, and no process is left. Jobs
follow each other until there were so many kills.
"""

import contextlib
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

from job_trial import DASK, answer_alone, call, merge, plan, trial_parser

PATIENCE = "2"


def children_of(pid):
    found = subprocess.run(["pgrep", "-P", str(pid)], stdout=subprocess.PIPE, check=False).stdout.decode().split()
    return [int(child) for child in found]


def descendants_of(pid):
    return [d for child in children_of(pid) for d in [child, *descendants_of(child)]]


class Runners:
    """Two runners of the program, each started again when it was killed."""

    def __init__(self, program):
        self.program = program

    def begin(self, job):
        self.command = [self.program, "job", "run", job, "--threads", "1", "--quiet", "--patience", PATIENCE]
        self.runners = [self.start(), self.start()]

    def start(self):
        return subprocess.Popen(self.command, stdout=subprocess.DEVNULL)

    def kill_one(self, chance):
        number = chance.randrange(2)
        runner = self.runners[number]
        if chance.random() < 0.15:
            runner.send_signal(signal.SIGSTOP)
            time.sleep(1.5 * float(PATIENCE))
            runner.send_signal(signal.SIGCONT)
            return False
        was_running = runner.poll() is None
        if was_running:
            runner.kill()
        elif runner.returncode != 0:
            sys.exit(f"a runner ended with status {runner.returncode}")
        runner.wait()
        self.runners[number] = self.start()
        return was_running

    def finish(self):
        if any(runner.wait() != 0 for runner in self.runners):
            sys.exit("a runner ended with another status than 0")

    def close(self):
        """Nothing lives on between jobs."""


class DaskRunners:
    """Two workers of Dask, whose nannies start them again, and a scheduler and a client that are started again here."""

    def __init__(self, program):
        self.program = program
        self.port = str(random.randrange(20000, 30000))
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.scheduler = self.start_scheduler()
        self.workers = self.start_workers()
        self.restarts = 0

    def begin(self, job):
        self.job = job
        self.client = self.start_client()

    def start_scheduler(self):
        command = ["dask", "scheduler", "--host", "127.0.0.1", "--port", self.port, "--no-dashboard"]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def start_workers(self):
        command = ["dask", "worker", self.address, "--nworkers", "2", "--nthreads", "1", "--no-dashboard"]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def restart_what_ended(self):
        """Workers end by themselves where their scheduler does not come back soon."""
        if self.client.poll() not in (None, 0):
            self.client = self.start_client()
        if self.workers.poll() is not None:
            self.workers = self.start_workers()
            self.restarts += 1

    def start_client(self):
        command = [DASK, self.job, "--scheduler", self.address, "--itin", self.program, "--patience", PATIENCE, "--quiet"]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill_one(self, chance):
        self.restart_what_ended()
        if chance.random() < 0.02:
            self.scheduler.kill()
            self.scheduler.wait()
            self.scheduler = self.start_scheduler()
            return True
        # The nannies' children work.
        workers = [w for nanny in children_of(self.workers.pid) for w in [nanny, *children_of(nanny)]]
        busy = [w for w in workers if any(is_program(child) for child in children_of(w))]
        if not busy:
            return False
        os.kill(chance.choice(busy), signal.SIGKILL)
        return True

    def finish(self):
        last = time.time() + 600
        while self.client.poll() != 0:
            self.restart_what_ended()
            time.sleep(0.5)
            if time.time() > last:
                sys.exit("itin-dask does not come to an end")

    def close(self):
        if self.restarts > 0:
            print(f"the workers ended with their scheduler, and were started again, {self.restarts} times")
        for process in (self.workers, self.scheduler):
            process.terminate()
            process.wait()


def is_program(pid):
    with contextlib.suppress(OSError):
        return b"\0job\0run\0" in pathlib.Path(f"/proc/{pid}/cmdline").read_bytes()
    return False


def killed_in_round(options, runners, job, kills, chance):
    """Plans, answers and merges a job, and kills its runners up to so many times. Returns how many times, and what is done."""
    plan(options, job)
    runners.begin(job)
    killed = 0
    while killed < kills and call(options.program, "job", "status", job, "--open"):
        time.sleep(chance.uniform(0, 2 * options.every))
        killed += runners.kill_one(chance)
    runners.finish()
    done = merge(options, job)
    return killed, f"{done}; {len(os.listdir(job + '/tmp'))} files in tmp"


def main():
    options = trial_parser(__doc__, kills=200, every=0.7, targets="4096", tasks="200").parse_args()
    chance = random.Random(options.seed)
    print(f"seed {options.seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        answer_alone(options)
        runners = (DaskRunners if options.dask else Runners)(options.program)
        kills, jobs, begun = 0, 0, time.time()
        while kills < options.kills:
            jobs += 1
            killed, done = killed_in_round(options, runners, f"job-{jobs}", options.kills - kills, chance)
            kills += killed
            print(f"{done}: {killed} kills, same bytes", flush=True)
        seconds = time.time() - begun
        runners.close()
        time.sleep(1)
        if orphans := [pid for pid in descendants_of(os.getpid()) if is_program(pid)]:
            sys.exit(f"processes are left: {orphans}")
        print(f"{kills} kills in {seconds:.0f} s, in {jobs} jobs; no process is left, and all bytes are the same")


if __name__ == "__main__":
    main()
