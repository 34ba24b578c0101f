// SPDX-License-Identifier: MIT
#pragma once
#include "ph/cubical.hpp"
#include "ph/explicit.hpp"

namespace ph {

/// The cubical complex of an image, cube by cube as in the definition: in the V-construction a cube
/// enters with its last vertex, in the T-construction with the first top cube around it; a cube
/// whose value an absent or infinite voxel decides does not exist.
///
/// A slow alternative to `Cubical`, with which it shares only the checks of its arguments: the
/// oracle uses it in order to be independent of the code that it checks. It has 2^d cells per
/// voxel, and takes 40 bytes per cell and per facet of each cell. Existing cells are numbered by
/// their place in the doubled grid.
/// @throws Error (bad_data) on NaN unless the image is masked, or sizes that disagree; Error
///         (resource) beyond the memory limit.
ExplicitComplex listed_cubes(const Image& image, const CubicalOptions& options = {},
                             const RunContext& context = default_context());

}  // namespace ph
