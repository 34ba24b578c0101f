# SPDX-License-Identifier: MIT
"""Calls of the Python package that are senseless, or only seem to be senseless: arrays of wrong
types, shapes and layouts, objects with contradictory properties, options of wrong types, unrelated
parts and files."""
import os
import pickle
import sys
import tempfile
import warnings

import numpy as np

NAN, INF = float("nan"), float("inf")
RANDOM = np.random.default_rng(0)
POINTS = RANDOM.random((20, 3))
DISTANCES = np.abs(POINTS[:, None] - POINTS[None]).sum(-1)
IMAGE = RANDOM.random((5, 6))
VOLUME = RANDOM.random((5, 6, 4))


def put(array, place, value):
    array = np.array(array, dtype=float)
    array[place] = value
    return array


def read_only(array):
    array = np.array(array)
    array.flags.writeable = False
    return array


def vast(shape, dtype=float):
    """An array that claims to be huge but holds a single number."""
    return np.lib.stride_tricks.as_strided(np.ones(1, dtype), shape, (0,) * len(shape))


class NoArray:
    """Raises an exception when its numbers are requested."""
    def __array__(self, dtype=None, copy=None):
        raise RuntimeError("not today")


class NegativeShape:
    __array_interface__ = {"shape": (-1, 3), "typestr": "<f8", "data": (8, False), "version": 3}


class NanAsFloat:
    def __float__(self):
        return NAN


class Derived(np.ndarray):
    pass


def prepared(folder):
    sys.path.insert(0, folder)
    import libph as ph
    warnings.simplefilter("ignore")
    bars = ph.rips(POINTS)
    names = {name: value for name, value in globals().items() if not name.startswith("_")}
    names.update(ph=ph, bars=bars, loops=ph.rips(POINTS, representatives="cycles"),
                 image_bars=ph.cubical(IMAGE), rows=bars.dgm(1), no_cells=ph.rips(POINTS, cells=False),
                 part=ph.image_part(IMAGE, 0, 2), other=ph.image_part(IMAGE, 1, 2),
                 cloud=ph.cloud_part(POINTS, 0, 2), tree=ph.merge_tree(POINTS))
    home = tempfile.mkdtemp()
    with open(os.path.join(home, "abcd"), "wb") as file:
        file.write(b"abcd")
    with open(os.path.join(home, "table.txt"), "w", encoding="ascii") as file:
        file.write("1 2 3\n4 5 6\n")
    names["home"] = home + os.sep
    return lambda text: lambda: _said(eval(text, names))  # evaluates only texts in this file


def _said(value):
    return "=: " + repr(value).replace("\n", " ")[:2000]


