// SPDX-License-Identifier: MIT
#include "libph/src/io/images/volume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libph/src/io/tables/cell_stream.hpp"
#include "ph/detail/core/files.hpp"

namespace ph::detail {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Vector& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

// A vector of length 1 that is perpendicular to the first `known` of the axes.
Vector completed(const std::array<Vector, 3>& axes, std::size_t known) {
  if (known == 2) {
    const Vector across = cross(axes[0], axes[1]);
    const double size = length(across);
    return {across[0] / size, across[1] / size, across[2] / size};
  }
  // The unit vector that is most nearly perpendicular to the only axis.
  const Vector& axis = axes[0];
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(axis[k]) < std::abs(axis[least])) least = k;
  Vector unit{};
  unit[least] = 1;
  const Vector across = cross(axis, unit);
  const double size = length(across);
  return {across[0] / size, across[1] / size, across[2] / size};
}

Input open_data(const VolumeHeader& header, const HeaderField& field) {
  const Input& input = header.input();
  if (input.path().empty()) {
    header.fail(field, "data in the file of the header",
                "a header from a stream has no folder in which its data may be; read it from its "
                "own file");
  }
  const auto path = input.path().parent_path() / files::path_of(std::string(field.value));
  try {
    return Input::open_stored(path, input.context(), Input::Excess::stays_in_file);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::no_input) throw;
    header.fail(field, "the name of a file, relative to the folder of the header", error.what());
  }
}

// Skips bytes that the header declares to come before the data.
std::size_t skipped(const Input& data, std::size_t offset, std::size_t lines, std::size_t bytes) {
  const auto fail = [&] {
    data.fail_at_byte(data.size(), {"truncated before the data",
                                    "the end of the file",
                                    "the lines and bytes that the header says to skip",
                                    {}});
  };
  for (; lines > 0; --lines) {
    const std::size_t end = data.text().find('\n', offset);
    if (end == std::string_view::npos) fail();
    offset = end + 1;
  }
  if (bytes > data.size() - offset) fail();
  return offset + bytes;
}

// Reads numbers in text. A number of an integer type must be an integer in the range of this type.
Image read_numbers(const Input& data, std::size_t offset, const StoredVolume& volume,
                   const ElementType& type, std::optional<std::size_t> bytes) {
  const std::size_t rest = data.size() - offset;
  const auto count = bytes ? *bytes / type.size : 0;
  if (!bytes || count > rest / 2 + 1) {
    data.fail_at_byte(offset, {"truncated: the sizes do not fit the file",
                               bytes ? fmt::format("{} numbers", count) : "more than 2^64 numbers",
                               fmt::format("at most {} in {} bytes", rest / 2 + 1, rest),
                               {}});
  }
  const std::string_view before = data.text().substr(0, offset);
  TextLines lines(data, offset, static_cast<std::size_t>(std::ranges::count(before, '\n')));
  CellStream stream(lines);
  const auto bits = 8 * type.size;
  const std::int64_t most =
      volume.kind[0] == 'i' ? (std::int64_t{1} << (bits - 2)) - 1 + (std::int64_t{1} << (bits - 2))
      : bits < 64           ? (std::int64_t{1} << bits) - 1
                            : std::numeric_limits<std::int64_t>::max();
  const std::int64_t least = volume.kind[0] == 'i' ? -most - 1 : 0;
  const auto next = [&](std::size_t k) {
    if (!stream.more()) {
      data.fail({"truncated: too few numbers", fmt::format("{}", k), fmt::format("{}", count), {}});
    }
    if (volume.kind[0] == 'f') return stream.cells().number(Allow::any);
    const char* const place = stream.cells().place();
    const std::int64_t number = stream.cells().integer(least, most, "number");
    constexpr std::int64_t kExact = std::int64_t{1} << 53;
    if (number > kExact || number < -kExact)
      lines.fail(
          place,
          {"integer that a double may not hold", fmt::format("{}", number), "at most 2^53", {}});
    return static_cast<double>(number);
  };
  return with_voxels(type.stored, nullptr, [&]<class T>(const T*) {
    data.require_memory(count * sizeof(T));
    std::vector<T> values(count);
    FirstAxisFastest walk(volume.extents);
    for (std::size_t k = 0; k < count; ++k, walk.next())
      values[walk.place()] = static_cast<T>(next(k)) + T{0};  // the sum turns -0.0 into +0.0
    if (stream.more()) {
      lines.fail(stream.cells().place(),
                 {"trailing data", "another number", fmt::format("{} numbers", count), {}});
    }
    return Image{volume.extents, std::move(values)};
  });
}

}  // namespace

