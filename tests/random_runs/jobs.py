# SPDX-License-Identifier: MIT
"""Random inputs with random options, and the bars that they must give by definition."""
import dataclasses
import itertools
import math

import formats
import oracle
from voxel_sets import Picture

INF = math.inf


@dataclasses.dataclass
class Job:
    """A job: files, options, and the bars of all dimensions up to `max_dim`."""
    kind: str
    files: list
    options: list
    filtration: dict
    prime: int
    max_dim: int
    tolerance: float = 0.0  # 0 if every double must be exact
    engines: tuple = ("standard", "twist")
    has_parts: bool = False  # true if --part applies
    name_of: object = tuple  # maps the program's name of a cell to the filtration's name
    period: tuple = None  # for images: for each axis, its period in doubled coordinates, or None
    has_cells: bool = True  # true if the filtration has the same cells as the program
    picture: Picture = None  # for images: the data for checking sets of voxels


def coordinate(rng, style):
    if style == "grid":
        return float(rng.randint(-2, 2))
    if style == "dyadic":
        return rng.randint(-2 ** 12, 2 ** 12) / 2 ** rng.randint(0, 6)
    if style == "wide":  # numbers for which sums of squares are not exact
        return rng.choice([-1, 1]) * rng.random() * 10 ** rng.uniform(-3, 3)
    return rng.uniform(-1, 1)


def random_points(rng, most, dim, style):
    points = [[coordinate(rng, style) for _ in range(dim)] for _ in range(rng.randint(1, most))]
    while rng.random() < 0.2:  # repeats some of the points
        points.insert(rng.randrange(len(points) + 1), list(rng.choice(points)))
    return points[:most]


def dimensions(rng, most, default):
    """@return max_dim, and options that set it."""
    if rng.random() < 0.3:
        return default, []
    max_dim = rng.randint(0, most)
    return max_dim, ["--max-dim", str(max_dim)]


def field(rng):
    prime = rng.choice([2, 2, 2, 3, 5, 7, 65521])
    option = rng.choice(["--field", "--modulus"])
    return prime, [option, str(prime)] if prime != 2 or rng.random() < 0.1 else []


def some_threshold(rng, values):
    """A threshold: None, one of the values, or a number between two values."""
    finite = sorted({v for v in values if math.isfinite(v)})
    if rng.random() < 0.6 or not finite:
        return None
    value = rng.choice(finite)
    return value if rng.random() < 0.6 else value + rng.random() * (max(finite) - min(finite)) / 2


def lost_rows(rng, rows):
    """Inserts some rows with a NaN. @return all rows."""
    rows = list(rows)
    for _ in range(rng.randint(1, 3)):
        row = [float(rng.randint(0, 3)) for _ in rows[0]]
        row[rng.randrange(len(row))] = math.nan
        rows.insert(rng.randrange(len(rows) + 1), row)
    return rows


def odd_matrix(rng, matrix, finite):
    """A file that expresses a distance matrix in another way: as correlations, with two entries per
    pair, or with NaN for pairs that are never joined. @return name, content, options."""
    n = len(matrix)
    way = rng.choice(["correlation", "twice"] if finite else ["nan"])
    if way == "correlation":
        rows = [[1 - x for x in row] for row in matrix]
        return *formats.square_file(rng, rows)[:2], ["--format", "distance", "--from-correlation"]
    rows = [list(row) for row in matrix]
    if way == "nan":
        rows = [[math.nan if x == INF else x for x in row] for row in rows]
        return *formats.square_file(rng, rows)[:2], ["--format", "distance", "--nan", "drop"]
    which = rng.choice(["max", "min", "lower"])
    for i, j in itertools.combinations(range(n), 2):
        other = rng.choice([0.0, 0.5, 1.0])
        if which == "max":
            u, v = rng.choice([(i, j), (j, i)])
            rows[u][v] = max(0.0, matrix[i][j] - other)
        elif which == "min":
            u, v = rng.choice([(i, j), (j, i)])
            rows[u][v] = matrix[i][j] + other
        else:
            rows[i][j] = other
    return *formats.square_file(rng, rows)[:2], ["--format", "distance", "--symmetrise", which]


