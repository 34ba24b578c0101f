// SPDX-License-Identifier: MIT
#include "ph/detail/rips/rips_vertices.hpp"

#include <fmt/format.h>

#include <numeric>

#include "ph/error.hpp"

namespace ph {

RipsVertices::RipsVertices(Index size, std::span<const std::uint32_t> chosen,
                           std::span<const double> births, WeightExponent exponent,
                           std::optional<double> threshold, const RunContext& context)
    : are_all_(chosen.empty()),
      members_(chosen.begin(), chosen.end(), &context.memory),
      births_(&context.memory),
      exponent_(exponent) {
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (Index{chosen[i]} >= size || (i > 0 && chosen[i] <= chosen[i - 1])) {
      throw Error(ErrorKind::usage, fmt::format("vertices: found point {} at position {}, expected "
                                                "ascending points below {}",
                                                chosen[i], i, size));
    }
  }
  if (births.empty()) return;
  if (static_cast<Index>(births.size()) != size) {
    throw Error(ErrorKind::usage, fmt::format("births of vertices: found {}, expected one for each "
                                              "of {} points",
                                              births.size(), size));
  }
  for (std::size_t v = 0; v < births.size(); ++v) {
    if (!(births[v] >= 0 && births[v] <= std::numeric_limits<double>::max())) {
      throw Error(
          ErrorKind::bad_data,
          fmt::format("vertex {}: found birth {}, expected a finite number >= 0", v, births[v]));
    }
  }
  // mutant: weights-late
  const auto is_late = [&](std::uint32_t v) { return threshold && births[v] > *threshold; };
  if (are_all_) {
    members_.resize(births.size());
    std::iota(members_.begin(), members_.end(), 0U);
  }
  const std::size_t late = std::erase_if(members_, is_late);
  are_all_ = are_all_ && late == 0;
  births_.reserve(members_.size());
  for (const std::uint32_t v : members_) births_.push_back(births[v] + 0.0);
  if (are_all_) members_.clear();
}

}  // namespace ph
