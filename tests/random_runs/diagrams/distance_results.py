# SPDX-License-Identifier: MIT
"""Reads the output of ph-distance according to the definitions of its formats."""
import csv
import io
import itertools
import json
import math
import pathlib
import re

import diagram_files

INF = math.inf
NUMBER = r"(?:\d[\d.e+-]*|inf)"


def digits(text):
    return len(text.split("e")[0].replace(".", "").lstrip("-0").rstrip("0"))


def shortest(text):
    """Parses a number, which must be the shortest text that gives this number. @throws
    ValueError"""
    value = float(text)
    if math.isfinite(value) and digits(text) > digits(repr(value)):
        raise ValueError(f"found {text}, expected {value!r}")
    return value


def written(value):
    return INF if value is None else value


def cell(program, ok, what):
    if not ok:
        program.differ(f"found another {what}")


def check_names(program, task, row):
    """Checks that a row states the distance, order, norm and directions. @param row of a CSV
    file."""
    ground = "" if task.distance == "sliced" else repr(float(task.ground))
    directions = str(task.directions) if task.distance == "sliced" else ""
    cell(program, row["distance"] == task.distance and float(row["order"]) == task.order, "distance")
    cell(program, row["ground"] == ground if not ground else float(row["ground"]) == float(ground), "ground norm")
    cell(program, row.get("directions", directions) == directions, "number of directions")


def heading(task):
    order = "inf" if task.order == INF else f"{task.order:g}"
    ground = "inf" if task.ground == INF else f"{task.ground:g}"
    error = f", relative error {task.error:g}" if task.error else ""
    return {"bottleneck": f"bottleneck distance (order inf, ground norm inf{error})",
            "wasserstein": f"Wasserstein distance (order {order}, ground norm {ground}{error})",
            "sliced": f"sliced Wasserstein distance (order 1, {task.directions} direction"}[task.distance]


def read_text(program, task, text):
    first, *lines = text.splitlines()
    cell(program, first.startswith(heading(task)) and " of " in first, f"heading {first!r}")
    found = {}
    places = itertools.cycle(itertools.combinations(range(len(task.names)), 2))
    if lines == ["no bars"]:
        return found
    for line, (i, j) in zip(lines, places):
        match = re.fullmatch(rf"H(\d+)  (?:({NUMBER})(?: \(at least ({NUMBER})\))?|"
                             rf"more than ({NUMBER}): from ({NUMBER}) to ({NUMBER})|inf: .*?)((?:  \S+)*)", line)
        cell(program, match, f"line {line!r}")
        dim, value, lower, limit, low, high, names = match.groups()
        cell(program, names.split() == ([task.names[i], task.names[j]] if len(task.names) > 2 else []), "pair of files")
        if limit:
            cell(program, float(limit) == task.at_most, "limit")
            value, lower = high, low
        value = value or "inf"
        # In text output, no lower bound is stated for exact distances.
        unsaid = task.distance == "wasserstein" and task.error == 0 and not lower and value != "inf"
        found[i, j, int(dim)] = shortest(value), None if unsaid else shortest(lower or value)
    return found


def read_distances(program, task, content):
    """@return the value and lower bound of each distance (None if not stated), by the indices of
    the two files and the dimension."""
    text = content.decode()
    if task.form == "text":
        return read_text(program, task, text)
    pairs = list(itertools.combinations(range(len(task.names)), 2))
    if task.form == "csv":
        rows = list(csv.DictReader(io.StringIO(text)))
        found = {}
        for row, (i, j) in zip(rows, itertools.cycle(pairs)):
            check_names(program, task, row)
            cell(program, (row["a"], row["b"]) == (task.names[i], task.names[j]), "pair of files")
            found[i, j, int(row["dim"])] = shortest(row["value"]), shortest(row["lower"])
        return found
    document = json.loads(text)
    head = {"format": "ph-distance", "version": 1, "distance": task.distance, "inputs": task.names,
            "order": None if task.order == INF else task.order}
    if task.distance == "sliced":
        head["directions"] = task.directions
    else:
        head |= {"ground": None if task.ground == INF else task.ground, "relative_error": task.error}
    if task.at_most < INF:
        head["at_most"] = task.at_most
    cell(program, all(document.get(name, 0) == value for name, value in head.items()), f"head, not {head}")
    return {(d["a"], d["b"], d["dim"]): (written(d["value"]), written(d["lower"])) for d in document["distances"]}


