// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/tables/array.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

[[noreturn]] void refuse(std::string_view what, const std::string& found,
                         std::string_view expected) {
  throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected {}", what, found, expected));
}

/// The place and the type of the numbers behind the bytes to skip.
detail::ArrayLayout numbers_of(const Input& input, const RawLayout& layout) {
  const auto type = detail::element_type(layout.type);
  if (!type || layout.type.starts_with('b'))
    refuse("raw type", printable(layout.type, 40), "u1, u2, u4, u8, i1, i2, i4, i8, f2, f4 or f8");
  if (layout.skip > input.size()) {
    input.fail_at_byte(input.size(), {"truncated in the skipped bytes",
                                      fmt::format("{} bytes", input.size()),
                                      fmt::format("at least {}", layout.skip),
                                      {}});
  }
  return {*type, layout.big_endian ? std::endian::big : std::endian::little, false, layout.skip};
}

}  // namespace

Image read_raw(const Input& input, const RawLayout& layout, const ReadOptions& options) {
  if (layout.extents.empty()) refuse("raw shape", "no axes", "at least one");
  for (const Index extent : layout.extents)
    if (extent < 0) refuse("raw shape", fmt::format("{}", extent), "sizes of 0 or more");
  if (layout.coordinates != 0)
    refuse("raw points", fmt::format("{}", layout.coordinates), "0 for an image");
  return detail::without_nan_pixels(
      detail::load_array(input, numbers_of(input, layout), layout.extents,
                         Input::Excess::stays_in_file),
      input, options);
}

Points read_raw_points(const Input& input, const RawLayout& layout, const ReadOptions& options) {
  constexpr Index most = Index{1} << 20;
  if (layout.coordinates < 1 || layout.coordinates > most)
    refuse("raw points", fmt::format("{}", layout.coordinates), "1 to 2^20 numbers per point");
  if (!layout.extents.empty()) refuse("raw points", "the extents of an image", "none");
  const detail::ArrayLayout array = numbers_of(input, layout);
  const auto width = static_cast<std::size_t>(layout.coordinates);
  const std::size_t bytes = input.size() - array.offset, each = width * array.type.size;
  if (bytes % each != 0)
    input.fail_at_byte(array.offset + bytes / each * each,
                       {"truncated point",
                        fmt::format("{} of its bytes", bytes % each),
                        fmt::format("{}, for {} numbers of {} bytes", each, width, array.type.size),
                        {}});
  const auto count = static_cast<Index>(bytes / each);
  return detail::points_of_array(detail::load_array(input, array, {count, layout.coordinates}),
                                 input, options);
}

}  // namespace ph
