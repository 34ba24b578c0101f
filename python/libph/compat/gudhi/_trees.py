# SPDX-License-Identifier: MIT
"""GUDHI's Rips complexes, and a substitute for the simplex tree that computes without listing
simplices."""
from __future__ import annotations

from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ... import _arrays, _core, _options
from ..._compute import rips
from ..._errors import NotBuiltIn, UsageError
from ..._points import distance_to_measure
from ..._requests import rips_request
from .. import _flag, _weights
from ._persistence import Persistence

_DEFAULTS: dict[str, Any] = {**rips.__kwdefaults__, "run": {}}  # the options of `rips`
_TREE_METHODS = {
    "assign_filtration", "assign_key", "clear", "collapse_edges", "compute_extended_filtration",
    "create_from_array", "dimension", "eccentricity", "edge_collapse", "euler_characteristic",
    "expansion", "expansion_with_blocker", "extend_filtration", "extended_persistence",
    "filtration", "find", "get_boundaries", "get_cofaces", "get_filtration", "get_simplices",
    "get_skeleton", "get_star", "initialize_filtration", "insert", "insert_batch",
    "insert_edges_from_coo_matrix", "lower_star_persistence_generators",
    "make_filtration_non_decreasing", "num_simplices", "num_simplices_by_dimension",
    "persistence_pairs", "prune_above_dimension", "prune_above_filtration",
    "remove_maximal_simplex", "reset_filtration", "set_dimension", "upper_bound_dimension",
    "write_persistence_diagram"}


