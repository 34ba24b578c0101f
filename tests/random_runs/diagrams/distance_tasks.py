# SPDX-License-Identifier: MIT
"""Random tasks for ph-distance: barcodes, options, and what the options mean."""
import dataclasses
import math
import pathlib

import diagram_files
import formats

INF = math.inf
# Options with values, and where they apply: the distances, and the tasks (two barcodes, more, a
# matching, groups).
BOTH, ALL = {"bottleneck", "wasserstein"}, {"pair", "many", "matching", "groups"}
SCOPES = {
    "--order": (["1", "2", "3.5"], {"wasserstein"}, ALL), "--ground": (["inf", "2", "1"], {"wasserstein"}, ALL),
    "--directions": (["1", "7"], {"sliced"}, ALL - {"matching"}), "--error": (["0", "0.1"], BOTH, ALL),
    "--at-most": (["0", "3"], BOTH, {"pair", "many"}), "--shuffles": (["9"], None, {"groups"}),
    "--power": (["2"], None, {"groups"}), "--seed": (["3"], None, {"groups"}),
}
SENSELESS = {
    "--order": ["0.5", "inf", "nan", "x"], "--ground": ["0.5", "nan", "two"], "--directions": ["0", "-1", "1.5"],
    "--error": ["-0.1", "inf", "1%"], "--at-most": ["-1", "inf", "nan"], "--dims": ["", "-1", "a", "0,0"],
    "--distance": ["", "hera"], "--shuffles": ["0", "x"], "--power": ["0", "-1", "inf"], "--seed": ["-1", "x"],
    "--output-format": ["npy", "pers"], "--threads": ["0", "-1", "x"],
}


@dataclasses.dataclass
class Task:
    """The results that a task requests."""
    names: list
    bars: list
    aim: str
    distance: str
    order: float
    ground: float = INF
    directions: int = 50
    error: float = 0.0
    at_most: float = INF
    dims: list = None
    labels: list = None
    shuffles: int = 1000
    power: float = 1.0
    seed: int = 0
    form: str = "text"
    output: str = None
    matching: str = None
    matrix: str = None

    def of(self, i, dim):
        return [(b, e) for d, b, e in self.bars[i] if d == dim]


def distance_options(rng, task):
    """@return the options for the distance, each with its value."""
    options = [] if task.distance == "bottleneck" and rng.random() < 0.7 else [["--distance", task.distance]]
    if task.distance == "wasserstein":
        if rng.random() < 0.6:
            task.order = rng.choice([1, 2, 1.5, 3, 4, 8, 30])
            options.append(["--order", repr(task.order)])
        if rng.random() < 0.6:
            task.ground = rng.choice([INF, 2, 1, 1.5, 3, 20])
            options.append(["--ground", formats.number(rng, float(task.ground))])
    if task.distance == "sliced":
        if rng.random() < 0.6:
            task.directions = rng.choice([1, 2, 3, 7, 20])
            options.append(["--directions", str(task.directions)])
    elif (task.distance, task.aim) != ("bottleneck", "matching") and rng.random() < 0.3:
        task.error = rng.choice([0.0, 0.01, 0.3, 1.0, 5.0])
        options.append(["--error", formats.number(rng, task.error)])
    if task.distance != "sliced" and task.aim in ("pair", "many") and rng.random() < 0.25:
        values = diagram_files.finite(task.bars[0]) or [1.0]
        task.at_most = rng.choice([0.0, 1.0, abs(rng.choice(values)), abs(rng.choice(values)) * rng.random()])
        options.append(["--at-most", formats.number(rng, task.at_most)])
    return options


