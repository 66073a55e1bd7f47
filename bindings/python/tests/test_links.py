"""Lines of sight and links: the command line's answers and bytes."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from conftest import run
from numpy.typing import NDArray

import itin


def random_links(store: itin.Store, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    random = np.random.default_rng(1994)
    low, high = np.array(store.bounds[:2]) + 100, np.array(store.bounds[2:]) - 100

    def ends() -> NDArray[np.float64]:
        return np.column_stack([random.uniform(low, high, (count, 2)), random.integers(2, 30, count)])

    return ends().round(2), ends().round(2)


def table_of(path: Path, start: NDArray[np.float64], end: NDArray[np.float64]) -> None:
    with path.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["id", "x1", "y1", "h1", "x2", "y2", "h2"])
        for number, (a, b) in enumerate(zip(start, end, strict=True)):
            rows.writerow([number, *map(float, a), *map(float, b)])


def test_links_are_those_of_the_command_line(cardiff: itin.Store, tmp_path: Path) -> None:
    start, end = random_links(cardiff, 200)
    end[17, :2] = 0  # there is no ground
    links = cardiff.links(start, end, frequency_ghz=7.5)
    table_of(tmp_path / "links.csv", start, end)
    counts = cardiff.link_table(tmp_path / "links.csv", tmp_path / "ours.csv", frequency_ghz=7.5)
    rows = list(csv.DictReader((tmp_path / "ours.csv").open()))
    verdicts = {"hidden": 0, "visible": 1, "undecided": 2, "error": 255}
    np.testing.assert_array_equal(links.verdict, [verdicts[row["verdict"]] for row in rows])
    for name, column in (("clearance", "clearance_m"), ("diffraction_db", "ld_db"), ("distance", "distance_m")):
        written = np.array([float(row[column] or "nan") for row in rows])
        computed = getattr(links, name)
        known = links.verdict != itin.Verdict.OUTSIDE
        np.testing.assert_allclose(computed[known], written[known], atol=0.006)
    assert list(links.messages) == [17] and "no ground" in links.messages[17]
    assert (counts.visible, counts.hidden) == ((links.verdict == 1).sum(), (links.verdict == 0).sum())
    assert counts.error == 1


def test_link_tables_have_the_command_line_s_bytes(town: itin.Store, tmp_path: Path) -> None:
    start, end = random_links(town, 60)
    grounds = town.heights(end[:, :2])
    start, end = start[~np.isnan(grounds)], end[~np.isnan(grounds)]
    start[np.isnan(town.heights(start[:, :2])), :2] = end[0, :2]
    table_of(tmp_path / "links.csv", start, end)
    ours = [tmp_path / f"ours{ending}" for ending in (".csv", ".gpkg", ".kml")]
    theirs = [tmp_path / f"theirs{ending}" for ending in (".csv", ".gpkg", ".kml")]
    town.link_table(tmp_path / "links.csv", ours)
    outputs = [argument for path in theirs for argument in ("-o", str(path))]
    run("los", town.path, "--links", tmp_path / "links.csv", *outputs)
    for a, b in zip(ours, theirs, strict=True):
        assert a.read_bytes() == b.read_bytes(), a.suffix


def test_batches_make_no_difference(town: itin.Store) -> None:
    start, end = random_links(town, 300)
    many = 70_000 // 300 + 1  # more than a batch
    once = town.links(start, end)
    often = town.links(np.tile(start, (many, 1)), np.tile(end, (many, 1)))
    np.testing.assert_array_equal(often.verdict, np.tile(once.verdict, many))
    np.testing.assert_array_equal(often.clearance, np.tile(once.clearance, many))


def test_a_line_is_that_of_the_command_line(town: itin.Store, tmp_path: Path) -> None:
    line = town.line_of_sight((321590, 4297655, 10), (321790, 4297662, 12), frequency_ghz=26)
    ends = ["--from", "321590,4297655,10", "--to", "321790,4297662,12"]
    document = json.loads(run("los", town.path, *ends, "--frequency", "26", "--json"))
    for name in ("verdict", "clearance_m", "critical", "obstructions", "radio", "surface"):
        assert line.document[name] == document[name]
    assert line.verdict.name.lower() == document["verdict"]
    assert line.clearance == document["clearance_m"]
    assert line.profile.length == line.distance == document["distance_m"]
    line.write(tmp_path / "report.pdf")
    assert (tmp_path / "report.pdf").read_bytes().startswith(b"%PDF")


def test_a_link_budget_is_that_of_the_command_line(town: itin.Store, tmp_path: Path) -> None:
    pattern = tmp_path / "sector.msi"
    pattern.write_text("HORIZONTAL 2\n0 0\n180 20\nVERTICAL 2\n0 1\n180 20\n")
    ends = ["--from", "321590,4297655,10", "--to", "321790,4297662,12"]
    cases: tuple[tuple[float | tuple[float, float], str], ...] = (((30.0, 31.0), "30,31"), (32.0, "32"))
    for gains, text in cases:
        line = town.line_of_sight(
            (321590, 4297655, 10),
            (321790, 4297662, 12),
            frequency_ghz=26,
            power_dbm=18,
            gain_dbi=gains,
            feeder_loss_db=1,
            sensitivity_dbm=-70,
            rain_rate_mm_h=42,
            refractivity_gradient=-200,
            from_antenna=pattern,
            antenna_azimuth=60,
            antenna_tilt=(2, None),
        )
        radio = ["--frequency", "26", "--power-dbm", "18", "--gain-dbi", text, "--feeder-loss-db", "1"]
        climate = ["--sensitivity-dbm", "-70", "--rain-rate-mm-h", "42", "--refractivity-gradient", "-200"]
        antenna = ["--from-antenna", str(pattern), "--antenna-azimuth", "60", "--antenna-tilt", "2,aim"]
        document = json.loads(run("los", town.path, *ends, *radio, *climate, *antenna, "--json"))
        assert line.document["radio"]["budget"] == document["radio"]["budget"]
    with pytest.raises(itin.InputError) as caught:
        town.line_of_sight((321590, 4297655, 10), (321790, 4297662, 12), frequency_ghz=26, sensitivity_dbm=-70)
    assert caught.value.field == "sensitivity_dbm"


def test_one_link_is_one_line(cardiff: itin.Store) -> None:
    start, end = random_links(cardiff, 20)
    links = cardiff.links(start, end)
    for i, (a, b) in enumerate(zip(start, end, strict=True)):
        line = cardiff.line_of_sight(a, b)
        assert line.verdict == links.verdict[i]
        assert line.clearance == links.clearance[i]
