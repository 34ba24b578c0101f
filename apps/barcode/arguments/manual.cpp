// SPDX-License-Identifier: MIT
#include "barcode/arguments/manual.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "ph/alpha.hpp"
#include "ph/io/read.hpp"
#include "ph/io/write.hpp"
#include "ph/persistence.hpp"

namespace ph::barcode {
namespace {

using Name = std::string_view;

constexpr std::array<Name, 4> kUsages{"[OPTION...] INPUT...", "plot BARCODE... -o FILE.svg|.png",
                                      "--join PART... -o FILE", "--compare FILE FILE"};
constexpr std::array<Name, 1> kCommands{"plot"};

constexpr std::array kTopics{
    app::Topic{"input", "Input: formats, tables, matrices, missing values"},
    app::Topic{"raw", "Raw images: numbers without a header"},
    app::Topic{"complexes", "Complexes and distances"},
    app::Topic{"rips", "Rips complexes: fewer edges and points, weights"},
    app::Topic{"alpha", "Alpha complexes: points of the plane and of space"},
    app::Topic{"cubical", "Cubical complexes: images, and points as voxels"},
    app::Topic{"engines", "Homology: dimensions, engines, representatives"},
    app::Topic{"parts", "Parts: several machines, and what exceeds one"},
    app::Topic{"output", "Output: barcodes, reports, comparisons"},
    app::Topic{"pictures", "Pictures: barcodes, diagrams, trees"},
    app::kLimitsTopic,
    app::kMessagesTopic,
};

constexpr std::array<Name, 12> kMostUsed{
    "--format", "--complex",    "--max-dim",         "--threshold",
    "--metric", "--superlevel", "--min-persistence", "--representatives",
    "--output", "--plot",       "--report",          "--dry-run"};

constexpr std::array kExamples{
    app::Example{"ph-barcode examples/data/two_circles.csv",
                 "The components and loops of a set of points, a bar a line"},
    app::Example{"ph-barcode examples/data/two_circles.csv --min-persistence 0.3 -o bars.csv "
                 "--plot bars.svg",
                 "The long bars only, as a file and as a picture"},
    app::Example{"ph-barcode examples/data/two_circles.csv --representatives cycles -o loops.json "
                 "--report loops.html",
                 "Where the loops are: as JSON, and as a page to look at"},
    app::Example{"ph-barcode examples/data/blobs.pgm --superlevel --min-persistence 60",
                 "The bright spots and rings of a picture"},
    app::Example{"ph-barcode examples/data/two_circles.csv --max-dim 2 --dry-run",
                 "What a computation would take: its cells, its memory, its engine"},
};

std::vector<app::FormatList> format_lists() {
  std::vector<app::FormatList> lists{{"Read (--format NAME), plain or compressed with gzip", {}},
                                     {"Written (--output-format NAME)", {}}};
  for (const FormatInfo& info : formats())
    lists[0].formats.push_back({info.name, info.description, info.example});
  for (const BarcodeFormatInfo& info : barcode_formats())
    lists[1].formats.push_back({info.name, info.description, info.example});
  return lists;
}

std::string built_in() {
  std::string engines, read, missing, written;
  for (const Name name : engine_names()) engines += fmt::format(" {}", name);
  for (const FormatInfo& info : formats())
    if (info.format != Format::automatic)
      (info.read ? read : missing) += fmt::format(" {}", info.name);
  for (const BarcodeFormatInfo& info : barcode_formats()) written += fmt::format(" {}", info.name);
  const std::string cgal = alpha_support();
  return fmt::format(
      "engines    {}\nreads      {}\n{}writes     {} svg\nCGAL       {}\nlicence    {}\n", engines,
      read, missing.empty() ? "" : fmt::format("not read   {}\n", missing), written,
      cgal.empty() ? "not built in (alpha complexes need it)" : "built in (" + cgal + ")",
      cgal.empty() ? "MIT" : "GPL 3 or later, since CGAL is linked; libph itself is MIT");
}

constexpr app::Manual kManual{
    .program = "ph-barcode",
    .phrase = "persistent homology of points, distances, images and complexes",
    .paragraph =
        "Computes the persistent homology of points, distances, images, meshes and filtered "
        "complexes. It prints bars: dimension, birth and death of each component, loop and void. "
        "Values of Rips complexes are diameters: two points join at their distance.",
    .usages = kUsages,
    .commands = kCommands,
    .topics = kTopics,
    .usual = kMostUsed,
    .examples = kExamples,
    .formats = format_lists,
    .see_also = "ph-segment",
    .built_in = built_in,
};

}  // namespace

const app::Manual& manual() { return kManual; }

std::string formats_table() {
  std::string text;
  for (const app::FormatList& list : format_lists()) {
    text += fmt::format("{}{}:\n", text.empty() ? "" : "\n", list.title);
    for (const auto& [name, what, example] : list.formats) {
      text += fmt::format("  {:<15} {}\n", name, what);
      if (!example.empty()) text += fmt::format("  {:<15}   {}\n", "", example);
    }
  }
  return text;
}

}  // namespace ph::barcode
