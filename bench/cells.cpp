// SPDX-License-Identifier: MIT
// Counts the cells of a Rips complex one by one; check_estimates.py compares estimates with this
// count.
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "ph/detail/rips/edge_collapse.hpp"
#include "ph/detail/rips/rips_filtration.hpp"
#include "ph/io/read.hpp"
#include "ph/ph.hpp"

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: %s points|binary FILE DIM THRESHOLD|- collapse|plain\n", argv[0]);
    return 64;
  }
  try {
    const int top = std::atoi(argv[3]);
    ph::RipsOptions options;
    if (argv[4] != std::string_view("-")) options.threshold = std::atof(argv[4]);
    const ph::Rips rips = argv[1] == std::string_view("binary")
                              ? ph::Rips(ph::read_binary_distances(argv[2]), options)
                              : ph::Rips(ph::read_points(argv[2]), options);
    const auto count = [top](const ph::RipsGraph& graph) {
      ph::with_rips_filtration(graph, std::max(0, top - 1), [&](const auto& filtration) {
        for (int dim = 0; dim <= top; ++dim) {
          unsigned long long cells = 0;
          filtration.for_each_cell(dim, [&](const auto&) { ++cells; });
          std::printf("%llu\n", cells);
        }
      });
    };
    const ph::RipsGraph& graph =  // the same call as in ph-barcode
        rips.graph(rips.has_form(ph::RipsForm::distinct_edges) ? ph::RipsForm::distinct_edges
                                                               : ph::RipsForm::edges);
    if (argv[5] == std::string_view("collapse"))
      count(ph::collapse_edges(graph));
    else
      count(graph);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
}
