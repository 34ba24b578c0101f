// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/stages.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libsegment/src/scene/options.hpp"
#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/error.hpp"

namespace ph::segment {

void find_neighbours(const MergeTree& tree, const Contacts& contacts, SceneCut& cut) {
  const std::vector<std::uint32_t>& label = cut.vertex_labels;
  std::vector<double> birth(cut.segments.size() + 1, kInfinity);
  for (std::size_t v = 0; v < label.size(); ++v)
    birth[label[v]] = std::min(birth[label[v]], tree.births[v]);
  for (const auto& [both, value] : contacts) {
    cut.segments[both.first - 1].neighbours.push_back({both.second, value});
    cut.segments[both.second - 1].neighbours.push_back({both.first, value});
  }
  for (Segment& s : cut.segments) {
    if (s.neighbours.empty()) continue;
    // Neighbours with equal values stay in the order of the labels.
    std::ranges::stable_sort(s.neighbours, {}, &Neighbour::meets_at);
    s.neighbour = s.neighbours.front().label;
    s.meets_at = s.neighbours.front().meets_at;
    s.persistence = s.meets_at - birth[s.label];
  }
}

std::optional<Meeting> first_meeting(const SceneTree& scene, const SceneCut& cut, std::uint32_t a,
                                     std::uint32_t b) {
  validate(scene, cut);
  for (const std::uint32_t label : {a, b})
    if (label == 0 || label > cut.segments.size())
      throw Error(ErrorKind::usage,
                  fmt::format("{}: found segment {}, expected one of 1 to {}",
                              mark(Setting::first_meeting), label, cut.segments.size()));
  if (a == b)
    throw Error(ErrorKind::usage,
                fmt::format("{}: found segment {} twice, expected two different segments",
                            mark(Setting::first_meeting), a));
  // The parts of a segment count as joined from the start.
  DisjointSets sets(cut.vertex_labels.size(), std::pmr::get_default_resource());
  const auto join = [&](std::uint32_t u, std::uint32_t v) {
    const std::uint32_t x = sets.find(u), y = sets.find(v);
    if (x != y) sets.link(x, y);
  };
  const auto first_of = [&](std::uint32_t label) {
    return static_cast<std::uint32_t>(std::ranges::find(cut.vertex_labels, label) -
                                      cut.vertex_labels.begin());
  };
  const std::uint32_t first_a = first_of(a), first_b = first_of(b);
  for (std::uint32_t v = 0; v < cut.vertex_labels.size(); ++v) {
    if (cut.vertex_labels[v] == a) join(v, first_a);
    if (cut.vertex_labels[v] == b) join(v, first_b);
  }
  for (const Merge& m : scene.merge_tree.merges) {
    join(static_cast<std::uint32_t>(m.u), static_cast<std::uint32_t>(m.v));
    if (sets.find(first_a) != sets.find(first_b)) continue;
    Meeting meeting{.value = m.value};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Index>(k);
      meeting.at[k] = (scene.vertices(m.u, axis) + scene.vertices(m.v, axis)) / 2;
    }
    return meeting;
  }
  return std::nullopt;
}

}  // namespace ph::segment
