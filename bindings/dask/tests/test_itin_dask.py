"""Jobs on two workers of Dask: the commands of README and of the guide as they stand there, and what goes wrong."""

from __future__ import annotations

import filecmp
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[3]
PROGRAM = Path(os.environ["ITIN_PROGRAM"])
PORT = "8786"

pytestmark = pytest.mark.skipif(
    shutil.which("dask") is None, reason="Dask is not installed; scripts/bootstrap --dask installs it"
)


def commands_of(page: str, language: str) -> str:
    return "\n".join(re.findall(rf"^```{language}\n(.*?)^```", (SOURCE / page).read_text(), re.DOTALL | re.MULTILINE))


def run(folder: Path, commands: str) -> subprocess.CompletedProcess[str]:
    """Runs commands as a user would, in one shell, which stops what is left in the background at the end."""
    path = f"{PROGRAM.parent}:{SOURCE / 'bindings/dask'}:{os.environ['PATH']}"
    script = f"set -e\ntrap 'kill $(jobs -p) 2>/dev/null || true; wait' EXIT\n{commands}\n"
    return subprocess.run(
        ["bash", "-c", script], cwd=folder, env=os.environ | {"PATH": path}, capture_output=True, text=True, check=False
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("dask")
    (made / "scripts").symlink_to(SOURCE / "scripts")
    for store in ("country", "cardiff"):
        done = run(made, f"itin import {store}.itin scripts/demo-data/cardiff.tif --quiet")
        assert done.returncode == 0, done.stderr
    return made


@pytest.mark.parametrize("page", ["README.md", "docs/many-machines.md"])
def test_the_commands_of_a_page_write_what_the_call_by_itself_writes(folder: Path, page: str) -> None:
    commands = commands_of(page, "bash")
    done = run(folder, commands)
    assert done.returncode == 0, done.stderr
    plan = re.search(r"itin job plan \w+ --tasks 12 (.*) -o (\w+\.tif)", commands)
    assert plan
    alone = run(folder, f"itin {plan[1]} -o alone.tif --quiet --overwrite")
    assert alone.returncode == 0, alone.stderr
    assert filecmp.cmp(folder / "alone.tif", folder / plan[2], shallow=False)


def on_two_workers(job: str) -> str:
    """Returns commands that answer a job of twelve tasks on two workers."""
    return (
        f"dask scheduler --no-dashboard --port {PORT} >/dev/null 2>&1 &\n"
        f"dask worker tcp://127.0.0.1:{PORT} --nworkers 2 --nthreads 1 --no-dashboard >/dev/null 2>&1 &\n"
        f"itin-dask {job} --scheduler tcp://127.0.0.1:{PORT} --quiet"
    )


def planned(job: str) -> str:
    return (
        f"itin job plan {job} --tasks 12 visibility country.itin --bbox 308000,180000,314000,186000 --cell 100 "
        f"--radius 5000 -o {job}.tif\n"
    )


def test_a_store_that_changes_ends_the_run(folder: Path) -> None:
    done = run(
        folder,
        planned("changed") + "cp country.itin kept.itin\n"
        "rm country.itin; itin import country.itin scripts/demo-data/cardiff.tif --levels 4,16 --quiet >/dev/null\n"
        + on_two_workers("changed")
        + " || status=$?\nmv kept.itin country.itin; exit ${status:-0}",
    )
    assert done.returncode == 4, done.stderr
    assert re.search(r"error: .*country\.itin: is not the store that .* was planned for", done.stderr)
    assert not list((folder / "changed/done").rglob("*/*/*"))


def test_a_worker_of_another_version_ends_the_run_at_once(folder: Path) -> None:
    change = "sed -i 's/\"itin\": \"[^\"]*\"/\"itin\": \"9.9\"/' other/job.json\n"
    done = run(folder, planned("other") + change + on_two_workers("other"))
    assert done.returncode == 5, done.stderr
    said = [line for line in done.stderr.splitlines() if "itin" in line]
    assert len(said) == 1, done.stderr
    assert re.fullmatch(r"itin: error: .*/other: was planned by itin 9\.9, and this is itin [0-9.]+; run the same version", said[0])
    assert not list((folder / "other/done").rglob("*/*/*"))


def test_a_task_that_always_fails_is_named_and_the_others_are_answered(folder: Path) -> None:
    fail = (
        "name=$(sed -n 's/.*\"n\":2,\"id\":\"\\([^\"]*\\)\".*/\\1/p' bad/tasks.jsonl)\n"
        "for k in 1 2 3; do printf 'this is bad' >bad/failed/$name.$k; done\n"
    )
    done = run(folder, planned("bad") + fail + on_two_workers("bad"))
    assert done.returncode == 1
    assert "itin-dask: error: bad: 1 task is left, the first is task 2: this is bad; itin job run --again bad" in done.stderr
    status = json.loads(run(folder, "itin job status bad --json").stdout)
    assert status["open"] == [] and status["done"] == status["tasks"] - 1


def test_a_scheduler_that_is_not_there_is_named(folder: Path) -> None:
    done = run(folder, "itin-dask nothing --scheduler tcp://127.0.0.1:1")
    assert done.returncode == 1
    assert "--scheduler tcp://127.0.0.1:1" in done.stderr
