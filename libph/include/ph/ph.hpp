// SPDX-License-Identifier: MIT
#pragma once
// The umbrella header of ph::core: complexes, barcodes, distances between them, clusters, vectors.
// Files are in ph/io/read.hpp and ph/io/save.hpp, and complexes that need CGAL in ph/alpha.hpp.
#include "ph/cluster_tree.hpp"
#include "ph/cubical.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/distances.hpp"
#include "ph/estimate.hpp"
#include "ph/euler_curve.hpp"
#include "ph/explicit.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/loops.hpp"
#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "ph/rips.hpp"
#include "ph/significance.hpp"
#include "ph/vectorise.hpp"
#include "ph/voxel_image.hpp"
