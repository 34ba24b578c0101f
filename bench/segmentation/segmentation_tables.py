# SPDX-License-Identifier: MIT
"""The results of segmentation_scores.py as Markdown."""
import statistics

import perturbations
from rips_table import number

ORDER = ("boxes", "stacked", "occluded", "cylindric", "mixed", "complex", "other")
OURS = "libph"


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def share(value):
    """A score in the usual form, for example .900 for 0.9."""
    return "–" if value is None else f"{value:.3f}".removeprefix("0")


def mean(values):
    there = [value for value in values if value is not None]
    return statistics.fmean(there) if there else None


def categories(report):
    """Each category with its frames, and finally all frames together."""
    frames = report["categories"]
    names = [name for name in ORDER if name in frames.values()]
    names += sorted(set(frames.values()) - set(ORDER))
    return {
        **{name: [f for f, c in frames.items() if c == name] for name in names},
        "all": list(frames),
    }


def scores_of(report, kind):
    """The programs that have scores of this truth."""
    return {
        program: frames
        for program, frames in report["scores"].items()
        if any(kind in scores for scores in frames.values())
    }


def supervoxels(report):
    rows = []
    for program, frames in scores_of(report, "supervoxels").items():
        of = lambda key: mean(scores["supervoxels"][key] for scores in frames.values())
        rows.append(
            [
                program,
                f"{of('supervoxels'):.0f}",
                share(of("boundary_recall")),
                f"{of('under_segmentation'):.4f}".removeprefix("0"),
            ]
        )
    return table(["", "supervoxels a frame", "borders met", "under-segmentation"], rows)


def by_category(report, truth, key):
    groups = categories(report)
    rows = [
        [
            program,
            *(
                share(mean(frames[f][truth][key] for f in group if f in frames))
                for group in groups.values()
            ),
        ]
        for program, frames in scores_of(report, truth).items()
    ]
    for truths, row in report.get("cross_validation", {}).items():
        if (truths, key) == (truth, "f"):
            rows.append(
                [f"{OURS}, cross-validated", *(share(row["f"].get(name)) for name in groups)]
            )
    names = [f"{name} ({len(group)})" for name, group in groups.items()]
    return table([f"{'boundary ' * (key != 'f')}F on {truth}", *names], rows)


def departures(options, grid):
    """The chosen options that differ from the default, which is the first value of each option."""
    words = options.split()
    others = [
        f"{name} {value}"
        for name, value in zip(words[::2], words[1::2])
        if value != grid[name.removeprefix("--")][0]
    ]
    return f"`{' '.join(others)}`" if others else "the defaults"


def chosen(report):
    lines = []
    for truth, row in report["cross_validation"].items():
        grid = "; ".join(f"`--{name}` {', '.join(values)}" for name, values in row["grid"].items())
        lines.append(f"F on {truth}, chosen without the category that is scored, of {grid}:")
        lines.append(
            table(
                ["left out", "F", "chosen", "F of the others"],
                [
                    [
                        name,
                        share(row["f"][name]),
                        departures(picked["options"], row["grid"]),
                        share(picked["f"]),
                    ]
                    for name, picked in row["chosen"].items()
                ],
            )
        )
    return "\n\n".join(lines)


def after_load(entry):
    return sum(seconds for name, seconds in entry["stages"].items() if name != "load")


def times(report):
    measured = {program: list(frames.values()) for program, frames in report["times"].items()}
    first = next(iter(measured))
    least = statistics.median(entry["cpu"] for entry in measured[first])
    least_after = statistics.median(map(after_load, measured[first]))
    rows = []
    for program, entries in measured.items():
        cpu, after = [entry["cpu"] for entry in entries], [after_load(entry) for entry in entries]
        row = [program, milliseconds(cpu), f"{statistics.median(cpu) / least:.1f}"]
        row += (
            [milliseconds(after), f"{statistics.median(after) / least_after:.1f}"]
            if any(after)
            else ["–", "–"]
        )
        rows.append([*row, number(max(entry["peak_mb"] for entry in entries))])
    return table(
        [
            "program",
            "CPU ms of the program: median / worst",
            f"× {first}",
            "stages after load, ms: median / worst",
            f"× {first}",
            "peak MB",
        ],
        rows,
    )


def milliseconds(seconds):
    return f"{number(1e3 * statistics.median(seconds))} / {number(1e3 * max(seconds))}"


def stages(report):
    rows = []
    for program, frames in report["times"].items():
        entries = list(frames.values())
        cells = [
            f"{name} {milliseconds([entry['stages'].get(name, 0.0) for entry in entries])}"
            for name in entries[0]["stages"]
        ]
        if cells:
            rows.append([program, " · ".join(cells)])
    return table(["program", "stages, ms: median / worst frame"], rows)


def unharmed(report):
    """The mean F of the unmodified frames, for each program and truth."""
    return {
        program: {
            truth: mean(frames[f][truth]["f"] for f in report["categories"] if f in frames)
            for truth in ("objects", "parts")
        }
        for program, frames in scores_of(report, "objects").items()
    }


def curves(report):
    parts = []
    for kind, amounts in report["curves"].items():
        amounts = {f"{perturbations.KINDS[kind].unharmed:g}": unharmed(report), **amounts}
        programs = dict.fromkeys(p for scores in report["curves"][kind].values() for p in scores)
        rows = [
            [
                amount,
                *(
                    " / ".join(share(scores[p][key]) for key in ("objects", "parts"))
                    if p in scores
                    else "–"
                    for p in programs
                ),
            ]
            for amount, scores in amounts.items()
        ]
        parts.append(table([perturbations.KINDS[kind].what, *programs], rows))
    return "\n\n".join(parts)


def markdown(report):
    scored = scores_of(report, "objects") or report["cross_validation"]
    parts = (
        [
            by_category(report, truth, key)
            for truth in ("objects", "parts")
            for key in ("f", "boundary_f")
        ]
        if scored
        else []
    )
    if scores_of(report, "supervoxels"):
        parts.append(supervoxels(report))
    if report.get("cross_validation"):
        parts.append(chosen(report))
    if report.get("times"):
        parts += [times(report), stages(report)]
    if report.get("curves"):
        parts.append("F on objects / F on parts, the mean of all frames.\n\n" + curves(report))
    return "\n\n".join(parts)
