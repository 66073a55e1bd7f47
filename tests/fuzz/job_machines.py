#!/usr/bin/env python3
"""Runs a job on machines of their own, and compares the merged outputs with those of the call by itself.

    tests/fuzz/job_machines.py PROGRAM [--machines 3] [--kills 10] [--seed N]         # runners: itin job run
    tests/fuzz/job_machines.py PROGRAM --dask [--machines 3] [--kills 10] [--seed N]  # workers of Dask

A machine is a set of namespaces of Linux: it has a network, numbers of processes and a name of its own, so that runners
have equal numbers everywhere; and two machines have one name, as containers may. There is no network between machines but
a wire from each to the scheduler of Dask. They share a folder. Their clocks are hours apart from that of the folder, and
each call about a file of the folder takes a while, as on a slow file server: clock_and_delay.c tells how.

In the first round nothing is killed: then no task may be taken from the one who works on it. How many are answered twice, since two
machines claimed them at the same moment, is told. In the second round machines lose their power and start again. Needs root, ip (iproute2) and cc. The caches of a real file server,
which may show a file late, are not tried.
"""

import contextlib
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

from job_trial import DASK, answer_alone, call, merge, plan, trial_parser

PATIENCE = "3"
PORT = "8786"


class Machine:
    """A network namespace with a wire to that of the head, and in it processes with a name, numbers and a clock."""

    def __init__(self, number, name, clock_s, options):
        self.space = f"itin-{os.getpid()}-{number}"
        self.name, self.clock_s, self.options = name, clock_s, options
        self.head_address, self.address = f"10.77.{number}.1", f"10.77.{number}.2"
        self.process = None
        call("ip", "netns", "add", self.space)
        call("ip", "-n", self.space, "link", "set", "lo", "up")

    def wire_to(self, head):
        near, far = f"i{os.getpid() % 10000}n{self.address.split('.')[2]}", "wire"
        call("ip", "-n", head.space, "link", "add", near, "type", "veth", "peer", "name", far, "netns", self.space)
        call("ip", "-n", head.space, "address", "add", self.head_address + "/30", "dev", near)
        call("ip", "-n", self.space, "address", "add", self.address + "/30", "dev", far)
        call("ip", "-n", head.space, "link", "set", near, "up")
        call("ip", "-n", self.space, "link", "set", far, "up")

    def start(self, *command):
        enter = ["ip", "netns", "exec", self.space, "unshare", "--uts", "--pid", "--mount", "--fork", "--kill-child"]
        enter += ["--mount-proc", "sh", "-c", 'hostname "$0" && exec "$@"', self.name]
        environment = dict(os.environ, LD_PRELOAD=self.options.shim, SHIFT_S=str(self.clock_s))
        environment.update(SLOW_FOLDER=os.getcwd(), DELAY_MS=str(self.options.delay))
        self.process = subprocess.Popen(
            [*enter, *command], env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        )

    def cut_power(self):
        """Ends all processes at once: those in a namespace end with its first one."""
        self.process.kill()
        self.process.communicate()

    def remove(self):
        if self.process and self.process.poll() is None:
            self.cut_power()
        subprocess.run(["ip", "netns", "del", self.space], check=False)


class Runners:
    """Machines that each run itin job run."""

    def __init__(self, machines, options, job):
        self.machines, self.options, self.job = machines, options, job
        self.answered = 0
        for machine in machines:
            self.start(machine)

    def start(self, machine):
        machine.start(self.options.program, "job", "run", self.job, "--threads", "1", "--quiet", "--patience", PATIENCE)

    def finish(self):
        for machine in self.machines:
            said = machine.process.communicate()[0].decode()
            if machine.process.returncode != 0:
                sys.exit(f"{machine.name}: a runner ended with status {machine.process.returncode}")
            self.answered += int(re.search(r": (\d+) tasks? answered here", said).group(1))