LESS = "more needed; ph.estimate says how much"
CALLS = [(room, *row) for room, rows in {
    "arrays of other types": [
        ("ph.rips(POINTS.astype(complex))", "DataError", "X: found complex numbers, expected real"),
        ("ph.rips(POINTS.astype('U'))", "DataError", "X: found text"),
        ("ph.rips(POINTS.astype('S'))", "DataError", "X: found bytes"),
        ("ph.rips(np.zeros((3, 2), 'M8[s]'))", "DataError", "X: found dates"),
        ("ph.rips(np.zeros((3, 2), 'm8[s]'))", "DataError", "X: found times"),
        ("ph.rips(np.zeros(3, [('x', float), ('id', int)]))", "DataError", "X: found records"),
        ("ph.rips(np.array([[1, 2], [3, None]], object))", "DataError", "point 1, coordinate 1: found nan"),
        ("ph.rips(np.array([[1, 2], [3, 'x']], object))", "DataError", "row 1, column 1: found str"),
        ("ph.rips(np.array([[1, 2], [3, [4]]], object))", "DataError", "row 1, column 1: found list"),
        ("ph.rips([[2**70, 0], [0, 1]])", "DataError", r"found 1180591620717411303424, .*2\*\*53"),
        ("ph.rips(np.array([[2**60, 0]]))", "DataError", "row 0, column 0: found 1152921504606846976"),
        ("ph.rips(np.array([[10**400, 0]], object))", "DataError", "beyond the range of float64"),
        ("ph.rips(np.array([[np.longdouble('1e400'), 0]]))", "DataError", "beyond the range of float64"),
        ("ph.cubical(IMAGE.astype(complex))", "DataError", "image: found complex numbers"),
        ("ph.cubical(IMAGE.astype('U'))", "DataError", "image: found text"),
        ("ph.cubical(np.array([[2**63]], np.uint64))", "DataError", "found 9223372036854775808"),
        ("ph.cubical(np.array([[-2**53 - 1]]))", "DataError", "found -9007199254740993"),
        ("ph.segment(POINTS.astype(complex))", "DataError", "cloud: found complex numbers"),
        ("ph.bottleneck(rows.astype(complex), rows)", "DataError", "a: found complex numbers"),
        ("ph.bottleneck(rows, rows.astype('U'))", "DataError", "b: found text"),
        ("ph.rips(POINTS.astype(object)) == bars", "=", "True"),
        ("ph.rips(POINTS.astype('>f8')) == bars", "=", "True"),
        ("ph.rips(POINTS.astype(np.longdouble)) == bars", "=", "True"),
    ],
    "arrays of other layouts": [
        ("ph.rips(read_only(POINTS)) == bars", "=", "True"),
        ("ph.rips(np.asfortranarray(POINTS)) == bars", "=", "True"),
        ("ph.rips(POINTS[::-1]) == ph.rips(POINTS[::-1].copy())", "=", "True"),
        ("ph.rips(np.repeat(POINTS, 2, 1)[:, ::2]) == bars", "=", "True"),
        ("ph.rips(np.matrix(POINTS)) == bars", "=", "True"),
        ("ph.rips(POINTS.view(Derived)) == bars", "=", "True"),
        ("ph.rips(memoryview(POINTS)) == bars", "=", "True"),
        ("ph.cubical(read_only(IMAGE)) == image_bars", "=", "True"),
        ("ph.cubical(np.asfortranarray(VOLUME)) == ph.cubical(VOLUME)", "=", "True"),
        ("ph.cubical(VOLUME.transpose(2, 0, 1)) == ph.cubical(VOLUME.transpose(2, 0, 1).copy())", "=", "True"),
        ("ph.cubical(IMAGE[::-2, ::-1]) == ph.cubical(IMAGE[::-2, ::-1].copy())", "=", "True"),
        ("len(ph.cubical(np.broadcast_to(np.float64(1), (50, 50))))", "=", "1"),
        ("ph.cubical(np.frombuffer(bytes(1) + IMAGE.tobytes(), np.uint8)[1:].view(float).reshape(5, 6))"
         " == image_bars", "=", "True"),
    ],
    "arrays of other shapes": [
        ("ph.rips(POINTS.reshape(2, 10, 3))", "UsageError", r"X: found an array of shape \(2, 10, 3\)"),
        ("ph.rips(POINTS[0])", "UsageError", r"shape \(3,\), expected \(points, coordinates\)"),
        ("ph.rips(3.0)", "UsageError", r"shape \(\)"),
        ("ph.rips([[1, 2], [3]])", "DataError", "row 1: found 1 numbers, expected 2"),
        ("ph.rips([[1, 2], 3])", "DataError", "row 1: found one number, expected 2"),
        ("ph.cubical(np.zeros(()))", "UsageError", "expected 1 to 8 axes"),
        ("ph.cubical(np.zeros((2,) * 9))", "UsageError", "expected 1 to 8 axes"),
        ("ph.cubical(np.zeros((0, 3)))", "DataError", "extents 0 x 3"),
        ("ph.cubical([[1, 2], [3]])", "DataError", "image: row 1"),
        ("ph.alpha(np.zeros((5, 4)))", "UsageError", r"points of R\^4, expected R\^1 to R\^3"),
        ("ph.alpha(np.zeros((5, 0)))", "UsageError", r"points of R\^0"),
        ("ph.segment(POINTS[:, :2])", "UsageError", r"cloud: found an array of shape \(20, 2\)"),
        ("ph.segment(np.zeros((2, 2, 3, 1)))", "UsageError", "cloud: found an array of shape"),
        ("ph.rips(POINTS, metric='precomputed')", "UsageError", "expected distances: a square matrix"),
        ("ph.rips(np.zeros(4), metric='precomputed')", "DataError", r"found 4 numbers, expected n\(n-1\)/2"),
        ("ph.rips(POINTS, weights=[0] * 19)", "UsageError", "weights: .*expected 20 numbers, one for each"),
        ("ph.alpha(POINTS, weights=[1])", "UsageError", "weights: .*expected 20 numbers"),
        ("ph.alpha(POINTS, period=[1, 1])", "UsageError", "period: .*one for each of 3 axes"),
        ("ph.bottleneck(rows[:, :1], rows)", "UsageError", r"a: .*expected rows \(birth, death\)"),
        ("ph.bottleneck(rows, [0, 1])", "UsageError", r"b: .*expected rows \(birth, death\)"),
        ("ph.permutation_test(POINTS, [0] * 20)", "UsageError", "expected a square matrix"),
        ("ph.confidence_band(IMAGE[0])", "UsageError", "functions: found an array of shape"),
        ("bars.betti_curve([[0, 1]])", "UsageError", "grid: .*expected one axis"),
        ("ph.segment(POINTS, colours=np.zeros((3, 3)))", "UsageError", r"colours: .*expected \(20, 3\)"),
    ],
    "arrays that say they are huge": [
        ("ph.rips(vast((2**31, 3), np.float32), memory_limit='1GiB')", "MemoryLimitError", "1 GiB would be exceeded: a copy of X"),
        ("ph.rips(vast((2**40, 3), np.int8))", "MemoryLimitError", "X: found 3298534883328"),
        ("ph.cubical(vast((2**20, 2**20)), memory_limit='1GiB')", "MemoryLimitError", "memory limit of 1 GiB"),
        ("ph.cubical(vast((2**20, 2**20)))", "MemoryLimitError", "memory limit"),
        ("ph.segment(vast((2**33, 3)))", "MemoryLimitError", "cloud: found 25769803776 numbers"),
        ("ph.segment(vast((2**17, 2**17)), camera='xtion')", "MemoryLimitError", "cloud: found 17179869184"),
        ("bars.image(1, resolution=10**6)", "MemoryLimitError", r"result of shape \(1000000, 1000000\)"),
        ("bars.image(1, resolution=10**6, pixel='density')", "MemoryLimitError", "result of shape"),
        ("bars.landscape(1, layers=2**20, resolution=2**30)", "MemoryLimitError", "result of shape"),
        ("ph.sliced_wasserstein(rows, rows, directions=2**31 - 1, memory_limit='1GB')", "MemoryLimitError", "limit"),
        ("ph.point_image(POINTS, 1e-300)", "MemoryLimitError", "voxel: found 1e-300, which makes an image"),
        ("ph.lower_star(range(70), [range(70)])", "MemoryLimitError", "found 70 vertices, expected at most 24"),
        ("ph.lower_star(range(24), [list(range(24))], timeout=0.5)", "Timeout", "not finished after 0.5 s"),
        ("ph.rips(vast((200_000, 3)))", "=", "1 bar of H0"),
        ("len(ph.distance_to_measure(np.zeros((100_000, 3)), 3))", "=", "100000"),
        ("ph.confidence_radius(np.zeros((20_000, 3)), subsamples=10)", "=", "0.0"),
    ],
    "what is no array": [
        ("ph.rips(None)", "UsageError", "X: found NoneType"), ("ph.rips({})", "UsageError", "X: found dict"),
        ("ph.rips('points.csv')", "UsageError", r"X: found str, .*ph.read\(path\)"),
        ("ph.rips(iter([[0, 1]]))", "UsageError", "X: found list_iterator"),
        ("ph.rips(x for x in [[0, 1]])", "UsageError", "X: found generator"),
        ("ph.rips(NoArray())", "DataError", "X: found no array of numbers: not today"),
        ("ph.rips(NegativeShape())", "DataError", "X: found no array of numbers"),
        ("ph.bottleneck(None, rows)", "UsageError", "a: found NoneType"),
        ("ph.diagram_distances('ab')", "UsageError", "diagrams: found 'ab'"),
        ("ph.diagram_distances([rows, 3])", "UsageError", r"diagrams\[1\]: found an array of shape \(\)"),
        ("ph.batch(ph.rips, 5)", "UsageError", "inputs: found 5"),
        ("ph.batch(3, [POINTS])", "UsageError", "function: found 3"),
        ("ph.batch(ph.rips, POINTS[0])", "UsageError", "input 0: X: "),
        ("ph.batch(ph.rips, [POINTS, put(POINTS, (0, 0), NAN)])", "DataError", "input 1: point 0, coordinate 0"),
        ("ph.boundary([[0]], [0])", "UsageError", "matrix: found list"),
        ("ph.lower_star([1], 'x')", "UsageError", "simplices: found str"),
        ("ph.report('x')", "UsageError", "X: found str"),
    ],
    "numbers that are none": [
        ("ph.rips(put(POINTS, (4, 1), NAN))", "DataError", "point 4, coordinate 1: found nan, .*nan='drop'"),
        ("ph.rips(put(POINTS, (4, 1), -INF))", "DataError", "point 4, coordinate 1: found -inf"),
        ("ph.rips(np.ma.masked_array(POINTS, POINTS > .9))", "DataError", "found nan"),
        ("ph.rips(put(DISTANCES, (3, 1), NAN), metric='precomputed')", "DataError", "row 3, column 1: found nan"),
        ("ph.rips(put(DISTANCES, (3, 1), 7), metric='precomputed')", "DataError", "asymmetric: row 3, column 1"),
        ("ph.rips(DISTANCES - 1, metric='precomputed')", "DataError", "expected 0 or more"),
        ("ph.rips(DISTANCES + 1, metric='precomputed')", "DataError", "row 0, column 0: found 1, expected 0 on"),
        ("ph.rips(POINTS * 0, metric='cosine')", "DataError", "point 0: found the zero vector"),
        ("ph.rips(POINTS, weights=[-1] * 20)", "UsageError", "weights: entry 0: found -1"),
        ("ph.rips(POINTS, weights=[NAN] * 20)", "UsageError", "weights: entry 0: found nan"),
        ("ph.rips(POINTS, metric=lambda a, b: NAN)", "DataError", "of points 0 and 1: found nan"),
        ("ph.rips(POINTS, metric=lambda a, b: -1)", "DataError", "of points 0 and 1: found -1"),
        ("ph.rips(POINTS, metric=lambda a, b: 'x')", "DataError", "metric of points 0 and 1: found str"),
        ("ph.rips(POINTS, metric=lambda a, b: POINTS)", "DataError", "metric of points 0 and 1: found ndarray"),
        ("ph.rips(POINTS, metric=lambda a, b: 1 / 0)", "ZeroDivisionError", "division"),
        ("ph.alpha(put(POINTS, (3, 0), NAN))", "DataError", "point 3, coordinate 0: found nan"),
        ("ph.alpha(POINTS, weights=[INF] * 20)", "DataError", "weight of point 0: found inf"),
        ("ph.alpha(POINTS, weights=[1e308] * 20)", "DataError", "expected 2.-458 to 2.511"),
        ("ph.cubical(put(IMAGE, (0, 0), NAN))", "DataError", "row 0, column 0: found nan, .*nan='drop'"),
        ("ph.lower_star([1, NAN], [[0, 1]])", "DataError", "vertex 1: found the value nan"),
        ("ph.filtered([[0], [1], [0, 1]], [0, 0, NAN])", "DataError", "cell 2: found the value nan"),
        ("ph.bottleneck([[0, NAN]], rows)", "DataError", r"a bar \[0, nan\)"),
        ("ph.bottleneck([[1, 0]], rows)", "DataError", r"a bar \[1, 0\)"),
        ("ph.diagram_distances([rows, [[0, NAN]]])", "DataError", r"a bar \[0, nan\)"),
        ("ph.p_values([[1, NAN]], filtration='rips')", "DataError", "death nan"),
        ("ph.p_values([[0, 1]], filtration='rips')", "DataError", "born at 0"),
        ("ph.permutation_test(put(DISTANCES, (0, 1), NAN), [0] * 10 + [1] * 10)", "DataError", "row 0, column 1"),
        ("ph.permutation_test(DISTANCES + 1, [0] * 10 + [1] * 10)", "DataError", "expected 0 on the diagonal"),
        ("ph.confidence_band(put(IMAGE, (0, 0), NAN))", "DataError", "row 0, column 0: found nan"),
        ("ph.segment(POINTS * INF)", "DataError", "cloud: row 0, column 0: found inf"),
        ("ph.segment(POINTS, colours=np.full((20, 3), 2.0))", "DataError", "colours: row 0, column 0: found 2"),
        ("ph.segment(POINTS, colours=np.full((20, 3), NAN))", "DataError", "colours: row 0, column 0: found nan"),
        ("bars.betti(NAN)", "UsageError", "t: found nan"),
        ("tree.components(NAN)", "UsageError", "t: found nan"),
        ("tree.basins(NAN)", "UsageError", "min_persistence: found nan"),
    ],
    "options": [
        ("ph.rips(POINTS, min_dim=3, max_dim=2)", "UsageError", "min_dim: found 3, expected at most max_dim"),
        ("ph.rips(POINTS, min_dim=3)", "UsageError", "min_dim: found 3, expected at most max_dim"),
        ("ph.cubical(IMAGE, min_dim=2, max_dim=1)", "UsageError", "min_dim: found 2, expected at most max_dim"),
        ("ph.alpha(POINTS, min_dim=2, max_dim=1)", "UsageError", "min_dim: found 2, expected at most max_dim"),
        ("ph.filtered([[0]], [0], min_dim=5, max_dim=1)", "UsageError", "min_dim: found 5, expected at most max_dim"),
        ("ph.rips(POINTS, threshold=NanAsFloat())", "UsageError", "threshold: found"),
        ("ph.rips(POINTS, max_dim=2**40)", "UsageError", "max_dim: found 1099511627776"),
        ("ph.rips(POINTS, field=2**64)", "UsageError", "field: found"),
        ("ph.rips(POINTS, subsample=2**63)", "UsageError", "subsample: found 9223372036854775808"),
        ("ph.rips(POINTS, weights='dtm', dtm_neighbors=21)", "UsageError", "dtm_neighbors: found 21"),
        ("ph.rips(POINTS, memory_limit='1')", "MemoryLimitError", LESS),
        ("ph.rips(RANDOM.random((3000, 4)), timeout=1e-3, max_dim=2)", "Timeout", "not finished after 0.001 s"),
        ("ph.rips(POINTS, POINTS)", "TypeError", "positional"),
        ("ph.rips(POINTS, **{'': 1})", "TypeError", "unexpected keyword argument ''"),
        ("ph.rips(POINTS, max_dims=1)", "TypeError", "did you mean 'max_dim'"),
        ("ph.cubical(IMAGE, periodic='01')", "UsageError", "periodic: found '01'"),
        ("ph.cubical(IMAGE, representatives='surfaces')", "UsageError", "representatives: found 'surfaces'"),
        ("ph.alpha(POINTS, period=NAN)", "UsageError", "period: found nan"),
        ("ph.alpha(POINTS, period=-1)", "UsageError", "period: found -1"),
        ("ph.alpha(POINTS, period='1')", "UsageError", "period: found '1'"),
        ("ph.alpha(POINTS, squared=1)", "UsageError", "squared: found 1"),
        ("ph.alpha(POINTS, values='delaunay-rips', period=1)", "UsageError", "expected values='alpha'"),
        ("ph.alpha(POINTS, threshold=-1)", "UsageError", "threshold: found -1"),
        ("ph.alpha_shape(POINTS, NAN)", "UsageError", "value: found nan"),
        ("ph.alpha_shape(POINTS, 1, wrap='x')", "UsageError", "wrap: found 'x'"),
        ("ph.bottleneck(bars, rows)", "UsageError", "dim: found None"),
        ("ph.bottleneck(rows, rows, dim=1)", "UsageError", "dim: does nothing for arrays"),
        ("ph.bottleneck(rows, rows, at_most=-1)", "UsageError", "at_most: found -1"),
        ("ph.bottleneck(rows, rows, relative_error=INF)", "UsageError", "relative_error: found inf"),
        ("ph.wasserstein(rows, rows, order=INF)", "UsageError", "order: found inf"),
        ("ph.wasserstein(rows, rows, ground=0)", "UsageError", "ground: found 0"),
        ("ph.sliced_wasserstein(rows, rows, directions=2**31)", "UsageError", "directions: found 2147483648"),
        ("ph.diagram_distances([rows], distance='x')", "UsageError", "distance: found 'x'"),
        ("ph.diagram_distances([rows], distance='bottleneck', order=2)", "UsageError", "order: does nothing"),
        ("ph.barycentre([])", "UsageError", "no diagram"),
        ("ph.barycentre([[[0, INF]], [[0, 1]]])", "DataError", "infinite bars in diagram 1"),
        ("ph.diagram_kernels([rows], sigma=0)", "UsageError", "sigma: found 0"),
        ("ph.confidence_radius(POINTS, alpha=0)", "UsageError", "alpha: found 0"),
        ("ph.confidence_radius(POINTS, size=21)", "UsageError", "size: found 21"),
        ("ph.permutation_test(DISTANCES, range(20))", "UsageError", "groups: found 20"),
        ("ph.permutation_test(DISTANCES, [0.0, 1.0, 1.0, NAN] * 5)", "UsageError", "groups: found .*none of them NaN"),
        ("ph.permutation_test(DISTANCES, [0, 0, '1', '1'] * 5)", "UsageError", "groups: found .*none of them NaN"),
        ("bars.landscape(1, range=(1, 0))", "UsageError", r"range: found \(1, 0\)"),
        ("bars.landscape(1, range=(-1e308, 1e308))", "UsageError", "-1e.308 to 1e.308"),
        ("bars.image(1, bandwidth=NAN)", "UsageError", "bandwidth: found nan"),
        ("bars.image(1, resolution=(2, 3, 4))", "UsageError", r"resolution: found \(2, 3, 4\)"),
        ("bars.silhouette(1, power=-1)", "UsageError", "power: found -1"),
        ("bars.statistics(0)", "UsageError", "row 19: found a bar that never dies"),
        ("ph.euler_curve(IMAGE, resolution=3)", "UsageError", "resolution: found 3"),
        ("ph.delay_embedding([1, 2, 3], 2**62, 2**62)", "DataError", "found 3 times, expected at least"),
        ("ph.delay_embedding([1, 2, 3], 2, 0)", "UsageError", "delay: found 0"),
        ("ph.segment(POINTS, crop=[NAN] * 6)", "UsageError", "crop: found"),
        ("ph.segment(IMAGE, intrinsics=[0, 1, 1, 1])", "UsageError", "focal lengths 0 and 1"),
        ("ph.segment(IMAGE, intrinsics='c.yaml')", "UsageError", "'c.yaml'.*camera takes a file"),
        ("ph.segment(IMAGE, camera=[1, 1, 1, 1])", "UsageError", "camera: found .*intrinsics takes numbers"),
        ("ph.segment(IMAGE, intrinsics=np.eye(4))", "UsageError", "intrinsics: found"),
        ("ph.segment(IMAGE, intrinsics=[1, 1, 1, 1], camera='xtion')", "UsageError", "camera: cannot be combined with intrinsics"),
        ("ph.segment(POINTS, previous=3)", "UsageError", "previous: found 3"),
        ("ph.LabelTracker(cell=0)", "UsageError", "cell: found 0"),
        ("ph.LabelTracker().update(np.array([[-1]]))", "UsageError", "labels from -1 to -1"),
        ("ph.limits(timeout=NAN).__enter__()", "UsageError", "timeout: found nan"),
    ],
    "complexes": [
        ("ph.filtered([[0, 1]], [0])", "DataError", r"simplex \(0 1\): its facet \(1\) is missing"),
        ("ph.filtered([[0], [0]], [0, 0])", "DataError", r"simplex \(0\) occurs twice"),
        ("ph.filtered([[0], [1], [0, 1]], [0, 2, 1])", "DataError", "enters at 1, before its facet 1 at 2"),
        ("ph.filtered([[]], [0])", "DataError", "simplex 0: found no vertices"),
        ("ph.filtered([[-1]], [0])", "DataError", "found vertex -1"),
        ("ph.filtered([[0], [2**63]], [0, 0])", "DataError", "found 9223372036854775808"),
        ("ph.filtered([range(30)], [0])", "DataError", "is missing"),
        ("ph.lower_star([1, 2], [[0, 2]])", "DataError", "vertex 2 has no value"),
        ("ph.lower_star([1, 2], [[0, -1]])", "DataError", "vertex -1 has no value"),
        ("ph.lower_star([1, 2], [[1, 1]])", "DataError", "occurs twice"),
        ("ph.lower_star([1, 1], [[0, 1.5]])", "DataError", "simplex 0: entry 1: found 1.5"),
    ],
    "barcodes": [
        ("bars[10**6]", "IndexError", "found 23 bars"), ("bars['x']", "TypeError", "found str"),
        ("bars.dgm(-1)", "UsageError", "dim: found -1"), ("bars.dgm(True)", "UsageError", "dim: found True"),
        ("bars.birth_cell(2**70)", "UsageError", "i: found 1180591620717411303424"),
        ("bars.representative(0)", "UsageError", "representative: found none"),
        ("bars.voxels(0)", "UsageError", "voxels: found none"),
        ("no_cells.birth_cell(0)", "UsageError", "cells: found none, expected a barcode computed with cells"),
        ("bars.filter(dim=[0, 'x'])", "UsageError", "dim: found 'x'"),
        ("bars.to_numpy('x')", "UsageError", "layout: found 'x'"),
        ("bars.longest(5)", "UsageError", "no bar of dimension 5"),
        ("pickle.loads(pickle.dumps(bars)[:-5])", "UnpicklingError", "truncated"),
        ("loops.representative(99)", "UsageError", "i: found 99"),
    ],
    "parts": [
        ("ph.CloudPart('x')", "UsageError", "data: found str, expected bytes"),
        ("ph.ImagePart(None)", "UsageError", "data: found NoneType, expected bytes"),
        ("ph.CloudPart(b'')", "DataError", "0 bytes that do not begin with \"ph part\""),
        ("ph.CloudPart.from_bytes(cloud.to_bytes()[:-1])", "DataError", "it is incomplete"),
        ("ph.CloudPart.from_bytes(part.to_bytes())", "DataError", "kind"),
        ("ph.ImagePart.from_bytes(cloud.to_bytes())", "DataError", "kind"),
        ("ph.cloud_part(POINTS, 2, 2)", "UsageError", "part: found 2"),
        ("ph.cloud_part(POINTS, 0, 2**40)", "UsageError", "parts: found 1099511627776"),
        ("ph.cloud_part(np.zeros((3, 9)), 0, 1)", "UsageError", "found 9 coordinates"),
        ("ph.image_part(IMAGE, 0, 6)", "UsageError", "found 6, expected 1 to 5"),
        ("ph.image_part(VOLUME, 0, 2)", "UsageError", "loops need messages between the parts"),
        ("part.barcode()", "DataError", "found 1 of 2"),
        ("part.barcode(loops=3)", "UsageError", "loops: found 3"),
        ("ph.join_parts(3)", "UsageError", "parts: found 3"), ("ph.join_parts([])", "DataError", "found none"),
        ("ph.join_parts([part, part])", "DataError", "found part 1 after part 1"),
        ("ph.join_parts([part, cloud])", "DataError", "CloudPart together with ImagePart"),
        ("ph.join_parts([part, ph.image_part(IMAGE * 2, 1, 2)])", "DataError", "layers that do not match"),
        ("ph.join_parts([part, ph.image_part(IMAGE, 1, 2, superlevel=True)])", "DataError", "differ in extents"),
        ("ph.join_parts([cloud, ph.cloud_part(POINTS + 1, 1, 2)]).barcode()", "DataError", "differ in points"),
        ("ph.join_parts([part, other]).barcode() == image_bars", "=", "True"),
    ],
    "files": [
        ("ph.read(home + 'none')", "MissingInputError", "cannot open"),
        ("ph.read(home)", "MissingInputError", "it is a directory"), ("ph.read('')", "UsageError", "path: found ''"),
        ("ph.read(3)", "UsageError", "path: found 3"), ("ph.read('a\\0b')", "UsageError", "path: found"),
        ("ph.read(home + 'abcd', 'x')", "UsageError", "format: found 'x'"),
        ("ph.read(home + 'table.txt', columns=3)", "UsageError", "columns: found 3"),
        ("ph.read(home + 'table.txt', columns=[NAN])", "UsageError", "columns: found 'nan'"),
        ("ph.read(home + 'table.txt', columns=[9])", "UsageError", "columns: found '9'"),
        ("ph.read(home + 'abcd', raw_shape=4)", "UsageError", "raw_shape: found 4"),
        ("ph.read(home + 'abcd', raw_shape=(-1,))", "UsageError", "raw_shape: found -1"),
        ("ph.read(home + 'abcd', raw_shape=(2**62, 4))", "DataError", "abcd"),
        ("ph.read(home + 'abcd', raw_shape=(3,))", "DataError", "trailing data"),
        ("ph.read(home + 'abcd', raw_shape=(2, 2)).tolist()", "=", r"\[\[97, 98\], \[99, 100\]\]"),
        ("ph.read(home + 'abcd', raw_skip=2)", "UsageError", "raw_skip"),
        ("ph.read(home + 'abcd', 'points', raw_shape=(4,))", "UsageError", "found format='points'"),
        ("ph.read(home + 'abcd', raw_shape=(2,), raw_dtype=object)", "UsageError", "raw_dtype: found"),
        ("ph.read_barcode(home + 'abcd')", "DataError", ":1:1: header"),
        ("ph.read_barcode(home + 'table.txt', 'x')", "UsageError", "format: found 'x'"),
        ("bars.save('/')", "UsageError", "format: found none"),
        ("bars.save(home + 'x.csv/x.csv')", "OutputError", "cannot create"),
        ("bars.save(home + 'x.xyz')", "UsageError", "format: found none"), ("bars.save(3)", "UsageError", "path"),
        ("ph.segment(home + 'none.pcd')", "MissingInputError", "cannot open"),
        ("ph.segment(IMAGE, camera=home + 'abcd')", "DataError", ":1:1: not a key"),
        ("ph.alpha_shape(POINTS, 1).save(home + 'x.xyz')", "UsageError", "path: found"),
    ],
}.items() for row in rows]