def output_options(rng, task):
    options = []
    if rng.random() < 0.5:
        task.form = rng.choice(["text", "csv", "json", "json"])
    if rng.random() < 0.3:
        task.output = "out." + {"text": "txt"}.get(task.form, task.form)
        options.append([rng.choice(["-o", "--output"]), task.output])
    if task.form != "text" and not task.output or rng.random() < 0.1:
        options.append(["--output-format", task.form])
    if task.aim == "matching":
        task.matching = rng.choice(["m.csv", "m.json"])
        options.append(["--matching", task.matching])
    if len(task.dims) == 1 and rng.random() < 0.3:
        task.matrix = rng.choice(["matrix.csv", "matrix.npy"])
        options.append(["--matrix", task.matrix])
    if rng.random() < 0.6:
        options.append(["--threads", rng.choice("123")])
    if rng.random() < 0.1:
        options.append(["--memory-limit", rng.choice(["256MiB", "1GiB", "100MB"])])
    return options + rng.choice([[], [], [["--quiet"]], [["--verbose"]], [["--progress", "json"]]])


def random_task(rng, folder):
    """@return the task and its options."""
    style = rng.choice(diagram_files.STYLES + ["vast"])
    aim = rng.choice(["pair", "pair", "many", "matching", "groups"])
    count = {"many": rng.randint(3, 5), "groups": rng.randint(4, 7)}.get(aim, 2)
    infinite = 0 if aim == "groups" and rng.random() < 0.9 else rng.choice([0, 0.05, 0.2])
    bars = [diagram_files.random_barcode(rng, style, infinite)]
    while len(bars) < count:
        bars.append(diagram_files.random_barcode(rng, style, infinite, bars[-1]))
    if infinite and rng.random() < 0.5:  # gives all barcodes the same number of infinite bars
        bars = [[bar for bar in own if bar[1] > -INF and bar[2] < INF] + [
            (d, b if b == -INF else diagram_files.number(rng, style),
             e if e == INF else diagram_files.number(rng, style))
            for d, b, e in bars[0] if b == -INF or e == INF] for own in bars]
    files = [diagram_files.barcode_file(rng, f"d{i}", own) for i, own in enumerate(bars)]
    if aim == "many" and rng.random() < 0.1:
        files.append(files[0])
        bars.append(bars[0])
    distance = rng.choice(["bottleneck", "wasserstein"] + ["sliced"] * (aim != "matching"))
    task = Task([name for name, _ in files], bars, aim, distance, INF if distance == "bottleneck" else 1)
    for name, content in files:
        pathlib.Path(folder, name).write_bytes(content)
    options = distance_options(rng, task)
    task.dims = sorted({d for own in bars for d, _, _ in own})
    if rng.random() < 0.4:
        task.dims = rng.sample(range(5), rng.choice([1, 1, 2]))
        options.append([rng.choice(["--dims", "--dim"]), ",".join(map(str, task.dims))])
    if aim == "groups":
        task.labels = [rng.choice("xyz" if count > 5 else "xy") for _ in bars]
        if rng.random() < 0.9:
            task.labels[:4] = "xyxy"
            task.labels = [w if task.labels.count(w) > 1 else "x" for w in task.labels]
            rng.shuffle(task.labels)
        pathlib.Path(folder, "g.txt").write_text(
            "".join(w + rng.choice(["\n", "\r\n", " # a comment\n", "\n\n"]) for w in task.labels), newline="")
        options.append(["--groups", "g.txt"])
        for option, values in ("shuffles", [1, 99, 400]), ("power", [0.5, 2.0, 3.0]), ("seed", [0, 7, 2 ** 40]):
            if rng.random() < 0.5:
                setattr(task, option, rng.choice(values))
                options.append(["--" + option, repr(getattr(task, option))])
    return task, options + output_options(rng, task)


def with_senseless(rng, task, options):
    """@return the options, one of which makes no sense, and the name of this option."""
    given = {option[0] for option in options}
    wrong = [(name, rng.choice(values)) for name, (values, distances, aims) in SCOPES.items()
             if name not in given and (task.aim not in aims or distances and task.distance not in distances)]
    wrong += [(name, rng.choice(values)) for name, values in SENSELESS.items() if name not in given | {"--dim"}
              and not (name == "--dims" and "--dim" in given)]
    name, value = rng.choice(wrong)
    return [*options, [name, value]], name
