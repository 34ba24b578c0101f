# SPDX-License-Identifier: MIT
"""Random tasks for ph-vectorise: barcodes or images, options, and what the options mean."""
import dataclasses
import math
import pathlib

import diagram_files
import formats

INF = math.inf
KINDS = ["statistics", "betti", "landscape", "silhouette", "image", "entropy", "life-entropy", "lengths", "atol",
         "euler"]
ON_GRIDS = {"betti", "landscape", "silhouette", "image", "life-entropy", "euler"}
KEEP = {"betti", "landscape", "euler"}
# Options with a value, and the kinds of vectors that accept them.
SCOPES = {
    ("--grid", "0,9,5"): ON_GRIDS, ("--length-grid", "0,9,5"): {"image"}, ("--layers", "2"): {"landscape"},
    ("--count", "2"): {"lengths", "atol"}, ("--sigma", "0.5"): {"image"}, ("--power", "2"): {"image", "silhouette"},
    ("--normalised",): {"entropy"}, ("--contrast", "gauss"): {"atol"}, ("--seed", "1"): {"atol"},
    ("--dims", "1"): set(KINDS) - {"euler"}, ("--format", "barcode"): {"euler"}, ("--infinite", "keep"): KEEP,
    ("--nan", "drop"): set(), ("--construction", "cells"): set(), ("--superlevel",): set(), ("--periodic", "0"): set(),
}
SENSELESS = {
    "--grid": ["", "0", "1,0,5", "0,0,5", "0,inf,5", "0,1", "0,1,0", "0,1,1.5", "a,b,3", "0,1,2,3"],
    "--length-grid": ["0", "3,1,2"], "--layers": ["0", "-1", "x"], "--count": ["0"],
    "--sigma": ["0", "-1", "inf", "nan"], "--power": ["-1", "inf"], "--dims": ["", "-1", "a", "0,0"],
    "--infinite": ["", "inf", "nan", "sometimes"], "--kind": ["", "tree"], "--contrast": ["flat"], "--seed": ["-1"],
    "--output-format": ["json"], "--threads": ["0", "x"],
}


@dataclasses.dataclass
class Task:
    """The results that a task requests. Grids are [low, high, count], or None if they are
    fitted."""
    names: list
    bars: list
    kind: str
    dims: list = None
    infinite: object = "drop"
    grid: list = None
    count: int = None
    across: list = None
    layers: int = 5
    sigma: float = None
    power: float = 1.0
    normalised: bool = False
    contrast: str = "laplace"
    superlevel: bool = False
    construction: str = "vertices"
    form: str = "csv"
    output: str = None
    fit: str = None


def some_grid(rng, task, pixels):
    """@return [low, high, count], where low is None if the range is fitted; and the value of the
    option."""
    count = rng.choice([1, 2, 3, 5, 9] if pixels else [1, 2, 3, 7, 20, 20, 50, 50])
    if rng.random() < 0.4:
        return [None, None, count], str(count)
    values = sorted({x for own in task.bars for x in diagram_files.finite(own)}) or [0.0]
    low = rng.choice(values)
    high = low + (max(values) - min(values)) * rng.choice([1, 0.5, 2]) or low + 1
    if not low < high < 1e100 or math.isinf(high - low):
        return [None, None, count], str(count)
    return [low, high, max(2, count)], f"{formats.number(rng, low)},{formats.number(rng, high)},{max(2, count)}"


def kind_options(rng, task):
    """@return the options of a kind of vectors, each with its value."""
    options, kind = [] if task.kind == "statistics" and rng.random() < 0.7 else [["--kind", task.kind]], task.kind
    if kind in ON_GRIDS and rng.random() < 0.7:
        task.grid, text = some_grid(rng, task, kind == "image")
        options.append(["--grid", text])
    if kind == "image":
        if rng.random() < 0.5:
            task.across, text = some_grid(rng, task, True)
            if task.across[0] is not None and task.across[1] - task.across[0] > 1e100:
                task.across[:2], text = [None, None], str(task.across[2])
            elif task.across[0] is not None:
                task.across[0], task.across[1] = 0.0, task.across[1] - task.across[0]
                text = f"0,{formats.number(rng, task.across[1])},{task.across[2]}"
            options.append(["--length-grid", text])
        if rng.random() < 0.5:
            sizes = [e - b for own in task.bars for _, b, e in own if 0 < e - b < INF] or [1.0]
            task.sigma = max(rng.choice(sizes) * rng.choice([0.01, 0.3, 1, 5]), 1e-300)
            options.append(["--sigma", formats.number(rng, task.sigma)])
    if kind in ("image", "silhouette") and rng.random() < 0.6:
        task.power = rng.choice([0.0, 0.5, 1.0, 2.0, 5.0])
        options.append(["--power", formats.number(rng, task.power)])
    if kind == "landscape" and rng.random() < 0.6:
        task.layers = rng.choice([1, 2, 3, 40])
        options.append(["--layers", str(task.layers)])
    task.count = {"atol": 10}.get(kind, 5)
    if kind in ("lengths", "atol") and rng.random() < (0.95 if kind == "atol" else 0.6):
        task.count = rng.choice([1, 2, 3] if kind == "atol" else [1, 3, 40])
        options.append(["--count", str(task.count)])
    if kind == "atol":
        if rng.random() < 0.5:
            task.contrast = rng.choice(["laplace", "gauss"])
            options.append(["--contrast", task.contrast])
        if rng.random() < 0.3:
            options.append(["--seed", rng.choice("019")])
    if kind == "entropy" and rng.random() < 0.4:
        task.normalised = True
        options.append(["--normalised"])
    return options


