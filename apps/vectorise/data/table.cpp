// SPDX-License-Identifier: MIT
#include "apps/vectorise/data/table.hpp"

#include <array>

#include "apps/common/files/csv_cell.hpp"
#include "ph/detail/io/npy_write.hpp"
#include "ph/io/write.hpp"

namespace ph::vectorise {

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
    line = app::csv_cell(inputs[i]);
    for (const double number : std::span(table.numbers).subspan(i * table.columns, table.columns))
      line += "," + shortest(number);
    file.write(line + "\n");
  }
}

}  // namespace ph::vectorise
