// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/io/cloud_data.hpp"
#include "ph/detail/io/png.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The segments that look adjacent to a viewer: neighbours[i] lists the segments (labels minus one)
/// next to segment i, ascending. In an image, these are segments less than five pixels apart, even
/// if one stands far behind the other; in a cloud without rows, they are touching segments
/// (Segment::neighbours).
std::vector<std::vector<std::size_t>> neighbouring_segments(const Cloud& cloud,
                                                            const SceneCut& cut);

/// One colour per segment, 0x00RRGGBB, from a palette that works with any common kind of colour
/// blindness (Okabe & Ito 2008). Neighbours differ as long as no segment has more than six
/// neighbours; the rest of the palette is used evenly.
std::vector<std::uint32_t> segment_colours(const std::vector<std::vector<std::size_t>>& neighbours);

/// Colours from the same palette, chosen by the numbers of the objects (from 1): an object keeps
/// its colour throughout a stream.
std::vector<std::uint32_t> object_colours(std::span<const std::uint32_t> numbers);

/// The colours of the segments in pictures and reports: chosen by number if `numbers` are given,
/// otherwise such that neighbours differ. @param cloud null: a stored tree was cut.
std::vector<std::uint32_t> shown_colours(const Cloud* cloud, const SceneCut& cut,
                                         std::span<const std::uint32_t> numbers);

/// Brightness 0…255 of each point (ITU-R BT.601); in a cloud without colours, it follows the depth,
/// and near points are bright.
std::vector<int> brightness(const Cloud& cloud);

/// The points with x, y, z, `rgba` and `label`: segments in their colours, all other points in
/// grey, with their brightness. Points, order and organisation are kept.
Cloud coloured_cloud(const Cloud& cloud, std::span<const std::uint32_t> labels,
                     std::span<const std::uint32_t> colours);

/// A picture of an organised cloud, RGB: its colours (or else its depth) in grey, with segments
/// tinted and outlined.
/// @throws Error (bad_data) if the cloud is not organised.
Raster picture(const Cloud& cloud, std::span<const std::uint32_t> labels,
               std::span<const std::uint32_t> colours);

}  // namespace ph::segment