@_options.with_hints
class FlagTree(Persistence):
    """A Rips complex, up to a dimension. Simplices are not listed.

    Made by `RipsComplex.create_simplex_tree` and similar methods.
    """

    _creators: NDArray[np.int64] | None = None  # births of bars in the highest dimension

    def __init__(self, data: Any, options: dict[str, Any], max_dimension: int) -> None:
        self._data = data
        self._options = options
        # GUDHI always lists edges.
        self._dimension = max(1, _options.whole("max_dimension", max_dimension, 0))

    def __getattr__(self, name: str) -> Any:
        if name not in _TREE_METHODS:
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

        def missing(*arguments: Any, **options: Any) -> NoReturn:
            raise NotBuiltIn(f"{name}: libph lists no simplices of a Rips complex; GUDHI has a "
                             "SimplexTree")

        return missing

    def num_vertices(self) -> int:
        """The number of points that enter."""
        births, limit = self._births(), self._options["threshold"]
        if births is None:
            return len(self._data)
        return int(np.count_nonzero(births <= (np.inf if limit is None else limit)))

    def is_empty(self) -> bool:
        """True if no point enters."""
        return self.num_vertices() == 0

    def copy(self) -> FlagTree:
        """The same complex, without its bars."""
        return FlagTree(self._data, self._options, self._dimension)

    def compute_persistence(self, homology_coeff_field: int = 11, min_persistence: float = 0,
                            persistence_dim_max: bool = False) -> FlagTree:
        """Computes the bars of all dimensions below the dimension of the complex, and returns
        itself.

        Parameters
        ----------
        homology_coeff_field : int
            A prime.
        min_persistence : float
            Bars with death - birth <= this value are left out; a negative value keeps all bars.
        persistence_dim_max : bool
            If True, bars of the dimension of the complex are included; they never die, because
            there are no simplices of higher dimension.
        """
        above, creators = None, None
        data, options = self._data, self._options
        min_persistence = _options.real("min_persistence", min_persistence)
        if _options.flag("persistence_dim_max", persistence_dim_max):
            if options.get("approximation") is not None:
                raise NotBuiltIn("persistence_dim_max: libph has no such bars for a sparse Rips "
                                 "complex; GUDHI has them")
            data, options, above, creators = self._skeleton(homology_coeff_field)
        if min_persistence < 0 and options["threshold"] is None:
            # Beyond the enclosing radius, there are bars of length zero.
            options = {**options, "threshold": np.inf}
        request = rips_request({
            **_DEFAULTS, **options, "X": data, "max_dim": self._dimension - 1,
            "field": homology_coeff_field, "min_persistence": min_persistence})
        self._keep(request.run(_core.barcode), self._dimension + (above is not None), above)
        self._creators = creators
        return self

    def persistence(self, homology_coeff_field: int = 11, min_persistence: float = 0,
                    persistence_dim_max: bool = False) -> list[tuple[int, tuple[float, float]]]:
        """Computes like `compute_persistence` and returns a list of (dimension, (birth, death)):
        the highest dimension first and, within a dimension, the longest bars first."""
        self.compute_persistence(homology_coeff_field, min_persistence, persistence_dim_max)
        return self._listed()

    def flag_persistence_generators(self) -> tuple[Any, ...]:
        """The edges that give values to the simplices of birth and death.

        Returns
        -------
        tuple
            For H0, rows of birth vertex and death edge; for each dimension from 1, rows of birth
            edge and death edge; the vertices of bars of H0 that never die; for each dimension from
            1, the edges of bars that never die. The larger vertex of an edge comes first.
        """
        barcode = self._barcode("flag_persistence_generators")
        finite, essential = [], []
        for dim in range(self._dimension):
            order, dies = self._order(dim)
            born = _flag.youngest_edges(self._values, barcode.birth_cells(dim)[order])
            killed = _flag.youngest_edges(self._values, barcode.death_cells(dim)[order[dies]])
            finite.append(np.column_stack([born[dies], killed]))
            essential.append(born[~dies])
        if self._creators is not None:  # bars of the dimension of the complex, which never die
            finite.append(np.empty((0, 4), dtype=finite[0].dtype))
            essential.append(_flag.youngest_edges(self._values, self._creators))
        return finite[0], finite[1:], essential[0][:, 0], essential[1:]

    # ---- values of vertices and edges

    def _births(self) -> NDArray[np.float64] | None:
        weights = self._options.get("weights")
        if isinstance(weights, str):
            metric = self._options["metric"]
            return 2 * distance_to_measure(self._data, self._options["dtm_neighbors"],
                                           metric=metric)
        return weights

    def _values(self, u: NDArray[np.int64], v: NDArray[np.int64]) -> NDArray[np.float64]:
        """The values of edges."""
        data = np.asarray(self._data, dtype=np.float64)
        if self._options["metric"] == "precomputed":
            distances = data[v, u]
        else:
            distances = np.sqrt(((data[u] - data[v])**2).sum(axis=-1))
        births = self._births()
        if births is None:
            return distances
        return _weights.meeting(distances, births[u], births[v], 1)

    def _skeleton(self, field: int) -> tuple[NDArray[np.float64], dict[str, Any],
                                             NDArray[np.float64], NDArray[np.int64]]:
        """Returns the edges as a matrix, in the form that `rips` accepts, and the bars in the
        dimension of the complex. These bars are given by the values and the vertices of their
        simplices, which kill no bar of the dimension below."""
        n = len(self._data)
        limit = self._options["threshold"]
        limit = np.inf if limit is None else limit
        i, j = np.triu_indices(n, 1)
        matrix = np.full((n, n), np.inf)
        matrix[i, j] = self._values(i, j)
        births = self._births()
        enters = np.ones(n, dtype=bool) if births is None else births <= limit
        matrix[(matrix > limit) | ~enters | ~enters[:, None]] = np.inf
        simplices, values = np.arange(n)[:, None], np.zeros(n)
        for _ in range(self._dimension):
            reach = np.maximum.reduce(matrix[simplices], axis=1) if len(simplices) else \
                np.empty((0, n))
            s, v = np.nonzero(reach < np.inf)
            values = np.maximum(values[s], reach[s, v])
            simplices = np.column_stack([simplices[s], v])
        np.fill_diagonal(matrix, 0)
        matrix = np.minimum(matrix, matrix.T)
        # All edges, including edges beyond the enclosing radius.
        options = {"metric": "precomputed", "threshold": limit, "weights": births}
        below = rips(matrix, max_dim=self._dimension - 1, min_persistence=-1, field=field,
                     **options)
        dies = np.isfinite(below.dgm(self._dimension - 1)[:, 1])
        killers = np.sort(below.death_cells(self._dimension - 1)[dies], axis=1)
        known = np.concatenate([killers, simplices])
        _, first, number = np.unique(known, axis=0, return_index=True, return_inverse=True)
        creates = first[number.ravel()[len(killers):]] >= len(killers)
        simplices, values = simplices[creates], values[creates]
        order = np.argsort(values, kind="stable")
        return matrix, options, values[order], simplices[order]


