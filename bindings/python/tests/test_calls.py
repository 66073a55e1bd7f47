"""Long calls: progress, and what ends them."""

from __future__ import annotations

import _thread
import os
import threading
import time

import pytest

import itin

HILL = (310375.0, 183525.0, 30.0)
MINUTES = {"cell_size": 10.0, "mode": "probability", "vertical_error": 1.0}
"""A viewshed that takes minutes."""


def work_time() -> float:
    """Returns the seconds that the processors have worked for this process: what else runs on them does not count."""
    return time.process_time() / len(os.sched_getaffinity(0))


def test_progress_rises_to_the_end(cardiff: itin.Store) -> None:
    told: list[tuple[str, float]] = []
    cardiff.viewshed(HILL, radius=15000, cell_size=10, mode="height", progress=lambda stage, share: told.append((stage, share)))
    assert told
    fractions = [fraction for _, fraction in told]
    assert fractions == sorted(fractions)
    assert 0 <= fractions[0] and fractions[-1] <= 1
    assert any(stage for stage, _ in told)


def test_ctrl_c_is_heard_within_half_a_second(cardiff: itin.Store) -> None:
    pressed = 0.0

    def press() -> None:
        nonlocal pressed
        time.sleep(0.7)
        pressed = work_time()
        _thread.interrupt_main()

    threading.Thread(target=press).start()
    with pytest.raises(KeyboardInterrupt):
        cardiff.viewshed(HILL, **MINUTES)  # type: ignore[arg-type]
    assert work_time() - pressed < 0.5


def test_what_progress_raises_ends_the_call(cardiff: itin.Store) -> None:
    def enough(stage: str, fraction: float) -> None:
        raise RuntimeError(f"enough of {stage}")

    start = work_time()
    with pytest.raises(RuntimeError, match="enough of"):
        cardiff.viewshed(HILL, progress=enough, **MINUTES)  # type: ignore[arg-type]
    assert work_time() - start < 2


def test_other_threads_run_meanwhile(cardiff: itin.Store) -> None:
    counted = 0
    done = threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    cardiff.viewshed(HILL, radius=15000, cell_size=10, mode="height")
    done.set()
    counter.join()
    assert counted > 20