def rips(rng):
    """A job for a Vietoris-Rips complex of points or distances."""
    style = rng.choice(["grid", "grid", "dyadic", "wide", "unit"])
    tolerance = 0.0 if style in ("grid", "dyadic") else 1e-12
    options, files, read = [], [], None
    if rng.random() < 0.6:
        dim = rng.choice([1, 2, 2, 3, 3, 4, 6])
        points = random_points(rng, 9, dim, style)
        metric = rng.choice(["euclidean"] * 4 + ["manhattan", "chebyshev", "minkowski:3", "minkowski:1.5",
                                                 "cosine", "hamming"])
        if metric == "cosine" and any(not any(p) for p in points):
            metric = "chebyshev"
        if metric.startswith("minkowski") or metric == "cosine":
            tolerance = 1e-7 if metric == "cosine" else 1e-9
        rows = points
        windows, step = rng.randint(1, 3), rng.randint(1, 2)
        is_series = rng.random() < 0.1 and len(rows) > (windows - 1) * step
        if is_series:
            points = [sum((rows[i + k * step] for k in range(windows)), [])
                      for i in range(len(rows) - (windows - 1) * step)]
            options += ["--delay", f"{windows},{step}"]
        if metric == "cosine" and any(not any(p) for p in points):
            metric = "euclidean"
        if not is_series and rng.random() < 0.1:
            rows = lost_rows(rng, rows)
            read = [i for i, row in enumerate(rows) if not any(map(math.isnan, row))]
            options += ["--nan", "drop"]
        name, content, more = formats.points_file(rng, rows, is_series or rows is not points)
        options += more
        if metric != "euclidean" or rng.random() < 0.1:
            options += ["--metric", metric]
        d = oracle.distance(metric)
        matrix = [[d(p, q) for q in points] for p in points]
        kind = "rips of points"
    else:
        n = rng.randint(1, 9)
        value = rng.choice([lambda: float(rng.randint(0, 4)), lambda: rng.randint(1, 32) / 16, rng.random])
        hole = rng.choice([0, 0, 0.3])
        matrix = [[0.0] * n for _ in range(n)]
        for i, j in itertools.combinations(range(n), 2):
            matrix[i][j] = matrix[j][i] = INF if rng.random() < hole else value()
        if not any(0 < x < INF for row in matrix for x in row):
            hole = 0
        metric, tolerance = None, 0.0
        if n > 2 and rng.random() < 0.3 and all(x == INF or x <= 2 and x * 16 == int(x * 16)
                                                for row in matrix for x in row):
            finite = all(x < INF for row in matrix for x in row)
            name, content, more = odd_matrix(rng, matrix, finite)
        else:
            name, content, more = formats.distances_file(rng, matrix)
        options += more
        kind = "rips of distances"
    files.append((name, content))
    n = len(matrix)
    chosen = list(range(n))
    plain = "--nan" not in options
    if rng.random() < 0.1:
        count = rng.randint(1, n)
        if tolerance == 0 and "sparse" not in options and options[-1] != "dipha":
            chosen = sorted(oracle.farthest_points(count, lambda i, j: matrix[i][j], n))
            options += ["--subsample", str(count)]
            plain = False
    births, exponent = [0.0] * n, "inf"
    if plain and rng.random() < 0.2:
        births = [rng.choice([0.0, rng.randint(0, 16) / 4]) for _ in range(n)]
        weights = formats.values_file(rng, births)
        files.append(weights)
        options += ["--vertex-weights", weights[0] + (":a" if weights[0].endswith("npz") else "")]
        exponent = rng.choice(["inf", "inf", "1", "2"])
        options += ["--weight-exponent", exponent] if exponent != "inf" else []
        tolerance = max(tolerance, 1e-12 if exponent == "2" else 0)
        plain = False
    elif plain and rng.random() < 0.07 and metric in ("euclidean", "manhattan", "chebyshev"):
        near = rng.randint(1, n)
        births = [2 * math.sqrt(math.fsum(x * x for x in sorted(row)[:near]) / near) for row in matrix]
        exponent = "1"
        options += ["--dtm", str(near)]
        tolerance = max(tolerance, 1e-12)
        plain = False
    elif plain and n > 1 and rng.random() < 0.07 and metric in ("euclidean", "manhattan", "chebyshev"):
        near = rng.randint(0, n - 1)
        births = [sorted(row)[near] for row in matrix]  # each row has the point itself
        options += ["--core", str(near)]
        plain = False
    joined = oracle.weighted_edge(exponent)
    entry = [[joined(matrix[i][j], births[i], births[j]) for j in chosen] for i in chosen]
    births = [births[i] for i in chosen]
    values = [x for i, row in enumerate(entry) for x in row[:i]] + births
    threshold = some_threshold(rng, values) if tolerance == 0 else None
    if threshold is not None and threshold >= 0:
        options += [rng.choice(["--threshold", "--max-scale"]), formats.number(rng, threshold)]
    else:
        threshold = INF
    max_dim, more = dimensions(rng, 3, 1)
    prime, of_field = field(rng)
    filtration = oracle.flag_filtration(births, lambda i, j: entry[i][j], max_dim, threshold)
    engines = ["standard", "twist", "cohomology"]
    engines += ["union-find"] if max_dim == 0 else ["edge-links"] if max_dim <= 3 else []
    if rng.random() < 0.3:
        options += ["--collapse", rng.choice(["on", "off", "auto"])]
    if kind == "rips of points" and metric == "euclidean" and plain and max_dim == 1:
        engines += ["beta-skeleton"]
    has_parts = kind == "rips of points" and metric == "euclidean" and plain and max_dim == 0 and \
        threshold == INF and len(files) == 1
    place = {read[point] if read else point: i for i, point in enumerate(chosen)}
    return Job(kind, files, options + more + of_field, filtration, prime, max_dim, tolerance, tuple(engines),
               has_parts, name_of=lambda points: tuple(sorted(place[i] for i in points)))


