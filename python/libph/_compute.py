# SPDX-License-Identifier: MIT
"""Barcodes of points, distances, images, meshes and filtered complexes."""
from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import _core
from ._barcodes import Barcode
from ._requests import (Request, alpha_request, boundary_request, cubical_request, filtered_request,
                        lower_star_request, rips_request)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._run import RunOptions


def _barcode(request: Request) -> Barcode:
    return Barcode._of(request.run(_core.barcode), request.meta)


def rips(X: Any, *, max_dim: int | None = 1, min_dim: int = 0, threshold: float | None = None,
         metric: Any = "euclidean", minkowski_p: float = 2.0, field: int = 2,
         weights: ArrayLike | str | None = None, dtm_neighbors: int | None = None,
         core_neighbors: int | None = None, weight_exponent: float | None = None, subsample: int | None = None,
         subsample_radius: float | None = None, approximation: float | None = None,
         merge_equal_points: bool | None = None, device: str = "cpu",
         collapse: str | bool = "auto",
         representatives: str | None = None, loops: str | None = None,
         min_persistence: float = 0.0, cells: bool = True, engine: str = "auto",
         nan: str = "error", diagonal: str = "zero", symmetrise: str | None = None,
         **run: Unpack[RunOptions]) -> Barcode:
    """The barcode of the Vietoris-Rips filtration of points or distances.

    A simplex enters at its diameter, the largest distance between two of its vertices.

    Parameters
    ----------
    X : array_like or sparse matrix
        Points, one per row. With ``metric="precomputed"``, distances: a square matrix, the
        condensed form of ``scipy.spatial.distance.pdist``, or a sparse matrix, in which a pair that
        is not stored is never joined. With a function as `metric`, any sequence of objects.
    max_dim : int
        The highest dimension of homology.
    min_dim : int
        The lowest dimension of homology.
    threshold : float, optional
        The largest distance at which two points are joined. Default: the enclosing radius, beyond
        which one component and no other class is left. There is no default threshold for sparse
        distances, for the engines "beta-skeleton" and "union-find", and for ``max_dim=0`` without a
        named engine.
    metric : str or callable
        "euclidean", "manhattan" ("l1", "cityblock"), "chebyshev", "minkowski", "cosine", "hamming"
        (how many coordinates differ), "precomputed", or a function of two points, which is called
        once for each pair.
    minkowski_p : float
        The exponent of ``metric="minkowski"``.
    field : int
        Coefficients are in Z/p for this prime p.
    weights : array_like, "dtm" or "core", optional
        The diameter at which each point enters. "dtm": twice its distance to the measure of its
        `dtm_neighbors` nearest points, including itself. "core": its core distance, the distance to
        its nearest other point of rank `core_neighbors`; edges then enter at the mutual
        reachability distances of HDBSCAN*.
    dtm_neighbors : int, optional
        The number of neighbours for ``weights="dtm"``.
    core_neighbors : int, optional
        The number of neighbours for ``weights="core"``.
    weight_exponent : {1, 2, inf}, optional
        The exponent that governs how a ball grows after the birth of its point. Default: 1 for
        "dtm", inf otherwise.
    subsample : int, optional
        Number of points to keep. Each point is the one farthest from the points chosen before it.
    subsample_radius : float, optional
        Points are added to the subsample until every point is at most this far from one of them.
    approximation : float, optional
        Epsilon of a sparse Rips filtration: births and deaths are later by a factor of at most 1 +
        epsilon.
    merge_equal_points : bool, optional
        If True, equal points without `weights` become one vertex, which keeps all bars of positive
        length. Default: True, unless `min_persistence` is negative or cocycles are requested.
    device : {"cpu", "gpu"}
        The device that finds the components of points with Euclidean distances (``max_dim=0``); the
        result does not depend on it. "gpu" is an NVIDIA GPU, if libph was built with support for
        it.
    collapse : {"auto", True, False}
        If True, edges are collapsed first, which does not change the bars, but may change their
        cells. "auto": edges are collapsed if a sample of them shows that this is worthwhile.
    representatives : {None, "cycles", "cocycles"}
        The kind of chains to compute with the bars; see `Barcode.representative`.
    loops : {None, "tight", "plain", "none"}
        How cycles of H1 are split into loops. Default: "tight", which shortens loops as far as is
        possible in little time.
    min_persistence : float
        Bars with death - birth <= this value are left out. A negative value keeps all bars.
    cells : bool
        If True, bars store the cells of their birth and death.
    engine : str
        "auto", or the name of an engine.
    nan : {"error", "drop"}
        How to treat NaN. "error": raise an error. "drop": leave out points with NaN; never join
        pairs whose entry in a matrix, or whose value of the function `metric`, is NaN.
    diagonal : {"zero", "births", "any"}
        The meaning of the diagonal of a matrix: "zero", it must be 0; "births", the values at which
        points enter; "any", it is ignored.
    symmetrise : {None, "max", "min", "lower"}
        Which of two unequal entries of a matrix to use. Default: unequal entries are an error.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barcode

    Examples
    --------
    >>> square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> bars = ph.rips(square)
    >>> bars.dgm(1)
    array([[1.        , 1.41421356]])
    >>> bars
    Barcode(rips of 4 points in R^2, field 2: 4 bars of H0, 1 of H1, longest [1, 1.41421))

    For distances, and for correlations r as distances 1 - r:

    >>> ph.rips([[0, 3], [3, 0]], metric="precomputed").dgm(0)
    array([[ 0.,  3.],
           [ 0., inf]])
    >>> r = np.corrcoef([[1, 2, 3], [1, 2, 4], [3, 1, 2]])
    >>> ph.rips(1 - r, metric="precomputed").dgm(0).round(2)
    array([[0.  , 0.02],
           [0.  , 1.33],
           [0.  ,  inf]])
    """
    return _barcode(rips_request(locals()))


