// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The formats for labels without a cloud.
enum class LabelFormat { npy, png, csv };

/// The file with one label per point of the scene: an array of uint32 or, for an organised cloud, a
/// 16-bit picture, both with its rows and columns; or one label per line.
/// @throws Error (bad_data) on labels that a picture cannot hold.
std::string label_bytes(const SceneTree& scene, std::span<const std::uint32_t> labels,
                        LabelFormat format);

}  // namespace ph::segment
