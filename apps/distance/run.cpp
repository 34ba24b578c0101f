// SPDX-License-Identifier: MIT
#include "apps/distance/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/common/files/extensions.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/inputs/barcode_files.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/values/numbers.hpp"
#include "apps/distance/arguments/scopes.hpp"
#include "apps/distance/data/groups.hpp"
#include "apps/distance/data/pairs.hpp"
#include "apps/distance/output/group_tests.hpp"
#include "apps/distance/output/matching.hpp"
#include "apps/distance/output/table.hpp"
#include "ph/io/write.hpp"

namespace ph::distance_program {
namespace {

bool has_format(const std::string& path, BarcodeFormat format) {
  return barcode_format_of_path(path) == format;
}

/// Returns a text such as "H0 and H1".
std::string names_of(const std::vector<int>& dims) {
  std::string names;
  for (std::size_t i = 0; i < dims.size(); ++i)
    names += fmt::format("{}H{}", i == 0 ? "" : i + 1 == dims.size() ? " and " : ", ", dims[i]);
  return names;
}

/// One run: opens the outputs, reads the barcodes, computes, and writes the results.
class Run {
 public:
  Run(const Arguments& arguments, app::Session& session)
      : arguments_(arguments),
        session_(session),
        context_(session.context()),
        files_(app::barcode_files(arguments.inputs)) {
    if (files_.size() < 2)
      throw Error(ErrorKind::usage,
                  fmt::format("BARCODE: found only {}, expected at least two barcodes",
                              printable(files_[0])));
    app::require_in_scope(arguments.given, files_.size() == 2 ? kTwo : kMany,
                          app::count_of(files_.size(), "barcode"));
    if (arguments.common.threads > 0 && files_.size() == 2 &&
        arguments.distance.kind != app::DistanceKind::sliced)
      session.note("--threads does nothing: one thread computes the distance between two barcodes");
    require_separate();
    if (arguments.writes_table()) {
      const std::string path = arguments.output_path();
      table_.emplace(path);
      const bool is_said = arguments.output_format || barcode_format_of_path(path);
      if (!is_said && app::has_extension(path) && !path.ends_with(".txt"))
        session.note(app::no_format_in(path, "text"));
    }
    if (!arguments.matching.empty()) matching_.emplace(arguments.matching);
    if (!arguments.matrix.empty()) matrix_.emplace(arguments.matrix);
  }

  void run() {
    if (!arguments_.groups.empty())
      groups_ = read_groups(app::open_input(arguments_.groups, session_), files_.size());
    const app::StoredBarcodes stored(files_, session_);
    const std::vector<Barcode>& barcodes = stored.all();
    const std::vector<int> dims = dims_to_compare(barcodes);
    std::vector<DimMatching> matchings;
    const PairDistances distances =
        matching_ ? matched(barcodes, dims, matchings)
                  : distances_of(barcodes, dims, arguments_.distance, context_);
    std::vector<PermutationTest> tests;
    if (groups_) tests = tests_of(distances, *groups_, barcodes, files_, arguments_, context_);
    note_infinite(distances);
    const app::BarHold results_are_written(session_);
    if (table_ && groups_)
      write_tests(table_->file(), tests, distances, *groups_, files_, arguments_);
    else if (table_)
      write_distances(table_->file(), distances, barcodes, files_, arguments_);
    if (matching_)
      write_matching(matching_->file(), matchings,
                     has_format(arguments_.matching, BarcodeFormat::json), arguments_.distance,
                     files_);
    if (matrix_)
      write_matrix(matrix_->file(), distances, has_format(arguments_.matrix, BarcodeFormat::npy),
                   files_);
    for (auto* output : {&table_, &matching_, &matrix_})
      if (*output) (*output)->commit();
    if (matrix_)  // the file itself cannot state the distance and the dimension
      session_.note(fmt::format("{}: {} in H{}", printable(arguments_.matrix),
                                app::words_of(arguments_.distance), dims[0]));
    session_.note(fmt::format("{}, {}: {}", app::count_of(files_.size(), "barcode"),
                              dims.empty() ? "no bars" : names_of(dims),
                              app::count_of(dims.size() * distances.pairs(), "distance")));
  }

 private:
  /// Checks that no output replaces an input. @throws Error (usage).
  void require_separate() const {
    app::InputFiles inputs;
    for (const std::string& file : files_) inputs.add(file);
    if (!arguments_.groups.empty()) inputs.add(arguments_.groups);  // mutant: group-file
    std::vector<app::Written> outputs;
    if (arguments_.writes_table()) outputs.push_back({"--output", arguments_.output_path()});
    if (!arguments_.matching.empty()) outputs.push_back({"--matching", arguments_.matching});
    if (!arguments_.matrix.empty()) outputs.push_back({"--matrix", arguments_.matrix});
    const bool replaces = app::require_separate(inputs, outputs, arguments_.common.force);
    if (!replaces && arguments_.common.force)
      session_.explain("--force: not needed, because no output is an input");
  }

  /// @throws Error (usage) if there are several dimensions and a matrix is requested.
  std::vector<int> dims_to_compare(const std::vector<Barcode>& barcodes) const {
    const std::vector<int> there = app::dims_of(barcodes);
    for (const int dim : arguments_.dims)
      if (!std::ranges::binary_search(there, dim))
        session_.note(fmt::format("--dims: no barcode has bars of H{}: all distances are 0", dim));
    const std::vector<int>& dims = arguments_.dims.empty() ? there : arguments_.dims;
    if (matrix_ && dims.size() != 1)  // mutant: matrix-dimensions
      throw Error(ErrorKind::usage,
                  fmt::format("--matrix: found {}, expected one dimension; --dim D selects one",
                              dims.empty() ? "no bars" : names_of(dims)));
    return dims;
  }

  /// The distances between two barcodes, and the pairs of their bars.
  PairDistances matched(const std::vector<Barcode>& barcodes, const std::vector<int>& dims,
                        std::vector<DimMatching>& matchings) const {
    PairDistances distances(2, dims, &context_.memory);
    for (std::size_t d = 0; d < dims.size(); ++d) {
      const std::span<const Bar> a = barcodes[0].bars(dims[d]), b = barcodes[1].bars(dims[d]);
      matchings.push_back({dims[d], {a, b}, app::matching_of(a, b, arguments_.distance, context_)});
      distances.at(d, 1, 0) = matchings.back().matching.distance;
    }
    return distances;
  }

  /// Notes infinite distances, because only the text format states the reason next to each of them.
  void note_infinite(const PairDistances& distances) const {
    if (table_ && !matrix_ && arguments_.table_format() == OutputFormat::text) return;
    for (std::size_t d = 0; d < distances.dims().size(); ++d) {
      std::size_t count = 0;
      for (std::size_t a = 0; a < distances.count(); ++a)
        for (std::size_t b = 0; b < a; ++b) count += std::isinf(distances.at(d, a, b).value);
      if (count > 0)  // mutant: matrix-infinite
        session_.note(fmt::format(
            "H{}: {} infinite, because the numbers of infinite bars differ", distances.dims()[d],
            count == 1 ? "1 distance is" : fmt::format("{} distances are", count)));
    }
  }

  const Arguments& arguments_;
  app::Session& session_;
  const RunContext& context_;
  std::vector<std::string> files_;
  std::optional<Groups> groups_;
  std::optional<app::Output> table_, matching_, matrix_;
};

}  // namespace

int run(const Arguments& arguments, app::Session& session) {
  Run(arguments, session).run();
  return app::kOk;
}

}  // namespace ph::distance_program
