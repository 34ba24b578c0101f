// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <vector>

#include "libph/src/alpha/periodic/box.hpp"
#include "libph/src/alpha/sites/sites.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::alpha {

/// A translation by entire periods, with the periods of all axes packed into one number.
/// Translations are added, subtracted and compared (x first) by adding, subtracting and comparing
/// these numbers.
using Translation = std::int64_t;
inline constexpr int kBitsOfAxis = 21;
inline constexpr std::int64_t kMostPeriods = std::int64_t{1} << (kBitsOfAxis - 3);

constexpr Translation translation_by(const std::array<std::int64_t, 3>& periods) {
  constexpr std::int64_t base = std::int64_t{1} << kBitsOfAxis;
  return (periods[0] * base + periods[1]) * base + periods[2];
}
/// The inverse of translation_by: the number of periods along each axis.
constexpr std::array<std::int64_t, 3> periods_of(Translation translation) {
  constexpr std::int64_t base = std::int64_t{1} << kBitsOfAxis, half = base / 2;
  std::array<std::int64_t, 3> periods{};
  for (std::size_t axis = 3; axis-- > 0;) {
    periods[axis] = ((translation + half) & (base - 1)) - half;
    translation = (translation - periods[axis]) / base;
  }
  return periods;
}

/// A periodic space unrolled around its box. It consists of *places*, which are the sites and their
/// images. Places are numbered by site and then by translation. Translating all places by the same
/// vector leaves their order unchanged.
struct Images {
  explicit Images(std::pmr::memory_resource* memory)
      : places(memory),
        site(memory),
        translation(memory),
        begin(memory),
        of_cell(memory),
        of_edge(memory) {}

  Sites places;                          ///< the images as sites of a space that is not periodic
  std::pmr::vector<std::uint32_t> site;  ///< indexed by place
  std::pmr::vector<Translation> translation;  ///< indexed by place
  /// For each site, its first place. The last entry is the number of places.
  std::pmr::vector<std::uint32_t> begin;
  /// The frame of each cell of the quotient and, in dimension 3, of each edge. A frame consists of
  /// places of the vertices that are near each other.
  RawVector<std::array<std::uint32_t, 4>> of_cell;
  RawVector<std::array<std::uint32_t, 2>> of_edge;

  /// The place of an image of a site, or kNone if that image is not listed.
  std::uint32_t place_of(std::uint32_t its_site, Translation its_translation) const {
    for (std::uint32_t place = begin[its_site]; place < begin[its_site + 1]; ++place)
      if (translation[place] == its_translation) return place;
    return kNone;
  }
};

/// For a point, the distance beyond the closed faces of the box up to which its images are wanted.
using Margin = std::function<double(const Vector<double>&)>;

/// Lists all images of the sites up to their margins.
/// @throws Error (resource) if there are too many images; Error (cancelled).
Images images_within(const Sites& sites, const Box& box, const Margin& margin_of,
                     const RunContext& context);

}  // namespace ph::alpha
