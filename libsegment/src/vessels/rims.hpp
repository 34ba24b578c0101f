// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

#include "ph/segment.hpp"
#include "scene/parts.hpp"

namespace ph::segment {

/// Finds the inside and the outside of round vessels (bowls, cups, pots) whose rims are too thin to
/// show a surface that both share: the upper ends of both parts are at the same height and lie on
/// one circle, each on its own arc, and together the arcs cover nearly the whole circle.
/// @param up unit normal of the support. @param join is called with the numbers of two parts.
/// @throws Error (cancelled) as `context` asks.
void join_around_rims(const Points& centroids, double voxel, const Vec3& up, const Parts& parts,
                      const std::function<void(std::uint32_t, std::uint32_t)>& join,
                      const RunContext& context = default_context());

}  // namespace ph::segment
