# SPDX-License-Identifier: MIT
"""Barcodes by the definition: filtrations are listed cell by cell, and columns are reduced from
left to right.

Reads no files, and shares nothing with libph. A filtration is a dictionary from cells to (value,
dimension, boundary), where a boundary is a list of pairs (cell, coefficient)."""
import itertools
import math

INF = math.inf


class Columns:
    """A boundary matrix whose columns have been reduced."""

    def __init__(self, filtration):
        self.filtration = filtration
        self.order = sorted(filtration, key=lambda c: (filtration[c][0], filtration[c][1], c))
        self.place = {cell: i for i, cell in enumerate(self.order)}
        self.by_lowest = {}  # columns by the position of their youngest cell
        self.killer = {}  # positions of these columns

    def value_at(self, low):
        """The value of the cell whose column has `low` as its youngest cell."""
        return self.filtration[self.order[self.killer[low]]][0]


def reduced_columns(filtration, prime=2):
    result = Columns(filtration)
    place, columns = result.place, result.by_lowest
    for i, cell in enumerate(result.order):
        _, _, boundary = filtration[cell]
        column = {}
        for face, coefficient in boundary:
            number = (column.get(place[face], 0) + coefficient) % prime
            column[place[face]] = number
            if number == 0:
                del column[place[face]]
        while column:
            low = max(column)
            if low not in columns:
                break
            other = columns[low]
            factor = column[low] * pow(other[low], -1, prime) % prime
            for k, coefficient in other.items():
                number = (column.get(k, 0) - factor * coefficient) % prime
                if number:
                    column[k] = number
                else:
                    column.pop(k, None)
        if column:
            low = max(column)
            columns[low] = column
            result.killer[low] = i
    return result


def barcode(filtration, prime=2):
    """All bars of positive length as a sorted list of (dim, birth, death)."""
    columns = reduced_columns(filtration, prime)
    paired, bars = set(), []
    for low, high in columns.killer.items():
        paired |= {low, high}
        birth, dim, _ = filtration[columns.order[low]]
        death = filtration[columns.order[high]][0]
        if birth < death:
            bars.append((dim, birth, death))
    bars += [(filtration[c][1], filtration[c][0], INF) for i, c in enumerate(columns.order) if i not in paired]
    return sorted((d, b + 0.0, e + 0.0) for d, b, e in bars)


def simplex_boundary(simplex):
    if len(simplex) == 1:
        return ()
    return tuple((simplex[:i] + simplex[i + 1:], (-1) ** i) for i in range(len(simplex)))


def simplicial(values):
    """A filtration of simplices, which are ascending tuples of vertices, with their values.
    Simplices with the value infinity never enter."""
    return {s: (v, len(s) - 1, simplex_boundary(s)) for s, v in values.items() if v < INF}


def flag_filtration(births, edge, max_dim, threshold=INF):
    """A Vietoris-Rips filtration: a simplex enters with the last of its edges. @param edge(i, j)
    the value at which i and j are joined. @param max_dim of homology."""
    n = len(births)
    values = {(i,): births[i] for i in range(n) if births[i] <= threshold}
    last = dict(values)
    for _ in range(max_dim + 1):
        longer = {}
        for simplex, value in last.items():
            for j in range(simplex[-1] + 1, n):
                if (j,) not in values:
                    continue
                entry = max([value, *(edge(i, j) for i in simplex)])
                if entry <= threshold and entry < INF:
                    longer[simplex + (j,)] = entry
        values |= longer
        last = longer
    return simplicial(values)