def infinite_options(rng, task):
    task.infinite = "keep" if task.kind == "euler" else "drop"
    if rng.random() < 0.5:
        return []
    ways = ["drop", "error", "cap", "cap"] + ["keep", "keep"] * (task.kind in KEEP)
    task.infinite = rng.choice(ways)
    if task.infinite == "cap":
        values = sorted({x for own in task.bars for x in diagram_files.finite(own)}) or [0.0]
        task.infinite = values[-1] if rng.random() < 0.8 else rng.choice(values)
        return [["--infinite", formats.number(rng, task.infinite)]]
    return [["--infinite", task.infinite]]


def output_options(rng, task):
    options = []
    if rng.random() < 0.4:
        task.form = rng.choice(["csv", "npy"])
        task.output = "out." + task.form
        options.append([rng.choice(["-o", "--output"]), task.output])
    elif rng.random() < 0.3:
        task.form = "npy"
    if task.form == "npy" and not task.output or rng.random() < 0.1:
        options.append(["--output-format", task.form])
    if rng.random() < 0.5 or task.kind == "atol":
        task.fit = "fit.json"
        options.append(["--fit", task.fit])
    if rng.random() < 0.5:
        options.append(["--threads", rng.choice("123")])
    if rng.random() < 0.1:
        options.append(["--memory-limit", rng.choice(["256MiB", "1GiB", "100MB"])])
    return options + rng.choice([[], [], [["--quiet"]], [["--verbose"]], [["--progress", "json"]]])


def random_barcodes(rng, folder, stem, style, infinite):
    """@return the names of files, and their bars."""
    bars = [diagram_files.random_barcode(rng, style, infinite)]
    while rng.random() < 0.6 and len(bars) < 5:
        bars.append(diagram_files.random_barcode(rng, style, infinite, bars[-1]))
    names = []
    for i, own in enumerate(bars):
        name, content = diagram_files.barcode_file(rng, f"{stem}{i}", own)
        pathlib.Path(folder, name).write_bytes(content)
        names.append(name)
    return names, bars


def random_task(rng, folder):
    """A task for barcodes. @return the task, its options, and the parameters to make similar
    barcodes."""
    style = "vast" if rng.random() < 0.02 else rng.choice(diagram_files.STYLES)
    infinite = rng.choice([0, 0.05, 0.2])
    task = Task(*random_barcodes(rng, folder, "d", style, infinite), rng.choice(KINDS))
    options = kind_options(rng, task) + infinite_options(rng, task)
    task.dims = sorted({d for own in task.bars for d, _, _ in own})
    if task.kind == "euler":
        task.dims = [None]
        if any(".npy" in name for name in task.names) or rng.random() < 0.2:
            options.append(["--format", "barcode"])  # an array could be an image
    elif rng.random() < 0.3:
        task.dims = rng.sample(range(5), rng.choice([1, 1, 2]))
        options.append([rng.choice(["--dims", "--dim"]), ",".join(map(str, task.dims))])
    return task, options + output_options(rng, task), (style, infinite)


def with_senseless(rng, task, options):
    """@return the options, one of which makes no sense, and the name of this option."""
    given = {option[0] for option in options}
    dims = {"--dims", "--dim"}
    taken = given | (dims if given & dims else set())
    wrong = [list(option) for option, kinds in SCOPES.items() if task.kind not in kinds and option[0] not in taken]
    wrong += [[name, rng.choice(values)] for name, values in SENSELESS.items() if name not in taken]
    option = rng.choice(wrong)
    return [*options, option], option[0]
