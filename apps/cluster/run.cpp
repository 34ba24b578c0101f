// SPDX-License-Identifier: MIT
#include "apps/cluster/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/cluster/arguments/scopes.hpp"
#include "apps/cluster/data/load.hpp"
#include "apps/cluster/data/make_tree.hpp"
#include "apps/cluster/output/results.hpp"
#include "apps/common/files/extensions.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/inputs/read_data.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/detail/metric/spanning_forest.hpp"

namespace ph::cluster {
namespace {

/// Checks that no output replaces an input. @throws Error (usage).
void require_separate(const Arguments& a, app::Session& session) {
  app::InputFiles inputs;
  inputs.add(a.input(), a.format);  // mutant: cluster-inputs
  std::vector<app::Written> outputs;
  if (a.dry_run) {
    outputs.push_back({"--dry-run", "-"});
  } else {
    outputs.push_back({"--output", a.output});
    if (!a.tree.empty()) outputs.push_back({"--tree", a.tree});
  }
  const bool replaces = app::require_separate(inputs, outputs, a.common.force);
  if (replaces || !a.common.force) return;
  if (a.dry_run)
    session.note("--force does nothing: --dry-run writes no file");
  else
    session.explain("--force: not needed, because no output is an input");
}

/// Notes the given options that have no effect without a computation.
void explain_unused(const Arguments& a, app::Session& session) {
  std::vector<std::string> unused;
  for (const app::GivenOption& option : a.given)
    if ((option.scope.where & kDryRun) == 0) unused.push_back("--" + option.name);
  if (!unused.empty()) session.note(fmt::format("--dry-run ignores {}", fmt::join(unused, ", ")));
}

/// The distances between which points are joined, in words.
std::string distances_text(const Loaded& loaded, const Arguments& a, Index neighbours) {
  const std::string kind = app::points_of(loaded.read)
                               ? metric_name(a.rips.distance, a.rips.minkowski_p)
                               : "as they were read";
  if (a.has_births()) return kind + ", points enter at births on the diagonal";
  if (neighbours == 0) return kind + ", single linkage";
  return fmt::format("{}, mutual reachability with {}", kind,
                     app::count_of(static_cast<std::size_t>(neighbours), "neighbour"));
}

/// The bytes that a run needs beside the data, at least and at most, measured on points with two to
/// twelve coordinates and on distances.
std::array<double, 2> bytes_beside(const Loaded& loaded, const Arguments& a, Index neighbours) {
  const auto n = static_cast<double>(loaded.points);
  const auto points = app::points_of(loaded.read);
  if (points && has_fast_spanning_forest(*points, a.rips.distance)) {
    // With more than three coordinates, there are two copies of them, which are not in the numbers.
    const Index axes = points->cols() > 3 ? points->cols() : 0;
    const double copies = 2 * sizeof(double) * static_cast<double>(axes);
    return {(90 + copies) * n, (220 + copies) * n};
  }
  if (const auto* some = std::get_if<SparseDistances>(&loaded.read.data)) {
    const auto edges = static_cast<double>(some->edges().size());
    return {40 * n, 140 * n + 40 * edges};
  }
  // The distances to the neighbours of all points are kept.
  return {40 * n, (140 + 8 * static_cast<double>(neighbours)) * n};
}

/// The output of --dry-run. @param taken the bytes that reading the data took.
std::string estimate_text(const Loaded& loaded, const Arguments& a, Index neighbours,
                          double taken) {
  const auto [least, most] = bytes_beside(loaded, a, neighbours);
  return fmt::format(
      "input     {}\ndistances {}\nclusters  of at least {} points\nmemory    {} to {}\n",
      loaded.read.description, distances_text(loaded, a, neighbours), a.min_size,
      format_size(taken + least), format_size(taken + most));
}

/// The files that a run writes. They are opened before the input is read, because a file that
/// cannot be created should be reported before a long computation.
struct Outputs {
  app::Output labels;
  std::optional<app::Output> tree;

  explicit Outputs(const Arguments& a) : labels(a.output) {
    if (!a.tree.empty()) tree.emplace(a.tree);
  }
  void write(const Results& results, app::Session& session) {
    const app::BarHold results_are_written(session);
    write_labels(labels.file(), results);
    if (tree) write_tree(tree->file(), results, ends_in(results.arguments.tree, ".csv"));
    labels.commit();
    if (tree) tree->commit();
  }
};

}  // namespace

int run(const Arguments& a, app::Session& session) {
  require_separate(a, session);
  const RunContext& context = session.context();
  if (a.dry_run) {
    explain_unused(a, session);
    const Loaded loaded = load(a, session);
    const app::BarHold results_are_written(session);
    write_file("-", estimate_text(loaded, a, neighbours_of(a, loaded.points),
                                  static_cast<double>(session.memory_taken())));
    return app::kOk;
  }
  Outputs outputs(a);
  if (!a.named_format() && app::has_extension(a.output))
    session.note(app::no_format_in(a.output, "csv"));
  const Loaded loaded = load(a, session);
  const Index neighbours = neighbours_of(a, loaded.points);
  session.explain("distances " + distances_text(loaded, a, neighbours));
  const ClusterTree tree = make_tree(loaded, a, neighbours, context);
  if (!a.neighbours && neighbours < a.min_size - 1 && loaded.points > 0 && !a.has_births())
    session.note(fmt::format("--neighbours {} instead of {}, because there are only {}", neighbours,
                             a.min_size - 1,
                             app::count_of(static_cast<std::size_t>(loaded.points), "point")));
  Results results{a, loaded, neighbours, tree, tree.select(a.choice)};
  if (a.scores) results.outlier_scores = tree.outlier_scores();
  session.explain("memory " + format_size(static_cast<double>(session.memory_taken())));
  outputs.write(results, session);
  const auto noise = std::ranges::count(results.clusters.labels, -1);
  session.note(fmt::format("{}: {}, {} of noise", loaded.read.description,
                           app::count_of(results.clusters.chosen.size(), "cluster"),
                           app::count_of(static_cast<std::size_t>(noise), "point")));
  return app::kOk;
}

}  // namespace ph::cluster