def cubical(rng):
    """A job for an image with one to four axes."""
    axes = rng.choice([1, 2, 2, 2, 3, 3, 3, 4])
    most = {1: 20, 2: 6, 3: 4, 4: 3}[axes]
    shape = tuple(rng.randint(1, most) for _ in range(axes))
    if math.prod(shape) > 48:
        shape = shape[:-1] + (1,)
    style = rng.choice([lambda: float(rng.randint(0, 3)), lambda: float(rng.randint(0, 255)),
                        lambda: float(rng.randint(-2, 2)), lambda: rng.randint(-64, 64) / 16, rng.random])
    values = [style() for _ in range(math.prod(shape))]
    if rng.random() < 0.15:
        values = [rng.choice([v, v, INF, -INF]) for v in values]
    absent = rng.random() < 0.15
    if absent:
        values = [math.nan if rng.random() < 0.3 else v for v in values]
    periodic = {k for k in range(axes) if rng.random() < 0.25}
    cells, superlevel = rng.random() < 0.5, rng.random() < 0.3
    name, content, options = formats.image_file(rng, shape, values, periodic)
    options += ["--nan", "drop"] if absent else []
    if cells or rng.random() < 0.2 or "perseus" in options:
        options += ["--construction", "cells" if cells else "vertices"]
    options += ["--superlevel"] if superlevel else []
    threshold = some_threshold(rng, [-v if superlevel else v for v in values if v == v])
    options += ["--threshold=" + formats.number(rng, threshold)] if threshold is not None else []
    max_dim, more = dimensions(rng, axes, axes)
    prime, of_field = field(rng)
    voxels = {at: None if math.isnan(v) else v for at, v in zip(formats.indices(shape), values)}
    limit = INF if threshold is None else threshold
    filtration = oracle.cubical_filtration(shape, voxels, cells, superlevel, periodic, limit)
    picture = Picture(shape, {at: INF if v is None else -v if superlevel else v for at, v in voxels.items()},
                      cells, periodic, limit)
    options += ["--slab-layers", str(rng.randint(1, 3))] if rng.random() < 0.15 else []
    has_parts = "--slab-layers" not in options and (max_dim == 0 or axes <= 2)
    # In DIPHA's format, the last axis comes first.
    turned = slice(None, None, -1 if "dipha" in options else 1)
    return Job(f"image of {axes} axes", [(name, content)], options + more + of_field, filtration, prime,
               max_dim, 0.0, ("standard", "twist", "gradient"), has_parts,
               name_of=lambda cube: tuple(cube[turned]), picture=picture,
               period=tuple(2 * n if k in periodic else None for k, n in enumerate(shape))[turned])


