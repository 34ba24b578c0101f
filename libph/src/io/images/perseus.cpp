// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/tables/array.hpp"
#include "libph/src/io/tables/cell_stream.hpp"
#include "ph/barcode.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

constexpr std::int64_t kMostAxes = 16;
constexpr std::int64_t kMostExtent = std::int64_t{1} << 40;
// The grid of a list of cubes may have at most this many voxels per cube, or at most kFreeVoxels
// voxels, whichever is more.
constexpr std::size_t kMostVoxelsPerCube = 1024;
constexpr std::size_t kFreeVoxels = std::size_t{1} << 20;
// Marks a voxel as absent (see Image::masked).
constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void fail_truncated(const Input& input, std::size_t found, std::size_t expected,
                                 const char* what) {
  input.fail({fmt::format("truncated: too few {}", what),
              fmt::format("{}", found),
              fmt::format("{}", expected),
              {}});
}

// Decides the meaning of the value -1. In Perseus, values are positive integers, and -1 means a
// cube that never enters. In GUDHI, a value may be any number, and -1 is an ordinary value. The
// meaning of Perseus applies if all other values are positive integers.
void take_missing_cubes(std::vector<double>& values, const ReadOptions& options) {
  std::ranges::replace(values, kInfinity, kAbsent);
  const auto count = std::count(values.begin(), values.end(), -1.0);
  if (count == 0) return;
  const bool perseus = std::all_of(values.begin(), values.end(), [](double v) {
    return v == -1 || std::isnan(v) || (v > 0 && v == std::floor(v));
  });
  if (perseus) std::ranges::replace(values, -1.0, kAbsent);
  detail::note(
      options,
      perseus
          ? fmt::format("{} of value -1 never enter{}, as in Perseus (all other values "
                        "are positive integers)",
                        count == 1 ? "1 cube" : fmt::format("{} cubes", count),
                        count == 1 ? "s" : "")
          : fmt::format("{} -1, which is read as a number; write inf for a cube that never enters",
                        count == 1 ? "1 value is" : fmt::format("{} values are", count)));
}

// Reads sizes, then values, with the first axis fastest.
PerseusImage read_dense(TextLines& lines, std::size_t axes) {
  const Input& input = lines.input();
  detail::CellStream stream(lines);
  PerseusImage result;
  std::optional<std::size_t> count = 1;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if (!stream.more()) fail_truncated(input, axis, axes, "sizes of axes");
    const char* place = stream.cells().place();
    const std::int64_t size = stream.cells().integer(-kMostExtent, kMostExtent, "size of an axis");
    if (size == 0)
      lines.fail(place,
                 {"size of an axis", "0", "1 or more, or a negative size for a periodic axis", {}});
    result.periodic.push_back(size < 0);
    result.image.extents.push_back(std::abs(size));
    if (count) count = checked_product(*count, static_cast<std::size_t>(std::abs(size)));
  }
  const std::size_t rest = input.size() - lines.offset() + lines.line().size();
  if (!count || *count > rest / 2 + 1) {
    lines.fail(lines.line().data(),
               {"truncated: the sizes do not fit the file",
                count ? fmt::format("{} values", *count) : "more than 2^64 values",
                fmt::format("at most {} in a file of this length", rest / 2 + 1),
                {}});
  }
  input.require_memory(*count * sizeof(double));
  std::vector<double> values(*count);
  detail::FirstAxisFastest walk(result.image.extents);
  for (std::size_t k = 0; k < *count; ++k, walk.next()) {
    if (!stream.more()) fail_truncated(input, k, *count, "values of cubes");
    values[walk.place()] = stream.cells().number(Allow::infinite);
  }
  if (stream.more()) {
    lines.fail(stream.cells().place(),
               {"trailing data", "another value", fmt::format("{} values", *count), {}});
  }
  result.image.values = std::move(values);
  return result;
}

