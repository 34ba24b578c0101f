// SPDX-License-Identifier: MIT
#include "libph/src/io/tables/array.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "libph/src/core/system/pages.hpp"

namespace ph::detail {
namespace {

// The number of elements between two polls of the stop token, minus one.
constexpr std::size_t kPollMask = 0xFFFFF;

double half_to_double(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 0x1F;
  const int mantissa = bits & 0x3FF;
  const double magnitude = exponent == 0 ? std::ldexp(mantissa, -24)
                           : exponent == 31
                               ? (mantissa == 0 ? std::numeric_limits<double>::infinity()
                                                : std::numeric_limits<double>::quiet_NaN())
                               : std::ldexp(mantissa + 1024, exponent - 25);
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

template <class T>
double element(const std::byte* from, std::endian order, bool& exact) {
  const T value = load<T>(from, order);
  const auto result = static_cast<double>(value);
  if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {
    // The largest values of int64 and uint64 become 2^63 and 2^64, which are outside the range of
    // the type. The converted value is therefore never exact.
    const bool in_range = result < std::ldexp(1.0, std::is_signed_v<T> ? 63 : 64);
    exact = in_range && static_cast<T>(result) == value;
  }
  return result + 0.0;  // the sum turns -0.0 into +0.0
}
double half(const std::byte* from, std::endian order, bool&) {
  return half_to_double(load<std::uint16_t>(from, order)) + 0.0;
}

}  // namespace

std::optional<ElementType> element_type(std::string_view kind) {
  if (kind == "b1") return ElementType{1, &element<std::uint8_t>, VoxelType::uint8, true};
  if (kind == "u1") return ElementType{1, &element<std::uint8_t>, VoxelType::uint8, true};
  if (kind == "u2") return ElementType{2, &element<std::uint16_t>, VoxelType::uint16, true};
  if (kind == "u4") return ElementType{4, &element<std::uint32_t>};
  if (kind == "u8") return ElementType{8, &element<std::uint64_t>};
  if (kind == "i1") return ElementType{1, &element<std::int8_t>, VoxelType::int16};
  if (kind == "i2") return ElementType{2, &element<std::int16_t>, VoxelType::int16, true};
  if (kind == "i4") return ElementType{4, &element<std::int32_t>};
  if (kind == "i8") return ElementType{8, &element<std::int64_t>};
  if (kind == "f2") return ElementType{2, &half, VoxelType::float32};
  if (kind == "f4") return ElementType{4, &element<float>, VoxelType::float32, true};
  if (kind == "f8") return ElementType{8, &element<double>, VoxelType::float64, true};
  return std::nullopt;
}

std::size_t count_elements(const Input& input, const ArrayLayout& layout,
                           const std::vector<Index>& extents) {
  std::optional<std::size_t> bytes = layout.type.size;
  for (const Index extent : extents) {
    // An extent of 0 must not hide an overflow of the other extents.
    if (bytes) bytes = checked_product(*bytes, static_cast<std::size_t>(extent));
  }
  const std::size_t there = input.size() - layout.offset;
  if (!bytes || *bytes != there) {
    input.fail_at_byte(
        layout.offset,
        {!bytes || *bytes > there ? "truncated" : "trailing data",
         fmt::format("{} bytes", there),
         bytes ? fmt::format("{} for shape ({})", *bytes, fmt::join(extents, ", "))
               : fmt::format("more than 2^64 for shape ({})", fmt::join(extents, ", ")),
         {}});
  }
  return there / layout.type.size;
}

namespace {

// Polls the stop token from time to time. If numbers are read from one file and written to another,
// the class also removes all pages of both files from memory. It removes all pages because the
// pages in use may be anywhere if the order of the axes changes.
class Watch {
 public:
  Watch(const Input& input, std::span<const std::byte> to, bool in_file)
      : input_(input), to_(to), in_file_(in_file) {}

  void passed(std::size_t elements) {
    // Each element may have loaded a page and the pages around it.
    constexpr std::size_t some = 0x7FFF;
    if ((elements & (in_file_ ? some : kPollMask)) != 0) return;
    input_.poll();
    if (!in_file_) return;
    input_.done_with(0, input_.size());
    forget_file_pages(to_.data(), to_.size());
  }

