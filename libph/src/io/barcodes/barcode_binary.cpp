// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "ph/detail/io/barcode_formats.hpp"
#include "ph/detail/io/npy_write.hpp"

namespace ph {
namespace {

/// Appends a number as 8 bytes in little-endian order, on every machine.
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
  // An essential class of dimension k is stored with the dimension -k-1. Its death is the maximum
  // of the threshold and all finite values.
  double largest = threshold && std::isfinite(*threshold) ? *threshold : -kInfinity;
  for (const Bar& bar : barcode)
    largest = std::max({largest, bar.birth, bar.is_infinite() ? bar.birth : bar.death});
  put(file, kDiphaMagic);
  put(file, kDiphaDiagram);
  put(file, static_cast<std::int64_t>(barcode.size()));
  for (const Bar& bar : barcode) {
    put(file, std::int64_t{bar.is_infinite() ? -bar.dim - 1 : bar.dim});
    put(file, bar.birth + 0.0);  // the sum turns -0 into 0
    put(file, bar.is_infinite() ? largest : bar.death);
  }
}

void write_barcode_npy(OutputFile& file, const Barcode& barcode) {
  write_npy_header(file, std::array{barcode.size(), std::size_t{3}});
  for (const Bar& bar : barcode)
    write_npy_numbers(file, std::array{static_cast<double>(bar.dim), bar.birth, bar.death});
}

}  // namespace ph
