// SPDX-License-Identifier: MIT
#include "ph/io/save.hpp"

#include <fmt/format.h>

namespace ph {

void save(const std::string& path, const Barcode& bars, const BarData& data) {
  const auto format = barcode_format_of_path(path);
  if (!format)
    throw Error(ErrorKind::usage,
                fmt::format("{}: found no known extension, expected .csv, .json, .ripser, .pers, "
                            ".dipha or .npy",
                            printable(path)));
  OutputFile file(path);
  write_barcode(file, bars, *format, data);
  file.commit();
}

}  // namespace ph
