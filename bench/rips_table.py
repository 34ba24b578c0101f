# SPDX-License-Identifier: MIT
"""The results of compare_rips.py as Markdown."""

OURS = "libph"
ENDED = {"time": "time limit", "memory": "memory limit"}


def number(value):
    """A number with about three digits; further digits would only show noise."""
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


def is_ours(program):
    """True for libph, with default options or with options chosen by hand."""
    return program.split()[0] == OURS


def fastest(row, wanted):
    """The fastest completed one-thread run among the programs in `wanted`."""
    ended = [e for e in row["results"] if wanted(e["program"]) and e["threads"] == 1 and e["outcome"] == "ok"]
    return min(ended, key=lambda e: e["cpu"], default=None)


def ratio(numerator, denominator):
    """The ratio of two times, or – if either run was not completed."""
    for entry in (numerator, denominator):
        if entry is None or entry.get("outcome", "ok") != "ok":
            return "–"
    return number(numerator["cpu"] / denominator["cpu"])


def bound(row, mine):
    """The time limit that stopped peers, and a lower bound on our speed-up, for a row that no peer
    completed."""
    stopped = [e for e in row["results"] if not is_ours(e["program"]) and e["threads"] == 1 and e["outcome"] == "time"]
    if mine is None or mine["outcome"] != "ok" or not stopped:
        return "none ended", "–"
    least = min(e["cpu"] for e in stopped)
    return f"none within {least:.0f} s", f"> {number(least / mine['cpu'])}"


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def summary_row(row, threads, has_choices):
    mine, peer = find(row, OURS, 1), fastest(row, lambda name: not is_ours(name))
    peer_cells = [f"{peer['program']} {cell(peer)}", ratio(peer, mine)] if peer else bound(row, mine)
    cells = [row["name"], cell(mine), *peer_cells]
    for n in threads:
        more = find(row, OURS, n)
        ended = mine and more and mine["outcome"] == more["outcome"] == "ok"
        cells += [cell(more), number(mine["wall"] / more["wall"]) if ended else "–"]
    if has_choices:
        cells.append(ratio(mine, fastest(row, is_ours)))
    return [*cells, ratio(mine, row.get("limit"))]


def markdown(report, limit="read + sort"):
    """Two tables: libph beside the best peer, and all programs. @param limit the name of the lower
    limit, for the last column."""
    rows = report["rows"]
    programs = list(dict.fromkeys((e["program"], e["threads"]) for row in rows for e in row["results"]))
    threads = sorted(n for name, n in programs if name == OURS and n > 1)
    has_choices = any(is_ours(name) and name != OURS for name, _ in programs)
    header = ["input", "libph: s / MB", "best peer: s / MB", "peer / libph"]
    for n in threads:
        header += [f"{n} threads: s / MB", f"wall, 1 / {n} threads"]
    if has_choices:
        header.append("libph / best choice")
    names = [name if n == 1 else f"{name}, {n} threads" for name, n in programs]
    return "\n\n".join([
        f"{report['version']}; {report['machine']}; {report['date']}.",
        table([*header, f"libph / ({limit})"], [summary_row(row, threads, has_choices) for row in rows]),
        table(["input", *names], [[row["name"], *(cell(find(row, *key)) for key in programs)] for row in rows])])
