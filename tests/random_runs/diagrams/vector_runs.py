# SPDX-License-Identifier: MIT
"""Compares ph-vectorise, with random options and on random barcodes and images, with vectors by the
definition."""
import csv
import io
import itertools
import json
import math
import pathlib
import re

import diagram_files
import formats
import oracle as barcodes
import vector_oracle as oracle
from distance_results import shortest
from random_runs import damaged
from vector_tasks import Task, output_options, random_barcodes, random_task, some_grid, with_senseless

INF = math.inf


def counted(task, dim):
    """The bars of each input that count, in one dimension or, if `dim` is None, in all dimensions.
    @return these bars, and the number of bars that were left out."""
    left_out, found = 0, []
    for own in task.bars:
        kept = []
        for d, b, e in own:
            if dim is not None and d != dim:
                continue
            if math.isinf(b) or math.isinf(e):
                if task.infinite == "drop":
                    left_out += 1
                    continue
                if task.infinite != "keep":
                    e = min(e, task.infinite)
            if b < e:
                kept.append((b + 0.0, e + 0.0) if dim is not None else (d, b + 0.0, e + 0.0))
        found.append(kept)
    return found, left_out


def expected_refusal(task):
    """@return the permitted exit codes, and words, one of which the message must contain; None if
    no refusal is expected."""
    used = [bar for own in task.bars for bar in own if task.kind == "euler" or bar[0] in task.dims]
    if not task.dims:
        return [65], ["no bars"]
    if any(1e100 < abs(x) < INF for bar in used for x in bar[1:]) or (
            isinstance(task.infinite, float) and abs(task.infinite) > 1e100):
        return [64, 65], ["at most 1e+100", "finite", "--count", "--infinite"]
    endless = [bar for bar in used if math.isinf(bar[1]) or math.isinf(bar[2])]
    if endless and task.infinite == "error":
        return [65], ["expected finite bars", "--count"]
    if isinstance(task.infinite, float) and any(b == -INF or b > task.infinite for _, b, _ in endless):
        return [64, 65], ["--infinite", "--count"]
    if task.infinite == "keep" and task.kind == "landscape" and any(b == -INF for _, b, _ in endless):
        return [65], ["finite birth"]
    if task.kind == "atol":
        of_dims = [{bar for own in counted(task, dim)[0] for bar in own} for dim in task.dims]
        if any(len(points) < task.count for points in of_dims):
            return [65], ["--count"]
        for points in of_dims:
            far = max(abs(x) for bar in points for x in bar)
            if any(math.dist(p, q) < far * 1e-150 for p, q in itertools.combinations(points, 2)):
                return [0, 64], ["finite widths above 0"]  # the square of so small a distance is 0
    longest = max((e - b for _, b, e in used if e - b < INF), default=0.0)
    if task.kind == "image" and longest > 0 and task.power * math.log10(longest) > 300:
        return [0, 65], ["expected a finite weight"]  # the bar may be outside the pixels
    if task.kind == "image" and any(0 < e - b < 1e-305 for _, b, e in used):
        return [0, 64], ["persistence_image: "]  # fitted values have few digits or none
    return None


# Fitted values by the definition.

def around(x, width):
    """A range around a number, wide enough to contain several doubles."""
    half = max(width / 2, abs(x) * 2 ** -40)
    return x - half, x + half


def ends_of(diagrams):
    """The range from the least to the largest finite birth or death."""
    values = [x for own in diagrams for bar in own for x in bar if math.isfinite(x)]
    if not values:
        return 0.0, 1.0
    low, high = min(values), max(values)
    return around(low, 1.0) if low == high else (low, high)


def changes(bars):
    """The values at which an Euler curve changes, each as a bar of length 0."""
    at = {}
    for dim, birth, death in bars:
        for x, sign in ((birth, 1), (death, -1)):
            at[x] = at.get(x, 0) + sign * (-1) ** dim
    return [(x, x) for x, change in at.items() if change]


def fitted_grid(task, diagrams):
    low, high, count = task.grid or [None, None, 100]
    if low is None and task.kind == "euler":
        diagrams = map(changes, diagrams)
    return [*(ends_of(diagrams) if low is None else (low, high)), count]


