// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <mutex>
#include <vector>

#include "libph/src/vectors/euler/layers.hpp"
#include "libph/src/vectors/grid_cells.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/euler_curve.hpp"

// The classes below collect the changes of the Euler characteristic at voxels. Each class has one
// Part per thread. A Part receives rows of keys and changes, and adds them to the whole in
// add_to_all.
namespace ph::vectors {

/// Calls use(i) for all voxels with a non-zero change, and possibly for other voxels.
template <class Sum, class Use>
void for_each_change(const Sum* changes, std::size_t count, Use&& use) {
  constexpr std::size_t together = sizeof(std::uint64_t) / sizeof(Sum);
  std::size_t i = 0;
  for (; i + together <= count; i += together) {
    std::uint64_t any;
    std::memcpy(&any, changes + i, sizeof(any));
    if (any == 0) continue;
    for (std::size_t k = 0; k < together; ++k) use(i + k);
  }
  for (; i < count; ++i) use(i);
}

/// Builds a step function from changes at ascending values.
class CurveBuilder {
 public:
  explicit CurveBuilder(double limit) : limit_(limit) {}
  void add(double value, std::int64_t change) {
    if (change == 0 || value > limit_) return;  // mutant: euler-threshold
    curve_.at.push_back(value);
    curve_.value.push_back(now_ += change);
  }
  void reserve(std::size_t count) {
    curve_.at.reserve(count);
    curve_.value.reserve(count);
  }
  StepFunction take() { return std::move(curve_); }

 private:
  double limit_;
  std::int64_t now_ = 0;
  StepFunction curve_;
};

/// Collects changes at integer keys. There is one sum for each possible key.
template <class T>
class Histogram {
  static constexpr std::size_t kBins = std::size_t{1} << 8 * sizeof(T);
  // For keys of one byte there are several copies, because consecutive additions to the same sum
  // would have to wait for each other.
  static constexpr std::size_t kCopies = sizeof(T) == 1 ? 4 : 1;
  static std::size_t bin_of(T key) {
    return static_cast<std::size_t>(key - std::numeric_limits<T>::min());
  }

 public:
  Histogram(const Layered& image, const RunContext& context)
      : image_(image.image), sums_(kBins, &context.memory) {}

  class Part {
   public:
    explicit Part(Histogram& all) : all_(all), sums_(kBins * kCopies, all.sums_.get_allocator()) {}
    template <class Sum>
    void take(const T* keys, const Sum* changes, std::size_t count) {
      for_each_change(changes, count, [&](std::size_t i) {
        sums_[i % kCopies * kBins + bin_of(keys[i])] += changes[i];
      });
    }
    void add_to_all() {
      const std::lock_guard lock(all_.mutex_);
      for (std::size_t i = 0; i < sums_.size(); ++i) all_.sums_[i % kBins] += sums_[i];
    }

   private:
    Histogram& all_;
    std::pmr::vector<std::int64_t> sums_;
  };

  StepFunction curve(const RunContext&) const {
    CurveBuilder curve(image_.limit);
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      const auto key =
          static_cast<T>(static_cast<std::int64_t>(bin) + std::numeric_limits<T>::min());
      curve.add(entry_value(key, image_.superlevel), sums_[bin]);
    }
    return curve.take();
  }

 private:
  CubicalImage image_;
  std::mutex mutex_;
  std::pmr::vector<std::int64_t> sums_;
};

/// Stores all changes and sorts them at the end.
template <class T>
class ChangeList {
  struct Change {
    T key;
    std::int16_t by;
  };

 public:
  ChangeList(const Layered& image, const RunContext& context)
      : image_(image.image), memory_(&context.memory) {}