def read_tests(program, task, content):
    """@return the p-value and loss for each dimension."""
    text = content.decode()
    if task.form == "csv":
        rows = list(csv.DictReader(io.StringIO(text)))
        for row in rows:
            check_names(program, task, row)
            cell(program, (float(row["power"]), row["shuffles"], row["seed"]) == (
                task.power, str(task.shuffles), str(task.seed)), "power, number of shuffles or seed")
        return {int(row["dim"]): (shortest(row["p"]), shortest(row["loss"])) for row in rows}
    if task.form == "json":
        document = json.loads(text)
        cell(program, (document["groups"], document["shuffles"], document["power"], document["seed"]) == (
            task.labels, task.shuffles, task.power, task.seed), "head")
        return {test["dim"]: (test["p"], test["loss"]) for test in document["tests"]}
    found, (first, *lines) = {}, text.splitlines()
    groups = ", ".join(f"{word} {task.labels.count(word)}" for word in dict.fromkeys(task.labels))
    cell(program, first == f"{heading(task)} of {len(task.names)} barcodes: {groups}" or task.distance == "sliced",
         f"heading {first!r}")
    for line in lines:
        match = re.fullmatch(rf"H(\d+)  p ({NUMBER}), loss ({NUMBER}) \({task.shuffles} shuffles?, "
                             rf"power {task.power:g}, seed {task.seed}\)", line)
        cell(program, match or line == "no bars", f"line {line!r}")
        if match:
            found[int(match[1])] = shortest(match[2]), shortest(match[3])
    return found


def read_matrix(program, task, folder):
    """@return the square matrix of distances, row by row."""
    content = pathlib.Path(folder, task.matrix).read_bytes()
    count = len(task.names)
    if task.matrix.endswith(".npy"):
        shape, values = diagram_files.read_npy(content)
        cell(program, shape == (count, count), "shape of the matrix")
        square = [values[i * count:(i + 1) * count] for i in range(count)]
    else:
        header, *rows = csv.reader(io.StringIO(content.decode()))
        names = [row[0] for row in rows]
        cell(program, header == ["input", *task.names] and names == task.names, "list of names in the matrix")
        square = [[shortest(x) for x in row[1:]] for row in rows]
    cell(program, all(square[i][i] == 0 and square[i][j] == square[j][i] for i in range(count) for j in range(count)),
         "matrix, which is not symmetric")
    return square


def read_matching(program, task, folder):
    """@return rows (dim, number of the bar of a, number of the bar of b, both ends of the bar of a,
    both ends of the bar of b, cost). A number is None for a place on the diagonal."""
    text = pathlib.Path(folder, task.matching).read_text(encoding="utf-8")
    if task.matching.endswith(".csv"):
        found = []
        for row in csv.DictReader(io.StringIO(text)):
            check_names(program, task, row)
            found.append((int(row["dim"]), *(None if row[s] == "diagonal" else int(row[s]) for s in "ab"),
                          *((shortest(row[s + "_birth"]), shortest(row[s + "_death"])) for s in "ab"),
                          shortest(row["cost"])))
        return found

    def side(x):
        return (-INF if x["birth"] == "-inf" else x["birth"], written(x["death"]))
    document = json.loads(text)
    cell(program, (document["format"], document["distance"], document["inputs"], document["relative_error"]) == (
        "ph-distance matching", task.distance, task.names, task.error), "head of the matching")
    return [(p["dim"], *(None if p[s]["bar"] == "diagonal" else p[s]["bar"] for s in "ab"),
             side(p["a"]), side(p["b"]), written(p["cost"])) for p in document["pairs"]]
