"""The results of a run as Markdown: tables by question, and what changed."""
from results import is_busy, key, times_run

HEADINGS = {"viewshed": "Viewsheds", "10,000 links": "10,000 links of 10 km", "section": "Sections",
            "zone": "Zone of visibility", "sites": "Sites", "import": "Import"}
COLUMNS = ["time", "processor", "memory", "of the peers' time", "of their processor time", "per second", "IoU", "decided",
           "bytes per vertex", "points read for each vertex"]


def table(header, rows):
    """Returns a table without the columns that are empty in all rows."""
    kept = [i for i in range(len(header)) if i == 0 or any(row[i] for row in rows)]
    lines = [[header[i] for i in kept], ["---"] * len(kept), *([row[i] for i in kept] for row in rows)]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def peers_of(rows, row):
    """Returns the rows of the peers that a row is compared with, in the question's order; none for a peer's own row."""
    if row["who"] in row["peers"]:
        return []
    found = {key(other): other for other in rows}
    return [found[k] for k in ((row["group"], row["question"], peer) for peer in row["peers"]) if k in found]


def seconds(value):
    return f"{value:.2f} s" if value < 100 else f"{value:.0f} s"


def rate(row):
    if "amount" not in row:
        return ""
    digits = f"{row['amount'] / row['seconds']:.2g}"
    return f"{float(digits):,.0f} {row['unit']}"


def multiples(row, peers, what):
    return "; ".join(f"{row[what] / max(peer[what], 1e-3):.2f}" for peer in peers)


def cells(row, peers):
    """Returns the cells of a row, in the order of COLUMNS."""
    return [seconds(row["seconds"]), seconds(row["processor"]), f"{row['megabytes']:.0f} MB",
            multiples(row, peers, "seconds"), multiples(row, peers, "processor"), rate(row),
            f"{row['iou']:.4f}" if "iou" in row else "", f"{row['decided']:g} %" if "decided" in row else "",
            f"{row['bytes_per_vertex']:.2f}" if "bytes_per_vertex" in row else "",
            f"{row['points_per_vertex']:g}" if "points_per_vertex" in row else ""]


def group_table(rows):
    """Returns the table of one group. Each question is named in its first row. Where a question has several peers, the
    multiples are of each peer's in turn, in the order of their rows."""
    lines, named = [], None
    for row in rows:
        question = row["question"] if row["question"] != named else ""
        named = row["question"]
        lines.append([question, row["who"], *cells(row, peers_of(rows, row))])
    return table(["question", "answered by", *COLUMNS], lines)


def settings(results):
    text = (f"Commit {results['commit']}, {results['when'][:16].replace('T', ' ')}, {results['machine']}; "
            f"{times_run(results)} (r.viewshed and the explicit TIN once); program {results['program']}.")
    return text + (f" The machine was busy: its load was {results['load']} when the run began." if is_busy(results) else "")


def changes_table(found, new, rows):
    parts = []
    if found:
        header = ["", "question", "answered by", "what", "before", "now", "now / before", "before: run of"]
        parts.append(table(header, [change.table_row() for change in found]))
    elif len(new) < len(rows):
        parts.append("Nothing changed by more than 3 % in time or memory, and no IoU at all.\n")
    if new:
        parts.append(f"{len(new)} of {len(rows)} rows were not measured before.\n")
    return "\n".join(parts)


def report(results, found, new):
    parts = ["# Comparison with peers\n", settings(results) + "\n"]
    for group in dict.fromkeys(row["group"] for row in results["rows"]):
        parts += [f"## {HEADINGS.get(group, group)}\n",
                  group_table([row for row in results["rows"] if row["group"] == group])]
    if results["left_out"]:
        parts += ["## Left out\n", "".join(f"- {line}\n" for line in results["left_out"])]
    parts += ["## Changes\n", changes_table(found, new, results["rows"])]
    return "\n".join(parts)
