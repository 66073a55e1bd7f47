"""Changes between runs, tables and charts, of results made up here."""
import pathlib
import tempfile
import unittest

import charts
import results
from changes import changes, last_rows
from measure import Cost, Failed, in_turns, median, run_once
from report import report, table
from stages import stage_in


def row(who, seconds, **more):
    return {"group": "viewshed", "question": "fractal", "who": who, "peers": ["gdal_viewshed", "deflated"], "seconds": seconds,
            "processor": seconds, "megabytes": 100, "spread": 1, "runs": 5, **more}


def run_of(day, *rows, machine="two cores", load=0.1):
    return {"when": f"2026-11-{day:02}T12:00:00", "commit": f"c{day}", "machine": machine, "load": load, "runs": 5,
            "program": "itin", "left_out": [], "rows": list(rows)}


class Changes(unittest.TestCase):
    def found(self, before, now):
        return [(change.what, change.before, change.now) for change in changes([run_of(1, before)], [now])[0]]

    def test_three_per_cent_of_time_or_memory(self):
        self.assertEqual(self.found(row("exact", 1.0), row("exact", 1.029)), [])
        self.assertEqual(self.found(row("exact", 1.0), row("exact", 1.031)), [("time, s", 1.0, 1.031)])
        self.assertEqual(self.found(row("exact", 1.031), row("exact", 1.0)), [("time, s", 1.031, 1.0)])
        self.assertEqual(self.found(row("exact", 1), row("exact", 1, megabytes=96)), [("memory, MB", 100, 96)])

    def test_any_agreement(self):
        self.assertEqual(self.found(row("exact", 1, iou=0.988), row("exact", 1, iou=0.988)), [])
        self.assertEqual(self.found(row("exact", 1, iou=0.988), row("exact", 1, iou=0.988001)), [("IoU", 0.988, 0.988001)])
        self.assertEqual(self.found(row("exact", 1, decided=75), row("exact", 1, decided=76)), [("decided, %", 75, 76)])
        self.assertEqual(self.found(row("exact", 1), row("exact", 1, iou=0.9)), [])

    def test_each_row_is_compared_with_the_last_run_that_has_it(self):
        runs = [run_of(1, row("exact", 1), row("gdal_viewshed", 2)), run_of(2, row("exact", 3))]
        self.assertEqual({key[2]: (of["seconds"], run) for key, (of, run) in last_rows(runs).items()},
                         {"exact": (3, "2026-11-02 12:00 c2"), "gdal_viewshed": (2, "2026-11-01 12:00 c1")})
        found, new = changes(runs, [row("exact", 3), row("gdal_viewshed", 4), row("tolerance 2 m", 1)])
        self.assertEqual([(change.row["who"], change.run) for change in found], [("gdal_viewshed", "2026-11-01 12:00 c1")])
        self.assertEqual([of["who"] for of in new], ["tolerance 2 m"])

    def test_a_run_of_a_busy_machine_says_so(self):
        found, _ = changes([run_of(1, row("exact", 1), load=2.5)], [row("exact", 2)])
        self.assertEqual(found[0].run, "2026-11-01 12:00 c1 (busy)")


class Reports(unittest.TestCase):
    def test_empty_columns_are_left_out(self):
        self.assertEqual(table(["a", "b", "c"], [["", "", "1"], ["", "", ""]]), "| a | c |\n| --- | --- |\n|  | 1 |\n|  |  |\n")

    def test_rows_changes_and_what_is_left_out(self):
        now = run_of(2, row("exact", 1.5, iou=1.0), row("gdal_viewshed", 0.5, iou=0.9886), row("deflated", 0.75), load=3)
        now["left_out"].append("r.viewshed: grass is not installed")
        text = report(now, *changes([run_of(1, row("exact", 1))], now["rows"]))
        for line in ("| fractal | exact | 1.50 s | 1.50 s | 100 MB | 3.00; 2.00 | 3.00; 2.00 | 1.0000 |",
                     "|  | gdal_viewshed | 0.50 s | 0.50 s | 100 MB |  |  | 0.9886 |",
                     "- r.viewshed: grass is not installed",
                     "| viewshed | fractal | exact | time, s | 1 | 1.5 | 1.50 | 2026-11-01 12:00 c1 |",
                     "2 of 3 rows were not measured before."):
            self.assertIn(line, text.splitlines())
        self.assertIn("The machine was busy", text)
        self.assertNotIn("The machine was busy", report(run_of(2, row("exact", 1)), [], []))

    def test_no_change_is_said(self):
        rows = [row("exact", 1)]
        self.assertIn("Nothing changed", report(run_of(2, *rows), *changes([run_of(1, *rows)], rows)))
        self.assertNotIn("Nothing changed", report(run_of(2, *rows), *changes([], rows)))


