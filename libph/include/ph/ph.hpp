// SPDX-License-Identifier: MIT
#pragma once
// The umbrella: complexes, engines, barcodes; and, where ph::io is linked, files.
#include "ph/complex/cubical.hpp"
#include "ph/complex/explicit.hpp"
#include "ph/complex/filtered_graph.hpp"
#include "ph/complex/lower_star.hpp"
#include "ph/complex/rips.hpp"
#include "ph/complex/voxel_image.hpp"
#include "ph/engine/merge_tree.hpp"
#include "ph/estimate.hpp"
#include "ph/loops.hpp"
#include "ph/metric/distance_to_measure.hpp"
#include "ph/persistence.hpp"
