// SPDX-License-Identifier: MIT
// Reads one number for each cell, vertex or point from a separate file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstring>

#include "libph/src/io/bytes/field_access.hpp"
#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/bytes/utf8.hpp"
#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

Fault wrong_count(std::size_t found, std::size_t count, std::string_view owner) {
  return {found < count ? "truncated: too few values" : "too many values",
          fmt::format("{}", found),
          fmt::format("{}, one per {}", count, owner),
          {}};
}

std::vector<double> of_text(const Input& input, std::size_t count, const ReadOptions& options,
                            std::string_view owner) {
  std::vector<double> values;
  input.require_memory(std::min(count, input.size()) * sizeof(double));
  values.reserve(std::min(count, input.size()));
  TextLines lines(input);
  Cells cells(lines);
  bool more = lines.next();
  if (more && !header_names(lines.line()).empty()) {
    detail::note(options,
                 fmt::format("{}: line {} is a header: skipped", input.name(), lines.number()));
    more = lines.next();
  }
  for (; more; more = lines.next()) {
    for (cells.start(); cells.more();) {
      if (values.size() == count) {
        lines.fail(cells.place(), {"too many values",
                                   fmt::format("more than {}", count),
                                   fmt::format("{}, one per {}", count, owner),
                                   {}});
      }
      values.push_back(cells.number(Allow::infinite));
    }
  }
  return values;
}

// Reads an array that has one axis, or a single row or column.
std::vector<double> of_array(const Input& input, std::string_view owner) {
  const Image array = detail::read_npy_array(input);
  std::size_t long_axes = 0;
  for (const Index extent : array.extents) long_axes += extent != 1 ? 1 : 0;
  if (long_axes > 1) {
    input.fail({"not a list of values",
                fmt::format("shape ({})", fmt::join(array.extents, ", ")),
                fmt::format("one axis: one value per {}", owner),
                {}});
  }
  input.require_memory(array.values.size() * sizeof(double));
  std::vector<double> values(array.values.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = array.values[k];
  return values;
}

// Reads the vertex property NAME of a PLY, for a name "FILE.ply:NAME".
std::vector<double> of_property(const Input& input) {
  const Cloud cloud = read_ply(input, {.allow_empty = true, .context = input.context()});
  std::vector<std::string> names;
  for (const CloudField& field : cloud.fields) names.push_back(printable(field.name, 40));
  const CloudField* const field = input.member().empty() ? nullptr : cloud.find(input.member());
  if (field == nullptr || field->count != 1) {
    input.fail({input.member().empty() ? "a PLY file has several values per vertex"
                                       : "no such property of the vertices",
                printable(input.member(), 40), fmt::format("one of {}", fmt::join(names, ", ")),
                fmt::format("{}:NAME chooses one", input.name())});
  }
  const auto count = static_cast<std::size_t>(cloud.size());
  input.require_memory(count * sizeof(double));
  std::vector<double> values(count);
  detail::visit_type(field->type, [&]<class T>(T) {
    for (std::size_t k = 0; k < count; ++k)
      values[k] = static_cast<double>(
          load<T>(cloud.data.data() + k * cloud.stride + field->offset, std::endian::native));
  });
  return values;
}

// Reads float64, little endian, without a header.
std::vector<double> of_bytes(const Input& input, std::size_t count, std::string_view owner) {
  if (input.size() % sizeof(double) != 0 || input.size() / sizeof(double) != count) {
    input.fail({"wrong number of values",
                fmt::format("{} bytes", input.size()),
                fmt::format("{} values of 8 bytes, one per {}", count, owner),
                {}});
  }
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k)
    values[k] = load<double>(input.bytes().data() + k * sizeof(double), std::endian::little);
  return values;
}

}  // namespace

std::vector<double> read_values(const Input& input, std::size_t count, const ReadOptions& options,
                                std::string_view owner) {
  const bool is_array = detail::is_npy(input) || detail::is_npz(input);
  const bool is_ply = detail::is_ply(input);
  // The bytes of a few doubles may contain no control characters, but they are rarely valid UTF-8.
  const bool may_be_raw = input.size() == count * sizeof(double) && !is_utf8(input.text());
  const bool is_raw = !is_array && !is_ply && (may_be_raw || !detail::is_text(input.text()));
  std::vector<double> values = is_array ? of_array(input, owner)
                               : is_ply ? of_property(input)
                               : is_raw ? of_bytes(input, count, owner)
                                        : of_text(input, count, options, owner);
  if (values.size() != count) input.fail(wrong_count(values.size(), count, owner));
  for (std::size_t k = 0; k < count; ++k) {
    if (std::isnan(values[k])) {
      const Fault fault{fmt::format("value {}", k), "NaN", "a number", {}};
      if (is_raw) input.fail_at_byte(k * sizeof(double), fault);
      input.fail(fault);
    }
    values[k] += 0.0;  // the sum turns -0.0 into +0.0
  }
  return values;
}

}  // namespace ph