def fitted_frame(task, diagrams):
    """The fitted frame of an image. @return the ranges of births and lengths, and sigma."""
    bars = [bar for own in diagrams for bar in own]
    births, across = (list(g or [None, None, None]) for g in (task.grid, task.across))
    births[2] = births[2] or 20
    across[2] = across[2] or births[2]
    height = max((e - b for b, e in bars), default=1.0)
    if births[0] is None:
        low, high = min((b for b, _ in bars), default=0.0), max((b for b, _ in bars), default=0.0)
        births[:2] = [0.0, 1.0] if not bars else around(low, height) if low == high else [low, high]
    if across[0] is None:
        across[:2] = [0.0, height]
    longer = max(births[1] - births[0], across[1] - across[0])
    return births, across, task.sigma or longer / 20


# Vectors, each with the errors that are permitted.

def block_of(task, bars, dim, fit):
    """@param fit the grid or other fitted values. @return the names of the columns, the numbers,
    and their permitted errors."""
    h = "" if dim is None else f"H{dim}_"
    kind, far = task.kind, max((abs(x) for bar in bars for x in bar[-2:] if math.isfinite(x)), default=0.0)
    if kind == "statistics":
        return [h + name for name in oracle.STATISTICS], oracle.statistics(bars), \
            [4e-14 * far + 1e-307] * 36 + [0, 1e-12]
    if kind == "entropy":
        return [h + "entropy"], [oracle.entropy(bars, task.normalised)], [1e-13]
    if kind == "lengths":
        return [f"{h}length{k}" for k in range(task.count)], oracle.lengths(bars, task.count), [0] * task.count
    if kind == "atol":
        numbers = oracle.atol(bars, fit["centres"], fit["widths"], fit["contrast"])
        return [f"{h}centre{k}" for k in range(len(numbers))], numbers, [1e-12 * len(bars)] * len(numbers)
    if kind == "image":
        births, across, sigma = fit
        numbers, total = oracle.image(bars, births, across, sigma, task.power)
        # The distance of a bar from the border of a pixel is affected by rounding.
        rounded = 4 * math.ulp(max(far, *map(abs, births[:2] + across[:2]))) / sigma
        names = [f"{h}p{j}_b{i}" for j, i in itertools.product(range(across[2]), range(births[2]))]
        return names, numbers, [max(total * (2e-14 + rounded), 1e-307)] * len(numbers)
    at = oracle.grid(*fit)
    count = len(at)
    if kind == "landscape":
        return [f"{h}layer{k}_{i}" for k in range(task.layers) for i in range(count)], \
            oracle.landscape(bars, at, task.layers), [0] * (count * task.layers)
    numbers, slack = {"betti": lambda: (oracle.betti(bars, at), 0), "euler": lambda: (oracle.euler(bars, at), 0),
                      "life-entropy": lambda: (oracle.life_entropy(bars, at), 1e-13),
                      "silhouette": lambda: (oracle.silhouette(bars, at, task.power),
                                             1e-14 * max(far, *map(abs, at)) + 1e-307)
                      }[kind]()
    return [f"{h}{kind.replace('-', '_')}{i}" for i in range(count)], numbers, [slack] * count


def fit_of(task, diagrams, block):
    """The fitted values by the definition. @param block the block in the file of --fit, for values
    that are learned from a random start."""
    if task.kind == "image":
        return fitted_frame(task, diagrams)
    if task.kind == "atol":
        return block
    return fitted_grid(task, diagrams)


def compare_fit(program, task, fit, block, dim, diagrams):
    """Compares the output of --fit for a dimension with the definition."""
    def same(name, found, expected):
        if not all(a == b or math.isclose(a, b, rel_tol=1e-15) for a, b in zip(found, expected)):
            program.differ(f"H{dim}: found {name} {found} in {task.fit}, expected {expected}")
    if block.get("dim") != dim:
        program.differ(f"found a block of {block.get('dim')}, expected {dim}")
    if task.kind == "image":
        for name, expected in zip(("births", "lengths"), fit):
            same(name, list(block[name].values()), expected)
        same("sigma", [block["sigma"]], [fit[2]])
    elif task.kind == "atol":
        points = [bar for own in diagrams for bar in own]
        far = max(abs(x) for bar in points for x in bar)
        centres = [tuple(c) for c in block["centres"]]
        if len(centres) != task.count or centres != sorted(centres) or block["contrast"] != task.contrast:
            program.differ(f"found other centres: {block}")
        near = min((math.dist(p, q) for p, q in itertools.combinations(set(points), 2)), default=far)
        if near < far * 1e-150:
            return  # the square of so small a distance is 0
        if not oracle.are_means(points, centres, 1e-12 * far):
            program.differ(f"found centres that are no means: {block}, points {points}")
        widths = oracle.widths(points, centres)
        if not all(math.isclose(w, x, rel_tol=1e-9, abs_tol=1e-14 * far) for w, x in zip(block["widths"], widths)):
            program.differ(f"found widths {block['widths']}, expected {widths}")
    elif "grid" in block:
        same("grid", list(block["grid"].values()), fit)


