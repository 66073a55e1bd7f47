"""Errors: one line, with the argument, the file or the place as data."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import DATA

import itin

HILL = (310375.0, 183525.0, 30.0)


def field_of(call: Callable[[], object]) -> str:
    with pytest.raises(itin.InputError) as caught:
        call()
    assert "\n" not in str(caught.value)
    return caught.value.field


def test_of_viewsheds_name_the_argument(cardiff: itin.Store) -> None:
    assert field_of(lambda: cardiff.viewshed((0.0, 0.0))) == "observers"
    assert field_of(lambda: cardiff.viewshed([])) == "observers"
    assert field_of(lambda: cardiff.viewshed(HILL, radius=-1)) == "radius"
    assert field_of(lambda: cardiff.viewshed(HILL, radius=100, cell_size=1000)) == "cell_size"
    assert field_of(lambda: cardiff.viewshed(HILL, target_height=-1)) == "target_height"
    assert field_of(lambda: cardiff.viewshed(HILL, mode="seen")) == "mode"  # type: ignore[arg-type]
    assert field_of(lambda: cardiff.viewshed(HILL, mode="loss")) == "frequency_ghz"
    assert field_of(lambda: cardiff.viewshed(HILL, frequency_ghz=5.8)) == "mode"
    assert field_of(lambda: cardiff.viewshed(HILL, nodata="sea")) == "nodata"  # type: ignore[arg-type]
    assert field_of(lambda: cardiff.viewshed(HILL, tolerance=-1)) == "tolerance"
    assert field_of(lambda: cardiff.viewshed(HILL, themes="moat")) == "themes"
    assert field_of(lambda: cardiff.viewshed(HILL, earth=itin.Earth(refraction=1))) == "refraction"


def test_of_other_calls_name_the_argument(cardiff: itin.Store, tmp_path: Path) -> None:
    assert field_of(lambda: cardiff.heights(np.zeros((2, 3)))) == "xy"
    assert field_of(lambda: cardiff.heights([(np.nan, 0)])) == "xy"
    assert field_of(lambda: cardiff.profile([(0, 0)])) == "corners"
    assert field_of(lambda: cardiff.links(np.zeros((2, 3)), np.zeros((3, 3)))) == "to"
    assert field_of(lambda: cardiff.line_of_sight(HILL, (0, 0, 2))) == "to"
    assert field_of(lambda: cardiff.site(count=1)) == "candidates"
    assert field_of(lambda: cardiff.site([itin.Place(*HILL[:2])])) == "count"
    assert field_of(lambda: cardiff.ztv([])) == "turbines"
    assert field_of(lambda: cardiff.hold((1, 1, 0, 0))) == "area"
    assert field_of(lambda: itin.import_terrain(tmp_path / "a.itin", DATA / "cardiff.tif", resolution=0)) == "resolution"
    assert field_of(lambda: itin.import_terrain(tmp_path / "a.itin", DATA / "cardiff.tif", where="x")) == "where"
    assert not list(tmp_path.iterdir())


def test_of_files_name_the_path(cardiff: itin.Store, tmp_path: Path) -> None:
    missing = str(tmp_path / "missing.itin")
    with pytest.raises(itin.FileError) as caught:
        itin.Store(missing)
    assert caught.value.path == missing
    seen = cardiff.viewshed(HILL, radius=500, cell_size=50)
    seen.write(tmp_path / "a.tif")
    with pytest.raises(itin.FileError) as caught:
        seen.write(tmp_path / "a.tif")
    assert caught.value.path == str(tmp_path / "a.tif")
    seen.write(tmp_path / "a.tif", overwrite=True)
    assert field_of(lambda: seen.write(tmp_path / "a.txt")) == "path"


def test_of_damaged_stores_name_the_place(cardiff_file: Path, tmp_path: Path) -> None:
    damaged = tmp_path / "damaged.itin"
    data = bytearray(cardiff_file.read_bytes())
    for at in range(len(data) // 3, len(data) - len(data) // 3, 512):
        data[at] ^= 0xFF
    damaged.write_bytes(data)
    with pytest.raises(itin.CorruptStore) as caught:
        itin.Store(damaged).viewshed(HILL)
    assert caught.value.path == str(damaged)
    assert caught.value.place in str(caught.value)


def test_a_hierarchy(cardiff: itin.Store) -> None:
    assert issubclass(itin.InputError, (itin.Error,)) and issubclass(itin.InputError, ValueError)
    assert issubclass(itin.CorruptStore, itin.FileError) and issubclass(itin.FileError, itin.Error)


def test_a_forked_process_is_refused(cardiff: itin.Store) -> None:
    def ask(answers: "multiprocessing.SimpleQueue[str]") -> None:
        try:
            cardiff.heights([HILL[:2]])
            answers.put("no error")
        except itin.Error as error:
            answers.put(str(error))
        os._exit(0)

    context = multiprocessing.get_context("fork")
    answers: "multiprocessing.SimpleQueue[str]" = context.SimpleQueue()
    child = context.Process(target=ask, args=(answers,))
    child.start()
    assert "'spawn'" in answers.get()
    child.join()