class DaskRunners:
    """Machines that each run a worker of Dask; the head runs the scheduler and the client."""

    def __init__(self, machines, options, job):
        self.head, self.machines, self.options, self.job = machines[0], machines[1:], options, job
        self.answered = None
        self.head.start("dask", "scheduler", "--host", "0.0.0.0", "--port", PORT, "--no-dashboard")
        for machine in self.machines:
            self.start(machine)
        self.client = self.start_client()

    def start(self, machine):
        worker = ["dask", "worker", f"tcp://{machine.head_address}:{PORT}", "--nworkers", "1", "--nthreads", "1"]
        machine.start(*worker, "--no-dashboard", "--local-directory", f"/tmp/{machine.space}")

    def start_client(self):
        command = ["ip", "netns", "exec", self.head.space, DASK, self.job, "--scheduler", f"tcp://127.0.0.1:{PORT}"]
        command += ["--itin", self.options.program, "--patience", PATIENCE, "--quiet"]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def finish(self):
        for _ in range(10):
            if self.client.wait() == 0:
                return
            self.client = self.start_client()
        sys.exit("itin-dask does not come to an end")


def expect_calm(job, runners):
    """Nobody died, so that nobody's task was taken over. Returns how many tasks were answered twice, in words."""
    taken = [name for name in os.listdir(f"{job}/failed") if ".vanished." in name]
    tasks = json.loads(call(runners.options.program, "job", "status", job, "--json"))["tasks"]
    if taken:
        sys.exit(f"{len(taken)} tasks were taken from machines that work on them: by whose clock?")
    return "" if runners.answered is None else f"; {runners.answered - tasks} tasks answered twice"


def round_of(machines, options, job, kills, chance):
    """Plans and answers a job. Returns what happened, in words."""
    plan(options, job)
    begun = time.time()
    runners = (DaskRunners if options.dask else Runners)(machines, options, job)
    killed = 0
    while killed < kills and call(options.program, "job", "status", job, "--open"):
        time.sleep(chance.uniform(0, 2 * options.every))
        machine = chance.choice(runners.machines)
        if machine.process.poll() is not None:
            break
        machine.cut_power()
        runners.start(machine)
        killed += 1
    runners.finish()
    seconds = time.time() - begun
    twice = expect_calm(job, runners) if killed == 0 else ""
    for machine in machines:
        if machine.process.poll() is None:
            machine.cut_power()
    status = merge(options, job)
    left = {folder: len(os.listdir(f"{job}/{folder}")) for folder in ("tmp", "claims", "failed")}
    return f"{killed} times without power in {seconds:.0f} s; {status}; left: {left}; same bytes{twice}"


def main():
    parser = trial_parser(__doc__, kills=10, every=2, targets="8192", tasks="100")
    parser.add_argument("--machines", type=int, default=3)
    parser.add_argument("--delay", type=float, default=5, help="milliseconds that each call about a file takes")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    print(f"seed {options.seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as at_the_end:
        os.chdir(folder)
        options.shim = folder + "/clock_and_delay.so"
        source = pathlib.Path(__file__).with_name("clock_and_delay.c")
        call("cc", "-O2", "-shared", "-fPIC", "-o", options.shim, source, "-ldl")
        answer_alone(options)
        machines = []
        for number in range(options.machines + options.dask):
            # The last two have one name.
            name = f"node{min(number, options.machines + options.dask - 2)}"
            machines.append(Machine(number, name, chance.choice([-86400, -10800, 7200, 90000]), options))
            at_the_end.callback(machines[-1].remove)
        if options.dask:
            for machine in machines[1:]:
                machine.wire_to(machines[0])
        clocks = ", ".join(f"{machine.name} {machine.clock_s / 3600:+g} h" for machine in machines)
        print(f"clocks: {clocks}; {options.delay:g} ms a call about a file", flush=True)
        print("calm:", round_of(machines, options, "calm", 0, chance), flush=True)
        print("stormy:", round_of(machines, options, "stormy", options.kills, chance))


if __name__ == "__main__":
    main()
