// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/cluster/output/results.hpp"
#include "apps/common/inputs/read_data.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "ph/detail/io/json_writer.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/io/write.hpp"

namespace ph::cluster {
namespace {

void write_csv(OutputFile& file, std::span<const ClusterTree::Cluster> clusters,
               std::span<const Index> labels) {
  file.write("cluster,parent,top,bottom,least,size,mass,label\n");
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const ClusterTree::Cluster& k = clusters[c];
    file.write(fmt::format("{},{},{},{},{},{},{},{}\n", c, k.parent, shortest(k.top),
                           shortest(k.bottom), shortest(k.least), k.size, shortest(k.mass),
                           labels[c]));
  }
}

void write_json(OutputFile& file, std::span<const ClusterTree::Cluster> clusters,
                std::span<const Index> labels, const Results& r) {
  file.write(json_head(r, "ph-cluster tree"));
  file.write(",\n  \"clusters\": [");
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const ClusterTree::Cluster& k = clusters[c];
    file.write(c == 0 ? "\n    " : ",\n    ");
    file.write(json::object({{"parent", json::integer(k.parent)},
                             {"top", json::number(k.top)},
                             {"bottom", json::number(k.bottom)},
                             {"least", json::number(k.least)},
                             {"size", json::integer(k.size)},
                             {"mass", json::number(k.mass)},
                             {"label", json::integer(labels[c])}}));
  }
  file.write(clusters.empty() ? "],\n  \"cluster_of\": " : "\n  ],\n  \"cluster_of\": ");
  const std::vector<Index> own(r.tree.cluster_of().begin(), r.tree.cluster_of().end());
  write_array<Index>(file, for_all_rows<Index>(own, r.loaded, -1), json::integer<Index>);
  file.write(",\n  \"leaves_at\": ");
  write_array<double>(file, for_all_rows<double>(r.tree.leaves_at(), r.loaded, kInfinity),
                      json::number);
  file.write("\n}\n");
}

}  // namespace

std::vector<Index> labels_of_clusters(const Results& r) {
  std::vector<Index> labels(r.tree.clusters().size(), -1);
  for (std::size_t label = 0; label < r.clusters.chosen.size(); ++label)
    labels[r.clusters.chosen[label]] = static_cast<Index>(label);
  return labels;
}

std::string json_head(const Results& r, std::string_view format) {
  const Arguments& a = r.arguments;
  const ReadResult& read = r.loaded.read;
  std::string text;
  json::add_members(
      text,
      {{"format", json::string(format)},
       {"version", "1"},
       {"program", json::string(app::program_and_version("ph-cluster"))},
       {"input", json::object({{"path", json::string(a.input())},
                               {"description", json::string(read.description)},
                               {"points", json::integer(r.loaded.rows)},
                               {"left_out", json::integer(r.loaded.rows - r.loaded.points)}})},
       {"metric", app::points_of(read)
                      ? json::string(metric_name(a.rips.distance, a.rips.minkowski_p))
                      : "null"},
       {"neighbours", a.has_births() ? "null" : json::integer(r.neighbours)},
       {"min_size", json::integer(a.min_size)}},
      ",\n  ");
  return "{\n  " + text;
}

void write_tree(OutputFile& file, const Results& r, bool is_csv) {
  const std::vector<Index> labels = labels_of_clusters(r);
  if (is_csv)
    write_csv(file, r.tree.clusters(), labels);
  else
    write_json(file, r.tree.clusters(), labels, r);
}

}  // namespace ph::cluster
