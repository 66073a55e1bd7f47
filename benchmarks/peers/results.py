"""The results of runs of benchmarks/peers/all: one JSON file each, `when-commit.json`.

    {"when": "2026-11-25T18:00:00", "commit": "d189510d", "machine": "...", "load": 0.1, "runs": 5, "program": "...",
     "left_out": ["Rainier: ..."],
     "rows": [{"group": "viewshed", "question": "fractal", "who": "exact", "peers": ["gdal_viewshed"], "seconds": 0.97,
               ...}]}

A row has `seconds`, `processor`, `megabytes`, `spread` and `runs`, and where they are known `iou` and `differing` (of the
verdicts that the exact answer has, too), `decided` (per cent), `amount`, `unit`, `bytes_per_vertex` and
`points_per_vertex`.
"""
import datetime
import json
import os
import pathlib
import platform
import subprocess


def commit_of(root):
    """Returns the commit that is checked out, with a + where sources differ from it."""
    def git(*arguments):
        try:
            return subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True).stdout.strip()
        except OSError:
            return ""

    return (git("rev-parse", "--short=8", "HEAD") or "unknown") + ("+" if git("status", "--porcelain", "-uno") else "")


def processor_name():
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()


def begin(root, program, runs):
    """Returns the results of a run that begins now, which have no rows yet."""
    return {"when": datetime.datetime.now().isoformat(timespec="seconds"), "commit": commit_of(root),
            "machine": f"{processor_name()}, {os.cpu_count()} cores", "load": round(os.getloadavg()[0], 2), "runs": runs,
            "program": str(program), "left_out": [], "rows": []}


def write(results, folder):
    """Writes results into the folder and returns the path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{results['when'].replace(':', '')}-{results['commit']}.json"
    part = path.with_suffix(".part")
    part.write_text(json.dumps(results, indent=1) + "\n")
    part.rename(path)
    return path


def earlier(folder):
    """Returns all results in the folder, the oldest first."""
    return sorted((json.loads(path.read_text()) for path in folder.glob("*.json")), key=lambda results: results["when"])


def key(row):
    return row["group"], row["question"], row["who"]


def times_run(results):
    return f"medians of {results['runs']} in turns" if results["runs"] > 1 else "one run each"


def is_busy(results):
    """Tells whether other programs ran when the run began."""
    return results["load"] > 0.3


def run_name(results):
    return f"{results['when'][:16].replace('T', ' ')} {results['commit']}" + (" (busy)" if is_busy(results) else "")