@_options.with_hints
class RipsComplex:
    """The Rips complex of points or distances.

    Parameters
    ----------
    points : array_like
        Points, one per row.
    distance_matrix : array_like
        Distances: a square, or the rows of its lower triangle.
    max_edge_length : float
        The largest distance at which points are joined.
    sparse : float, optional
        Epsilon of a sparse filtration, below 1: bars are off by a factor of at most 1 / (1 -
        epsilon).
    """

    def __init__(self, *, points: ArrayLike = (), distance_matrix: ArrayLike = (),
                 max_edge_length: float = np.inf, sparse: float | None = None) -> None:
        self._data, self._rips = _space(points, distance_matrix, "max_edge_length",
                                        max_edge_length)
        if sparse is not None:
            epsilon = _options.positive("sparse", sparse)
            if epsilon >= 1:
                raise _options.refuse("sparse", sparse, "a number above 0 and below 1")
            self._rips["approximation"] = epsilon / (1 - epsilon)

    def create_simplex_tree(self, max_dimension: int = 1) -> FlagTree:
        """The complex up to a dimension."""
        return FlagTree(self._data, self._rips, max_dimension)


@_options.with_hints
class WeightedRipsComplex:
    """The Rips complex of points that enter at twice their weights.

    Parameters
    ----------
    distance_matrix : array_like
        Distances: a square, or the rows of its lower triangle.
    weights : array_like, optional
        A number of at least 0 for each point. Two points are joined at their distance plus both
        weights.
    max_filtration : float
        The largest value at which cells enter.
    """

    def __init__(self, distance_matrix: ArrayLike, weights: ArrayLike | None = None,
                 max_filtration: float = np.inf) -> None:
        self._data, self._rips = _space((), distance_matrix, "max_filtration", max_filtration)
        if weights is not None:
            self._rips["weights"] = 2 * _arrays.as_values(weights, "weights", len(self._data),
                                                          "point")
            self._rips["weight_exponent"] = 1

    def create_simplex_tree(self, max_dimension: int) -> FlagTree:
        """The complex up to a dimension."""
        return FlagTree(self._data, self._rips, max_dimension)


@_options.with_hints
class DTMRipsComplex(WeightedRipsComplex):
    """The weighted Rips complex whose weights are distances to a measure.

    Parameters
    ----------
    points, distance_matrix : array_like
        As in `RipsComplex`.
    k : int
        Number of neighbours, including the point itself; with 0 or 1, there are no weights.
    q : float
        The exponent of the mean of their distances.
    max_filtration : float
        The largest value at which cells enter.
    """

    def __init__(self, points: ArrayLike | None = None, distance_matrix: ArrayLike | None = None,
                 k: int = 1, q: float = 2, max_filtration: float = np.inf) -> None:
        self._data, self._rips = _space(() if points is None else points,
                                        () if distance_matrix is None else distance_matrix,
                                        "max_filtration", max_filtration)
        q = _options.positive("q", q)
        count = len(self._data)
        if _options.whole("k", k, -2**63, count or 2**63 - 1) <= 1 or count == 0:
            return
        self._rips["weight_exponent"] = 1
        if q == 2:
            self._rips.update(weights="dtm", dtm_neighbors=k)
            return
        if self._rips["metric"] != "precomputed":
            from scipy.spatial.distance import pdist, squareform
            self._data, self._rips["metric"] = squareform(pdist(self._data)), "precomputed"
        self._rips["weights"] = _weights.distance_to_measure(
            lambda i: self._data[i], len(self._data), {"n_neighbors": k - 1, "r": q})


def _space(points: Any, distances: Any, name: str, limit: float
           ) -> tuple[NDArray[np.float64], dict[str, Any]]:
    """Data and keywords for `rips`; `name` is the name of the limit."""
    options: dict[str, Any] = {
        "metric": "euclidean", "threshold": None if limit == np.inf else
        _options.real(name, limit, "a number of at least 0", 0)}
    if not hasattr(distances, "__len__") or len(distances) == 0:
        return _arrays.as_points(points, "points"), options
    if hasattr(points, "__len__") and len(points):
        raise UsageError("points: cannot be combined with distance_matrix; leave out one of them")
    options["metric"] = "precomputed"
    return _square(distances), options


def _square(distances: Any) -> NDArray[np.float64]:
    """The full matrix. Rows of a lower triangle, or a square whose upper triangle is 0, are
    mirrored."""
    if isinstance(distances, (list, tuple)) and all(
            hasattr(row, "__len__") and len(row) in (i, i + 1) for i, row in enumerate(distances)):
        square = np.zeros((len(distances),) * 2)
        for i, row in enumerate(distances):
            square[i, :i] = row[:i]
    else:
        square = _arrays.as_float64(_arrays.as_array(distances, "distance_matrix"),
                                    "distance_matrix")
        if square.ndim != 2 or square.shape[0] != square.shape[1]:
            raise UsageError(f"distance_matrix: found an array of shape {square.shape}, expected a "
                             "square, or the rows of its lower triangle")
        if np.triu(square, 1).any():
            return square
    lower = np.tril(square, -1)
    return lower + lower.T
