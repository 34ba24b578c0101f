// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "ph/error.hpp"
#include "ph/image.hpp"

namespace ph {
namespace {

/// @throws Error (usage) on a negative extent, or if the number of bytes overflows.
std::size_t voxels_of(const std::vector<Index>& extents, std::size_t bytes_of_voxel) {
  std::size_t most = std::numeric_limits<std::ptrdiff_t>::max() / bytes_of_voxel, count = 1;
  bool is_empty = false;
  for (const Index n : extents) {
    if (n < 0)
      throw Error(ErrorKind::usage,
                  fmt::format("image: found extents {}, expected numbers >= 0", extents));
    is_empty = is_empty || n == 0;
  }
  if (is_empty) return 0;
  for (const Index n : extents) {
    if (static_cast<std::size_t>(n) > most / count)
      throw Error(
          ErrorKind::usage,
          fmt::format("image: found extents {}, expected a product of at most {}", extents, most));
    count *= static_cast<std::size_t>(n);
  }
  return count;
}

/// True if voxels are contiguous and the index of the last axis varies fastest. The stride of an
/// axis with one voxel does not matter.
bool is_c_order(const std::vector<Index>& extents, std::span<const std::ptrdiff_t> strides) {
  std::ptrdiff_t expected = 1;
  for (std::size_t k = extents.size(); k-- > 0; expected *= extents[k])
    if (extents[k] > 1 && strides[k] != expected) return false;
  return true;
}

/// Copies voxels with any strides into an array in C order.
template <class T>
std::vector<T> copied(const void* data, const std::vector<Index>& extents,
                      std::span<const std::ptrdiff_t> strides, std::size_t count) {
  std::vector<T> voxels(count);
  std::vector<Index> at(extents.size(), 0);
  std::ptrdiff_t place = 0;
  for (T& voxel : voxels) {
    // The array need not be aligned.
    std::memcpy(&voxel, static_cast<const char*>(data) + place * std::ptrdiff_t{sizeof(T)},
                sizeof(T));
    for (std::size_t k = extents.size(); k-- > 0;) {
      place += strides[k];
      if (++at[k] < extents[k]) break;
      place -= extents[k] * strides[k];
      at[k] = 0;
    }
  }
  return voxels;
}

}  // namespace

std::vector<double> Voxels::doubles() const {
  return visit([](const auto& all) { return std::vector<double>(all.begin(), all.end()); });
}

bool operator==(const Voxels& a, const Voxels& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

Image image_of_array(VoxelType type, const void* data, std::vector<Index> extents,
                     std::span<const std::ptrdiff_t> strides, std::shared_ptr<const void> owner) {
  const std::size_t bytes = bytes_of(type), count = voxels_of(extents, bytes);
  if (!strides.empty() && strides.size() != extents.size())
    throw Error(ErrorKind::usage, fmt::format("image: found {} strides, expected {}, one per axis",
                                              strides.size(), extents.size()));
  if (count == 0) return {std::move(extents), {}};
  const bool is_aligned = reinterpret_cast<std::uintptr_t>(data) % bytes == 0;
  if (is_aligned && (strides.empty() || is_c_order(extents, strides)))
    return {std::move(extents), Voxels(BorrowedVoxels{type, data, count, std::move(owner)})};
  std::vector<std::ptrdiff_t> dense(extents.size());
  std::ptrdiff_t stride = 1;
  for (std::size_t k = extents.size(); k-- > 0; stride *= extents[k]) dense[k] = stride;
  if (strides.empty()) strides = dense;
  return with_voxels(type, data, [&]<class T>(const T*) -> Image {
    Voxels voxels = copied<T>(data, extents, strides, count);
    return {std::move(extents), std::move(voxels)};
  });
}

}  // namespace ph
