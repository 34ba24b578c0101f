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
         weight_exponent: float | None = None, subsample: int | None = None,
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
        Points, one a row. With ``metric="precomputed"`` distances: a square matrix, the condensed
        form of ``scipy.spatial.distance.pdist``, or a sparse matrix, in which a pair that is not
        stored is never joined. With a function as `metric` any sequence.
    max_dim : int
        The highest dimension of homology.
    min_dim : int
        The lowest dimension of homology.
    threshold : float, optional
        The largest distance at which two points are joined. Default: the enclosing radius, beyond
        which one component is left and nothing else; none for sparse distances, for engines
        "beta-skeleton" and "union-find", and for ``max_dim=0`` of no engine by name.
    metric : str or callable
        "euclidean", "manhattan" ("l1", "cityblock"), "chebyshev", "minkowski", "cosine", "hamming"
        (how many coordinates differ), "precomputed", or a function of two points, which is called
        once for each pair.
    minkowski_p : float
        The exponent of ``metric="minkowski"``.
    field : int
        Coefficients are in Z/p for this prime p.
    weights : array_like or "dtm", optional
        The diameter at which each point enters; "dtm": twice its distance to the measure of its
        `dtm_neighbors` nearest points, itself among them.
    dtm_neighbors : int, optional
        For ``weights="dtm"``.
    weight_exponent : {1, 2, inf}, optional
        How balls grow from the birth of a point on. Default: 1 for "dtm", inf otherwise.
    subsample : int, optional
        So many points are kept, each the farthest from those before.
    subsample_radius : float, optional
        Points are kept until all are so close to one of them.
    approximation : float, optional
        Epsilon of a sparse Rips filtration: bars are born and die later by a factor of
        1 + epsilon at most.
    merge_equal_points : bool, optional
        Whether equal points become one vertex. Default: where bars of positive length allow it.
    device : {"cpu", "gpu"}
        What finds the components of points with Euclidean distances (``max_dim=0``): the same ones.
        "gpu" is one of NVIDIA, where that is built in.
    collapse : {"auto", True, False}
        Whether edges are collapsed first, which leaves the bars as they are.
    representatives : {None, "cycles", "cocycles"}
        Chains that come with the bars; see `Barcode.representative`.
    loops : {None, "tight", "plain", "none"}
        How cycles of H1 are taken apart into loops. Default: tight, as short as is cheap.
    min_persistence : float
        Bars with death - birth <= this are left out. Below 0: none are.
    cells : bool
        Whether bars know the cells of their birth and death.
    engine : str
        "auto", or the name of an engine.
    nan : {"error", "drop"}
        What a NaN means: an error; or points are left out, and pairs of a matrix are never joined,
        nor those of which a function as `metric` gives NaN.
    diagonal : {"zero", "births", "any"}
        What stands on the diagonal of a matrix: 0, when each point enters, or anything.
    symmetrise : {None, "max", "min", "lower"}
        Which of two unequal entries of a matrix is taken. Default: they are an error.
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

    Of distances, and of correlations r, as distances 1 - r:

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
    """The barcode of growing balls around points of the plane or of space.

    Of an alpha complex: the simplices of the Delaunay triangulation, each of which enters when the
    balls around its vertices, cut to their Voronoi cells, meet. It has the bars of the union of the
    balls, in all dimensions, and its simplices are few: a million points of space take seconds.
    Values are radii, so that of H0 is half of that of `rips`. See
    docs/explanation/engines/alpha.md.

    Parameters
    ----------
    X : array_like
        Points of R^1, R^2 or R^3, one a row. Copies and points in a plane or on a line will do.
    values : {"alpha", "delaunay-cech", "delaunay-rips"}
        When a simplex enters: as above; when its balls meet, which gives the same bars; when each
        two of them do.
    squared : bool, optional
        Whether values are squares of radii, as in GUDHI. Default: of points with weights only.
    weights : array_like, optional
        The square of each ball's first radius: of an atom, of a grain. What is hidden in others is
        named by ``bars.meta["hidden"]``.
    period : float or sequence of float, optional
        Of a periodic space, as a crystal or a simulated box: the length after which each axis
        closes up, one for all or one an axis; 0 or None where it does not. Only for
        ``values="alpha"``.
    threshold : float, optional
        The largest value that enters.
    max_dim : int, optional
        The highest dimension of homology. Default: all.
    min_dim, field, representatives, loops, min_persistence, cells, engine
        As of `cubical`.
    nan : {"error", "drop"}
        What a NaN means: an error, or points are left out.
    **run
        `threads`, `memory_limit`, `progress`, `timeout`, `stop`; see `libph`.

    Returns
    -------
    Barcode

    Raises
    ------
    NotBuiltIn
        If CGAL was not there when libph was built. What has CGAL in it falls under the GPL.

    Examples
    --------
    >>> square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> ph.alpha(square).dgm(1)
    array([[0.5       , 0.70710678]])

    Two balls of radius 1 and 2, which touch from the beginning on:

    >>> ph.alpha([[0, 0, 0], [3, 0, 0]], weights=[1, 4]).dgm(0)
    array([[-4., inf],
           [-1.,  0.]])

    One point of a periodic plane: its ball meets itself along both axes, then fills all.

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
    """The barcode of the sublevel sets of an image, of 1 to 8 axes.

    At a value t those voxels are there that are not above t, so dark ones come first. With
    `superlevel` bright ones do, and a voxel of value f enters at -f.

    Parameters
    ----------
    image : array_like or PointImage
        Numbers of pixels or voxels. uint8, uint16, int16, float32 and float64 in C order are read
        where they are; a memory map that is read-only need not fit into the memory.
    construction : {"vertices", "cells"}
        Voxels are vertices, and a cube enters with its largest voxel (4 or 6 neighbours); or they
        are top cubes, and a face enters with the smallest voxel around it (8 or 26 neighbours).
    superlevel : bool
        Superlevel sets of f: the sublevel sets of -f, with values of -f.
    periodic : sequence of int, or bool
        The axes that close up on themselves; True: all.
    threshold : float, optional
        The largest value that enters.
    max_dim : int, optional
        The highest dimension of homology. Default: all.
    min_dim : int
        The lowest dimension of homology.
    field : int
        Coefficients are in Z/p for this prime p.
    representatives : {None, "cycles", "cocycles", "voxels"}
        What comes with the bars: chains, or the voxels of components and hollows.
    loops : {None, "plain", "none"}
        Whether cycles of H1 are taken apart into loops.
    min_persistence : float
        Bars with death - birth <= this are left out. Below 0: none are.
    cells : bool
        Whether bars know the cells of their birth and death.
    nan : {"error", "drop"}
        What a NaN means: an error, or a voxel that is absent.
    engine : str
        "auto", or the name of an engine.
    slab_layers : int, optional
        Layers along the first axis that are looked at together. Default: all that memory allows.
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

    Two bright spots in a row of pixels, of values 8 and 5, and a gap of 2 between them:

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
        A value for each vertex. What is inf never enters.
    simplices : array_like
        Triangles (m, 3), edges (m, 2), a list of such arrays, or of tuples of vertices. Faces need
        not be listed.
    max_dim, min_dim, threshold, field, representatives, loops, min_persistence, cells, engine
        As of `cubical`.
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
        All simplices, vertices among them: a list of tuples of vertices, or of an array (m, k) for
        each dimension.
    values : array_like
        A value for each, no smaller than those of its faces; for a list of arrays one array, or a
        list of arrays.
    max_dim, min_dim, threshold, field, representatives, loops, min_persistence, cells, engine
        As of `cubical`.
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
        A value for each cell, no smaller than those of its facets. Default: its position.
    max_dim, min_dim, threshold, field, representatives, min_persistence, cells, engine
        As of `cubical`.
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
