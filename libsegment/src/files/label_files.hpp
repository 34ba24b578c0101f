// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The formats in which labels alone are written.
enum class LabelFormat { npy, png, csv };

/// One label a point of the scene, as the bytes of a file: an array of uint32 or, of organised
/// clouds, a picture of 16 bits, both of rows and columns; or a line each.
/// @throws Error (bad_data) on labels that a picture cannot hold.
std::string label_bytes(const SceneTree& scene, std::span<const std::uint32_t> labels,
                        LabelFormat format);

}  // namespace ph::segment
