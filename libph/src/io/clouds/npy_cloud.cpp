// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/clouds/cloud_rows.hpp"
#include "libph/src/io/points/npy_header.hpp"
#include "ph/io/cloud.hpp"

namespace ph {

Cloud read_npy_cloud(const Input& input, const ReadOptions& options) {
  if (detail::is_npy_of_records(input)) return detail::cloud_of_records(input, options);
  const Image array = detail::read_npy_array(input);
  const std::vector<Index>& shape = array.extents;
  const bool organised = shape.size() == 3;
  const std::string found = fmt::format("shape ({})", fmt::join(shape, ", "));
  constexpr Index least_columns = 3, most_columns = 64;
  const auto are_columns = [&](Index n) { return n >= least_columns && n <= most_columns; };
  if (shape.size() < 2 || shape.size() > 3 || !are_columns(shape.back())) {
    const bool turned = shape.size() == 2 && are_columns(shape.front());
    input.fail({"not an array of points", found,
                "(points, n) or (rows, columns, n) with n from 3 to 64",
                turned              ? "save its transpose"
                : shape.size() == 2 ? fmt::format("a depth image needs a camera: {} or {}",
                                                  mark(Setting::camera), mark(Setting::intrinsics))
                                    : ""});
  }
  if (!detail::is_npy_of_floats(input))
    input.fail({"coordinates", "whole numbers", "floats", "points are in metres"});
  const Index count = organised ? shape[0] * shape[1] : shape[0];
  input.require_memory(static_cast<std::size_t>(count * shape.back()) * sizeof(double));
  detail::TextTable table{Points(count, shape.back()), {}};
  constexpr std::size_t block = std::size_t{1} << 16;
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    table.rows.data()[i] = array.values[i];
    // The pages of the file that were read leave the memory.
    if (i % block == 0) input.poll(i * bytes_of(array.values.type()));
  }
  Cloud cloud = detail::cloud_of_rows(table, input, options, detail::RowSource::array);
  if (organised && count > 0) {
    cloud.width = shape[1];
    cloud.height = shape[0];
  }
  return cloud;
}

}  // namespace ph
