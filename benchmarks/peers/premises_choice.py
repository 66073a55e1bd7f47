#!/usr/bin/python3
"""Sites that `itin site --demand premises` chose, against greedy choice by brute force.

    premises_choice.py CANDIDATES LINKS SITES

CANDIDATES is the table that `itin site` chose from with --swap off, LINKS the links.csv of `itin premises` with all
candidates as masts, SITES the sites.csv of the choice. Ends with status 1 where the choice is another.
"""
import csv
import sys


def greedy(names, served, count):
    chosen, together = [], set()
    while len(chosen) < count:
        best = max(names, key=lambda name: len(served.get(name, set()) - together))  # of several the first
        gain = served.get(best, set()) - together
        if not gain:
            break
        chosen.append((best, len(gain)))
        together |= gain
    return chosen


def main():
    candidates, links, sites = (list(csv.DictReader(open(path))) for path in sys.argv[1:4])
    served = {}
    for row in links:
        if row["verdict"] == "served":
            served.setdefault(row["mast"], set()).add((row["theme"], row["id"]))
    found = greedy([row["name"] for row in candidates], served, len(sites))
    told = [(row["id"], int(float(row["gain"]))) for row in sites]
    print(f"    {len(candidates)} candidates, {len(links)} links of buildings; the choice serves "
          f"{sum(gain for _, gain in told)} and is {'' if told == found else 'NOT '}that of brute force")
    if told != found:
        print(f"    told {told}, but found {found}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main()
