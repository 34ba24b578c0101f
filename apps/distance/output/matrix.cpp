// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "apps/common/files/csv_cell.hpp"
#include "apps/distance/output/table.hpp"
#include "ph/detail/io/npy_write.hpp"
#include "ph/io/write.hpp"

namespace ph::distance_program {

void write_matrix(OutputFile& file, const PairDistances& distances, bool is_npy,
                  const std::vector<std::string>& inputs) {
  const std::size_t n = distances.count();
  std::vector<double> row(n);
  if (is_npy) {
    write_npy_header(file, std::array{n, n});
  } else {
    std::string header = "input";
    for (const std::string& input : inputs) header += "," + app::csv_cell(input);
    file.write(header + "\n");
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b)
      row[b] = a == b ? 0 : distances.at(0, std::max(a, b), std::min(a, b)).value;
    if (is_npy) {
      write_npy_numbers(file, row);
      continue;
    }
    std::string line = app::csv_cell(inputs[a]);
    for (const double number : row) line += "," + shortest(number);
    file.write(line + "\n");
  }
}

}  // namespace ph::distance_program
