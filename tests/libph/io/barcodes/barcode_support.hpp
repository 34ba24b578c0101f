// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <string>

#include "ph/io/write.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {

/// Four bars in three dimensions, with infinite, very small and very large numbers.
inline Barcode example(CellKind kind = CellKind::vertices) {
  Barcode barcode(kind);
  const std::array<Index, 2> edge{0, 2};
  const std::array<Index, 3> triangle{0, 1, 2};
  barcode.add({0, 0, 0.1}, std::array<Index, 1>{2}, edge);
  barcode.add({0, 0, kInfinity}, std::array<Index, 1>{0}, {});
  barcode.add({2, 1.0 / 3, 1e22}, edge, triangle);
  barcode.add({1, -kInfinity, 5e-324}, edge, triangle);
  barcode.sort();
  return barcode;
}

/// The content of the file to which a barcode is written.
inline std::string text_of(const Barcode& barcode, BarcodeFormat format) {
  const TempDir dir;
  OutputFile file(dir.file("barcode").string());
  write_barcode(file, barcode, format);
  file.commit();
  return std::string(Input::open(dir.file("barcode")).text());
}
inline Barcode back(const std::string& bytes, const std::string& name = "b") {
  return read_barcode(Input::view(bytes, name));
}

}  // namespace ph::test