def alpha(X: Any, *, values: str = "alpha", squared: bool | None = None,
          weights: ArrayLike | None = None,
          period: float | Sequence[float | None] | None = None, threshold: float | None = None,
          max_dim: int | None = None, min_dim: int = 0, field: int = 2,
          representatives: str | None = None, loops: str | None = None,
          min_persistence: float = 0.0, cells: bool = True, engine: str = "auto",
          nan: str = "error", **run: Unpack[RunOptions]) -> Barcode:
    """The barcode of growing balls around points on a line, in the plane or in space.

    Uses an alpha complex: the simplices of the Delaunay triangulation, each of which enters when
    the balls around its vertices, cut to their Voronoi cells, meet. Its bars are the bars of the
    union of the balls, in all dimensions. It has so few simplices that a million points in space
    take seconds. Values are radii; values of H0 are therefore half as large as in `rips`. See
    docs/explanation/engines/alpha.md.

    Parameters
    ----------
    X : array_like
        Points in R^1, R^2 or R^3, one per row. Duplicates, and points in a common plane or on a
        common line, are accepted.
    values : {"alpha", "delaunay-cech", "delaunay-rips"}
        When a simplex enters. "alpha": as above. "delaunay-cech": when the balls around all its
        vertices have a common point, which gives the same bars. "delaunay-rips": when all pairs of
        the balls around its vertices meet.
    squared : bool, optional
        If True, values are squares of radii, as in GUDHI. Default: True only for points with
        weights.
    weights : array_like, optional
        The square of each ball's initial radius, for example the radius of an atom or a grain.
        ``bars.meta["hidden"]`` lists the points whose balls are hidden in others.
    period : float or sequence of float, optional
        For a periodic space such as a crystal or a simulation box: the length after which each axis
        repeats, one for all axes or one per axis; 0 or None for an axis that does not repeat. Only
        for ``values="alpha"``.
    threshold : float, optional
        The largest value at which cells enter.
    max_dim : int, optional
        The highest dimension of homology. Default: all.
    min_dim, field, representatives, loops, min_persistence, cells, engine
        As in `cubical`.
    nan : {"error", "drop"}
        How to treat points with NaN: as an error, or left out.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barcode

    Raises
    ------
    NotBuiltIn
        If libph was built without CGAL. A build with CGAL is subject to the GPL.

    Examples
    --------
    >>> square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> ph.alpha(square).dgm(1)
    array([[0.5       , 0.70710678]])

    Two balls of radii 1 and 2, which touch from the start:

    >>> ph.alpha([[0, 0, 0], [3, 0, 0]], weights=[1, 4]).dgm(0)
    array([[-4., inf],
           [-1.,  0.]])

    One point in a periodic plane. Its ball meets itself along both axes, and later fills the plane:

    >>> bars = ph.alpha([[0, 0]], period=2)
    >>> bars.births.tolist()
    [0.0, 1.0, 1.0, 1.4142135623730951]
    """
    return _barcode(alpha_request(locals()))