# Tables read from the output.

def read_table(program, task, folder):
    """@return the names of the columns (None for an array), and the rows of numbers."""
    content = pathlib.Path(folder, task.output).read_bytes() if task.output else program.run.stdout
    try:
        if task.form == "npy":
            (rows, columns), values = diagram_files.read_npy(content)
            return None, [list(values[i * columns:(i + 1) * columns]) for i in range(rows)]
        header, *rows = csv.reader(io.StringIO(content.decode()))
        if header[0] != "input" or [row[0] for row in rows] != task.names:
            program.differ(f"found other names of inputs: {header[0]}, {[row[0] for row in rows]}")
        return header[1:], [[shortest(x) for x in row[1:]] for row in rows]
    except Exception as error:  # noqa: BLE001
        program.differ(f"cannot read it back: {error!r}: {content[:300]!r}")


def compare(program, task, folder, fits=None):
    """Compares the outputs of a run with the definitions. @param fits the fitted values of an
    earlier run, by dimension. @return the fitted values, by dimension."""
    names, rows = read_table(program, task, folder)
    document = json.loads(pathlib.Path(folder, task.fit).read_text()) if task.fit else None
    blocks = document["blocks"] if document else [None] * len(task.dims)
    expected_names, expected, slacks, found, all_left_out = [], [[] for _ in task.bars], [], {}, 0
    if len(blocks) != len(task.dims):
        program.differ(f"found {len(blocks)} blocks, expected {len(task.dims)}")
    for dim, block in zip(task.dims, blocks):
        diagrams, left_out = counted(task, dim)
        all_left_out += left_out
        fit = fits[dim] if fits else fit_of(task, diagrams, block)
        if document:
            compare_fit(program, task, fit, block, dim, diagrams)
        found[dim] = fit
        of_dim = []
        for own, numbers in zip(diagrams, expected):
            block_names, values, slack = block_of(task, own, dim, fit)
            numbers += values
            of_dim.append(slack)
        expected_names += block_names
        slacks.append(of_dim)
    if names is not None and names != expected_names:
        program.differ(f"found columns {names}, expected {expected_names}")
    for i, (row, numbers) in enumerate(zip(rows, expected)):
        slack = [x for of_dim in slacks for x in of_dim[i]]
        if len(row) != len(numbers):
            program.differ(f"found {len(row)} numbers, expected {len(numbers)}")
        for k, (x, y, s) in enumerate(zip(row, numbers, slack)):
            if not (x == y or s > 0 and abs(x - y) <= s + 1e-12 * abs(y) + 1e-307):
                program.differ(f"{task.names[i]}, {expected_names[k]}: found {x!r}, expected {y!r}; "
                               f"fitted: {found}")
    if len(rows) != len(task.bars):
        program.differ(f"found {len(rows)} rows, expected {len(task.bars)}")
    if "--quiet" not in program.command:
        said = re.search(r"left out: (\d+) bar", program.said)
        if int(said[1] if said else 0) != all_left_out:
            program.differ(f"found {said and said[0]!r}, expected {all_left_out} bars left out")
    elif program.said:
        program.differ("found a message with --quiet")
    return found


# Image tasks.

def image_task(rng, folder):
    """A task for Euler curves of images. The expected values are found by counting cells. @return
    the task and its options; the bars of the task stand for cells."""
    axes = rng.choice([1, 2, 2, 3])
    task = Task([], [], "euler", [None], infinite="keep")
    options = [["--kind", "euler"], ["--format", "image"]]
    task.construction = rng.choice(["vertices", "cells"])
    if task.construction == "cells" or rng.random() < 0.2:
        options.append(["--construction", task.construction])
    task.superlevel = rng.random() < 0.4
    options += [["--superlevel"]] * task.superlevel
    periodic = [k for k in range(axes) if rng.random() < 0.2]
    if periodic:
        options.append(["--periodic", "all" if len(periodic) == axes else ",".join(map(str, periodic))])
    drop = rng.random() < 0.3
    options += [["--nan", "drop"]] * drop
    style = rng.choice(["grid", "grid", "unit", "dyadic"])
    for i in range(rng.choice([1, 1, 2])):
        shape = tuple(rng.randint(1, (12, 5, 3)[axes - 1]) for _ in range(axes))
        values = [diagram_files.number(rng, style) for _ in range(math.prod(shape))]
        values = [math.nan if drop and rng.random() < 0.1 else INF if rng.random() < 0.02 else v for v in values]
        name = f"a{i}.npy"
        pathlib.Path(folder, name).write_bytes(formats.npy(rng, shape, values))
        voxels = {at: None if math.isnan(v) else v for at, v in zip(formats.indices(shape), values)}
        filtration = barcodes.cubical_filtration(shape, voxels, task.construction == "cells", task.superlevel, periodic)
        # Each cell stands for a bar that never dies.
        task.names.append(name)
        task.bars.append([(dim, value, INF) for value, dim, _ in filtration.values()])
    task.grid, text = some_grid(rng, task, False)
    if task.grid[0] is None:
        task.grid, text = [-2.5, 4.0, 14], "-2.5,4,14"
    options.append(["--grid", text])
    return task, options + output_options(rng, task)


