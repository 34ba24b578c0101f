// SPDX-License-Identifier: MIT
#include "ph/detail/report/bar_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "ph/error.hpp"
#include "ph/io/plot.hpp"

namespace ph::report {
namespace {

/// Numbers of cells, one cell after another.
class CellColumn {
 public:
  void add(const InputCell& cell) {
    for (const Index number : cell.numbers) {
      if (number < 0 || number > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorKind::bad_data,
                    fmt::format("{}: found a cell of vertex {}, expected 0 to 2^32 - 1",
                                mark(Setting::report), number));
      numbers_.push_back(static_cast<std::uint32_t>(number));
    }
  }
  const std::vector<std::uint32_t>& numbers() const { return numbers_; }

 private:
  std::vector<std::uint32_t> numbers_;
};

void add_cells(ReportFile& report, const Barcode& barcode, std::string_view prefix) {
  CellColumn births, deaths;
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    births.add(barcode.birth_cell(i));
    if (const auto death = barcode.death_cell(i)) deaths.add(*death);
  }
  // A barcode without cells has no birth cells. The page needs the cells of all bars or of no bar.
  if (births.numbers().empty()) return;
  report.add(fmt::format("{}/birth_cells", prefix), births.numbers());
  report.add(fmt::format("{}/death_cells", prefix), deaths.numbers());
}

}  // namespace

void add_bars(ReportFile& report, const Barcode& barcode, std::string_view prefix, bool cells) {
  const MemoryClaim columns(report.context().memory,
                            barcode.size() * (sizeof(std::uint8_t) + 2 * sizeof(double)));
  std::vector<std::uint8_t> dims;
  std::vector<double> births, deaths;
  for (const Bar& bar : barcode) {
    if (bar.dim > UINT8_MAX)
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: found a bar of dimension {}, expected at most {}",
                              mark(Setting::report), bar.dim, UINT8_MAX));
    dims.push_back(static_cast<std::uint8_t>(bar.dim));
    births.push_back(bar.birth);
    deaths.push_back(bar.death);
  }
  report.add(fmt::format("{}/dim", prefix), dims);
  report.add(fmt::format("{}/birth", prefix), births);
  report.add(fmt::format("{}/death", prefix), deaths);
  if (cells) add_cells(report, barcode, prefix);
}

void add_pictures(ReportFile& report, std::span<const Barcode> barcodes, const Metadata& meta) {
  PlotOptions options;
  options.value_label = meta.value_unit.empty()
                            ? meta.value_label
                            : fmt::format("{} ({})", meta.value_label, meta.value_unit);
  options.negated = meta.negated;
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < barcodes.size(); ++i) {
    // The plot needs this memory to find the longest bars.
    const MemoryClaim places(report.context().memory, 2 * barcodes[i].size() * sizeof(std::size_t));
    options.title = meta.barcodes[i].name;
    pictures.push_back(svg_plot(barcodes[i], options));
  }
  report.add_pictures(pictures);
}

void add_chains(ReportFile& report, const Barcode& barcode) {
  if (barcode.representatives() == Representatives::none) return;
  std::vector<std::uint32_t> bars, start{0};
  CellColumn cells;
  std::vector<std::int32_t> coefficients;
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    const InputChain chain = barcode.representative(i);
    if (chain.size() == 0) continue;
    bars.push_back(static_cast<std::uint32_t>(i));
    start.push_back(start.back() + static_cast<std::uint32_t>(chain.size()));
    for (std::size_t k = 0; k < chain.size(); ++k) {
      cells.add(chain.cell(k));
      coefficients.push_back(static_cast<std::int32_t>(chain.coefficient(k)));
    }
  }
  report.add("chains/bar", bars);
  report.add("chains/start", start, {.delta = true});
  report.add("chains/cells", cells.numbers());
  if (std::ranges::any_of(coefficients, [](std::int32_t c) { return c != 1; }))
    report.add("chains/coefficients", coefficients);
}

}  // namespace ph::report
