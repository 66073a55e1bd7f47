"""Sites and wind turbines: the command line's choice and bytes."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from conftest import DATA, run

import itin

PLACES = [(310375, 183525), (312000, 185000), (308000, 181000), (314500, 187500), (305500, 186500)]


def test_sites_are_the_command_line_s(cardiff: itin.Store, tmp_path: Path) -> None:
    plan = cardiff.site(
        [itin.Place(x, y) for x, y in PLACES], masts=[(15, 1), (25, 2)], count=2, radius=4000, cell_size=100
    )
    lines = ["x,y", *(f"{x},{y}" for x, y in PLACES)]
    (tmp_path / "places.csv").write_text("\n".join(lines) + "\n")
    options = ["--mast-height", "15,25", "--mast-cost", "1,2", "--count", "2", "--radius", "4000", "--cell", "100"]
    run("site", cardiff.path, "--candidates", tmp_path / "places.csv", *options, "-o", tmp_path / "theirs")
    document = json.loads((tmp_path / "theirs" / "site.json").read_text())
    assert [site.name for site in plan.chosen] == [site["id"] for site in document["chosen"]]
    assert [site.height for site in plan.chosen] == [site["height_m"] for site in document["chosen"]]
    assert plan.value == document["value"] == plan.chosen[-1].cumulative
    assert plan.upper_bound == document["upper_bound"]
    files = plan.write(tmp_path / "ours")
    assert files
    for file in files:
        theirs = tmp_path / "theirs" / Path(file.path).name
        if theirs.suffix not in (".tif", ".png"):  # whose metadata has the command
            assert Path(file.path).read_bytes() == theirs.read_bytes(), file.path
    assert {"sites.csv"} <= {Path(file.path).name for file in files}
    assert (plan.served == itin.Verdict.VISIBLE).sum() == plan.value
    assert set(np.unique(plan.best_server)) == {0, 1, 2, 65535}
    assert plan.redundancy.shape == plan.grid.shape


def test_a_mast_with_sectors_is_the_command_line_s(cardiff: itin.Store, tmp_path: Path) -> None:
    pattern = tmp_path / "sector.msi"
    pattern.write_text("HORIZONTAL 2\n0 0\n180 20\nVERTICAL 2\n0 1\n180 20\n")
    (x, y), homes = PLACES[0], PLACES[1:]
    sectors = [itin.Sector(name, pattern, azimuth, 2) for name, azimuth in (("north", 0), ("south", 180))]
    plan = cardiff.site(
        [itin.Place(x, y, "north", sectors=sectors)],
        masts=[(25, 1)],
        demand=[itin.Place(*home, f"home {i}", 5) for i, home in enumerate(homes)],
        count=1,
        radius=9000,
        cell_size=300,
        frequency_ghz=5.8,
        power_dbm=20,
        gain_dbi=(16, 20),
        sensitivity_dbm=-90,
    )
    rows = [f"{sector.name},{x},{y},{pattern},{sector.antenna_azimuth},{sector.antenna_tilt}" for sector in sectors]
    (tmp_path / "masts.csv").write_text("\n".join(["name,x,y,antenna,azimuth,tilt", *rows]) + "\n")
    lines = [f"home {i},{x},{y},5" for i, (x, y) in enumerate(homes)]
    (tmp_path / "homes.csv").write_text("\n".join(["name,x,y,height", *lines]) + "\n")
    places = ["--candidates", tmp_path / "masts.csv", "--name-field", "name", "--demand", tmp_path / "homes.csv"]
    radio = ["--frequency", "5.8", "--power-dbm", "20", "--gain-dbi", "16,20", "--sensitivity-dbm", "-90"]
    choice = ["--mast-height", "25", "--count", "1", "--radius", "9000", "--cell", "300"]
    run("site", cardiff.path, *places, *radio, *choice, "-o", tmp_path / "theirs")
    plan.write(tmp_path / "ours")
    ours, theirs = (list(csv.DictReader((tmp_path / who / "demand.csv").open())) for who in ("ours", "theirs"))
    assert ours == theirs
    assert {row["sector"] for row in ours} == {"north", "south"}
    assert plan.level is not None and plan.level.shape == plan.grid.shape
    assert set(np.unique(plan.best_server)) == {0, 1, 2, 65535}
    by_sector = [plan.level[plan.best_server == number] for number in (1, 2)]
    assert all(np.nanmin(levels) >= -90 for levels in by_sector)
    assert (tmp_path / "ours" / "level.qml").read_text() == (tmp_path / "theirs" / "level.qml").read_text()


def test_sites_are_proposed_in_an_area_for_weighted_cells(town: itin.Store) -> None:
    grid = itin.Grid(321600, 4297900, 10, 10, 30, 30)
    weights = np.ones(grid.shape)
    weights[:15] = 0
    plan = town.site(
        search_area=itin.Window.box(321650, 4297650, 321850, 4297850),
        spacing=60,
        masts=[(6, 1)],
        demand=(grid, weights),
        radius=150,
        count=2,
    )
    assert plan.grid == grid
    assert 0 < plan.value <= plan.upper_bound <= 450
    assert len(plan.chosen) == 2


def test_a_wind_farm_is_the_command_line_s(cardiff: itin.Store, tmp_path: Path) -> None:
    (tmp_path / "turbines.csv").write_text("x,y,hub_height,rotor_diameter\n310375,183525,80,90\n312000,185000,80,90\n")
    study = cardiff.ztv(tmp_path / "turbines.csv", cell_size=250)
    files = study.write(tmp_path / "ours")
    options = ["--cell", "250"]
    run("ztv", cardiff.path, "--turbines", tmp_path / "turbines.csv", *options, "-o", tmp_path / "theirs")
    for file in files:
        if Path(file.path).name != "methods.md":  # which has names of options
            assert (tmp_path / "ours" / file.path).read_bytes() == (tmp_path / "theirs" / file.path).read_bytes()
    assert len(files) > 5
    listed = [itin.Turbine(x, y, hub_height=80, rotor_diameter=90) for x, y in PLACES[:2]]
    again = cardiff.ztv(listed, cell_size=250)
    for name, values in study.bare.items():
        np.testing.assert_array_equal(values, again.bare[name], err_msg=name)
    assert study.screened is None or study.screened.keys() == study.bare.keys()
    assert study.bare["tip_count"].shape == study.grid.shape


def test_a_wind_farm_s_seasons_are_the_command_line_s(tmp_path: Path) -> None:
    path = tmp_path / "wooded.itin"
    itin.import_terrain(path, DATA / "alexandria-dtm.tif")
    (tmp_path / "trees.geojson").write_text(
        '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":'
        "[[[321810,4297600],[321830,4297600],[321830,4297780],[321810,4297780],[321810,4297600]]]}}]}"
    )
    run("import", path, tmp_path / "trees.geojson", "--crs", "EPSG:26918", "--kind", "vegetation", "--height", "15")
    (tmp_path / "turbines.csv").write_text("x,y,hub_height,rotor_diameter\n321950,4297690,20,10\n")
    study = itin.Store(path).ztv(tmp_path / "turbines.csv", radius=300, cell_size=5, foliage=0.4, transmittance=0.3)
    files = study.write(tmp_path / "ours")
    options = ["--radius", "300", "--cell", "5", "--foliage=0.4", "--transmittance", "0.3", "-o", tmp_path / "theirs"]
    run("ztv", path, "--turbines", tmp_path / "turbines.csv", *options)
    for name in ("tip-count-summer.tif", "hub-count-winter.tif", "areas.csv"):
        assert name in {file.path for file in files}
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes()
    seasons = study.seasons
    assert seasons is not None and study.screened is not None
    seen = [int((counts == 1).sum()) for counts in (study.screened["tip_count"], seasons["winter"]["tip_count"])]
    assert 0 < seen[0] < seen[1]
    solid = itin.Store(path).ztv(tmp_path / "turbines.csv", radius=300, cell_size=5)
    assert solid.seasons is None


def test_a_wind_farm_s_viewpoints_routes_and_radar_are_the_command_line_s(cardiff: itin.Store, tmp_path: Path) -> None:
    (tmp_path / "turbines.csv").write_text("x,y,hub_height,rotor_diameter\n310375,183525,80,90\n312000,185000,80,90\n")
    (tmp_path / "views.csv").write_text("x,y,name,height\n308000,181000,Bridge,1.6\n314500,187500,Farm,1.6\n")
    (tmp_path / "route.geojson").write_text(
        '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:27700"}},"features":[{"type":"Feature",'
        '"properties":{"name":"Lane"},"geometry":{"type":"LineString","coordinates":[[308000,181000],[309000,182500]]}}]}'
    )
    study = cardiff.ztv(
        tmp_path / "turbines.csv",
        cell_size=250,
        radius=8000,
        viewpoints=[itin.Place(308000, 181000, "Bridge", 1.6), itin.Place(314500, 187500, "Farm", 1.6)],
        routes={"Lane": [(308000, 181000), (309000, 182500)]},
        route_step=200,
        radar=(310000, 180000, 15),
    )
    study.write(tmp_path / "ours")
    files = ["--turbines", tmp_path / "turbines.csv", "--viewpoints", tmp_path / "views.csv"]
    files += ["--route", tmp_path / "route.geojson", "--every", "200", "--radar", "310000,180000,15"]
    run("ztv", cardiff.path, *files, "--radius", "8000", "--cell", "250", "-o", tmp_path / "theirs")
    tables = sorted(path.name for path in (tmp_path / "theirs").glob("*.csv"))
    assert any("viewpoint" in name for name in tables) and any("route" in name for name in tables)
    for name in tables:
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes(), name
    assert study.radar_height_m is not None and study.radar_height_m.shape == study.grid.shape
    assert np.nanmin(study.radar_height_m) == 0
    assert cardiff.ztv(tmp_path / "turbines.csv", cell_size=500, radius=3000).radar_height_m is None


def test_placed_turbines_are_the_command_line_s(cardiff: itin.Store, tmp_path: Path) -> None:
    plan = cardiff.site(
        search_area=itin.Window.box(308000, 182000, 312000, 186000),
        spacing=1000,
        turbines=itin.TurbinesToPlace(hub_height=80, rotor_diameter=90, spacing=(450, 270, 225)),
        count=2,
        radius=5000,
        cell_size=200,
    )
    size = ["--hub-height", "80", "--rotor-diameter", "90", "--rotor-spacing", "5x3", "--wind-from", "225"]
    area = ["--search-area", "POLYGON((308000 182000,312000 182000,312000 186000,308000 186000,308000 182000))"]
    options = ["--spacing", "1000", "--count", "2", "--radius", "5000", "--cell", "200"]
    run("site", cardiff.path, "--turbines", *area, *size, *options, "-o", tmp_path / "theirs")
    document = json.loads((tmp_path / "theirs" / "site.json").read_text())
    assert [(site.x, site.y) for site in plan.chosen] == [(site["x"], site["y"]) for site in document["chosen"]]
    assert plan.value == document["value"]


def test_dwellings_are_the_command_line_s(wooded: itin.Store, tmp_path: Path) -> None:
    (tmp_path / "rotors.csv").write_text("name,x,y,hub_height,rotor_diameter\nA,321950,4297600,60,50\nB,321940,4297890,60,50\n")
    shares = [(0.5, 0.8)] * 6 + [(0.6, 0.7)] * 6
    rows = [f"{month},{sunshine},{operation}" for month, (sunshine, operation) in enumerate(shares, 1)]
    (tmp_path / "months.csv").write_text("\n".join(["month,sunshine,operation", *rows]) + "\n")
    survey = wooded.dwellings(
        tmp_path / "rotors.csv",
        year=2027,
        utc_offset_minutes=-300,
        limit_minutes_year=600,
        months=shares,
        radius=400,
        foliage=0.4,
        transmittance=0.3,
    )
    files = survey.write(
        tmp_path / "ours", sheets=["A3"], sheets_of=["feature 17"], project="Old Town", date="1 July 2027"
    )
    flicker = ["--year", "2027", "--time-zone", "-5", "--limits", "10h,30min", "--months", tmp_path / "months.csv"]
    woods = ["--foliage=0.4", "--transmittance", "0.3", "--radius", "400"]
    sheets = ["--sheets", "A3", "--sheets-of", "feature 17", "--project", "Old Town", "--date", "1 July 2027"]
    turbines = ["--turbines", tmp_path / "rotors.csv"]
    run("dwellings", wooded.path, *turbines, *flicker, *woods, *sheets, "-o", tmp_path / "theirs")
    assert len(files) > 8
    for file in files:
        assert (tmp_path / "ours" / Path(file.path).name).read_bytes() == (tmp_path / "theirs" / Path(file.path).name).read_bytes()
    assert {path.name for path in (tmp_path / "ours").iterdir()} == {path.name for path in (tmp_path / "theirs").iterdir()}
    table = list(csv.DictReader((tmp_path / "ours" / "dwellings.csv").open()))
    assert [house.name for house in survey.dwellings] == [row["name"] for row in table]
    for house, row in zip(survey.dwellings, table, strict=True):
        assert house.flicker.days == int(row["flicker_days"])
        assert house.flicker.minutes <= house.flicker.calendar[:, 2].sum()
        winter = house.views.winter
        assert (str(winter.tips) if winter else "") == row["tips_visible_winter"]
        assert all(facade.outward is not None for facade in house.facades)
    assert any(house.flicker.over_year for house in survey.dwellings)
    assert survey.document["dwellings"]["all"] == len(table)


def test_dwellings_may_be_listed_or_of_a_file(town: itin.Store, tmp_path: Path) -> None:
    (tmp_path / "homes.csv").write_text("name,x,y\nField,321700,4297700\n")
    turbines = [itin.Turbine(321950, 4297600, hub_height=60, rotor_diameter=50, name="A")]
    (tmp_path / "rotors.csv").write_text("name,x,y,hub_height,rotor_diameter\nA,321950,4297600,60,50\n")
    of_file = town.dwellings(tmp_path / "rotors.csv", dwellings=tmp_path / "homes.csv", year=2027)
    listed = town.dwellings(turbines, dwellings=[itin.Place(321700, 4297700, "Field")], year=2027)
    (one,), (other,) = of_file.dwellings, listed.dwellings
    assert (one.name, one.nearest, one.views) == (other.name, other.nearest, other.views)
    np.testing.assert_array_equal(one.flicker.calendar, other.flicker.calendar)
    assert one.views.bare is not None and one.views.summer is None
    with pytest.raises(itin.InputError) as caught:
        town.dwellings(turbines, year=1800)
    assert caught.value.field == "year"
    with pytest.raises(itin.InputError) as caught:
        town.dwellings(turbines, year=2027, months=[(0.5, 0.5)])
    assert caught.value.field == "months"
