"""Charts of results: what they show, as documents, and their drawing by matplotlib.

    {"title": "...", "note": "...", "axis": "what the bars measure", "line": 1.0, "series": ["exact", ...],
     "groups": [{"name": "fractal", "bars": [{"series": 0, "value": 0.97, "text": "0.97 s"}]}]}
"""
import importlib.util

from results import key, run_name, times_run

MOST_RUNS = 8
# The rows whose history is drawn.
HISTORY = [("viewshed", "fractal", "certified at 32 m"), ("viewshed", "fractal", "exact"),
           ("viewshed", "fractal", "gdal_viewshed"), ("viewshed", "all of Wales", "certified at 32 m"),
           ("viewshed", "all of Wales", "exact"), ("viewshed", "lidar with trees", "exact"),
           ("10,000 links", "within 30 km", "los"), ("10,000 links", "over all of Wales", "los"),
           ("zone", "75 turbines, 40 km", "ztv"), ("sites", "10 of 500, 10 km", "site"), ("import", "fractal", "import")]


def bar(series, value, seconds):
    return {"series": series, "value": round(value, 4), "text": f"{value:.2f} ({seconds:.2f} s)"}


def viewsheds(results, names, base):
    """Returns a group for each viewshed that has the base: the seconds of each name in multiples of the base's."""
    groups = {}
    for row in results["rows"]:
        if row["group"] == "viewshed":
            groups.setdefault(row["question"], {})[row["who"]] = row["seconds"]
    return [{"name": question,
             "bars": [bar(i, who[name] / who[base], who[name]) for i, name in enumerate(names) if name in who]}
            for question, who in groups.items() if base in who and len(who) > 1]


def of_run(results):
    return f"{run_name(results)}, {results['machine']}, {times_run(results)}"


def beside_the_peer(results):
    names = ["certified at 32 m", "exact", "gdal_viewshed", "gdal_viewshed, deflated raster"]
    return {"title": "Viewsheds beside gdal_viewshed", "note": of_run(results), "line": 1,
            "axis": "time by the clock, in multiples of gdal_viewshed's", "series": names,
            "groups": viewsheds(results, names, "gdal_viewshed")}


def by_tolerance(results):
    names = ["exact", *dict.fromkeys(row["who"] for row in results["rows"] if row["who"].startswith("tolerance"))]
    return {"title": "Plain viewsheds by tolerance", "note": of_run(results), "line": 1,
            "axis": "time by the clock, in multiples of the exact viewshed's", "series": names,
            "groups": viewsheds(results, names, "exact") if len(names) > 1 else []}


def over_runs(runs):
    """Returns a chart of the runs on the machine of the last run, in multiples of the oldest run that has the row."""
    runs = [run for run in runs if run["machine"] == runs[-1]["machine"] and any(key(row) in HISTORY for row in run["rows"])]
    runs = runs[-MOST_RUNS:]
    seconds = [{key(row): row["seconds"] for row in run["rows"]} for run in runs]
    groups = []
    for wanted in HISTORY:
        having = [(i, of[wanted]) for i, of in enumerate(seconds) if wanted in of]
        if len(having) > 1:
            _, question, who = wanted
            groups.append({"name": f"{question}: {who}", "bars": [bar(i, value / having[0][1], value) for i, value in having]})
    return {"title": "Time over the runs", "note": runs[-1]["machine"] if runs else "", "line": 1,
            "axis": "time by the clock, in multiples of the first run's",
            "series": [run_name(run) for run in runs], "groups": groups}


def chosen(runs):
    """Returns (name, description) of each chart that has something to show of the last run."""
    described = {"peers": beside_the_peer(runs[-1]), "tolerances": by_tolerance(runs[-1]), "history": over_runs(runs)}
    return [(name, chart) for name, chart in described.items() if chart["groups"]]


def colours(count):
    """A few series have colours that are told apart with every kind of colour blindness (Okabe and Ito); more have an order,
    which shades of blue show."""
    if count <= 4:
        return ["#009e73", "#0072b2", "#8c8c8c", "#d55e00"][:count]
    return [(0.08 + 0.62 * i / (count - 1), 0.25 + 0.55 * i / (count - 1), 0.45 + 0.45 * i / (count - 1))
            for i in range(count)]


def draw_bars(chart, path):
    """Draws bars from left to right, those of a group below each other, with what they stand for at their ends."""
    from matplotlib.figure import Figure

    count = sum(len(group["bars"]) for group in chart["groups"])
    figure = Figure(figsize=(10, 1.6 + 0.17 * count + 0.15 * len(chart["groups"])), layout="constrained")
    axes = figure.add_subplot()
    hues = colours(len(chart["series"]))
    place, middles = 0.0, []
    for group in chart["groups"]:
        first = place
        for bar in group["bars"]:
            axes.barh(place, bar["value"], 0.85, color=hues[bar["series"]])
            axes.annotate(bar["text"], (bar["value"], place), (3, 0), textcoords="offset points", va="center", fontsize=7)
            place += 1
        middles.append((first + place - 1) / 2)
        place += 0.9
    axes.set_yticks(middles, [group["name"] for group in chart["groups"]], fontsize=8)
    axes.invert_yaxis()
    axes.axvline(chart["line"], color="black", linewidth=0.8, linestyle="--")
    axes.grid(axis="x", linewidth=0.4)
    axes.set_axisbelow(True)
    axes.margins(x=0.12)
    axes.set_xlabel(chart["axis"], fontsize=8)
    figure.suptitle(f"{chart['title']}\n{chart['note']}", fontsize=9)
    keys = [axes.barh(0, 0, color=hue) for hue in hues]
    axes.legend(keys, chart["series"], fontsize=8, loc="best")
    figure.savefig(path, dpi=120)


def draw(runs, results_path):
    """Draws the charts beside the last run's results. Returns lines that say where they are, or why there are none."""
    if not importlib.util.find_spec("matplotlib"):
        return ["no charts: python3-matplotlib is not installed"]
    lines = []
    for name, chart in chosen(runs):
        path = results_path.with_name(f"{results_path.stem}-{name}.png")
        draw_bars(chart, path)
        lines.append(str(path))
    return lines
