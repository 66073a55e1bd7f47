"""The tables that questions are asked about, made once: links, candidate sites, turbines and masts, all in Wales."""
import subprocess

from terrain import PEERS, WORK, raster

TURBINES = [(285025 + 500 * (i % 9), 280025 + 500 * (i // 9)) for i in range(75)]  # Pumlumon and what lies east of it
TIP = 145  # metres, of each turbine


def write_links(path, side):
    """Writes 10,000 links of 10 km within a square of `side` metres on high ground."""
    subprocess.run([PEERS / "section.py", "links", raster("wales"), str(side), "10000", "10000", path], check=True)


def write_candidates(path):
    with open(path, "w") as table:
        subprocess.run([PEERS / "site_choice.py", "candidates"], check=True, stdout=table)


def write_turbines(path):
    rows = [f"{x},{y},90,110,bench\n" for x, y in TURBINES]
    path.write_text("x,y,hub_height,rotor_diameter,farm\n" + "".join(rows))


def write_masts(path):
    rows = [f"{270000 + 40000 * (i * 0.618 % 1):.1f},{250000 + 40000 * (i * 0.382 % 1):.1f},100\n" for i in range(75)]
    path.write_text("x,y,h\n" + "".join(rows))


def write_one_link(path):
    path.write_text("id,x1,y1,h1,x2,y2,h2\n0,280000,240000,10,286000,248000,10\n")


MADE = {
    "links": ("section/links-30000.csv", lambda path: write_links(path, 30000)),
    "far_links": ("section/links-1000000.csv", lambda path: write_links(path, 1000000)),
    "one_link": ("section/one-link.csv", write_one_link),
    "candidates": ("site/candidates.csv", write_candidates),
    "turbines": ("ztv/turbines.csv", write_turbines),
    "masts": ("observers/masts.csv", write_masts),
}


def table(name):
    """Returns the path of the table of this name."""
    place, write = MADE[name]
    path = WORK / place
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(".part")
        write(part)
        part.rename(path)
    return path
