// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <limits>
#include <string_view>

#include "apps/cluster/output/results.hpp"
#include "ph/detail/io/json_writer.hpp"
#include "ph/detail/io/npy_write.hpp"
#include "ph/detail/segment/cloud_files.hpp"
#include "ph/io/write.hpp"
#include "ph/segment.hpp"

namespace ph::cluster {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// What is written about each point of the input.
struct Columns {
  std::vector<Index> labels;
  std::vector<double> probabilities, outlier_scores;  // empty unless scores are requested

  explicit Columns(const Results& r)
      : labels(for_all_rows<Index>(r.clusters.labels, r.loaded, kLeftOut)) {
    if (!r.arguments.scores) return;
    probabilities = for_all_rows<double>(r.clusters.probabilities, r.loaded, kUnknown);
    outlier_scores = for_all_rows<double>(r.outlier_scores, r.loaded, kUnknown);
  }
};

void write_csv(OutputFile& file, const Columns& columns, bool has_scores) {
  file.write(has_scores ? "label,probability,outlier_score\n" : "label\n");
  for (std::size_t i = 0; i < columns.labels.size(); ++i)
    file.write(has_scores ? fmt::format("{},{},{}\n", columns.labels[i],
                                        shortest(columns.probabilities[i]),
                                        shortest(columns.outlier_scores[i]))
                          : fmt::format("{}\n", columns.labels[i]));
}

void write_npy(OutputFile& file, const Columns& columns, bool has_scores) {
  const std::size_t n = columns.labels.size();
  if (!has_scores) {
    write_npy_header(file, std::array{n}, "<i8");
    return write_npy_numbers(file, columns.labels);
  }
  write_npy_header(file, std::array{n, std::size_t{3}});
  for (std::size_t i = 0; i < n; ++i)
    write_npy_numbers(file, std::array{static_cast<double>(columns.labels[i]),
                                       columns.probabilities[i], columns.outlier_scores[i]});
}

std::string clusters_json(const Results& r) {
  std::vector<Index> sizes(r.clusters.chosen.size());
  for (const Index label : r.clusters.labels)
    if (label >= 0) ++sizes[static_cast<std::size_t>(label)];
  std::size_t label = 0;
  return json::lines(r.clusters.chosen, [&](std::uint32_t c) {
    const ClusterTree::Cluster& cluster = r.tree.clusters()[c];
    const std::string size = json::integer(sizes[label]);
    return json::object({{"label", json::integer(label++)},
                         {"cluster", json::integer(c)},
                         {"points", size},
                         {"top", json::number(cluster.top)},
                         {"bottom", json::number(cluster.bottom)},
                         {"mass", json::number(cluster.mass)}});
  });
}

void write_json(OutputFile& file, const Columns& columns, const Results& r) {
  const ClusterOptions& choice = r.arguments.choice;
  file.write(json_head(r, "ph-cluster"));
  file.write(fmt::format(
      ",\n  \"method\": {},\n  \"epsilon\": {},\n  \"max_size\": {},\n  \"allow_single\": {},\n"
      "  \"clusters\": {},\n  \"labels\": ",
      json::string(name_of(choice.method)), json::number(choice.epsilon),
      choice.max_size == 0 ? "null" : json::integer(choice.max_size),
      json::boolean(choice.allow_single), clusters_json(r)));
  write_array<Index>(file, columns.labels, json::integer<Index>);
  if (r.arguments.scores) {
    file.write(",\n  \"probabilities\": ");
    write_array<double>(file, columns.probabilities, json::number);
    file.write(",\n  \"outlier_scores\": ");
    write_array<double>(file, columns.outlier_scores, json::number);
  }
  file.write("\n}\n");
}

void add_floats(Cloud& cloud, const char* name, const std::vector<double>& values) {
  const std::size_t field = cloud.add_field(name, FieldType::float32);
  std::byte* at = cloud.data.data() + cloud.fields[field].offset;
  for (const double value : values) {
    const auto number = static_cast<float>(value);
    std::memcpy(at, &number, sizeof number);
    at += cloud.stride;
  }
}

void write_cloud(OutputFile& file, const Columns& columns, const Results& r) {
  std::vector<std::uint32_t> labels;
  labels.reserve(columns.labels.size());
  for (const Index label : columns.labels)
    labels.push_back(label < 0 ? 0 : static_cast<std::uint32_t>(label + 1));
  Cloud cloud = segment::with_labels(*r.loaded.cloud, labels);
  if (r.arguments.scores) {
    add_floats(cloud, "probability", columns.probabilities);
    add_floats(cloud, "outlier_score", columns.outlier_scores);
  }
  file.write(
      segment::cloud_bytes(std::move(cloud), r.arguments.written_format() == OutputFormat::pcd
                                                 ? segment::CloudFormat::pcd
                                                 : segment::CloudFormat::ply));
}

}  // namespace

void write_labels(OutputFile& file, const Results& r) {
  const Columns columns(r);
  switch (r.arguments.written_format()) {
    case OutputFormat::csv:
      return write_csv(file, columns, r.arguments.scores);
    case OutputFormat::json:
      return write_json(file, columns, r);
    case OutputFormat::npy:
      return write_npy(file, columns, r.arguments.scores);
    case OutputFormat::pcd:
    case OutputFormat::ply:
      return write_cloud(file, columns, r);
  }
}

}  // namespace ph::cluster
