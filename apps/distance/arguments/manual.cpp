// SPDX-License-Identifier: MIT
#include "apps/distance/arguments/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>

#include "apps/common/distances/distance_choice.hpp"
#include "ph/io/write.hpp"

namespace ph::distance_program {
namespace {

using Name = std::string_view;

constexpr std::array<Name, 3> kUsages{"[OPTION...] BARCODE BARCODE...",
                                      "--matrix FILE [OPTION...] BARCODE...",
                                      "--groups FILE [OPTION...] BARCODE..."};

constexpr std::array kTopics{
    app::Topic{"input", "Input: barcodes and their dimensions"},
    app::Topic{"distances", "Distances: which, and how exact"},
    app::Topic{"output", "Output: tables, matrices, matchings"},
    app::Topic{"groups", "Groups: a permutation test whether they differ"},
    app::kLimitsTopic,
    app::kMessagesTopic,
};

constexpr std::array<Name, 12> kMostUsed{"--dims",   "--distance", "--order",    "--ground",
                                         "--error",  "--output",   "--matching", "--matrix",
                                         "--groups", "--shuffles", "--seed",     "--threads"};

constexpr std::array kExamples{
    app::Example{"ph-distance examples/data/bars/circles.csv examples/data/bars/torus.csv",
                 "How far apart two barcodes are, dimension by dimension"},
    app::Example{"ph-distance examples/data/bars/circles.csv examples/data/bars/torus.csv "
                 "--distance wasserstein --order 2 --ground 2 --error 0.01",
                 "The 2-Wasserstein distance, within 1 %, with its lower bound"},
    app::Example{"ph-distance examples/data/bars/circles.csv examples/data/bars/torus.csv "
                 "--dim 1 --matching pairs.csv",
                 "Which loops are paired, and what each pair costs"},
    app::Example{"ph-distance examples/data/bars --distance sliced --output-format csv",
                 "All pairs of the barcodes of a folder as a table"},
    app::Example{
        "ph-distance examples/data/bars --dim 1 --matrix distances.npy",
        "A matrix of all barcodes of a folder, for metric=\"precomputed\" of scikit-learn"},
};

std::vector<app::FormatList> format_lists() {
  std::vector<app::FormatList> lists{
      {"Read, plain or compressed with gzip", {}},
      {"Written (--output-format NAME)",
       {{"text", "a line for each distance", {}},
        {"csv", "a header of names, then a row for each distance", {}},
        {"json", "an object, the distances in an array", {}}}},
      {"Written (by the name of the file)",
       {{"matrix .npy", "NumPy: float64, a row for each barcode", {}},
        {"matrix .csv", "a header of names, then a row for each barcode, its name first", {}},
        {"matching .csv", "a header of names, then a row for each pair", {}},
        {"matching .json", "an object, the pairs in an array", {}}}}};
  for (const BarcodeFormatInfo& info : barcode_formats())
    if (info.format != BarcodeFormat::none)
      lists[0].formats.push_back({info.name, info.description, info.example});
  return lists;
}

std::string built_in() {
  return fmt::format("distances  {}\n", fmt::join(all_names<app::DistanceKind>, " "));
}

constexpr app::Manual kManual{
    .program = "ph-distance",
    .phrase = "distances of barcodes, matchings, tests whether groups differ",
    .paragraph =
        "Prints how far apart two barcodes are, dimension by dimension: the bottleneck, the "
        "Wasserstein or the sliced Wasserstein distance. Of more than two it prints the distance "
        "of each pair, writes a matrix, or tests whether groups of barcodes differ. Bars that "
        "never die are paired with such bars only; if their numbers differ the distance is "
        "infinite.",
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

}  // namespace ph::distance_program
