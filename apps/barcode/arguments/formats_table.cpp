// SPDX-License-Identifier: MIT
#include "barcode/arguments/formats_table.hpp"

#include <fmt/format.h>

#include "ph/io/read.hpp"
#include "ph/io/write.hpp"

namespace ph::barcode {
namespace {

std::string line(std::string_view name, std::string_view description, std::string_view example) {
  std::string text = fmt::format("  {:<15} {}\n", name, description);
  if (!example.empty()) text += fmt::format("  {:<15}   {}\n", "", example);
  return text;
}

}  // namespace

std::string formats_table() {
  std::string text = "Read (--format NAME), plain or compressed with gzip:\n";
  for (const FormatInfo& info : formats()) text += line(info.name, info.description, info.example);
  text += "\nWritten (--output-format NAME):\n";
  for (const BarcodeFormatInfo& info : barcode_formats())
    text += line(info.name, info.description, info.example);
  return text;
}

}  // namespace ph::barcode
