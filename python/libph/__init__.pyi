# SPDX-License-Identifier: MIT
from . import gradients
from ._barcodes import Bar, Barcode, Chain, Loop
from ._batch import batch
from ._clusters import Clusters, ClusterTree, cluster_tree
from ._compute import alpha, boundary, cubical, filtered, lower_star, rips
from ._core import version as __version__
from ._distances import (Barycentre, Matching, barycentre, bottleneck, bottleneck_matching,
                         diagram_distances, sliced_wasserstein, wasserstein, wasserstein_matching)
from ._errors import (Cancelled, DataError, Error, InternalError, MemoryLimitError,
                      MissingInputError, NotBuiltIn, OutputError, Timeout, UsageError)
from ._estimate import Estimate, estimate
from ._files import Boundary, Mesh, Simplices, read, read_barcode
from ._images import SpatialImage, write_nifti
from ._parts import CloudPart, ImageLoops, ImagePart, cloud_part, image_part, join_parts
from ._points import (Subsample, collapse, core_distances, delay_embedding, distance_to_measure,
                      farthest_points, point_image)
from ._real_clusters import ClusterSignificance, ClusterStability
from ._report import Report, report
from ._requests import PointImage
from ._run import limits
from ._scenes import (LabelTracker, Objects, SceneSurface, Segment, Segmentation, Tracked, Voxels,
                      segment)
from ._significance import (Band, PermutationTest, confidence_band, confidence_radius, p_values,
                            permutation_test)
from ._surfaces import Surface, alpha_shape
from ._trees import MergeTree, merge_tree
from ._vectors import PiecewiseLinear, StepFunction
from ._vectors._euler import euler_curve
from ._vectors._kernels import diagram_kernels

__all__ = [
    "Band", "Bar", "Barcode", "Barycentre", "Boundary", "Cancelled", "Chain", "CloudPart",
    "ClusterSignificance", "ClusterStability", "ClusterTree", "Clusters",
    "DataError", "Error", "Estimate", "ImageLoops", "ImagePart", "InternalError", "LabelTracker",
    "Loop", "Matching", "MemoryLimitError", "MergeTree", "Mesh", "MissingInputError", "NotBuiltIn",
    "Objects", "OutputError", "PermutationTest", "PiecewiseLinear", "PointImage", "Report",
    "SceneSurface", "Segment", "Segmentation", "Simplices", "SpatialImage", "StepFunction",
    "Subsample", "Surface", "Timeout", "Tracked", "UsageError", "Voxels", "__version__",
    "alpha", "alpha_shape", "barycentre", "batch",
    "bottleneck", "bottleneck_matching", "boundary", "cloud_part", "cluster_tree", "collapse", "confidence_band",
    "confidence_radius", "core_distances", "cubical", "delay_embedding", "diagram_distances", "diagram_kernels",
    "distance_to_measure",
    "estimate", "euler_curve", "farthest_points", "filtered", "gradients", "image_part",
    "join_parts", "limits", "lower_star",
    "merge_tree", "p_values", "permutation_test", "point_image", "read", "read_barcode", "report",
    "rips", "segment", "sliced_wasserstein", "wasserstein", "wasserstein_matching", "write_nifti",
]
