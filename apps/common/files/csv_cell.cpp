// SPDX-License-Identifier: MIT
#include "apps/common/files/csv_cell.hpp"

#include "ph/detail/io/reader.hpp"

namespace ph::app {

std::string csv_cell(const std::string& name) {
  std::string text = printable(name);
  if (text.find_first_of(",\"#") == text.npos && !text.empty()) return text;
  // mutant: csv-quotes
  for (std::size_t i = 0; (i = text.find('"', i)) != text.npos; i += 2) text.insert(i, 1, '"');
  return '"' + text + '"';
}

}  // namespace ph::app
