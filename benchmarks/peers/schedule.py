"""How long traced work takes on several workers, by list scheduling: whoever is idle takes the next task that is ready.

    seconds = makespan(task, 32)

A task is a number of seconds, or a list of seconds and loops, one after the other. A loop has `tasks`, which may run at the
same time; the task that it is part of goes on when all are done, and nobody waits for them idly. Free of charge are
beginning tasks and waking workers, memory and locks that they share, and files that are read from the disk: so the times
are the least that the division of the work allows.
"""
import collections
import heapq
import itertools
from typing import NamedTuple


class Loop(NamedTuple):
    at: str
    tasks: list


class Running:
    """A task that has begun: what is left of it, and the task that it is part of."""

    def __init__(self, task, parent=None):
        self.items = iter(task if isinstance(task, list) else [task])
        self.parent = parent
        self.unfinished = 0


def work(task):
    """Returns the seconds that a task takes on one worker."""
    if not isinstance(task, list):
        return task
    return sum(sum(map(work, item.tasks)) if isinstance(item, Loop) else item for item in task)


def longest_chain(task):
    """Returns the seconds that a task takes on as many workers as there are tasks."""
    if not isinstance(task, list):
        return task
    return sum(max(map(longest_chain, item.tasks), default=0) if isinstance(item, Loop) else item for item in task)


class Schedule:
    def __init__(self, workers):
        self.idle = workers
        self.ready = collections.deque()
        self.ends = []  # a heap of (time, order, running)
        self.order = itertools.count()

    def proceed(self, running, now):
        """Lets an idle worker go on with a task until it works, forks or has finished it."""
        for item in running.items:
            if isinstance(item, Loop):
                if not item.tasks:
                    continue
                running.unfinished = len(item.tasks)
                # Deeper tasks come first, as with the workers of oneTBB.
                self.ready.extendleft(Running(task, running) for task in reversed(item.tasks))
                return
            self.idle -= 1
            heapq.heappush(self.ends, (now + item, next(self.order), running))
            return
        if running.parent:
            running.parent.unfinished -= 1
            if running.parent.unfinished == 0:
                self.ready.appendleft(running.parent)

    def run(self, task):
        now = 0
        self.ready.append(Running(task))
        while self.ready or self.ends:
            while self.ready and self.idle:
                self.proceed(self.ready.popleft(), now)
            if self.ends:
                now, _, running = heapq.heappop(self.ends)
                self.idle += 1
                self.proceed(running, now)
        return now


def makespan(task, workers):
    return Schedule(workers).run(task)
