// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/barcodes/barcode_formats.hpp"

namespace ph {
namespace {

/// Appends a number of 8 bytes, little endian on every machine.
template <class T>
void put(OutputFile& file, T value) {
  static_assert(sizeof(T) == 8);
  const auto bits = std::bit_cast<std::uint64_t>(value);
  char bytes[8];
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(bits >> (8 * i) & 0xff);
  file.write(std::string_view(bytes, 8));
}

constexpr std::int64_t kDiphaMagic = 8067171840;
constexpr std::int64_t kDiphaDiagram = 2;

}  // namespace

void write_barcode_dipha(OutputFile& file, const Barcode& barcode,
                         const std::optional<double>& threshold) {
  // An essential class of dimension k is stored as -k-1, with the largest value as its death.
  double largest = threshold && std::isfinite(*threshold) ? *threshold : -kInfinity;
  for (const Bar& bar : barcode)
    largest = std::max({largest, bar.birth, bar.is_infinite() ? bar.birth : bar.death});
  put(file, kDiphaMagic);
  put(file, kDiphaDiagram);
  put(file, static_cast<std::int64_t>(barcode.size()));
  for (const Bar& bar : barcode) {
    put(file, std::int64_t{bar.is_infinite() ? -bar.dim - 1 : bar.dim});
    put(file, bar.birth + 0.0);  // -0 is 0
    put(file, bar.is_infinite() ? largest : bar.death);
  }
}

void write_barcode_npy(OutputFile& file, const Barcode& barcode) {
  // NumPy's format 1.0: magic, version, length of the header, a header that ends on a multiple of
  // 64 bytes in a newline, the numbers.
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, 3), }}", barcode.size());
  constexpr std::size_t kPrefix = 10;
  header.append(63 - (kPrefix + header.size()) % 64, ' ');
  header += '\n';
  file.write(std::string_view("\x93NUMPY\x01\x00", 8));
  const char length[2] = {static_cast<char>(header.size() & 0xff),
                          static_cast<char>(header.size() >> 8)};
  file.write(std::string_view(length, 2));
  file.write(header);
  for (const Bar& bar : barcode) {
    put(file, static_cast<double>(bar.dim));
    put(file, bar.birth + 0.0);  // -0 is 0
    put(file, bar.death);
  }
}

}  // namespace ph