  class Part {
   public:
    explicit Part(ChangeList& all) : all_(all), changes_(all.memory_) {}
    template <class Sum>
    void take(const T* keys, const Sum* changes, std::size_t count) {
      const std::size_t before = changes_.size();
      if (changes_.capacity() < before + count) changes_.reserve(2 * (before + count));
      changes_.resize(before + count);
      Change* to = changes_.data() + before;
      for_each_change(changes, count, [&](std::size_t i) {
        *to = {keys[i], changes[i]};
        to += changes[i] != 0;
      });
      changes_.resize(static_cast<std::size_t>(to - changes_.data()));
    }
    void add_to_all() {
      RawVector<Change> exact(changes_.begin(), changes_.end(), all_.memory_);
      const std::lock_guard lock(all_.mutex_);
      all_.parts_.push_back(std::move(exact));
    }

   private:
    ChangeList& all_;
    RawVector<Change> changes_;
  };

  StepFunction curve(const RunContext& context) {
    RawVector<Change> changes = joined();
    radix_sort_by_value(
        changes, [](const Change& change) { return static_cast<double>(change.key); }, context);
    Ticker ticker(context, "Euler curve");
    const auto for_each_value = [&](auto&& use) {
      for (std::size_t i = 0; i < changes.size();) {
        const std::size_t first = i;
        std::int64_t sum = 0;
        for (; i < changes.size() && changes[i].key == changes[first].key; ++i)
          sum += changes[i].by;
        use(entry_value(changes[first].key, image_.superlevel), sum);
        ticker.work(i - first);
      }
    };
    std::size_t steps = 0;
    for_each_value([&](double, std::int64_t sum) { steps += sum != 0; });
    const MemoryClaim claim(context.memory, steps * (sizeof(double) + sizeof(std::int64_t)));
    CurveBuilder curve(image_.limit);
    curve.reserve(steps);
    for_each_value([&](double value, std::int64_t sum) { curve.add(value, sum); });
    return curve.take();
  }

 private:
  /// Joins all parts, and frees each part as soon as it is copied. The order of the parts depends
  /// on threads. It does not matter, because changes with equal keys are summed.
  RawVector<Change> joined() {
    std::size_t count = 0;
    for (const auto& part : parts_) count += part.size();
    RawVector<Change> all(memory_);
    all.reserve(count);
    for (auto& part : parts_) {
      all.insert(all.end(), part.begin(), part.end());
      RawVector<Change>(memory_).swap(part);
    }
    return all;
  }

  CubicalImage image_;
  std::pmr::memory_resource* memory_;
  std::mutex mutex_;
  std::vector<RawVector<Change>> parts_;
};

/// Collects changes at the values of a grid. Each change is added at the first value that is not
/// below its key.
template <class T>
class GridCounts {
 public:
  GridCounts(const Layered& image, const GridCells& cells, const RunContext& context)
      : image_(image.image),
        cells_(cells),
        most_(std::min(cells.values().back(), image.image.limit)),
        sums_(cells.size(), &context.memory) {}

  class Part {
   public:
    explicit Part(GridCounts& all)
        : all_(all), sums_(all.cells_.size(), all.sums_.get_allocator()) {}
    template <class Sum>
    void take(const T* keys, const Sum* changes, std::size_t count) {
      for_each_change(changes, count, [&](std::size_t i) {
        if (changes[i] == 0) return;
        const double value = entry_value(keys[i], all_.image_.superlevel);
        if (value <= all_.most_) sums_[all_.cells_.first_from(value)] += changes[i];
      });
    }
    void add_to_all() {
      const std::lock_guard lock(all_.mutex_);
      for (std::size_t i = 0; i < sums_.size(); ++i) all_.sums_[i] += sums_[i];
    }

   private:
    GridCounts& all_;
    std::pmr::vector<std::int64_t> sums_;
  };

  void write(std::span<double> out) const {
    std::int64_t now = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) out[i] = static_cast<double>(now += sums_[i]);
  }

 private:
  CubicalImage image_;
  const GridCells& cells_;
  double most_;
  std::mutex mutex_;
  std::pmr::vector<std::int64_t> sums_;
};

}  // namespace ph::vectors
