# SPDX-License-Identifier: MIT
"""Names in other packages, and their equivalents in libph."""
from __future__ import annotations


def _table(*rows: tuple[str, str]) -> dict[str, str]:
    return {name: hint for names, hint in rows for name in names.split()}


MODULE = _table(
    ("ripser Rips", "use ph.rips, or libph.compat.ripser for ripser.py's interface"),
    ("ripser_parallel", "use ph.rips, or libph.compat.gph for giotto-ph's interface"),
    ("vietoris_rips VietorisRips Ripser persistence persistent_homology barcode",
     "use ph.rips for points or distances, ph.cubical for images"),
    ("RipsComplex", "use ph.rips, or libph.compat.gudhi for GUDHI's interface"),
    ("CubicalComplex PeriodicCubicalComplex",
     "use ph.cubical, or libph.compat.gudhi for GUDHI's interface"),
    ("SimplexTree", "use ph.filtered(simplices, values)"),
    ("AlphaComplex DelaunayCechComplex DelaunayComplex Alpha fill_alpha_shapes alpha_complex",
     "use ph.alpha"),
    ("alphashape", "use ph.alpha_shape"),
    ("computePH compute_ph", "use ph.cubical, or libph.compat.cripser for CubicalRipser's interface"),
    ("lower_star_img", "use ph.cubical, or libph.compat.ripser for ripser.py's interface"),
    ("VietorisRipsPersistence RipsPersistence", "use libph.sklearn.RipsPersistence"),
    ("CubicalPersistence", "use libph.sklearn.CubicalPersistence"),
    ("PersistenceImage PersistenceImager PersImage", "use bars.image, or libph.sklearn"),
    ("Landscape PersistenceLandscape PersLandscapeApprox landscape landscapes",
     "use bars.landscape(dim), or libph.sklearn.Landscape"),
    ("PersLandscapeExact", "use bars.exact_landscape(dim)"),
    ("Silhouette silhouette", "use bars.silhouette(dim), or libph.sklearn.Silhouette"),
    ("PersistenceEntropy persistent_entropy entropy",
     "use bars.entropy(dim), or libph.sklearn.Entropy"),
    ("statistics persistence_statistics", "use bars.statistics(dim), or libph.sklearn.Statistics"),
    ("Atol ATOL atol", "use libph.sklearn.Atol"),
    ("euler euler_characteristic euler_characteristic_curve ecc ECC EulerCharacteristicCurve",
     "use ph.euler_curve(image), bars.euler_curve()"),
    ("PersistenceScaleSpaceKernel PersistenceWeightedGaussianKernel persistence_scale_space heat",
     "use ph.diagram_kernels"),
    ("plot plot_diagrams plot_diagram plot_dgms plot_barcode plot_persistence_diagram "
     "plot_persistence_barcode", "use bars.plot()"),
    ("bottleneck_distance", "use ph.bottleneck"),
    ("wasserstein_distance emd", "use ph.wasserstein"),
    ("sliced_wasserstein_distance SlicedWassersteinDistance", "use ph.sliced_wasserstein"),
    ("PairwiseDistance pairwise_persistence_diagram_distances pairwise_distances",
     "use ph.diagram_distances"),
    ("frechet_mean lagrangian_barycenter barycenter", "use ph.barycentre"),
    ("betti betti_numbers betti_curve", "use bars.betti(t), bars.betti_curve(grid)"),
    ("load loadtxt", "use ph.read for data, ph.read_barcode for what bars.save wrote"),
    ("save", "use bars.save"),
)

