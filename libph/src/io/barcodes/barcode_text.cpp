// SPDX-License-Identifier: MIT
#include "ph/detail/io/barcode_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ph {

std::string shortest(double value) {
  return fmt::format("{}", value == 0 ? 0.0 : value);  // the number -0.0 becomes 0
}

namespace {

/// Formats a number as in Ripser's output, with six significant digits. The number -0 becomes 0.
std::string six_digits(double value) { return fmt::format("{:g}", value == 0 ? 0.0 : value); }

}  // namespace

void write_barcode_csv(OutputFile& file, const Barcode& barcode, std::span<const double> p_values) {
  const bool has_p = !p_values.empty();
  file.write(has_p ? "dim,birth,death,p\n" : "dim,birth,death\n");
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    const Bar& bar = barcode[i];
    file.write(fmt::format("{},{},{}", bar.dim, shortest(bar.birth), shortest(bar.death)));
    if (has_p)
      file.write(std::isnan(p_values[i]) ? "," : fmt::format(",{}", shortest(p_values[i])));
    file.write("\n");
  }
}

void write_barcode_pers(OutputFile& file, const Barcode& barcode) {
  for (const Bar& bar : barcode)
    file.write(fmt::format("{} {} {}\n", bar.dim, shortest(bar.birth), shortest(bar.death)));
}

void write_barcode_ripser(OutputFile& file, const Barcode& barcode, int max_dim) {
  for (const Bar& bar : barcode) max_dim = std::max(max_dim, bar.dim);
  for (int dim = 0; dim <= max_dim; ++dim) {
    file.write(fmt::format("persistence intervals in dim {}:\n", dim));
    // Ripser prints infinite bars last.
    for (const Bar& bar : barcode.bars(dim))
      if (!bar.is_infinite())
        file.write(fmt::format(" [{},{})\n", six_digits(bar.birth), six_digits(bar.death)));
    for (const Bar& bar : barcode.bars(dim))
      if (bar.is_infinite()) file.write(fmt::format(" [{}, )\n", six_digits(bar.birth)));
  }
}

}  // namespace ph
