# SPDX-License-Identifier: MIT
"""Names in other packages, and their equivalents in libph."""
from __future__ import annotations


def _table(*rows: tuple[str, str]) -> dict[str, str]:
    return {name: hint for names, hint in rows for name in names.split()}


_VECTORS = ("libph.sklearn has PersistenceImage, Landscape, Silhouette, BettiCurve, Entropy, Atol, "
            "DiagramDistances and DiagramKernels")

MODULE = _table(
    ("ripser Rips", "use ph.rips, or libph.compat.ripser for ripser.py's interface"),
    ("ripser_parallel", "use ph.rips, or libph.compat.gph for giotto-ph's interface"),
    ("vietoris_rips VietorisRips Ripser persistence persistent_homology barcode",
     "use ph.rips for points or distances, ph.cubical for images"),
    ("RipsComplex", "use ph.rips, or libph.compat.gudhi for GUDHI's interface"),
    ("CubicalComplex PeriodicCubicalComplex",
     "use ph.cubical, or libph.compat.gudhi for GUDHI's interface"),
    ("SimplexTree", "use ph.filtered(simplices, values)"),
    ("AlphaComplex DelaunayComplex Alpha fill_alpha_shapes alpha_complex", "use ph.alpha"),
    ("DelaunayCechComplex", "use ph.alpha with values='delaunay-cech'"),
    ("alphashape", "use ph.alpha_shape"),
    ("computePH compute_ph", "use ph.cubical, or libph.compat.cripser for CubicalRipser's interface"),
    ("lower_star_img", "use ph.cubical, or libph.compat.ripser for ripser.py's interface"),
    ("VietorisRipsPersistence RipsPersistence", "use libph.sklearn.RipsPersistence"),
    ("CubicalPersistence", "use libph.sklearn.CubicalPersistence"),
    ("PersistenceImage PersistenceImager PersImage persistence_image",
     "use bars.image(dim), or libph.sklearn.PersistenceImage"),
    ("Landscape PersistenceLandscape PersistenceLandscaper PersLandscapeApprox landscape landscapes",
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
    ("sliding_window sliding_windows SlidingWindow takens_embedding TakensEmbedding "
     "SingleTakensEmbedding TimeDelay TimeDelayEmbedding time_delay_embedding takens",
     "use ph.delay_embedding"),
    ("sparse_rips SparseRips SparseRipsPersistence",
     "use ph.rips with approximation, the largest relative error of a value"),
    ("sedt SEDT signed_distance distance_transform porosity",
     "ph.cubical takes the distances of scipy.ndimage.distance_transform_edt"),
    ("watershed basins", "use ph.merge_tree(image).basins(persistence)"),
    ("read_image read_nifti read_png read_tiff read_csv read_off read_ply read_point_cloud",
     "use ph.read"),
    ("write_tiff write_png write_nrrd save_nifti",
     "use ph.write_nifti, or another package: images and labels are arrays"),
    ("euclidean_clusters region_growing", "use ph.segment"),
    ("networkx from_networkx",
     "ph.rips reads networkx.to_scipy_sparse_array(graph) with metric='precomputed'"),
    ("CechComplex cech fill_cech", "use ph.alpha, whose balls have the same bars"),
    ("WitnessComplex StrongWitnessComplex EuclideanWitnessComplex EuclideanStrongWitnessComplex "
     "witness witness_complex lazy_witness",
     "use ph.rips with subsample, the number of landmarks"),
    ("fill_rips fill_freudenthal homology_persistence",
     "use ph.rips for points, ph.cubical for images, ph.filtered for simplices"),
    ("circular_coordinates CircularCoords CircularCoordinates ToroidalCoords",
     "DREiMac has them; ph.rips with representatives='cocycles' gives the cocycles"),
    ("mapper Mapper KeplerMapper make_mapper_pipeline MapperComplex CoverComplex",
     "KeplerMapper and giotto-tda have it"),
    ("zigzag zigzag_persistence zigzag_homology_persistence ZigzagPersistence", "Dionysus has it"),
    ("flagser flagser_unweighted flagser_weighted FlagserPersistence Flagser",
     "pyflagser has it; ph.filtered takes the simplices of any complex"),
    ("extended_persistence", "GUDHI's SimplexTree has it"),
    ("gromov_hausdorff", "persim has it"),
    ("representations representation vectorization vectorisation vectorizations", _VECTORS),
    ("clustering", "use libph.sklearn.PersistenceClustering"),
    ("HDBSCAN hdbscan",
     "use libph.sklearn.HDBSCAN, or libph.compat.hdbscan for hdbscan's interface"),
    ("RobustSingleLinkage robust_single_linkage",
     "use ph.cluster_tree with weights='core', whose result has the method cut"),
    ("PLSCAN", "fast_hdbscan has it; the result of ph.cluster_tree has the method with_min_size"),
    ("subsampling", "use ph.farthest_points"),
    ("point_cloud", "use ph.delay_embedding, ph.distance_to_measure"),
)


def _as_in_module(names: str) -> dict[str, str]:
    return {name: MODULE[name] for name in names.split()}


BARCODE = _table(
    ("diagrams diagram dgm_ intervals persistence_intervals persistence_intervals_in_dimension",
     "use dgm(dim) for one dimension, dgms() for all"),
    ("persistence", "use dgm(dim) for births and deaths, deaths - births for lengths"),
    ("top", "use longest(dim, n)"),
    ("mask masks", "use voxels(i) of one bar, labels(dim) of all"),
    ("to_dict", "use to_pandas().to_dict(), meta"),
    ("show plot_diagrams plot_diagram plot_barcode plot_persistence_diagram",
     "use plot(), plot('barcode')"),
    ("dim dimension dimensions", "use dims, the dimension of each bar; len(bars) counts the bars"),
    ("birth death", "use births, deaths, arrays with a number for each bar"),
    ("lifetimes lengths persistences", "use deaths - births"),
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
    ("HeatKernel Scaler Filtering ForgetDimension ComplexPolynomial",
     "giotto-tda has it, and accepts the results of output='giotto'"),
    ("CechPersistence", "use AlphaPersistence"),
    ("WeakAlphaPersistence", "use AlphaPersistence with values='delaunay-rips'"),
    ("NumberOfPoints", "use len(bars.dgm(dim)), of the results of output='barcode'"),
    ("BirthPersistenceTransform", "bars of output='barcode' have births, deaths - births"),
    ("DimensionSelector", "use homology_dimensions of RipsPersistence and its like"),
    ("representations", "the vectors are in this module: PersistenceImage, Landscape, Atol"),
    ("DiagramSelector", "estimators leave out bars that never die if infinity='drop'"),
    ("SlidingWindow TakensEmbedding SingleTakensEmbedding TimeDelayEmbedding",
     "use ph.delay_embedding"),
    ("Binarizer HeightFiltration RadialFiltration DilationFiltration ErosionFiltration "
     "SignedDistanceFiltration DensityFiltration Inverter Padder",
     "giotto-tda has it; CubicalPersistence accepts its images"),
    ("KNeighborsGraph GraphGeodesicDistance ConsistentRescaling ConsecutiveRescaling",
     "giotto-tda has it; RipsPersistence with metric='precomputed' accepts its results"),
    ("FlagserPersistence", "giotto-tda has it"),
    ("Mapper make_mapper_pipeline MapperComplex CoverComplex NerveComplex GraphInducedComplex",
     "KeplerMapper and giotto-tda have it"),
)

# Functions and classes that a package has and the drop-in for it does not have.
MISSING_NAMES = {
    "persim": _as_in_module(
        "PersistenceImager PersImage PersLandscapeExact PersLandscapeApprox PersistenceLandscaper "
        "heat persistent_entropy") | _table(
        ("sliced_wasserstein", "use ph.sliced_wasserstein"),
        ("bottleneck_matching", "use ph.bottleneck_matching(a, b).plot()"),
        ("wasserstein_matching", "use ph.wasserstein_matching(a, b).plot()"),
        ("gromov_hausdorff plot_landscape plot_landscape_simple death_vector vectorize snap_pl "
         "lc_approx average_approx average_exact", ""),
    ),
    "gudhi": _as_in_module(
        "SimplexTree AlphaComplex DelaunayComplex DelaunayCechComplex WitnessComplex "
        "StrongWitnessComplex EuclideanWitnessComplex EuclideanStrongWitnessComplex") | _table(
        ("choose_n_farthest_points", "ph.farthest_points gives the indices of the points"),
        ("sparsify_point_set", "ph.farthest_points(X, radius=r) thins points out"),
        ("plot_persistence_barcode", "use bars.plot('barcode')"),
        ("plot_persistence_diagram", "use bars.plot()"),
        ("read_points_from_off_file", "ph.read(path).vertices has the points of an OFF file"),
        ("read_persistence_intervals_in_dimension read_persistence_intervals_grouped_by_dimension",
         "use ph.read_barcode"),
        ("read_lower_triangular_matrix_from_csv_file", "use ph.read"),
        ("sklearn.CechPersistence",
         "use libph.sklearn.AlphaPersistence with values='delaunay-cech'"),
        ("CoverComplex MapperComplex NerveComplex GraphInducedComplex TangentialComplex "
         "pick_n_random_points plot_persistence_density write_points_to_off_file", ""),
    ),
    "hdbscan": _table(
        ("BranchDetector detect_branches_in_clusters approximate_predict_branch",
         "ph.lower_star of minus the eccentricities has a bar for each branch"),
    ),
}
MISSING_MODULES = {
    "persim": _as_in_module("landscapes heat persistent_entropy") | _table(
        ("images images_kernels images_weights", MODULE["PersistenceImage"]),
        ("sliced_wasserstein", "use ph.sliced_wasserstein"),
        ("gromov_hausdorff", ""),
    ),
    "gudhi": _as_in_module("representations clustering subsampling point_cloud") | _table(
        ("wasserstein.barycenter", "use ph.barycentre"),
        ("persistence_graphical_tools", "use bars.plot()"),
        ("alpha_complex delaunay_complex", "use ph.alpha"),
        ("off_utils off_reader", "use ph.read"),
        ("reader_utils", "use ph.read_barcode"),
        ("sklearn.cech_persistence",
         "use libph.sklearn.AlphaPersistence with values='delaunay-cech'"),
        ("tensorflow", "libph.torch and libph.gradients differentiate bars"),
        ("cover_complex tangential_complex nerve_gic datasets witness_complex "
         "strong_witness_complex euclidean_witness_complex euclidean_strong_witness_complex", ""),
    ),
    "hdbscan": _table(
        ("branches branch_data", "ph.lower_star of minus the eccentricities has a bar for each "
         "branch"),
        ("flat", "HDBSCAN takes cluster_selection_epsilon"),
        ("dist_metrics", ""),
    ),
}

# Objects of other packages, by two of their attributes.
OBJECTS = [
    ("adjacency edges", "networkx.to_scipy_sparse_array(graph) has the lengths of its edges, which "
     "ph.rips reads with metric='precomputed'; list(graph.edges) are simplices for ph.lower_star"),
    ("get_filtration get_simplices", "ph.filtered(*zip(*tree.get_filtration())) reads a simplex tree"),
    ("get_edgelist vs", "graph.get_adjacency_sparse('weight') has the lengths of its edges, which "
     "ph.rips reads with metric='precomputed'; graph.get_edgelist() are simplices for ph.lower_star"),
    ("points", ".points has its points"),
    ("vertices", ".vertices has its points"),
]

# Names of keywords with the same meaning, those of libph first. A name that a function lacks stands
# for the one that it has.
SAME = [row.split() for row in (
    "max_dim maxdim max_dimension maxdimension max_homology_dim upper_dim",
    "homology_dimensions dim dims dimension dimensions homology_dimension plot_only",
    "threshold thresh max_edge_length max_edge maxscale max_scale max_filtration",
    "field coeff homology_coeff_field prime modulus",
    "subsample n_perm n_landmarks landmarks",
    "n n_perm n_landmarks n_points nb_points n_clusters",
    "threads n_jobs n_threads num_threads nthreads workers",
    "memory_limit memory max_memory",
    "timeout time_limit",
    "progress verbose verbosity show_progress",
    "collapse collapse_edges edge_collapse",
    "weights weight_params",
    "weight_power weight weight_function",
    "superlevel super_level superlevel_sets upper_level",
    "periodic periodic_dimensions periodic_axes pbc",
    "period box box_size",
    "order p",
    "minkowski_p p",
    "ground internal_p q",
    "relative_error delta e epsilon",
    "directions M n_directions num_directions",
    "range sample_range grid_range",
    "persistence_range pers_range",
    "resolution n_bins num_samples num_bins num_steps n_values",
    "layers n_layers num_landscapes n_landscapes",
    "sigma bandwidth",
    "normalised normalized normalise normalize",
    "min_persistence min_pers min_lifetime min_length persistence_threshold merge_threshold",
    "infinity infinity_values",
    "seed random_state random_seed rng",
    "centres n_clusters quantiser",
    "density density_type",
    "k n_neighbors n_neighbours min_samples knn",
    "delay tau time_delay lag",
    "window window_size",
    "step stride",
    "squared output_squared_values",
    "intrinsics K camera_matrix camera_intrinsics",
    "voxel voxel_size leaf_size voxel_resolution",
    "plane_distance distance_threshold ransac_threshold plane_threshold",
    "max_range depth_trunc max_depth",
    "colours colors rgb",
)]

_SIZES = "spacing sampling voxel_spacing voxel_size voxelsize pixel_size pixdim zooms"  # of voxels

# Names of keywords that need more words: the names, the keywords of libph that a function must have
# for the hint to apply, and the hint. These rows come before SAME.
EXPLAINED = [
    ("sublevel sublevel_set sublevel_sets sublevelset sub_level lower_level", "superlevel",
     "sublevel sets are the default, superlevel=True takes superlevel sets"),
    ("mask roi", "construction nan",
     "nan='drop' leaves out the voxels that are NaN: np.where(mask, image, np.nan)"),
    ("mask roi", "intrinsics",
     "cloud[mask] chooses points, np.where(mask, depth, np.nan) chooses pixels"),
    (_SIZES, "construction", "bars do not depend on the size of voxels; "
     "ph.SpatialImage(image, affine) gives voxels their places"),
    (_SIZES, "affine", "did you mean affine=np.diag([dx, dy, dz, 1])?"),
    ("connectivity neighbours neighbors neighborhood", "construction",
     "construction='vertices' joins 4 or 6 neighbours, construction='cells' 8 or 26"),
    ("filtration", "construction",
     "construction='vertices' is the V-construction, construction='cells' the T-construction"),
    ("embedded", "construction", "np.pad(-image, 1, constant_values=-np.inf) is the embedded image"),
    ("location locations", "construction representatives",
     "representatives='voxels' keeps places: bars.birth_voxel(i), bars.death_voxel(i)"),
    ("homology_dimensions homology_dimension dims dimensions dim top_dim", "min_dim max_dim",
     "min_dim and max_dim are the ends of a range: max_dim=1 gives H0 and H1, "
     "min_dim=2, max_dim=2 gives H2 alone"),
    ("max_dim maxdim max_dimension maxdimension max_homology_dim", "homology_dimensions",
     "did you mean homology_dimensions? It lists the dimensions: (0, 1, 2)"),
    ("max_dimension", "max_dim",
     "did you mean max_dim? It is the highest dimension of bars, one less than GUDHI's max_dimension"),
    ("stride", "delay window step",
     "step moves windows; for every n-th row, take the result's [::n]"),
    ("k", "layers", "did you mean 'layers'?"),
    ("reverse invert", "superlevel", "did you mean 'superlevel'?"),
    ("reps representative generator", "representatives", "did you mean 'representatives'?"),
    ("fx fy cx cy", "intrinsics", "did you mean intrinsics=(fx, fy, cx, cy)?"),
    ("parts", "objects min_part", "did you mean objects=False? It keeps the visible parts apart"),
    ("plane_removal remove_plane ransac", "plane plane_distance", "did you mean 'plane'?"),
    ("do_cocycles cocycles", "representatives", "did you mean representatives='cocycles'?"),
    ("do_cycles cycles generators", "representatives", "did you mean representatives='cycles'?"),
    ("return_generators", "representatives cells",
     "bars.birth_cells(dim) and bars.death_cells(dim) have the simplices"),
    ("distance_matrix precomputed distances dist dist_matrix D", "metric minkowski_p",
     "did you mean metric='precomputed'?"),
    ("max_radius radius", "threshold metric",
     "did you mean threshold? It is a distance: the radius of balls, times 2"),
    ("max_alpha_square", "threshold squared", "did you mean threshold, with squared=True?"),
    ("radii", "weights squared", "did you mean weights, the squares of radii: weights=radii**2?"),
    ("sparse epsilon", "approximation",
     "did you mean approximation, which is sparse / (1 - sparse)?"),
    ("reduced reduced_homology", "min_dim max_dim", "the estimators of libph.sklearn take "
     "reduced=True, which leaves out the component that never dies"),
    ("metric", "distance order", "did you mean 'distance'?"),
    ("im_range image_range", "birth_range persistence_range",
     "did you mean birth_range and persistence_range?"),
    ("pixel_size", "birth_range persistence_range", "did you mean resolution? It counts pixels, "
     "between the ends that birth_range and persistence_range give"),
    ("kernel_params", "bandwidth", "did you mean bandwidth, the standard deviation of a bar?"),
    ("cluster_tolerance eps tolerance", "min_part voxel",
     "objects end at seams, and no distance separates them; voxel sets the scale; with "
     "method='paper', distance joins the voxels that are at most so far apart"),
    ("min_cluster_size min_samples min_points", "min_part",
     "did you mean min_size, which counts voxels?"),
    ("title xlabel ylabel xlim ylim", "ax noise",
     "the result is an Axes of matplotlib: bars.plot().set(title='bars')"),
    ("legend", "ax noise", "the result is an Axes of matplotlib: bars.plot().legend()"),
    ("figsize size", "ax noise",
     "ax takes an Axes of any size, which matplotlib.pyplot.subplots makes"),
    ("path file filename savefig save", "ax noise",
     "the result belongs to a figure: bars.plot().figure.savefig('bars.png')"),
    ("show", "ax noise", "matplotlib.pyplot.show() shows the picture"),
]

# Pairs of opposites.
OPPOSITES = [("min", "max"), ("sub", "super"), ("lower", "upper"), ("before", "after"),
             ("birth", "death")]