Image load_numbers(const Input& data, const StoredVolume& volume) {
  const ElementType type = *element_type(volume.kind);
  const std::optional<std::size_t> bytes = bytes_of(volume, type.size);
  const bool is_packed = volume.encoding == VolumeEncoding::packed;
  std::size_t offset = skipped(data, volume.offset, volume.lines, is_packed ? 0 : volume.skip);
  if (volume.encoding == VolumeEncoding::text)
    return read_numbers(data, offset, volume, type, bytes);
  if (volume.at_end && bytes && *bytes <= data.size() - offset) offset = data.size() - *bytes;
  const auto load = [&](const Input& input, std::size_t begin) {
    return load_array(input, {type, volume.order, true, begin}, volume.extents,
                      Input::Excess::stays_in_file);
  };
  if (!is_packed) return load(data, offset);
  const std::size_t there = data.size() - offset;
  if (volume.packed_size != 0 && volume.packed_size != there) {
    data.fail_at_byte(offset, {there < volume.packed_size ? "truncated" : "trailing data",
                               fmt::format("{} bytes", there),
                               fmt::format("{} of compressed data", volume.packed_size),
                               {}});
  }
  const Input unpacked =
      data.unpacked(offset, bytes.value_or(SIZE_MAX), Input::Excess::stays_in_file);
  return load(unpacked, skipped(unpacked, 0, 0, volume.skip));
}

std::optional<std::size_t> bytes_of(const StoredVolume& volume, std::size_t each) {
  std::optional<std::size_t> bytes = each;
  for (const Index extent : volume.extents)
    if (bytes) bytes = checked_product(*bytes, static_cast<std::size_t>(extent));
  return bytes;
}

void drop_last_axes(std::vector<Index>& extents) {
  while (extents.size() > 1 && extents.back() == 1) extents.pop_back();
}

std::optional<Affine> affine_of(const std::vector<std::vector<double>>& vectors,
                                const std::vector<double>& origin,
                                const std::array<double, 3>& signs) {
  std::array<Vector, 3> axes{};
  const std::size_t known = std::min<std::size_t>(vectors.size(), 3);
  for (std::size_t axis = 0; axis < known; ++axis)
    std::copy_n(vectors[axis].begin(), std::min<std::size_t>(vectors[axis].size(), 3),
                axes[axis].begin());
  for (std::size_t axis = known; axis < 3; ++axis) axes[axis] = completed(axes, axis);
  Affine affine{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t axis = 0; axis < 3; ++axis) affine[r][axis] = signs[r] * axes[axis][r] + 0.0;
    affine[r][3] = r < origin.size() ? signs[r] * origin[r] + 0.0 : 0;
    for (const double number : affine[r])
      if (!std::isfinite(number)) return std::nullopt;
  }
  return affine;
}

Volume load_volume(const VolumeHeader& header, StoredVolume volume, const ReadOptions& options) {
  drop_last_axes(volume.extents);
  const auto load = [&](const Input& data) {
    return Volume{without_nan_pixels(load_numbers(data, volume), data, options), volume.affine};
  };
  if (volume.file == nullptr) return load(header.input());
  return load(open_data(header, *volume.file));
}

}  // namespace ph::detail
