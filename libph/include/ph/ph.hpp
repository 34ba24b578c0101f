// SPDX-License-Identifier: MIT
#pragma once
// The umbrella header: complexes, engines, barcodes. For files see ph/io/read.hpp and
// ph/io/write.hpp.
#include "ph/cluster_tree.hpp"
#include "ph/cubical.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/estimate.hpp"
#include "ph/explicit.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/loops.hpp"
#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "ph/rips.hpp"
#include "ph/voxel_image.hpp"
