// SPDX-License-Identifier: MIT
#include "ph/detail/segment/colouring.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "ph/error.hpp"

namespace ph::segment {
namespace {

// The palette of Masataka Okabe and Kei Ito, "Color Universal Design" (2008), without black. Strong
// contrasts come first.
constexpr std::array<std::uint32_t, 7> kPalette = {0xE69F00, 0x0072B2, 0x009E73, 0xCC79A7,
                                                   0x56B4E9, 0xD55E00, 0xF0E442};
constexpr Index kReach = 4;  // in pixels

using Neighbours = std::vector<std::vector<std::size_t>>;

void join(Neighbours& neighbours, std::size_t a, std::size_t b) {
  neighbours[a].push_back(b);
  neighbours[b].push_back(a);
}

Neighbours neighbours_in_image(Index width, Index height, const SceneCut& s) {
  Neighbours neighbours(s.segments.size());
  const auto label = [&](Index x, Index y) {
    return s.labels[static_cast<std::size_t>(y * width + x)];
  };
  std::uint64_t last = 0;  // consecutive pixels often repeat a pair, which is listed once
  for (Index y = 0; y < height; ++y) {
    for (Index x = 0; x < width; ++x) {
      const std::uint32_t a = label(x, y);
      if (a == 0) continue;
      for (Index step = 1; step <= kReach; ++step) {
        for (const bool right : {true, false}) {
          const Index u = right ? x + step : x, v = right ? y : y + step;
          if (u >= width || v >= height) continue;
          const std::uint32_t b = label(u, v);
          const std::uint64_t pair = std::uint64_t{a} << 32 | b;
          if (b == 0 || b == a || pair == last) continue;
          last = pair;
          join(neighbours, a - 1, b - 1);
        }
      }
    }
  }
  return neighbours;
}

Neighbours neighbours_that_touch(const std::vector<Segment>& segments) {
  Neighbours neighbours(segments.size());
  for (const Segment& s : segments)
    for (const Neighbour& n : s.neighbours) neighbours[s.label - 1].push_back(n.label - 1);
  return neighbours;
}

struct Rgb {
  int r = 0, g = 0, b = 0;
};

Rgb unpack(std::uint32_t c) {
  return {static_cast<int>(c >> 16 & 255), static_cast<int>(c >> 8 & 255),
          static_cast<int>(c & 255)};
}

}  // namespace

std::vector<int> brightness(const Cloud& cloud) {
  std::vector<int> result(static_cast<std::size_t>(cloud.size()), 128);
  if (const auto colours = cloud.rgb()) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      const Rgb c = unpack((*colours)[i]);
      result[i] = (299 * c.r + 587 * c.g + 114 * c.b) / 1000;
    }
    return result;
  }
  const std::vector<float> xyz = cloud.xyz();
  double nearest = kInfinity, farthest = -kInfinity;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double z = xyz[3 * i + 2];
    if (!std::isfinite(z)) continue;
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double z = xyz[3 * i + 2];
    if (!std::isfinite(z)) {
      result[i] = 0;
    } else if (farthest > nearest) {
      result[i] = static_cast<int>(224 - 160 * (z - nearest) / (farthest - nearest));
    }
  }
  return result;
}

std::vector<std::vector<std::size_t>> neighbouring_segments(const Cloud& cloud,
                                                            const SceneCut& cut) {
  Neighbours neighbours = cloud.organised() ? neighbours_in_image(cloud.width, cloud.height, cut)
                                            : neighbours_that_touch(cut.segments);
  for (std::vector<std::size_t>& list : neighbours) {
    std::ranges::sort(list);
    const auto same = std::ranges::unique(list);
    list.erase(same.begin(), same.end());
  }
  return neighbours;
}

std::vector<std::uint32_t> segment_colours(const Neighbours& neighbours) {
  constexpr std::size_t none = kPalette.size();
  std::vector<std::size_t> choice(neighbours.size(), none);
  std::array<std::size_t, kPalette.size()> uses{};
  std::vector<std::uint32_t> colours;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    std::array<std::size_t, kPalette.size()> clashes{};
    for (const std::size_t j : neighbours[i]) {
      if (choice[j] != none) ++clashes[choice[j]];
    }
    std::size_t best = 0;
    for (std::size_t c = 1; c < kPalette.size(); ++c) {
      if (std::pair(clashes[c], uses[c]) < std::pair(clashes[best], uses[best])) best = c;
    }
    choice[i] = best;
    ++uses[best];
    colours.push_back(kPalette[best]);
  }
  return colours;
}

