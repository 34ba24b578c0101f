// SPDX-License-Identifier: MIT
#include "libph/src/diagram/diagram_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "ph/error.hpp"

namespace ph::diagram {

DiagramParts::DiagramParts(std::span<const Bar> bars, std::string_view function) {
  struct Placed {
    Point point;
    std::uint32_t place;
  };
  std::vector<Placed> placed;
  if (bars.size() >= kNone)
    throw Error(ErrorKind::resource, fmt::format("{}: found {} bars, expected fewer than 2^32 - 1",
                                                 function, bars.size()));
  for (std::uint32_t i = 0; i < bars.size(); ++i) {
    const Bar& bar = bars[i];
    if (!(bar.birth <= bar.death))
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: found a bar [{}, {}), expected birth <= death", function,
                              bar.birth, bar.death));
    if (bar.birth == bar.death) continue;
    const bool has_birth = bar.birth > -kInfinity, has_death = bar.death < kInfinity;
    if (has_birth && has_death)
      placed.push_back({{bar.birth, bar.death}, i});
    else if (has_birth || has_death)
      rays[has_birth ? 0 : 1].push_back({has_birth ? bar.birth : bar.death, i});
    else
      lines.push_back(i);
  }
  std::ranges::stable_sort(placed, std::greater<>(),
                           [](const Placed& p) { return to_diagonal(p.point); });
  for (const auto& [point, place] : placed) {
    finite.push_back(point);
    places.push_back(place);
  }
  for (auto& ends : rays) std::ranges::stable_sort(ends, {}, &PlacedEnd::value);
}

bool have_as_many_infinite(const DiagramParts& a, const DiagramParts& b) {
  return a.lines.size() == b.lines.size() && a.rays[0].size() == b.rays[0].size() &&
         a.rays[1].size() == b.rays[1].size();
}

void pair_infinite(const DiagramParts& a, const DiagramParts& b,
                   std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  for (const std::size_t k : {0U, 1U})
    for (std::size_t i = 0; i < a.rays[k].size(); ++i)
      pairs.emplace_back(a.rays[k][i].place, b.rays[k][i].place);
  for (std::size_t i = 0; i < a.lines.size(); ++i) pairs.emplace_back(a.lines[i], b.lines[i]);
}

void check(const DistanceLimits& limits, std::string_view function) {
  if (!(limits.relative_error >= 0 && limits.relative_error < kInfinity))
    throw Error(ErrorKind::usage,
                fmt::format("{}: relative_error: found {}, expected a finite number >= 0", function,
                            limits.relative_error));
  if (std::isnan(limits.at_most))
    throw Error(ErrorKind::usage,
                fmt::format("{}: at_most: found nan, expected a number", function));
}

}  // namespace ph::diagram