def random_complex(rng, most):
    """Simplices with all their faces, and values such that no face enters after a coface."""
    n = rng.randint(1, most)
    values = {(v,): float(rng.randint(0, 3)) for v in range(n)}
    kept = [(v,) for v in range(n)]
    for size in (2, 3, 4):
        share = rng.uniform(0.2, 0.9)
        for s in itertools.combinations(range(n), size):
            faces = [f for f, _ in oracle.simplex_boundary(s)]
            if all(f in values for f in faces) and rng.random() < share:
                values[s] = max(values[f] for f in faces) + rng.choice([0, 0, 1, 0.25])
                kept.append(s)
    return values


def explicit(rng):
    """A job for simplices with values, or for a boundary matrix."""
    values = random_complex(rng, 6)
    top = max(len(s) for s in values) - 1
    max_dim, more = dimensions(rng, top + 1, top)
    threshold = some_threshold(rng, values.values())
    options = ["--threshold=" + formats.number(rng, threshold)] if threshold is not None else []
    limit = INF if threshold is None else threshold
    if rng.random() < 0.5:
        prime, of_field = field(rng)
        name, content, of_format = formats.simplices_file(rng, values)
        filtration = oracle.simplicial({s: v for s, v in values.items() if v <= limit})
        return Job("simplices", [(name, content)], of_format + options + more + of_field, filtration, prime,
                   max_dim)
    order = sorted(values, key=lambda s: (values[s], len(s), s))
    place = {s: i for i, s in enumerate(order)}
    cells = [(len(s) - 1, sorted(place[f] for f, _ in oracle.simplex_boundary(s))) for s in order]
    numbers = [values[s] for s in order]
    files, of_format, may_lack = formats.boundary_file(rng, cells, numbers)
    if may_lack and rng.random() < 0.5:
        numbers = [float(i) for i in range(len(order))]
        filtration = {s: (numbers[place[s]], len(s) - 1, oracle.simplex_boundary(s)) for s in order
                      if numbers[place[s]] <= limit}
    else:
        if may_lack:
            files.append(formats.values_file(rng, numbers))
            of_format += ["--values", files[1][0] + (":a" if files[1][0].endswith("npz") else "")]
        filtration = oracle.simplicial({s: v for s, v in values.items() if v <= limit})
    return Job("boundary matrix", files, of_format + options + more, filtration, 2, max_dim,
               name_of=lambda row: order[row])


def lower_star(rng):
    """A job for a mesh with values at its vertices."""
    n = rng.randint(3, 8)
    faces = [rng.sample(range(n), 3) for _ in range(rng.randint(1, 10))]
    faces = list({tuple(sorted(f)): f for f in faces}.values())
    heights = [float(rng.randint(0, 4)) for _ in range(n)]
    points = [[float(rng.randint(-3, 3)) for _ in range(3)] for _ in range(n)]
    if rng.random() < 0.5:
        content = f"OFF\n{n} {len(faces)} 0\n" + "".join(" ".join(map(str, p)) + "\n" for p in points)
        files = [("a.off", (content + "".join(f"3 {a} {b} {c}\n" for a, b, c in faces)).encode())]
    else:
        files = [("a.ply", formats.ply(rng, points, faces))]
    files.append(formats.values_file(rng, heights))
    options = ["--values", files[1][0] + (":a" if files[1][0].endswith("npz") else "")]
    values = {}
    for f in faces:
        for size in (1, 2, 3):
            for s in itertools.combinations(sorted(f), size):
                values[s] = max(heights[v] for v in s)
    values |= {(v,): heights[v] for v in range(n)}
    threshold = some_threshold(rng, values.values())
    options += ["--threshold=" + formats.number(rng, threshold)] if threshold is not None else []
    filtration = oracle.simplicial({s: v for s, v in values.items() if threshold is None or v <= threshold})
    max_dim, more = dimensions(rng, 2, 2)
    prime, of_field = field(rng)
    return Job("lower star of a mesh", files, options + more + of_field, filtration, prime, max_dim)


