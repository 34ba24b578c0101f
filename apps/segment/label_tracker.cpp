// SPDX-License-Identifier: MIT
#include "ph/label_tracker.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>

namespace ph::segment {
namespace {

/// A segment and an object that share places.
struct Overlap {
  double share;  // of their union
  std::size_t segment, object;
};

}  // namespace

std::vector<std::uint32_t> LabelTracker::update(std::span<const std::uint32_t> labels) {
  std::vector<Place> places;
  std::uint32_t segments = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == 0) continue;
    segments = std::max(segments, labels[i]);
    places.push_back(
        {{static_cast<double>(labels.size()), static_cast<double>(i), 0, 0}, labels[i] - 1});
  }
  return match(std::move(places), segments);
}

std::vector<std::uint32_t> LabelTracker::update(const SceneTree& scene, const SceneCut& cut) {
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
    for (std::size_t v = 0; v < scene.cells.size(); ++v) {
      const auto& [x, y, z] = scene.cells[v];
      if (cut.vertex_labels[v] != 0)
        places.push_back({{scene.voxel, z, y, x}, cut.vertex_labels[v] - 1});
    }
  }
  return match(std::move(places), cut.segments.size());
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
