"""List scheduling, held to its bounds and to schedules worked out by hand; traces read and named."""
import random
import unittest

import obstacles
from schedule import Loop, longest_chain, makespan, work
from trace import name_of, named


def random_task(chance, depth):
    """Seconds, or up to three stretches and loops of up to six tasks."""
    if depth == 0 or chance.random() < 0.3:
        return chance.choice((0, 0.25, 1, 2.5))
    items = []
    for _ in range(chance.randint(0, 3)):
        items.append(chance.random())
        items.append(Loop("somewhere", [random_task(chance, depth - 1) for _ in range(chance.randint(0, 6))]))
    return items


class Schedules(unittest.TestCase):
    def test_tasks_are_taken_in_order(self):
        loop = Loop("", [3, 3, 2, 2, 2])
        self.assertEqual([makespan([loop], workers) for workers in (1, 2, 3, 4, 5)], [12, 7, 5, 4, 3])

    def test_what_is_alone_is_added(self):
        self.assertEqual(makespan([1, Loop("", [2, 2]), 1, Loop("", []), 1], 2), 5)

    def test_a_task_that_waits_for_its_loop_keeps_nobody(self):
        # The first task forks; both workers take its two halves, then go on with the others.
        self.assertEqual(makespan([Loop("", [[1, Loop("", [2, 2]), 1], 4])], 2), 6)
        self.assertEqual(makespan([Loop("", [[1, Loop("", [2, 2]), 1], 4])], 3), 4)

    def test_bounds_of_graham_hold(self):
        chance = random.Random(1994)
        for _ in range(300):
            task = random_task(chance, 3)
            self.assertAlmostEqual(makespan(task, 1), work(task))
            self.assertAlmostEqual(makespan(task, 10000), longest_chain(task))
            for workers in (2, 3, 8):
                least = max(work(task) / workers, longest_chain(task))
                most = work(task) / workers + longest_chain(task) * (1 - 1 / workers)
                self.assertGreaterEqual(makespan(task, workers), least - 1e-9)
                self.assertLessEqual(makespan(task, workers), most + 1e-9)


class Obstacles(unittest.TestCase):
    def test_short_loops_lose_what_their_longest_task_keeps(self):
        root = [0.5, Loop("viewshed/src/scene/reveal.cpp", [4, 1, 1]), Loop("libitin/src/store/store.cpp", [1] * 4)]
        ((seconds, text), (none, _)) = obstacles.of_loops(root, 2)
        self.assertEqual((seconds, none), (1, 0))
        self.assertIn("viewshed/scene/reveal.cpp (3 tasks, the longest 4.000 s)", text)

    def test_the_greatest_is_named_first(self):
        found = obstacles.of_one_thread({"cli/a.cpp": 0.1, "libitin/src/b.cpp": 0.3})
        self.assertEqual(found, [(0.3, "libitin/b.cpp"), (0.1, "cli/a.cpp")])
        self.assertEqual(obstacles.line("one thread", found), "one thread 0.40 s: 0.30 libitin/b.cpp, 0.10 cli/a.cpp")


class Traces(unittest.TestCase):
    SOURCES = {1: "/x/libitin/src/base/parallel.cpp:9", 2: "/x/build/../viewshed/src/scene/reveal.cpp:12", 3: "??:0",
               4: "/x/cli/los/los.cpp:1"}

    def test_the_innermost_source_that_is_no_seam_names_a_loop(self):
        self.assertEqual(name_of([1, 3, 2, 4], self.SOURCES), "viewshed/src/scene/reveal.cpp")
        self.assertEqual(name_of([1, 3], self.SOURCES), "elsewhere")

    def test_json_becomes_tasks(self):
        document = [0.5, {"at": [1, 2], "tasks": [0.25, [1, {"at": [4], "tasks": [2]}, 3]]}, 0.5]
        self.assertEqual(named(document, self.SOURCES), [
            0.5, Loop("viewshed/src/scene/reveal.cpp", [0.25, [1, Loop("cli/los/los.cpp", [2]), 3]]), 0.5])


if __name__ == "__main__":
    unittest.main()
