// SPDX-License-Identifier: MIT
#include "vectorise/data/table.hpp"

#include <array>

#include "io/points/npy_write.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/io/write.hpp"

namespace ph::vectorise {
namespace {

/// A cell of CSV: between quotes, which are doubled, if it has a mark that means something.
std::string cell_of(const std::string& name) {
  std::string text = printable(name);
  if (text.find_first_of(",\"#") == text.npos && !text.empty()) return text;
  for (std::size_t i = 0; (i = text.find('"', i)) != text.npos; i += 2) text.insert(i, 1, '"');
  return '"' + text + '"';
}

}  // namespace

void write_table(OutputFile& file, const Table& table, OutputFormat format,
                 const std::vector<std::string>& inputs, const std::vector<std::string>& names) {
  if (format == OutputFormat::npy) {
    write_npy_header(file, std::array{inputs.size(), table.columns});
    write_npy_numbers(file, table.numbers);
    return;
  }
  std::string line = "input";
  for (const std::string& name : names) line += "," + name;
  file.write(line + "\n");
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    line = cell_of(inputs[i]);
    for (const double number : std::span(table.numbers).subspan(i * table.columns, table.columns))
      line += "," + shortest(number);
    file.write(line + "\n");
  }
}

}  // namespace ph::vectorise
