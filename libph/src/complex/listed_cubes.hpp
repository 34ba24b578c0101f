// SPDX-License-Identifier: MIT
#pragma once
#include "ph/cubical.hpp"
#include "ph/explicit.hpp"

namespace ph {

/// The cubical complex of an image, cube by cube as the definition has it: in the V-construction a
/// cube enters with the last of its vertices, in the T-construction with the first of the top cubes
/// around it; a cube that needs an absent or infinite voxel is not there.
///
/// A slow path beside `Cubical`, with which it shares the checks of its arguments and nothing else:
/// what the oracle is given, so that it does not see an image through the eyes of what it checks.
/// 2^d cells a voxel, 40 bytes for each and for each of their facets. Cells are numbered by their
/// place in the doubled grid among those that are there.
/// @throws Error (bad_data) on NaN unless the image is masked, or sizes that disagree; Error
///         (resource) beyond the memory limit.
ExplicitComplex listed_cubes(const Image& image, const CubicalOptions& options = {},
                             const RunContext& context = default_context());

}  // namespace ph