 private:
  const Input& input_;
  std::span<const std::byte> to_;
  bool in_file_;
};

// True if the stored numbers need no conversion to be an image in memory.
template <class T>
bool is_as_in_memory(const ArrayLayout& layout, const std::vector<Index>& extents) {
  return layout.type.is_native && (layout.order == std::endian::native || sizeof(T) == 1) &&
         (!layout.first_axis_fastest || extents.size() < 2);
}

template <class T>
std::vector<T> copy_array(const Input& input, std::size_t offset, std::size_t count) {
  // A block stays in the cache between copying and the loop.
  constexpr std::size_t block = 1 << 14;
  const std::byte* bytes = input.bytes().data() + offset;
  std::vector<T> values;
  values.reserve(count);
  prefer_huge_pages(values.data(), count * sizeof(T));
  for (std::size_t k = 0; k < count; k += block) {
    input.poll();
    const std::size_t size = std::min(count - k, block);
    values.resize(k + size);
    std::memcpy(values.data() + k, bytes + k * sizeof(T), size * sizeof(T));
    if constexpr (std::is_floating_point_v<T>)
      for (std::size_t i = k; i < k + size; ++i) values[i] += 0;  // the sum turns -0.0 into +0.0
  }
  return values;
}

template <class T>
void convert_array(const Input& input, const ArrayLayout& layout, const std::vector<Index>& extents,
                   std::span<T> values, bool in_file) {
  const std::byte* bytes = input.bytes().data() + layout.offset;
  const bool as_it_is =
      layout.type.is_native && (layout.order == std::endian::native || sizeof(T) == 1);
  const auto element_at = [&](std::size_t k) {
    const std::size_t at = k * layout.type.size;
    if (as_it_is) {
      T value;
      std::memcpy(&value, bytes + at, sizeof(T));
      return static_cast<T>(value + T{0});
    }
    bool exact = true;
    const double value = layout.type.load(bytes + at, layout.order, exact);
    if (!exact) {
      const std::string near = fmt::format("one near {:.0f}", value);
      input.fail_at_byte(layout.offset + at,
                         {"integer that a double cannot hold", near, "at most 2^53", {}});
    }
    return static_cast<T>(value);
  };
  Watch watch(input, std::as_bytes(values), in_file);
  if (!layout.first_axis_fastest || extents.size() < 2) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = element_at(k);
      watch.passed(k);
    }
    return;
  }
  // The first and the last axis are swapped in tiles that fit into a few cache lines. The axes
  // between them keep the file's order.
  constexpr std::size_t tile = 8;
  const auto first = static_cast<std::size_t>(extents.front());
  const auto last = static_cast<std::size_t>(extents.back());
  const std::size_t between = values.empty() ? 0 : values.size() / first / last;
  FirstAxisFastest middle({extents.begin() + 1, extents.end() - 1});
  std::size_t done = 0;
  for (std::size_t m = 0; m < between; ++m, middle.next()) {
    for (std::size_t z0 = 0; z0 < last; z0 += tile) {
      for (std::size_t x0 = 0; x0 < first; x0 += tile) {
        for (std::size_t x = x0; x < std::min(x0 + tile, first); ++x) {
          T* to = values.data() + (x * between + middle.place()) * last;
          for (std::size_t z = z0; z < std::min(z0 + tile, last); ++z, watch.passed(++done))
            to[z] = element_at(x + first * (m + between * z));
        }
      }
    }
  }
}

template <class T>
Voxels load_as(const Input& input, const ArrayLayout& layout, const std::vector<Index>& extents,
               std::size_t count, bool is_large) {
  const bool as_in_memory = is_as_in_memory<T>(layout, extents);
  if (is_large && as_in_memory) {
    const std::byte* const first = input.bytes().data() + layout.offset;
    const bool is_aligned = reinterpret_cast<std::uintptr_t>(first) % alignof(T) == 0;
    if (auto file = is_aligned ? input.keep_in_file() : nullptr)
      return Voxels(BorrowedVoxels{layout.type.stored, first, count, std::move(file), true});
  }
  if (is_large) {
    return voxels_in_file<T>(layout.type.stored, count, [&](std::span<T> values) {
      convert_array<T>(input, layout, extents, values, true);
    });
  }
  input.require_memory(count * sizeof(T));
  if (as_in_memory) return copy_array<T>(input, layout.offset, count);
  std::vector<T> values(count);
  convert_array<T>(input, layout, extents, values, false);
  return values;
}

}  // namespace

bool stays_in_file(const Input& input, std::size_t bytes) {
  constexpr std::size_t few = std::size_t{1} << 20;
  if (input.stays_in_file()) return true;
  return input.context() != nullptr && bytes > few && bytes > input.context()->memory.left() / 3;
}

Image load_array(const Input& input, const ArrayLayout& layout, std::vector<Index> extents,
                 Input::Excess excess) {
  count_elements(input, layout, extents);
  return load_elements(input, layout, std::move(extents), excess);
}

Image load_elements(const Input& input, const ArrayLayout& layout, std::vector<Index> extents,
                    Input::Excess excess) {
  std::size_t count = 1;
  for (const Index extent : extents) count *= static_cast<std::size_t>(extent);
  return with_voxels(layout.type.stored, nullptr, [&]<class T>(const T*) {
    const bool is_large =
        excess == Input::Excess::stays_in_file && stays_in_file(input, count * sizeof(T));
    Voxels values = load_as<T>(input, layout, extents, count, is_large);
    return Image{std::move(extents), std::move(values)};
  });
}

FirstAxisFastest::FirstAxisFastest(const std::vector<Index>& extents) : axes_(extents.size()) {
  std::size_t stride = 1;
  for (std::size_t axis = extents.size(); axis-- > 0;) {
    const auto extent = static_cast<std::size_t>(extents[axis]);
    axes_[axis] = {extent, stride, 0};
    stride *= extent;
  }
}

void FirstAxisFastest::next() {
  for (Axis& axis : axes_) {
    place_ += axis.stride;
    if (++axis.at < axis.extent) return;
    place_ -= axis.stride * axis.extent;
    axis.at = 0;
  }
}

}  // namespace ph::detail
