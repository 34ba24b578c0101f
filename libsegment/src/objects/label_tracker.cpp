// SPDX-License-Identifier: MIT
#include "ph/label_tracker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "libsegment/src/scene/options.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

/// A segment and an object that share places in space.
struct Overlap {
  double share;  // the share of their union
  std::size_t segment, object;
};

/// The number of things. These are the segments, followed by the surfaces that were found among the
/// components.
std::size_t things_in(const SceneTree& scene, const SceneCut& cut) {
  return cut.segments.size() + scene.surfaces.size() - static_cast<std::size_t>(scene.removed);
}

/// The number of the thing (a segment or a surface) at point i. Empty if there is no thing.
std::optional<std::uint32_t> thing_at(const SceneTree& scene, const SceneCut& cut, std::size_t i) {
  if (cut.labels[i] != 0) return cut.labels[i] - 1;
  const std::uint32_t surface = cut.surface_labels[i];
  if (std::cmp_less_equal(surface, scene.removed)) return std::nullopt;  // mutant: wall-number
  return static_cast<std::uint32_t>(cut.segments.size()) + surface - 1 -
         static_cast<std::uint32_t>(scene.removed);
}

}  // namespace

LabelTracker::LabelTracker(int patience, double cell) : patience_(patience), cell_(cell) {
  if (patience < 0)
    throw Error(ErrorKind::usage, fmt::format("{}: found {} frames, expected 0 or more",
                                              mark(Setting::patience), patience));
  if (!(cell > 0) || !std::isfinite(cell))
    throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected a positive finite length",
                                              mark(Setting::cell), cell));
}

std::vector<std::uint32_t> LabelTracker::update(std::span<const std::uint32_t> labels) {
  // The labels that occur, in ascending order. A label may be any number.
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
  standings_.clear();
  const std::vector<std::uint32_t> numbers = match(std::move(places), known.size(), known.size());
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
    for (std::size_t i = 0; i < cut.labels.size(); ++i)
      if (const auto thing = thing_at(scene, cut, i))
        places.push_back({{-static_cast<double>(scene.width), static_cast<double>(scene.height),
                           static_cast<double>(i / width), static_cast<double>(i % width)},
                          *thing});
  } else {
    places = cubes(scene, cut);
  }
  std::vector<std::uint32_t> numbers =
      match(std::move(places), things_in(scene, cut), cut.segments.size());
  settle(scene, cut, numbers);
  numbers.resize(cut.segments.size());
  return numbers;
}

LabelTracker::Object& LabelTracker::object(std::uint32_t number) {
  return *std::ranges::lower_bound(objects_, number, {}, &Object::number);
}

/// Updates the role of each thing and what the thing stands on. A new thing takes its role and its
/// support from its first frame. Later, a change takes effect after several frames in a row agree
/// on it.
void LabelTracker::settle(const SceneTree& scene, const SceneCut& cut,
                          const std::vector<std::uint32_t>& numbers) {
  constexpr int frames = 3;  // mutant: role-frames
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    Standing now;
    if (i < cut.segments.size()) {
      now = {cut.segments[i].role, cut.segments[i].on};
      // mutant: number-below
      if (now.on.segment != 0) now.on.segment = numbers[now.on.segment - 1];
    } else {
      now.role =
          scene.surfaces[i - cut.segments.size() + static_cast<std::size_t>(scene.removed)].role;
    }
    if (numbers[i] == 0) continue;
    Object& known = object(numbers[i]);
    if (now == known.is) {
      known.times = 0;
      continue;
    }
    known.times = known.times > 0 && now == known.said ? known.times + 1 : 1;  // mutant: role-times
    known.said = now;
    if (known.is_new || known.times == frames) {
      known.is = now;
      known.times = 0;
    }
  }
  standings_.clear();
  for (const Segment& segment : cut.segments) {
    Standing standing = object(numbers[standings_.size()]).is;
    // The support may be absent from this frame. In this case, only the result of this frame is
    // used.
    if (standing.on.segment != 0) {
      const auto lower = std::ranges::find(numbers, standing.on.segment) - numbers.begin();
      if (lower < std::ssize(cut.segments))
        standing.on.segment = static_cast<std::uint32_t>(lower + 1);
      else
        standing.on = segment.on;
    } else if (const std::uint32_t s = standing.on.surface;
               s > scene.surfaces.size() || (s != 0 && !is_support(scene.surfaces[s - 1].role))) {
      standing.on = segment.on;
    }
    standings_.push_back(standing);
  }
}

/// The cubes in which a segment or a surface has more points than any other.
std::vector<LabelTracker::Place> LabelTracker::cubes(const SceneTree& scene,
                                                     const SceneCut& cut) const {
  std::map<Key, std::map<std::uint32_t, Index>> points;
  const float* p = scene.xyz.data();
  for (const Index point : scene.points) {
    if (const auto thing = thing_at(scene, cut, static_cast<std::size_t>(point)))
      ++points[{cell_, std::floor(p[2] / cell_), std::floor(p[1] / cell_),
                std::floor(p[0] / cell_)}][*thing];
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

/// Gives a number to each thing of this frame. This is the number of the known object that the
/// thing overlaps most, or a new number.
/// @param places the places of the things, sorted by key. @param segments the number of segments,
/// which come first among the things. Each segment gets a number even if it has no place.
/// @return the number of each thing, or 0 if the thing has none.
std::vector<std::uint32_t> LabelTracker::match(std::vector<Place> places, std::size_t things,
                                               std::size_t segments) {
  constexpr double least = 0.25;  // the share of the smaller of the two
  std::vector<double> size_of_thing(things), size_of_object(objects_.size());
  const auto index_of = [&](std::uint32_t number) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(objects_, number, {}, &Object::number) - objects_.begin());
  };
  for (const Place& p : places) ++size_of_thing[p.number];
  for (const Place& p : places_) ++size_of_object[index_of(p.number)];

  std::map<std::pair<std::size_t, std::size_t>, double> shared;
  // The places of objects that no segment covers now.
  std::vector<Place> uncovered;
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
    const double a = size_of_thing[both.first], b = size_of_object[both.second];
    if (count > least * std::min(a, b))
      overlaps.push_back({count / (a + b - count), both.first, both.second});
  }
  std::ranges::stable_sort(overlaps, std::ranges::greater(), &Overlap::share);

  std::vector<std::uint32_t> numbers(things, 0);
  std::vector<bool> taken(objects_.size());
  for (const Overlap& o : overlaps) {
    if (numbers[o.segment] != 0 || taken[o.object]) continue;
    numbers[o.segment] = objects_[o.object].number;
    taken[o.object] = true;
  }
  const std::uint32_t first_new = next_;
  for (std::size_t i = 0; i < things; ++i)
    // mutant: number-used
    if (numbers[i] == 0 && (i < segments || size_of_thing[i] > 0)) numbers[i] = next_++;

  // The things of this frame and the objects that were seen recently are remembered. An object that
  // was seen recently keeps only the places that nothing covers now.
  std::vector<Object> remembered;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    Object known = objects_[i];
    known.unseen = taken[i] ? 0 : known.unseen + 1;
    known.is_new = false;
    if (known.unseen <= patience_) remembered.push_back(known);
  }
  for (const std::uint32_t number : numbers)
    if (number >= first_new) remembered.push_back({number});
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
