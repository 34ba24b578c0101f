// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "ph/detail/io/reader.hpp"

namespace ph {

std::span<const std::byte> BinaryCursor::take(std::size_t size, const char* what) {
  if (size > remaining()) {
    input_.fail_at_byte(input_.size(),
                        {fmt::format("truncated in the {}", what),
                         fmt::format("{} bytes from byte {} on", remaining(), offset_),
                         fmt::format("{}", size),
                         {}});
  }
  const auto result = input_.bytes().subspan(offset_, size);
  offset_ += size;
  return result;
}

std::size_t BinaryCursor::read_count(const char* what, std::size_t bytes_each) {
  const std::size_t at = offset_;
  const auto count = read<std::int64_t>(what);
  if (count < 0) {
    input_.fail_at_byte(
        at, {fmt::format("negative {}", what), fmt::format("{}", count), "0 or more", {}});
  }
  const auto bytes = checked_product(static_cast<std::size_t>(count), bytes_each);
  if (!bytes || *bytes > remaining()) {
    input_.fail_at_byte(at,
                        {fmt::format("truncated: the {} does not fit the file", what),
                         fmt::format("{}", count),
                         fmt::format("at most {} for the {} bytes that follow",
                                     bytes_each == 0 ? 0 : remaining() / bytes_each, remaining()),
                         {}});
  }
  return static_cast<std::size_t>(count);
}

void BinaryCursor::expect_end() const {
  if (remaining() > 0) {
    input_.fail_at_byte(
        offset_,
        {"trailing data", fmt::format("{} more bytes", remaining()), "the end of the file", {}});
  }
}

}  // namespace ph
