// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/alpha/intervals/intervals.hpp"
#include "libph/src/alpha/periodic/images.hpp"

namespace ph::alpha {

/// Gives the vertices of a cell, facet or edge as indices into `places`, for computations with
/// coordinates. If the space is periodic, the places of a simplex are images of its sites that lie
/// near each other; otherwise they are the sites. All frames of a simplex are translates of each
/// other, and differences of coordinates are exact.
class Frames {
 public:
  /// @param images null if the space is not periodic. Both arguments must outlive the frames.
  Frames(const AlphaCells& cells, const Images* images) : cells_(cells), images_(images) {}

  // mutant: alpha-places
  const Sites& places() const { return images_ == nullptr ? cells_.sites : images_->places; }
  const std::array<std::uint32_t, 4>& of_cell(std::size_t t) const {
    return images_ == nullptr ? cells_.triangulation.cells[t] : images_->of_cell[t];
  }
  std::array<std::uint32_t, 3> of_facet(std::uint32_t code) const {
    return facet_of(of_cell(code >> 2), code & 3, cells_.dim());
  }
  const std::array<std::uint32_t, 2>& of_edge(std::uint32_t e) const {
    return images_ == nullptr ? cells_.edges.ends[e] : images_->of_edge[e];
  }

 private:
  const AlphaCells& cells_;
  const Images* images_;
};

}  // namespace ph::alpha