def cubical_filtration(shape, voxels, cells=False, superlevel=False, periodic=(), threshold=INF):
    """A filtration of cubes, which are named by their doubled coordinates. @param voxels values by
    coordinates; None if absent. @param cells true if voxels are top-dimensional cubes."""
    def voxel(at):
        value = voxels[at]
        if value is None:
            return INF
        return -value if superlevel else value

    def beside(x, axis):
        both = [x // 2] if x % 2 == (1 if cells else 0) else [(x + 1) // 2 - 1, (x + 1) // 2]
        if axis in periodic:
            return [i % shape[axis] for i in both]
        return [i for i in both if 0 <= i < shape[axis]]

    lengths = [2 * n if k in periodic else 2 * n + (1 if cells else -1) for k, n in enumerate(shape)]
    found = {}
    for cube in itertools.product(*map(range, lengths)):
        value = (min if cells else max)(
            voxel(at) for at in itertools.product(*(beside(x, k) for k, x in enumerate(cube))))
        if value == INF or value > threshold:
            continue
        boundary, sign = [], 1
        for k, x in enumerate(cube):
            if x % 2:
                boundary.append((cube[:k] + ((x + 1) % lengths[k],) + cube[k + 1:], sign))
                boundary.append((cube[:k] + (x - 1,) + cube[k + 1:], -sign))
                sign = -sign
        found[cube] = (value, sum(x % 2 for x in cube), tuple(boundary))
    return found


def solve(matrix, right):
    """Gaussian elimination with pivots. None if the matrix is singular or nearly singular."""
    n = len(right)
    rows = [list(row) + [r] for row, r in zip(matrix, right)]
    scale = max((abs(x) for row in matrix for x in row), default=0)
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        if abs(rows[pivot][k]) <= 1e-12 * scale:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(n):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    return [rows[k][n] / rows[k][k] for k in range(n)]


def smallest_ball(points, weights=None):
    """The squared radius of the smallest ball around some points. Tries the smallest sphere through
    each subset of at most dim + 1 points, and returns the least one that encloses all points.
    Weights are subtracted from squared distances."""
    best = INF
    weight = dict(enumerate(weights or [0.0] * len(points)))
    dim = len(points[0])
    size = max((abs(x) for p in points for x in p), default=0)
    for count in range(1, min(dim + 1, len(points)) + 1):
        for first, *others in itertools.combinations(range(len(points)), count):
            origin = points[first]
            edges = [[x - y for x, y in zip(points[i], origin)] for i in others]
            gram = [[2 * sum(a * b for a, b in zip(e, f)) for f in edges] for e in edges]
            at = solve(gram, [sum(a * a for a in e) - weight[i] + weight[first] for e, i in zip(edges, others)])
            if at is None:
                continue
            centre = [origin[k] + sum(t * e[k] for t, e in zip(at, edges)) for k in range(dim)]
            square = sum((x - y) ** 2 for x, y in zip(centre, origin)) - weight[first]
            if square < best and all(sum((x - y) ** 2 for x, y in zip(centre, p)) - weight[i] <=
                                     square + 1e-11 * (abs(square) + size * size) for i, p in enumerate(points)):
                best = square
    return best


def cech_filtration(points, max_dim, weights=None):
    """The Čech filtration: a simplex enters with the radius of the smallest ball around it. By the
    nerve theorem, the complex has the same homology as the union of the balls around the points, as
    does the alpha complex.
    @param weights squared radii at the start; with weights, values are squared radii."""
    values = {}
    for count in range(1, max_dim + 3):
        for simplex in itertools.combinations(range(len(points)), count):
            value = smallest_ball([points[i] for i in simplex], [weights[i] for i in simplex] if weights else None)
            faces = (values[f] for f, _ in simplex_boundary(simplex))
            values[simplex] = max([value if weights else math.sqrt(value), *faces])
    return simplicial(values)


def circumscribed(points):
    """The smallest sphere through points, as its centre and squared radius. None if the points are
    affinely dependent, or nearly so."""
    edges = [[x - y for x, y in zip(p, points[0])] for p in points[1:]]
    at = solve([[2 * sum(a * b for a, b in zip(e, f)) for f in edges] for e in edges],
               [sum(a * a for a in e) for e in edges])
    if at is None:
        return None
    to = [sum(t * e[k] for t, e in zip(at, edges)) for k in range(len(points[0]))]
    return [x + y for x, y in zip(points[0], to)], sum(x * x for x in to)


def periodic_alpha_filtration(points, period):
    """The alpha complex of points in general position on a torus, cell by cell. An image is a pair
    (point, periods). A cell is a set of images on an empty sphere, up to translation. With few
    points, it is not a simplicial complex. The images of a cell have an order that translations do
    not change."""
    dim = len(period)
    points = [[x % length for x, length in zip(point, period)] for point in points]
    reach = math.sqrt(sum(length * length for length in period))  # larger than every empty ball
    periods = [range(-math.ceil(reach / length) - 1, math.ceil(reach / length) + 2) for length in period]
    images = {(i, t): [x + k * length for x, k, length in zip(point, t, period)]
              for i, point in enumerate(points) for t in itertools.product(*periods)}

    def home(cell):
        first = cell[0][1]
        return tuple((i, tuple(k - k0 for k, k0 in zip(t, first))) for i, t in cell)

    def own_value(cell):
        """The squared radius of the cell's smallest sphere; None if a point lies inside."""
        sphere = circumscribed([images[image] for image in cell])
        if sphere is None or any(image not in cell and math.dist(sphere[0], x) ** 2 < sphere[1]
                                 for image, x in images.items()):
            return None
        return sphere[1]

    cells = {}
    for i, point in enumerate(points):
        first = (i, (0,) * dim)
        near = sorted(image for image, x in images.items() if image > first and math.dist(point, x) <= reach)
        for others in itertools.combinations(near, dim):
            value = own_value((first, *others))
            if value is not None:
                cells[(first, *others)] = (value, dim, ())
    for size in range(dim, 0, -1):
        above = [cell for cell in cells if len(cell) == size + 1]
        latest = {}
        for cell in above:
            facets = tuple((home(cell[:k] + cell[k + 1:]), (-1) ** k) for k in range(size + 1))
            cells[cell] = (cells[cell][0], size, facets)
            for facet, _ in facets:
                latest[facet] = min(latest.get(facet, INF), cells[cell][0])
        for facet, value in latest.items():
            own = own_value(facet) if size > 1 else 0.0
            cells[facet] = (value if own is None else own, size - 1, ())
    return {cell: (math.sqrt(value), of, facets) for cell, (value, of, facets) in cells.items()}


def distance(metric):
    """A metric, by its name in the options. For coordinates that are small multiples of a power of
    two, sums are exact, and a root is rounded once."""
    def euclidean(a, b):
        return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)))

    def cosine(a, b):
        product = sum(x * y for x, y in zip(a, b))
        return 1 - product / math.sqrt(sum(x * x for x in a) * sum(y * y for y in b))

    if metric.startswith("minkowski:"):
        power = float(metric.split(":")[1])
        return lambda a, b: sum(abs(x - y) ** power for x, y in zip(a, b)) ** (1 / power)
    return {"euclidean": euclidean, "cosine": cosine,
            "manhattan": lambda a, b: sum(abs(x - y) for x, y in zip(a, b)),
            "chebyshev": lambda a, b: max(abs(x - y) for x, y in zip(a, b)),
            "hamming": lambda a, b: float(sum(x != y for x, y in zip(a, b)))}[metric]


def weighted_edge(exponent):
    """The value at which two balls meet (Anai et al. 2019, with all values doubled). The balls are
    born at f and g, and d is the distance between their centres."""
    def joined(d, f, g):
        late = max(f, g)
        if exponent == "inf" or d == INF:
            return max(late, d)
        if exponent == "1":
            return max(late, d + (f + g) / 2)
        if 4 * d * d > abs(f * f - g * g):
            return math.sqrt(d * d + (f + g) ** 2 / 4) * math.sqrt(d * d + (f - g) ** 2 / 4) / d
        return late
    return joined


def farthest_points(count, d, n):
    """Point 0, and then repeatedly the point that is farthest from all chosen points; among ties,
    the first point. Duplicates of chosen points are left out."""
    chosen = [0]
    while len(chosen) < count:
        far = max(range(n), key=lambda i: (min(d(i, j) for j in chosen), -i))
        if min(d(far, j) for j in chosen) == 0:
            break
        chosen.append(far)
    return chosen