std::vector<std::uint32_t> label_colours(const SceneCut& cut) {
  return segment_colours(neighbours_that_touch(cut.segments));
}

std::vector<std::uint32_t> object_colours(std::span<const std::uint32_t> numbers) {
  std::vector<std::uint32_t> colours;
  for (const std::uint32_t number : numbers)
    colours.push_back(kPalette[(number - 1) % kPalette.size()]);
  return colours;
}

std::vector<std::uint32_t> shown_colours(const Cloud* cloud, const SceneCut& cut,
                                         std::span<const std::uint32_t> numbers) {
  if (!numbers.empty()) return object_colours(numbers);
  return cloud ? segment_colours(neighbouring_segments(*cloud, cut)) : label_colours(cut);
}

Cloud coloured_cloud(const Cloud& cloud, std::span<const std::uint32_t> labels,
                     std::span<const std::uint32_t> colours) {
  const std::vector<float> xyz = cloud.xyz();
  const std::vector<int> grey = brightness(cloud);
  Cloud result;
  result.width = cloud.width;
  result.height = cloud.height;
  result.viewpoint = cloud.viewpoint;
  result.fields = {{"x", FieldType::float32, 1, 0},
                   {"y", FieldType::float32, 1, 4},
                   {"z", FieldType::float32, 1, 8},
                   {"rgba", FieldType::uint32, 1, 12},
                   {"label", FieldType::uint32, 1, 16}};
  result.stride = 20;
  result.data.resize(result.stride * labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto g = static_cast<std::uint32_t>(grey[i]);
    const std::uint32_t colour = labels[i] != 0 ? colours[labels[i] - 1] : g << 16 | g << 8 | g;
    const std::uint32_t opaque = 0xFF000000U | colour;
    std::byte* record = &result.data[result.stride * i];
    std::memcpy(record, &xyz[3 * i], 12);
    std::memcpy(record + 12, &opaque, 4);
    std::memcpy(record + 16, &labels[i], 4);
  }
  return result;
}

Raster picture(const Cloud& cloud, std::span<const std::uint32_t> labels,
               std::span<const std::uint32_t> colours) {
  if (!cloud.organised()) {
    throw Error(ErrorKind::bad_data,
                "picture: found an unorganised cloud, expected one with rows and columns");
  }
  const std::vector<int> grey = brightness(cloud);
  const Index width = cloud.width, height = cloud.height;
  Raster raster{width, height, 3, 8, {}};
  raster.samples.reserve(labels.size() * 3);
  const auto at = [&](Index x, Index y) { return labels[static_cast<std::size_t>(y * width + x)]; };
  const auto differs = [&](Index x, Index y, std::uint32_t label) {
    return x >= 0 && y >= 0 && x < width && y < height && at(x, y) != label;
  };
  // An outline separates a segment only from regions larger than a speck. Gaps of a few pixels get
  // no outline.
  const auto ends_at = [&](Index x, Index y, Index dx, Index dy, std::uint32_t label) {
    return differs(x + dx, y + dy, label) && differs(x + kReach * dx, y + kReach * dy, label);
  };
  for (Index y = 0; y < height; ++y) {
    for (Index x = 0; x < width; ++x) {
      const std::uint32_t label = at(x, y);
      const int g = grey[static_cast<std::size_t>(y * width + x)];
      const bool border = ends_at(x, y, -1, 0, label) || ends_at(x, y, 1, 0, label) ||
                          ends_at(x, y, 0, -1, label) || ends_at(x, y, 0, 1, label);
      Rgb c{g, g, g};
      if (label != 0 && border) {
        c = {255, 255, 255};
      } else if (label != 0) {
        const Rgb tint = unpack(colours[label - 1]);
        // The result is 70 % colour and 30 % of the camera's brightness, so that the hue of the
        // palette remains.
        c = {(7 * tint.r + 3 * g) / 10, (7 * tint.g + 3 * g) / 10, (7 * tint.b + 3 * g) / 10};
      }
      for (const int channel : {c.r, c.g, c.b}) {
        raster.samples.push_back(static_cast<std::uint16_t>(channel));
      }
    }
  }
  return raster;
}

}  // namespace ph::segment
