// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <vector>

#include "ph/detail/core/raw_vector.hpp"
#include "ph/detail/image/cubical_image.hpp"

namespace ph::vectors {

/// An image that is divided into layers along its first axis. A layer consists of rows along the
/// last axis. The image has at least two axes. If necessary, axes of one voxel are added, which do
/// not change the Euler characteristic.
struct Layered {
  CubicalImage image;
  std::vector<std::size_t> extents;
  std::vector<bool> periodic;

  explicit Layered(const CubicalImage& given)
      : image(given),
        extents(given.extents.begin(), given.extents.end()),
        periodic(given.periodic) {
    while (extents.size() < 2) {
      extents.insert(extents.begin(), 1);
      periodic.insert(periodic.begin(), false);
    }
  }
  std::size_t axes() const { return extents.size(); }
  std::size_t layers() const { return extents.front(); }
  std::size_t row_length() const { return extents.back(); }
  std::size_t voxels_each() const { return image.size() / layers(); }
  std::size_t rows_each() const { return voxels_each() / row_length(); }
};

/// The number by which voxels are compared. It determines when a voxel enters, and has the type of
/// the image.
template <class T>
T entry_key(T voxel, bool superlevel) {
  if constexpr (std::floating_point<T>) {
    if (voxel != voxel) return std::numeric_limits<T>::infinity();
    return (superlevel ? -voxel : voxel) + T{0};
  } else {
    return superlevel ? static_cast<T>(~voxel) : voxel;
  }
}

/// The value of a voxel that has the given key.
template <class T>
double entry_value(T key, bool superlevel) {
  if constexpr (std::floating_point<T>)
    return static_cast<double>(key);
  else  // integers have only one zero
    return static_cast<double>(superlevel ? -std::int64_t{static_cast<T>(~key)} : key);
}

/// Three adjacent layers, as keys. Rows have one extra key at each end, which is the neighbour
/// there if the axis is periodic.
template <class T>
class ThreeLayers {
 public:
  /// The first call of `go_up` moves layer `first` into the middle.
  ThreeLayers(const Layered& of, std::size_t first, std::pmr::memory_resource* memory)
      : of_(of),
        padded_(of.row_length() + 2),
        layers_{RawVector<T>(memory), RawVector<T>(memory), RawVector<T>(memory)},
        middle_(first - 1) {
    for (auto& layer : layers_) layer.resize(of.rows_each() * padded_);
    load(wrapped(first - 1), order_[1]);
    load(first, order_[2]);
  }

  void go_up() {
    ++middle_;
    std::rotate(std::begin(order_), std::begin(order_) + 1, std::end(order_));
    load(wrapped(middle_ + 1), order_[2]);
  }
  /// The layer at an offset from the middle layer. Returns null if there is no such layer. @param
  /// offset -1, 0 or 1.
  const T* layer(int offset) const {
    const int which = order_[offset + 1];
    return present_[which] ? layers_[which].data() + 1 : nullptr;
  }
  std::size_t padded_row() const { return padded_; }

 private:
  static constexpr std::size_t kNone = SIZE_MAX;

  std::size_t wrapped(std::size_t layer) const {
    if (layer < of_.layers()) return layer;
    if (!of_.periodic.front()) return kNone;  // mutant: euler-first-axis
    // `layer` is kNone before the first layer, otherwise the number after the last layer.
    return layer == kNone ? of_.layers() - 1 : 0;
  }
  void load(std::size_t layer, int to) {
    present_[to] = layer != kNone;
    if (layer == kNone) return;
    const std::size_t length = of_.row_length();
    const T* voxels = static_cast<const T*>(of_.image.voxels) + layer * of_.voxels_each();
    T* keys = layers_[to].data();
    for (std::size_t row = 0; row < of_.rows_each(); ++row) {
      const bool superlevel = of_.image.superlevel;
      for (std::size_t x = 0; x < length; ++x) keys[x + 1] = entry_key(voxels[x], superlevel);
      keys[0] = keys[length];
      keys[length + 1] = keys[1];
      voxels += length;
      keys += padded_;
    }
  }

  const Layered& of_;
  std::size_t padded_;
  RawVector<T> layers_[3];
  bool present_[3] = {};
  int order_[3] = {0, 1, 2};  // below, middle, above
  std::size_t middle_;
};

}  // namespace ph::vectors
