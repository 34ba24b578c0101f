# SPDX-License-Identifier: MIT
"""The results of compare_rips.py as Markdown."""

ENDED = {"time": "time limit", "memory": "memory limit"}


def number(value):
    """Three digits; more would be noise."""
    if value >= 100:
        return f"{value:.0f}"
    return f"{value:.{1 if value >= 10 else 2 if value >= 1 else 3 if value >= 0.01 else 4}f}"


def cell(entry):
    if entry is None:
        return "–"
    if entry["outcome"] != "ok":
        return ENDED.get(entry["outcome"], entry["outcome"])
    return f"{number(entry['cpu'])} / {number(entry['peak_mb'])}"


def line(row, entry):
    return (f"{row}: {entry['program']}, {entry['threads']} thread{'s'[:entry['threads'] != 1]}: {cell(entry)} "
            f"(wall {number(entry['wall'])})")


def find(row, program, threads):
    return next((e for e in row["results"] if e["program"] == program and e["threads"] == threads), None)


def best_peer(row, ours, threads=1):
    """The fastest peer that ended, on that number of threads."""
    ended = [e for e in row["results"] if e["program"] != ours and e["threads"] == threads and e["outcome"] == "ok"]
    return min(ended, key=lambda e: e["cpu"], default=None)


def ratio(numerator, denominator):
    """A factor, or – where either run did not end."""
    for entry in (numerator, denominator):
        if entry is None or entry.get("outcome", "ok") != "ok":
            return "–"
    return number(numerator["cpu"] / denominator["cpu"])


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def summary_row(row, ours, threads):
    mine, peer = find(row, ours, 1), best_peer(row, ours)
    cells = [row["name"], cell(mine), f"{peer['program']} {cell(peer)}" if peer else "none ended", ratio(peer, mine)]
    for n in threads:
        more = find(row, ours, n)
        ended = mine and more and mine["outcome"] == more["outcome"] == "ok"
        cells += [cell(more), number(mine["wall"] / more["wall"]) if ended else "–"]
    return [*cells, ratio(mine, row.get("limit"))]


def markdown(report, ours):
    """Two tables: libph beside the best peer, and every program."""
    rows = report["rows"]
    threads = sorted({e["threads"] for row in rows for e in row["results"] if e["program"] == ours} - {1})
    header = ["input", "libph: s / MB", "best peer: s / MB", "peer / libph"]
    for n in threads:
        header += [f"{n} threads: s / MB", f"wall, 1 / {n} threads"]
    programs = list(dict.fromkeys((e["program"], e["threads"]) for row in rows for e in row["results"]))
    names = [name if n == 1 else f"{name}, {n} threads" for name, n in programs]
    return "\n\n".join([
        f"{report['version']}; {report['machine']}; {report['date']}.",
        table([*header, "libph / (read + sort)"], [summary_row(row, ours, threads) for row in rows]),
        table(["input", *names], [[row["name"], *(cell(find(row, *key)) for key in programs)] for row in rows])])
