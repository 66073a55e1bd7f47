#!/usr/bin/python3
"""Damaged LAZ files, imported: whatever their bytes are, the program makes a store or says in one line what is wrong.

    tests/fuzz/laz.py FIRST_SEED COUNT      with build/test/bin/itin, or ITIN_PROGRAM

Every seed changes some bytes of a small lidar file of tests/libitin/import/lidar, mostly of its header, tables and sizes
of layers, or cuts it off. A crash, a message of several lines, a store that is left behind or does not pass `itin check`,
more than a gigabyte, and more than a minute are faults. The damaged file is kept in build/fuzz.
"""
import os
import random
import resource
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ITIN = os.environ.get("ITIN_PROGRAM", ROOT + "/build/test/bin/itin")
LIDAR = ROOT + "/tests/libitin/import/lidar"
MOST_MEMORY = 1 << 30


def damaged(data, rng):
    data = bytearray(data)
    start = int.from_bytes(data[96:100], "little")
    places = [range(len(data)), range(100, 255), range(start - 60, start), range(start, start + 90),
              range(len(data) - 20, len(data))]
    for _ in range(rng.randint(1, 5)):
        place = rng.choice(rng.choice(places))
        data[place] = rng.choice([0, 0xff, 0x7f, rng.randrange(256), data[place] ^ 1 << rng.randrange(8)])
    if rng.random() < 0.2:
        del data[rng.randrange(len(data)):]
    return data


def run(*arguments):
    return subprocess.run([ITIN, *arguments, "--quiet"], capture_output=True, text=True, timeout=60, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (MOST_MEMORY, MOST_MEMORY)))


def fault(folder):
    """What is wrong with how the program takes the file in this folder; nothing where all is well."""
    store = folder + "/s.itin"
    done = run("import", store, folder + "/damaged.laz", "--crs", "EPSG:28992")
    if done.returncode not in (0, 1, 2):
        return f"status {done.returncode}: {done.stderr.strip()[-300:]}"
    errors = [line for line in done.stderr.splitlines() if not line.startswith("itin: warning: ")]
    if done.returncode != 0 and (len(errors) != 1 or os.path.exists(store)):
        return f"{len(errors)} lines: {done.stderr.strip()[-300:]}" if len(errors) != 1 else "a store is left behind"
    if done.returncode == 0 and run("check", store).returncode != 0:
        return "the store does not pass its check"
    return ""


def main():
    first, count = int(sys.argv[1]), int(sys.argv[2])
    failed = 0
    for seed in range(first, first + count):
        rng = random.Random(seed)
        folder = f"{ROOT}/build/fuzz/laz-{seed}"
        os.makedirs(folder, exist_ok=True)
        with open(f"{LIDAR}/{rng.choice(['ahn3', 'ign'])}.laz", "rb") as file:
            data = damaged(file.read(), rng)
        with open(folder + "/damaged.laz", "wb") as file:
            file.write(data)
        try:
            wrong = fault(folder)
        except subprocess.TimeoutExpired:
            wrong = "takes more than a minute"
        if wrong:
            failed += 1
            print(f"seed {seed}: {wrong}", flush=True)
        else:
            shutil.rmtree(folder)
    print(f"{failed} of {count} seeds failed")
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