def cubical(image: Any, *, construction: str = "vertices", superlevel: bool = False,
            periodic: Any = (), threshold: float | None = None, max_dim: int | None = None,
            min_dim: int = 0, field: int = 2, representatives: str | None = None,
            loops: str | None = None, min_persistence: float = 0.0, cells: bool = True,
            nan: str = "error", engine: str = "auto", slab_layers: int | None = None,
            **run: Unpack[RunOptions]) -> Barcode:
    """The barcode of the sublevel sets of an image with 1 to 8 axes.

    At a value t, the voxels with values up to t are present: dark voxels come first. With
    `superlevel`, bright voxels come first, and a voxel of value f enters at -f.

    Parameters
    ----------
    image : array_like or PointImage
        Values of pixels or voxels. Arrays of uint8, uint16, int16, float32 and float64 in C order
        are read in place; a read-only memory map need not fit into memory.
    construction : {"vertices", "cells"}
        "vertices": voxels are vertices, and a cube enters with its largest voxel (4 or 6
        neighbours). "cells": voxels are top-dimensional cubes, and a face enters with the smallest
        voxel around it (8 or 26 neighbours).
    superlevel : bool
        If True, superlevel sets of f are used: the sublevel sets of -f, with values of -f.
    periodic : sequence of int, bool or "all"
        The periodic axes; True or "all": all axes.
    threshold : float, optional
        The largest value at which cells enter. With `superlevel`, ``threshold=-100`` lets the voxels
        of value 100 or more enter.
    max_dim : int, optional
        The highest dimension of homology. Default: all.
    min_dim : int
        The lowest dimension of homology.
    field : int
        Coefficients are in Z/p for this prime p.
    representatives : {None, "cycles", "cocycles", "voxels"}
        What to compute with the bars: chains, or the voxels of components and hollows.
    loops : {None, "plain", "none"}
        How cycles of H1 are split into loops.
    min_persistence : float
        Bars with death - birth <= this value are left out. A negative value keeps all bars.
    cells : bool
        If True, bars store the cells of their birth and death.
    nan : {"error", "drop"}
        How to treat NaN: as an error, or as an absent voxel.
    engine : str
        "auto", or the name of an engine.
    slab_layers : int, optional
        Number of layers along the first axis that are processed together. Default: as many as
        memory allows.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barcode

    Examples
    --------
    >>> ring = [[9, 9, 9, 9, 9], [9, 1, 1, 1, 9], [9, 1, 7, 1, 9], [9, 1, 1, 1, 9], [9, 9, 9, 9, 9]]
    >>> list(ph.cubical(ring))
    [Bar(dim=0, birth=1.0, death=inf), Bar(dim=1, birth=1.0, death=7.0)]

    A row of pixels with two bright spots, of values 8 and 5, and a gap of value 2 between them:

    >>> ph.cubical([0, 8, 2, 5, 0], superlevel=True).dgm(0)
    array([[-8., inf],
           [-5., -2.]])
    """
    return _barcode(cubical_request(locals()))


def lower_star(values: ArrayLike, simplices: Any, *, max_dim: int | None = None, min_dim: int = 0,
               threshold: float | None = None, field: int = 2, representatives: str | None = None,
               loops: str | None = None, min_persistence: float = 0.0, cells: bool = True,
               engine: str = "auto", **run: Unpack[RunOptions]) -> Barcode:
    """The barcode of a function on the vertices of a mesh or graph.

    A simplex enters with the last of its vertices.

    Parameters
    ----------
    values : array_like
        A value for each vertex. A vertex with value inf never enters.
    simplices : array_like
        Triangles (m, 3), edges (m, 2), a list of such arrays, or a list of tuples of vertices.
        Faces need not be listed.
    max_dim, min_dim, threshold, field, representatives, loops, min_persistence, cells, engine
        As in `cubical`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barcode

    Examples
    --------
    >>> ph.lower_star([0, 2, 1], [[0, 1], [1, 2]]).dgm(0)
    array([[ 0., inf],
           [ 1.,  2.]])
    """
    return _barcode(lower_star_request(locals()))


def filtered(simplices: Any, values: Any, *, max_dim: int | None = None, min_dim: int = 0,
             threshold: float | None = None, field: int = 2, representatives: str | None = None,
             loops: str | None = None, min_persistence: float = 0.0, cells: bool = True,
             engine: str = "auto", **run: Unpack[RunOptions]) -> Barcode:
    """The barcode of any filtered simplicial complex.

    Parameters
    ----------
    simplices : array_like
        All simplices, including vertices: a list of tuples of vertices, or a list with an array (m,
        k) for each dimension.
    values : array_like
        A value for each simplex, no smaller than the values of its faces; for a list of arrays, one
        array or a list of arrays.
    max_dim, min_dim, threshold, field, representatives, loops, min_persistence, cells, engine
        As in `cubical`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barcode

    Examples
    --------
    >>> list(ph.filtered([(0,), (1,), (0, 1)], [0, 0, 1]))
    [Bar(dim=0, birth=0.0, death=1.0), Bar(dim=0, birth=0.0, death=inf)]
    """
    return _barcode(filtered_request(locals()))


def boundary(matrix: Any, dims: ArrayLike, values: ArrayLike | None = None, *,
             max_dim: int | None = None, min_dim: int = 0, threshold: float | None = None,
             field: int = 2, representatives: str | None = None, min_persistence: float = 0.0,
             cells: bool = True, engine: str = "auto", **run: Unpack[RunOptions]) -> Barcode:
    """The barcode of a filtered cell complex, given by its boundary matrix.

    Parameters
    ----------
    matrix : sparse matrix
        Column j is the boundary of cell j: incidence numbers in the rows of its facets.
    dims : array_like
        The dimension of each cell.
    values : array_like, optional
        A value for each cell, no smaller than the values of its facets. Default: its position.
    max_dim, min_dim, threshold, field, representatives, min_persistence, cells, engine
        As in `cubical`.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barcode

    Examples
    --------
    >>> from scipy.sparse import csc_matrix
    >>> edge = csc_matrix([[0, 0, -1], [0, 0, 1], [0, 0, 0]])
    >>> list(ph.boundary(edge, [0, 0, 1]))
    [Bar(dim=0, birth=0.0, death=inf), Bar(dim=0, birth=1.0, death=2.0)]
    """
    return _barcode(boundary_request({"loops": None, **locals()}))
