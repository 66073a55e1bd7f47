"""Finds how rows changed since they were measured last: by more than 3 % in time or memory, and by any amount in what does
not depend on chance."""
from typing import NamedTuple

from results import key, run_name

BY_CHANCE = {"seconds": "time, s", "megabytes": "memory, MB"}
CERTAIN = {"iou": "IoU", "differing": "differing", "decided": "decided, %", "bytes_per_vertex": "bytes per vertex",
           "points_per_vertex": "points read for each vertex", "amount": "amount"}
NOTABLE = 1.03


class Change(NamedTuple):
    row: dict
    what: str
    before: float
    now: float
    run: str  # which earlier run has it

    def table_row(self):
        factor = self.now / self.before if self.before else float("inf")
        chance = self.what in BY_CHANCE.values()
        return [self.row["group"], self.row["question"], self.row["who"], self.what, *map(shown, (self.before, self.now)),
                f"{factor:.2f}" if chance else "", self.run]


def shown(value):
    return f"{value:.4g}" if value < 1e5 else f"{value:.0f}"


def last_rows(runs):
    """Returns each row by key, from the last run that has it, with the name of that run. A run of a few questions does not
    hide the other rows of the run before it."""
    return {key(row): (row, run_name(run)) for run in runs for row in run["rows"]}


def changed(before, now):
    """Yields (what, before, now) for all that differs between two rows of one key."""
    for field, what in BY_CHANCE.items():
        a, b = before[field], now[field]
        if max(a, b) > NOTABLE * min(a, b):
            yield what, a, b
    for field, what in CERTAIN.items():
        if field in before and field in now and before[field] != now[field]:
            yield what, before[field], now[field]


def changes(runs, rows):
    """Returns the changes of the rows since the earlier runs, and the rows that the earlier runs do not have."""
    last = last_rows(runs)
    found, new = [], []
    for row in rows:
        if key(row) not in last:
            new.append(row)
            continue
        before, run = last[key(row)]
        found += [Change(row, *change, run) for change in changed(before, row)]
    return found, new
