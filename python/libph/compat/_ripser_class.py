# SPDX-License-Identifier: MIT
"""The class of ripser.py, in a module of its own because its base class loads scikit-learn."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import _options
from .persim import plot_diagrams
from .ripser import ripser

if TYPE_CHECKING:
    TransformerMixin = object
else:
    try:
        from sklearn.base import TransformerMixin
    except ImportError:
        TransformerMixin = object


@_options.with_hints
class Rips(TransformerMixin):
    """`ripser` as a class that keeps its results.

    Parameters
    ----------
    maxdim, thresh, coeff, do_cocycles, n_perm
        As in `ripser`.
    verbose : bool
        If True, the constructor prints the parameters.

    Attributes
    ----------
    dgms_, cocycles_, dperm2all_, num_edges_, idx_perm_, r_cover_
        The results of the last call.
    """

    def __init__(self, maxdim: int = 1, thresh: float = np.inf, coeff: int = 2,
                 do_cocycles: bool = False, n_perm: int | None = None, verbose: bool = True
                 ) -> None:
        self.maxdim = maxdim
        self.thresh = thresh
        self.coeff = coeff
        self.do_cocycles = do_cocycles
        self.n_perm = n_perm
        self.verbose = verbose
        self.dgms_: Any = None
        self.cocycles_: Any = None
        self.dperm2all_: Any = None
        self.metric_: Any = None
        self.num_edges_: Any = None
        self.idx_perm_: Any = None
        self.r_cover_: Any = 0.0
        if verbose:
            print(f"Rips(maxdim={maxdim}, thresh={thresh}, coeff={coeff}, "
                  f"do_cocycles={do_cocycles}, n_perm = {n_perm}, verbose={verbose})")

    def transform(self, X: Any, distance_matrix: bool = False, metric: Any = "euclidean"
                  ) -> list[NDArray[np.float64]]:
        """The diagrams of X, as `ripser` returns them."""
        found = ripser(X, self.maxdim, self.thresh, self.coeff, distance_matrix, self.do_cocycles,
                       metric, self.n_perm)
        for name in ("dgms", "cocycles", "num_edges", "dperm2all", "idx_perm", "r_cover"):
            setattr(self, f"{name}_", found[name])
        dgms: list[NDArray[np.float64]] = found["dgms"]
        return dgms

    def fit_transform(self, X: Any, distance_matrix: bool = False, metric: Any = "euclidean"
                      ) -> list[NDArray[np.float64]]:
        """The same as `transform`."""
        return self.transform(X, distance_matrix, metric)

    def plot(self, diagrams: Any = None, *args: Any, **kwargs: Any) -> None:
        """Draws diagrams, by default the last ones, with the arguments of `plot_diagrams`."""
        plot_diagrams(self.dgms_ if diagrams is None else diagrams, *args, **kwargs)
