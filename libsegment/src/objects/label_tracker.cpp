// SPDX-License-Identifier: MIT
#include "ph/label_tracker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>

#include "options.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

/// A segment and an object that share places.
struct Overlap {
  double share;  // of their union
  std::size_t segment, object;
};

}  // namespace

LabelTracker::LabelTracker(int patience, double cell) : patience_(patience), cell_(cell) {
  if (patience < 0)
    throw Error(ErrorKind::usage,
                fmt::format("patience: found {} frames, expected 0 or more", patience));
  if (!(cell > 0) || !std::isfinite(cell))
    throw Error(ErrorKind::usage,
                fmt::format("cell: found {}, expected a positive finite length", cell));
}

std::vector<std::uint32_t> LabelTracker::update(std::span<const std::uint32_t> labels) {
  // Those that occur, ascending: a label may be as large as it likes.
  std::vector<std::uint32_t> known(labels.begin(), labels.end());
  std::ranges::sort(known);
  const auto same = std::ranges::unique(known);
  known.erase(same.begin(), same.end());
  std::erase(known, 0U);
  const auto index_of = [&](std::uint32_t label) {
    return static_cast<std::size_t>(std::ranges::lower_bound(known, label) - known.begin());
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == 0) continue;
    places.push_back({{static_cast<double>(labels.size()), static_cast<double>(i), 0, 0},
                      static_cast<std::uint32_t>(index_of(labels[i]))});
  }
  const std::vector<std::uint32_t> numbers = match(std::move(places), known.size());
  std::vector<std::uint32_t> result(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] != 0) result[i] = numbers[index_of(labels[i])];
  return result;
}

std::vector<std::uint32_t> LabelTracker::update(const SceneTree& scene, const SceneCut& cut) {
  validate(scene, cut);
  std::vector<Place> places;
  if (scene.height > 1) {
    const auto width = static_cast<std::size_t>(scene.width);
    for (std::size_t i = 0; i < cut.labels.size(); ++i) {
      if (cut.labels[i] == 0) continue;
      places.push_back({{-static_cast<double>(scene.width), static_cast<double>(scene.height),
                         static_cast<double>(i / width), static_cast<double>(i % width)},
                        cut.labels[i] - 1});
    }
  } else {
    places = cubes(scene, cut);
  }
  return match(std::move(places), cut.segments.size());
}

/// The cubes in which a segment has more points than any other.
std::vector<LabelTracker::Place> LabelTracker::cubes(const SceneTree& scene,
                                                     const SceneCut& cut) const {
  std::map<Key, std::map<std::uint32_t, Index>> points;
  const float* p = scene.xyz.data();
  for (const std::uint32_t vertex : scene.vertex_of_point) {
    if (const std::uint32_t label = cut.vertex_labels[vertex]; label != 0)
      ++points[{cell_, std::floor(p[2] / cell_), std::floor(p[1] / cell_),
                std::floor(p[0] / cell_)}][label - 1];
    p += 3;
  }
  std::vector<Place> places;
  for (const auto& [key, counts] : points) {
    const auto most = std::ranges::max_element(
        counts, [](const auto& a, const auto& b) { return a.second < b.second; });
    places.push_back({key, most->first});
  }
  return places;
}

/// @param places of segments, by key.
std::vector<std::uint32_t> LabelTracker::match(std::vector<Place> places, std::size_t segments) {
  constexpr double least = 0.25;  // of the smaller one
  std::vector<double> size_of_segment(segments), size_of_object(objects_.size());
  const auto index_of = [&](std::uint32_t number) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(objects_, number, {}, &Object::number) - objects_.begin());
  };
  for (const Place& p : places) ++size_of_segment[p.number];
  for (const Place& p : places_) ++size_of_object[index_of(p.number)];

  std::map<std::pair<std::size_t, std::size_t>, double> shared;
  std::vector<Place> uncovered;  // places of objects where no segment is now
  auto now = places.begin();
  for (const Place& before : places_) {
    while (now != places.end() && now->key < before.key) ++now;
    if (now != places.end() && now->key == before.key) {
      ++shared[{now->number, index_of(before.number)}];
    } else {
      uncovered.push_back(before);
    }
  }
  std::vector<Overlap> overlaps;
  for (const auto& [both, count] : shared) {
    const double a = size_of_segment[both.first], b = size_of_object[both.second];
    if (count > least * std::min(a, b))
      overlaps.push_back({count / (a + b - count), both.first, both.second});
  }
  std::ranges::stable_sort(overlaps, std::ranges::greater(), &Overlap::share);

  std::vector<std::uint32_t> numbers(segments, 0);
  std::vector<bool> taken(objects_.size());
  for (const Overlap& o : overlaps) {
    if (numbers[o.segment] != 0 || taken[o.object]) continue;
    numbers[o.segment] = objects_[o.object].number;
    taken[o.object] = true;
  }
  for (std::uint32_t& number : numbers)
    if (number == 0) number = next_++;

  // What is remembered: the segments, and what was seen not long ago and is not covered.
  std::vector<Object> remembered;
  for (const std::uint32_t number : numbers) remembered.push_back({number, 0});
  for (std::size_t i = 0; i < objects_.size(); ++i)
    if (!taken[i] && objects_[i].unseen < patience_)
      remembered.push_back({objects_[i].number, objects_[i].unseen + 1});
  std::ranges::sort(remembered, {}, &Object::number);
  std::erase_if(uncovered, [&](const Place& p) {
    const std::size_t i = index_of(p.number);
    return taken[i] || objects_[i].unseen >= patience_;
  });
  for (Place& p : places) p.number = numbers[p.number];
  places_.clear();
  std::ranges::merge(places, uncovered, std::back_inserter(places_), {}, &Place::key, &Place::key);
  objects_ = std::move(remembered);
  return numbers;
}

}  // namespace ph::segment