def alpha(rng):
    """A job for an alpha or Delaunay-Čech complex. Its bars are the bars of the Čech complex of all
    balls: of alpha complexes by the nerve theorem, of Delaunay-Čech complexes because the Čech
    complex collapses to them (Bauer & Edelsbrunner 2017)."""
    dim = rng.choice([1, 2, 2, 3])
    style = rng.choice(["grid", "grid", "dyadic", "unit"])
    points = random_points(rng, 7, dim, style)
    name, content, options = formats.points_file(rng, points)
    options = [o for k, o in enumerate(options) if o != "--complex" and (k == 0 or options[k - 1] != "--complex")]
    kind = rng.choice(["alpha", "alpha", "delaunay-cech"])
    options += ["--complex", kind]
    max_dim, more = dimensions(rng, dim - 1, dim - 1)
    prime, of_field = field(rng)
    files = [(name, content)]
    if kind == "alpha" and rng.random() < 0.3:
        weights = [rng.choice([0.0, rng.randint(-4, 8) / 16, rng.random()]) for _ in points]
        files.append(formats.values_file(rng, weights))
        options += ["--weights", files[1][0] + (":a" if files[1][0].endswith("npz") else "")]
        options += rng.choice([[], ["--alpha-values", "squared"]])
        return Job("alpha with weights", files, options + more + of_field,
                   oracle.cech_filtration(points, max_dim, weights), prime, max_dim, 1e-7,
                   ("standard", "twist"), has_cells=False)
    filtration = oracle.cech_filtration(points, max_dim)
    if rng.random() < 0.2:
        options += ["--alpha-values", "squared"]
        filtration = {s: (v * v, d, b) for s, (v, d, b) in filtration.items()}
    return Job(kind, files, options + more + of_field, filtration, prime, max_dim, 1e-7,
               ("standard", "twist"), has_cells=False)


def periodic_alpha(rng):
    """A job for an alpha complex of points on a circle or a torus."""
    dim = rng.choice([1, 2, 2])
    points = random_points(rng, 4 if dim == 1 else 2, dim, "unit")
    # Adds points, because the periodic images of a single point are not in general position: they
    # lie on common circles.
    points += [[rng.random() for _ in range(dim)] for _ in range(dim)]
    points = sorted(map(list, {tuple(p) for p in points}), key=lambda _: rng.random())
    period = [rng.choice([1.0, 1.0, rng.uniform(0.5, 1.5)]) for _ in range(dim)]
    name, content, options = formats.points_file(rng, points)
    options = [o for k, o in enumerate(options) if o != "--complex" and (k == 0 or options[k - 1] != "--complex")]
    options += ["--complex", "alpha", "--period", ",".join(formats.number(rng, length) for length in period)]
    max_dim, more = dimensions(rng, dim, dim)
    prime, of_field = field(rng)
    filtration = oracle.periodic_alpha_filtration(points, period)
    return Job("alpha, periodic", [(name, content)], options + more + of_field, filtration, prime, max_dim,
               1e-7, ("standard", "twist", "cohomology", "gradient"), has_cells=False)


KINDS = {"rips": rips, "cubical": cubical, "explicit": explicit, "lower-star": lower_star, "alpha": alpha,
         "periodic-alpha": periodic_alpha}