BARCODE = _table(
    ("diagrams diagram dgm_ persistence intervals persistence_intervals "
     "persistence_intervals_in_dimension", "use dgm(dim) for one dimension, dgms() for all"),
    ("show plot_diagrams plot_diagram plot_barcode plot_persistence_diagram",
     "use plot(), plot('barcode')"),
    ("dim dimension dimensions", "use dims, a number for each bar; len(bars) counts them"),
    ("birth death lifetimes lengths persistences", "use births, deaths: arrays; deaths - births"),
    ("pairs cells persistence_pairs", "use birth_cells(dim), death_cells(dim)"),
    ("generators gens flag_persistence_generators cofaces_of_persistence_pairs",
     "use ph.gradients.deciders(bars, data): the edges or voxels that decide"),
    ("cocycles cycles representatives loops loop",
     "use representative(i), of bars computed with representatives='cycles' or 'cocycles'"),
    ("betti_numbers persistent_betti_numbers", "use betti(t), betti_curve(grid)"),
    ("bottleneck bottleneck_distance wasserstein wasserstein_distance distance",
     "use ph.bottleneck(a, b), ph.wasserstein(a, b)"),
    ("euler euler_characteristic euler_characteristic_curve ecc", "use euler_curve()"),
    ("persistence_image", "use image(dim)"),
    ("landscapes persistence_landscape", "use landscape(dim), exact_landscape(dim)"),
    ("persistent_entropy persistence_entropy", "use entropy(dim)"),
    ("stats describe", "use statistics(dim)"),
    ("df to_df to_frame to_dataframe", "use to_pandas()"),
    ("to_csv to_json dump write", "use save('bars.csv'), save('bars.json')"),
    ("numpy to_array array", "use to_numpy(), dgm(dim)"),
)

SKLEARN = _table(
    ("VietorisRipsPersistence WeightedRipsPersistence SparseRipsPersistence VietorisRips",
     "use RipsPersistence"),
    ("PersistenceEntropy PersistentEntropy", "use Entropy"),
    ("PersistenceLandscape", "use Landscape"),
    ("PersistenceImager", "use PersistenceImage"),
    ("PersistenceLengths", "use Lengths"),
    ("PersistenceStatistics", "use Statistics"),
    ("PersistenceSilhouette", "use Silhouette"),
    ("EntropySummary EntropySummaryFunction LifeEntropyCurve", "use LifeEntropy"),
    ("ATOL", "use Atol"),
    ("EulerCharacteristic EulerCharacteristicCurve ECC", "use EulerCurve"),
    ("PersistenceScaleSpaceKernel PersistenceWeightedGaussianKernel", "use DiagramKernels"),
    ("Amplitude TopologicalVector", "use Lengths, Landscape"),
    ("Tomato ToMATo", "use PersistenceClustering"),
    ("PairwiseDistance BottleneckDistance WassersteinDistance SlicedWassersteinDistance",
     "use DiagramDistances"),
    ("HeatKernel Scaler Filtering",
     "giotto-tda has it, and accepts the results of output='giotto'"),
)

# Names of keywords in other packages. The key is the equivalent keyword of libph.
_KEYWORDS = {
    "max_dim": "maxdim max_dimension maxdimension homology_dimensions max_homology_dim",
    "threshold": "thresh max_edge_length max_edge maxscale",
    "field": "coeff homology_coeff_field prime",
    "metric": "distance_matrix precomputed",
    "subsample": "n_perm",
    "representatives": "do_cocycles return_generators generators cocycles",
    "threads": "n_threads n_jobs num_threads workers",
    "memory_limit": "memory max_memory",
    "approximation": "sparse",
    "collapse": "collapse_edges edge_collapse",
    "weights": "weight_params",
    "periodic": "periodic_dimensions",
    "order": "p",
    "ground": "internal_p q",
    "relative_error": "delta e epsilon",
    "directions": "M n_directions num_directions",
    "range": "sample_range im_range",
    "resolution": "n_bins num_samples num_bins",
    "sigma": "bandwidth",
}
KEYWORDS = {old: new for new, names in _KEYWORDS.items() for old in names.split()}
VALUES = {"metric": "metric='precomputed'", "representatives": "representatives='cocycles'",
          "max_dimension": "max_dim, which counts homology: one less than GUDHI's max_dimension",
          "sparse": "approximation, which is sparse / (1 - sparse)"}