class Charts(unittest.TestCase):
    def test_bars_are_multiples_of_the_peer(self):
        chart = charts.beside_the_peer(run_of(1, row("exact", 1.5), row("gdal_viewshed", 0.5)))
        self.assertEqual(chart["groups"], [{"name": "fractal", "bars": [
            {"series": 1, "value": 3.0, "text": "3.00 (1.50 s)"}, {"series": 2, "value": 1.0, "text": "1.00 (0.50 s)"}]}])

    def test_history_is_of_one_machine(self):
        runs = [run_of(1, row("exact", 2)), run_of(2, row("exact", 9), machine="another"), run_of(3, row("exact", 1))]
        chart = charts.over_runs(runs)
        self.assertEqual([bar["value"] for bar in chart["groups"][0]["bars"]], [1, 0.5])
        self.assertEqual(chart["series"], ["2026-11-01 12:00 c1", "2026-11-03 12:00 c3"])

    def test_history_leaves_out_runs_of_other_questions(self):
        runs = [run_of(1, row("exact", 2)), run_of(2, row("tolerance 2 m", 1)), run_of(3, row("exact", 1), load=4)]
        self.assertEqual(charts.over_runs(runs)["series"], ["2026-11-01 12:00 c1", "2026-11-03 12:00 c3 (busy)"])
        self.assertEqual(charts.over_runs(runs[1:2])["groups"], [])

    def test_what_has_nothing_to_show_is_not_drawn(self):
        self.assertEqual(charts.chosen([run_of(1, row("exact", 1))]), [])
        names = [name for name, _ in charts.chosen([run_of(1, row("exact", 1)), run_of(2, row("exact", 1),
                                                                                      row("tolerance 2 m", 2))])]
        self.assertEqual(names, ["tolerances", "history"])


class Files(unittest.TestCase):
    def test_runs_are_read_in_their_order(self):
        with tempfile.TemporaryDirectory() as folder:
            for day in (2, 1):
                results.write(run_of(day), pathlib.Path(folder))
            self.assertEqual([run["commit"] for run in results.earlier(pathlib.Path(folder))], ["c1", "c2"])


class Measures(unittest.TestCase):
    def test_contestants_run_in_turns(self):
        order = []
        in_turns([[["true"]], [["true"]]], 3, order.append)
        self.assertEqual(order, [0, 1, 1, 0, 0, 1])

    def test_medians_and_spread(self):
        cost = median([Cost(1, 5, 30), Cost(2, 4, 10), Cost(4, 9, 20, output="last")])
        self.assertEqual(cost, Cost(2, 5, 20, 4, "last"))

    def test_a_command_that_fails_is_told(self):
        with self.assertRaisesRegex(Failed, "false failed"):
            run_once([["true"], ["false"]])

    def test_output_is_that_of_the_last_command(self):
        self.assertEqual(run_once([["echo", "1"], ["echo", 2]]).output, "2\n")


class Stages(unittest.TestCase):
    def test_lines_of_progress(self):
        self.assertEqual(stage_in("\x1b[Ksight lines  37 %, 12 s left"), "sight lines")
        self.assertEqual(stage_in("reading some/file.tif  5 %"), "reading")
        self.assertIsNone(stage_in("wales.itin: 13 million posts"))


if __name__ == "__main__":
    unittest.main()
