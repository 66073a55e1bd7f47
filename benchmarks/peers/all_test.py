"""The commands themselves, on the demo's Cardiff, with the program and the tools that CMake names; skipped without these."""
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PEERS = pathlib.Path(__file__).resolve().parent
PROGRAM = os.environ.get("ITIN_PROGRAM")


def beside(name):
    """The tool of this name in the program's folder."""
    return pathlib.Path(PROGRAM).with_name(name)


@unittest.skipUnless(PROGRAM, "ITIN_PROGRAM names no program")
class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stores = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.stores.cleanup)
        cls.cardiff = pathlib.Path(cls.stores.name) / "cardiff.itin"
        subprocess.run([PROGRAM, "import", cls.cardiff, PEERS / "../../scripts/demo-data/cardiff.tif", "--quiet"], check=True,
                       capture_output=True)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        shutil.copy(self.cardiff, self.work)

    def run_script(self, name, *arguments, status=0, **environment):
        done = subprocess.run([PEERS / name, *arguments], capture_output=True, text=True,
                              env={**os.environ, "ITIN_BENCHMARK_DIR": str(self.work), **environment})
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_all_measures_and_compares_with_the_run_before(self):
        before = {"group": "viewshed", "question": "Cardiff", "who": "exact", "seconds": 1000, "megabytes": 1}
        folder = self.work / "results"
        folder.mkdir()
        (folder / "before.json").write_text(json.dumps(
            {"when": "2026-11-01T12:00:00", "commit": "c1", "machine": "another", "load": 0, "runs": 5, "rows": [before]}))
        # There are no peers without a PATH.
        told = self.run_script("all", "--only", "viewshed: Cardiff", "--runs", "1", "--no-grass", "--program", PROGRAM,
                               PATH="/nowhere")
        self.assertIn("left out: gdal_viewshed: gdal_viewshed is not installed", told)
        self.assertIn("left out: r.viewshed: --no-grass", told)
        self.assertIn("| viewshed | Cardiff | exact | time, s | 1000 |", told)
        self.assertIn("6 of 7 rows were not measured before.", told)
        (path,) = folder.glob("2*.json")
        rows = json.loads(path.read_text())["rows"]
        self.assertEqual([row["who"] for row in rows][:3], ["exact", "certified at 32 m", "tolerance 1 m"])
        self.assertEqual(rows[1]["decided"], 100)
        self.assertTrue(path.with_suffix(".md").read_text().startswith("# Comparison with peers\n"))
        if importlib.util.find_spec("matplotlib"):
            (chart,) = folder.glob("*.png")
            self.assertIn(str(chart), told)
            self.assertTrue(chart.read_bytes().startswith(b"\x89PNG"))
        else:
            self.assertIn("no charts: python3-matplotlib is not installed", told)

    def test_all_says_what_is_wrong(self):
        self.assertIn("is not there", self.run_script("all", "--program", "/nowhere/itin", status=1))
        self.assertIn("no question has", self.run_script("all", "--only", "Atlantis", "--program", PROGRAM, status=1))

    def test_a_traced_program_writes_the_same_and_tells_its_tasks(self):
        if not beside("itin_traced").exists():
            self.skipTest("itin_traced is not built")
        written = []
        for program in (PROGRAM, beside("itin_traced")):
            path = self.work / f"{pathlib.Path(program).name}.tif"
            subprocess.run([program, "viewshed", self.cardiff, "--observer", "310375,183525,30", "--radius", "5000", "-o", path],
                           check=True, capture_output=True,
                           env={**os.environ, "ITIN_TRACE": str(self.work / "trace.json")})
            written.append(path.read_bytes())
        self.assertEqual(*written)
        told = json.loads((self.work / "trace.json").read_text())
        self.assertTrue(any(isinstance(item, dict) and item["tasks"] for item in told["root"]))

    def test_threads_schedules_what_is_traced(self):
        if not beside("itin_traced").exists():
            self.skipTest("itin_traced is not built")
        told = self.run_script("threads.py", PROGRAM, "--only", "Cardiff, exact", "--runs", "1")
        self.assertIn("scheduled on 2, 4, 8, 16, 32", told)
        self.assertIn("one thread alone", told)


if __name__ == "__main__":
    unittest.main()
