// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/tables/array.hpp"
#include "ph/io/read.hpp"

namespace ph {

Image read_raw(const Input& input, const RawLayout& layout, const ReadOptions& options) {
  const auto refuse = [](std::string what, std::string found, std::string expected) {
    throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected {}", what, found, expected));
  };
  const auto type = detail::element_type(layout.type);
  if (!type || layout.type.starts_with('b'))
    refuse("raw type", printable(layout.type, 40), "u1, u2, u4, u8, i1, i2, i4, i8, f2, f4 or f8");
  if (layout.extents.empty()) refuse("raw shape", "no axes", "at least one");
  for (const Index extent : layout.extents)
    if (extent < 0) refuse("raw shape", fmt::format("{}", extent), "sizes of 0 or more");
  if (layout.skip > input.size()) {
    input.fail_at_byte(input.size(), {"truncated in the skipped bytes",
                                      fmt::format("{} bytes", input.size()),
                                      fmt::format("at least {}", layout.skip),
                                      {}});
  }
  const detail::ArrayLayout array{*type, layout.big_endian ? std::endian::big : std::endian::little,
                                  false, layout.skip};
  return detail::without_nan_pixels(
      detail::load_array(input, array, layout.extents, Input::Excess::stays_in_file), input,
      options);
}

}  // namespace ph
