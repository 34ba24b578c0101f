// SPDX-License-Identifier: MIT
#include "apps/vectorise/arguments/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>

#include "apps/vectorise/fit/fit.hpp"
#include "ph/io/write.hpp"

namespace ph::vectorise {
namespace {

using Name = std::string_view;

constexpr std::array<Name, 2> kUsages{"[OPTION...] INPUT...", "--fitted FILE [OPTION...] INPUT..."};

constexpr std::array kTopics{
    app::Topic{"input", "Input: barcodes, and images for Euler curves"},
    app::Topic{"vectors", "Vectors: kinds, dimensions, infinite bars"},
    app::Topic{"parameters", "Parameters: grids, layers, widths, weights"},
    app::Topic{"output", "Output: tables, and what was fitted"},
    app::kLimitsTopic,
    app::kMessagesTopic,
};

constexpr std::array<Name, 12> kMostUsed{"--kind",   "--dims",  "--infinite", "--grid",
                                         "--layers", "--count", "--sigma",    "--power",
                                         "--output", "--fit",   "--fitted",   "--threads"};

constexpr std::array kExamples{
    app::Example{"ph-vectorise examples/data/bars",
                 "Statistics of the barcodes in a folder, a row each"},
    app::Example{"ph-vectorise examples/data/bars/circles.csv --kind lengths --dims 1 --count 3",
                 "The three longest loops"},
    app::Example{"ph-vectorise examples/data/bars --kind landscape --dims 1 -o landscapes.npy",
                 "Landscapes of the loops, for NumPy"},
    app::Example{"ph-vectorise examples/data/bars --kind image --dims 1 --grid 20 -o images.npy "
                 "--fit fit.json",
                 "Persistence images, and what a test set needs to be given the same"},
    app::Example{"ph-vectorise examples/data/blobs.pgm --kind euler --superlevel --grid -255,0,16",
                 "The Euler characteristic curve of a picture, from its bright parts on"},
};

std::vector<app::FormatList> format_lists() {
  std::vector<app::FormatList> lists{
      {"Read, plain or compressed with gzip", {}},
      {"Written (--output-format NAME)",
       {{"csv", "a header of names, then a row for each input, its name first", {}},
        {"npy", "NumPy: float64, a row for each input", {}}}}};
  for (const BarcodeFormatInfo& info : barcode_formats())
    if (info.format != BarcodeFormat::none)
      lists[0].formats.push_back({info.name, info.description, info.example});
  lists[0].formats.push_back(
      {"images", "with --kind euler: what ph-barcode reads as an image", {}});
  return lists;
}

std::string built_in() { return fmt::format("kinds      {}\n", fmt::join(all_names<Kind>, " ")); }

constexpr app::Manual kManual{
    .program = "ph-vectorise",
    .phrase = "vectors of barcodes for statistics and machine learning",
    .paragraph =
        "Makes a vector of each barcode: statistics, curves, landscapes, persistence images and "
        "others; or the Euler characteristic curve of each image. It prints a table with a row for "
        "each input. Ranges that are not given are fitted to all inputs, and can be kept for "
        "others.",
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

}  // namespace ph::vectorise