# Runs of the program.

class Names:
    def __init__(self, task):
        self.name = task.output or task.fit


def refused(program, task, folder, words):
    program.expect_refusal(program.run.returncode, Names(task))
    for name in (task.output, task.fit):
        if name and pathlib.Path(folder, name).exists():
            program.differ(f"found {name} after a refusal")
    said = [line for line in program.said.splitlines() if line.startswith("ph-vectorise: ") and ": read " not in line]
    if words and not any(word in said[-1] for word in words):
        program.differ(f"found a message that does not name any of {words}")


def fitted_run(rng, program, task, folder, fits, like):
    """Applies the fitted values to other barcodes, and checks the vectors."""
    names, bars = random_barcodes(rng, folder, "e", *like)
    if task.output:
        pathlib.Path(folder, task.output).unlink()
    other = Task(names, bars, **{name: getattr(task, name) for name in (
        "kind", "dims", "infinite", "count", "layers", "power", "normalised", "contrast")})
    options = [option for option in output_options(rng, other) if option[0] != "--fit"]
    other.fit = None
    if task.kind == "euler":
        options.append(["--format", "barcode"])
    if rng.random() < 0.1:
        options, name = [*options, ["--kind", task.kind]], "--kind"
        if program([*[[n] for n in names], ["--fitted", task.fit], *options]) != 64:
            program.differ("found no refusal of --kind beside --fitted")
        return refused(program, other, folder, [name])
    code = program([*[[name] for name in names], ["--fitted", task.fit], *options])
    expected = expected_refusal(other) if task.kind != "atol" else expected_refusal(
        Task(names, bars, "lengths", task.dims, task.infinite))
    if expected:
        if code not in expected[0]:
            program.differ(f"found no refusal with {expected}")
        return code and refused(program, other, folder, expected[1])
    if code != 0:
        program.differ("found a refusal, expected vectors of what was fitted")
    return compare(program, other, folder, fits)


def one_run(rng, program, folder):
    """Runs the program once. @return the kind of run, for the counts."""
    of_images = rng.random() < 0.1
    if of_images:
        task, options = image_task(rng, folder)
    else:
        task, options, like = random_task(rng, folder)
    kind = task.kind + " of images" * of_images
    inputs = [[name] for name in task.names]
    if rng.random() < 0.1:
        path = pathlib.Path(folder, rng.choice(task.names))
        path.write_bytes(damaged(rng, path.read_bytes()))
        code = program([*inputs, *options])
        if code not in (0, 64, 65, 66, 75):
            program.differ("found another end than vectors or a refusal")
        if code:
            refused(program, task, folder, [])
        else:
            read_table(program, task, folder)
        return f"{kind}, damaged"
    if rng.random() < 0.08 and not of_images:
        options, name = with_senseless(rng, task, options)
        if program([*inputs, *options]) != 64:
            program.differ(f"found no refusal of {name}")
        refused(program, task, folder, [name])
        return f"{kind}, refused"
    rng.shuffle(options)
    at = rng.randint(0, len(options))
    code = program([*options[:at], *inputs, *options[at:]])
    expected = expected_refusal(task)
    if expected:
        if code not in expected[0]:
            program.differ(f"found no refusal with {expected}")
        if code:
            refused(program, task, folder, expected[1])
        return f"{kind}, refused"
    if code != 0:
        program.differ("found a refusal, expected vectors")
    fits = compare(program, task, folder)
    if task.fit and not of_images and rng.random() < 0.6:
        fitted_run(rng, program, task, folder, fits, like)
        return f"{kind}, fitted"
    return kind
