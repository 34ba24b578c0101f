// SPDX-License-Identifier: MIT
#include "libph/src/vectors/euler/mask_rows.hpp"

#include "libph/src/core/for_each_target.hpp"

// A template cannot be compiled for several targets. Each type therefore has its own function, into
// which a common template is inlined.
namespace ph::vectors {
namespace {

template <class T>
[[gnu::always_inline]] inline void compare(const T* neighbours, const T* voxels, std::size_t count,
                                           bool or_equal, Mask flip, Mask* out) {
  if (or_equal)
    for (std::size_t i = 0; i < count; ++i)
      out[i] = static_cast<Mask>((neighbours[i] <= voxels[i] ? 0xFF : 0) ^ flip);
  else
    for (std::size_t i = 0; i < count; ++i)
      out[i] = static_cast<Mask>((neighbours[i] < voxels[i] ? 0xFF : 0) ^ flip);
}

template <class Sum>
[[gnu::always_inline]] inline void join(Mask* masks, const Mask* a, const Mask* b, const Mask* c,
                                        std::size_t count, bool adds, Sum* sum) {
  // Read as a signed number, a mask with all bits set is -1.
  if (adds)
    for (std::size_t i = 0; i < count; ++i) {
      masks[i] = static_cast<Mask>(masks[i] & a[i] & b[i] & c[i]);
      sum[i] = static_cast<Sum>(sum[i] - static_cast<std::int8_t>(masks[i]));
    }
  else
    for (std::size_t i = 0; i < count; ++i) {
      masks[i] = static_cast<Mask>(masks[i] & a[i] & b[i] & c[i]);
      sum[i] = static_cast<Sum>(sum[i] + static_cast<std::int8_t>(masks[i]));
    }
}

}  // namespace

PH_FOR_EACH_TARGET
void find_preceding(const std::uint8_t* neighbours, const std::uint8_t* voxels, std::size_t count,
                    bool or_equal, Mask flip, Mask* out) {
  compare(neighbours, voxels, count, or_equal, flip, out);
}
PH_FOR_EACH_TARGET
void find_preceding(const std::uint16_t* neighbours, const std::uint16_t* voxels, std::size_t count,
                    bool or_equal, Mask flip, Mask* out) {
  compare(neighbours, voxels, count, or_equal, flip, out);
}
PH_FOR_EACH_TARGET
void find_preceding(const std::int16_t* neighbours, const std::int16_t* voxels, std::size_t count,
                    bool or_equal, Mask flip, Mask* out) {
  compare(neighbours, voxels, count, or_equal, flip, out);
}
PH_FOR_EACH_TARGET
void find_preceding(const float* neighbours, const float* voxels, std::size_t count, bool or_equal,
                    Mask flip, Mask* out) {
  compare(neighbours, voxels, count, or_equal, flip, out);
}
PH_FOR_EACH_TARGET
void find_preceding(const double* neighbours, const double* voxels, std::size_t count,
                    bool or_equal, Mask flip, Mask* out) {
  compare(neighbours, voxels, count, or_equal, flip, out);
}

PH_FOR_EACH_TARGET
void count_where_all(Mask* masks, const Mask* a, const Mask* b, const Mask* c, std::size_t count,
                     bool adds, std::int8_t* sum) {
  join(masks, a, b, c, count, adds, sum);
}
PH_FOR_EACH_TARGET
void count_where_all(Mask* masks, const Mask* a, const Mask* b, const Mask* c, std::size_t count,
                     bool adds, std::int16_t* sum) {
  join(masks, a, b, c, count, adds, sum);
}

}  // namespace ph::vectors
