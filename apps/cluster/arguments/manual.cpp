// SPDX-License-Identifier: MIT
#include "apps/cluster/arguments/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>

#include "apps/common/terminal/words.hpp"

namespace ph::cluster {
namespace {

using Name = std::string_view;

constexpr std::array<Name, 1> kUsages{"[OPTION...] INPUT"};

constexpr std::array kTopics{
    app::Topic{"input", "Input: points, distances, missing values"},
    app::Topic{"clusters", "Clusters: sizes, densities, which are chosen"},
    app::Topic{"output", "Output: labels, scores, trees"},
    app::kLimitsTopic,
    app::kMessagesTopic,
};

constexpr std::array<Name, 12> kMostUsed{
    "--format",   "--min-size", "--neighbours",    "--metric", "--method", "--epsilon",
    "--max-size", "--output",   "--output-format", "--scores", "--tree",   "--dry-run"};

constexpr std::array kExamples{
    app::Example{"ph-cluster examples/data/two_circles.csv -o labels.csv",
                 "The label of the cluster of each point, -1 for noise"},
    app::Example{"ph-cluster examples/data/two_circles.csv --min-size 20 --scores -o scores.csv",
                 "Larger clusters, and how strongly each point belongs to its cluster"},
    app::Example{"ph-cluster examples/data/two_circles.csv --neighbours 0 --tree tree.json -o "
                 "labels.npy",
                 "Single linkage, with the whole hierarchy as JSON"},
    app::Example{"ph-cluster examples/data/table.pcd --min-size 50 -o clusters.ply",
                 "The clusters of a cloud, as a field of the cloud"},
    app::Example{"ph-cluster examples/data/two_circles.csv --dry-run",
                 "The memory that a run would take"},
};

std::vector<app::FormatList> format_lists() {
  std::vector<app::FormatList> lists{
      {"Read (--format NAME), plain or compressed with gzip", {}},
      {"Written (--output-format NAME)",
       {{"csv", "a header of names, then a row for each point", {}},
        {"json", "an object, the labels in an array", {}},
        {"npy", "NumPy: int64, a label for each point; with --scores float64, a row for each", {}},
        {"pcd", "the cloud that was read, with its labels as a field", {}},
        {"ply", "the same", {}}}}};
  // The vector is static, because the lists refer to the descriptions.
  static const std::vector<std::string> descriptions = [] {
    std::vector<std::string> all;
    for (const Format format : input_formats())
      all.push_back(format_info(format).description().in_words(app::kWords));
    return all;
  }();
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    const FormatInfo& info = format_info(input_formats()[i]);
    lists[0].formats.push_back({info.name, descriptions[i], info.example});
  }
  return lists;
}

std::string built_in() {
  return fmt::format("methods    {}\n", fmt::join(all_names<ClusterMethod>, " "));
}

constexpr app::Manual kManual{
    .program = "ph-cluster",
    .phrase = "clusters of points and distances by density (HDBSCAN*)",
    .paragraph =
        "Finds groups of points that stay together over a long range of distances, as HDBSCAN* "
        "does. It needs neither the number of clusters nor a distance: it prints a label for each "
        "point, -1 for noise. The labels do not depend on the order of the points.",
    .usages = kUsages,
    .commands = {},
    .topics = kTopics,
    .usual = kMostUsed,
    .examples = kExamples,
    .formats = format_lists,
    .see_also = "ph-barcode",
    .built_in = built_in,
};

}  // namespace

const app::Manual& manual() { return kManual; }

}  // namespace ph::cluster
