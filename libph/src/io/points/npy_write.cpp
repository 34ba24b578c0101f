// SPDX-License-Identifier: MIT
#include "ph/detail/io/npy_write.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace ph {
namespace {

void write_bits(OutputFile& file, std::uint64_t bits) {
  char bytes[8];
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(bits >> (8 * i) & 0xff);
  file.write(std::string_view(bytes, 8));
}

}  // namespace

void write_npy_header(OutputFile& file, std::span<const std::size_t> shape, std::string_view type) {
  // The file begins with a magic number, a version and the length of the header. The header ends in
  // a newline at a multiple of 64 bytes.
  std::string extents;
  for (const std::size_t n : shape) extents += fmt::format("{}{}", extents.empty() ? "" : ", ", n);
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}",
                                   type, extents, shape.size() == 1 ? "," : "");
  constexpr std::size_t kPrefix = 10;
  header.append(63 - (kPrefix + header.size()) % 64, ' ');
  header += '\n';
  file.write(std::string_view("\x93NUMPY\x01\x00", 8));
  const char length[2] = {static_cast<char>(header.size() & 0xff),
                          static_cast<char>(header.size() >> 8)};
  file.write(std::string_view(length, 2));
  file.write(header);
}

void write_npy_numbers(OutputFile& file, std::span<const double> numbers) {
  for (const double number : numbers) write_bits(file, std::bit_cast<std::uint64_t>(number + 0.0));
}

void write_npy_numbers(OutputFile& file, std::span<const std::int64_t> numbers) {
  for (const std::int64_t number : numbers) write_bits(file, static_cast<std::uint64_t>(number));
}

}  // namespace ph
