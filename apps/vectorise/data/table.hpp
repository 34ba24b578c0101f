// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <span>
#include <string>
#include <vector>

#include "apps/vectorise/arguments/arguments.hpp"
#include "ph/detail/io/output_file.hpp"

namespace ph::vectorise {

/// A table with one row of numbers per input.
struct Table {
  std::size_t columns = 0;
  std::pmr::vector<double> numbers;

  std::span<double> row(std::size_t i) { return std::span(numbers).subspan(i * columns, columns); }
};

/// Writes the table. @param inputs the names of the inputs, one for each row. @param names the
/// names of the columns.
void write_table(OutputFile& file, const Table& table, OutputFormat format,
                 const std::vector<std::string>& inputs, const std::vector<std::string>& names);

}  // namespace ph::vectorise