// Reads one cube per line, as its coordinates and then its value. The current line is the first
// cube.
PerseusImage read_sparse_cubes(TextLines& lines, std::size_t axes) {
  struct Cubes {
    std::vector<Index> at;  // for each cube, one coordinate per axis
    std::vector<double> values;
    std::vector<std::size_t> lines;
  } cubes;
  const Input& input = lines.input();
  PerseusImage result;
  std::vector<Index>& extents = result.image.extents;
  extents.assign(axes, 0);
  result.periodic.assign(axes, false);
  Cells cells(lines);
  const std::string expected = fmt::format("{} coordinates and a value", axes);
  do {
    cells.start();
    if (cubes.values.size() == cubes.values.capacity()) {
      input.require_memory(2 * cubes.values.size() * (axes + 2) * sizeof(double));
    }
    for (std::size_t axis = 0; axis <= axes; ++axis) {
      if (!cells.more()) {
        lines.fail(lines.line().data() + lines.line().size(),
                   {"incomplete cube", fmt::format("{} cells", axis), expected, {}});
      }
      if (axis == axes) break;
      cubes.at.push_back(cells.integer(0, kMostExtent, "coordinate"));
      extents[axis] = std::max(extents[axis], cubes.at.back() + 1);
    }
    cubes.values.push_back(cells.number(Allow::infinite));
    cubes.lines.push_back(lines.number());
    cells.expect_end(expected);
  } while (lines.next());

  std::optional<std::size_t> count = 1;
  for (const Index extent : extents) {
    if (count) count = checked_product(*count, static_cast<std::size_t>(extent));
  }
  const std::size_t most = std::max(kFreeVoxels, kMostVoxelsPerCube * cubes.values.size());
  if (!count || *count > most) {
    input.fail({"the cubes lie too far apart for a grid",
                count ? fmt::format("{} voxels for {} cubes", *count, cubes.values.size())
                      : "more than 2^64 voxels",
                fmt::format("at most {}", most), "coordinates count from 0"});
  }
  input.require_memory(*count * sizeof(double));
  std::vector<double> values(*count, kAbsent);  // mutant: perseus-absent
  for (std::size_t i = 0; i < cubes.values.size(); ++i) {
    std::size_t place = 0;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      place = place * static_cast<std::size_t>(extents[axis]) +
              static_cast<std::size_t>(cubes.at[i * axes + axis]);
    }
    double& value = values[place];
    if (!std::isnan(value)) {
      input.fail_at(cubes.lines[i], 1, {"cube listed twice", {}, "each cube once", {}});
    }
    value = cubes.values[i];
  }
  result.image.values = std::move(values);
  return result;
}

}  // namespace

PerseusImage read_perseus(const Input& input, const ReadOptions& options) {
  TextLines lines(input);
  if (!lines.next()) {
    input.fail({"no dimension", "nothing", "dimension, sizes and values", {}});
  }
  Cells first(lines);
  first.start();
  const auto axes = static_cast<std::size_t>(first.integer(1, kMostAxes, "dimension"));
  first.expect_end("the dimension alone on its line");
  PerseusImage result;
  // Looking ahead at the next line distinguishes a list of cubes from a grid.
  TextLines ahead(input, lines.offset(), lines.number());
  std::size_t cells = 0;
  if (ahead.next()) {
    Cells counter(ahead);
    for (counter.start(); counter.more(); ++cells) counter.word();
  }
  if (cells == axes + 1) {
    lines.next();
    result = read_sparse_cubes(lines, axes);
  } else {
    result = read_dense(lines, axes);
  }
  result.image.values.change([&]<class T>(std::vector<T>& values) {
    if constexpr (std::same_as<T, double>) take_missing_cubes(values, options);
    result.image.masked = std::ranges::any_of(values, [](T v) { return v != v; });
  });
  return result;
}

PerseusImage read_perseus(const std::filesystem::path& path, const ReadOptions& options) {
  return read_perseus(Input::open(path, options.context, Input::Excess::refused,
                                  detail::start_check(Format::perseus)),
                      options);
}

}  // namespace ph
