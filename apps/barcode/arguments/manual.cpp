// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/arguments.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "apps/common/terminal/words.hpp"
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
    app::Topic{"raw", "Raw images and points: numbers without a header"},
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
                 "The components and loops of a set of points, one bar per line"},
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

constexpr std::array<Name, 2> kUsagesOfRanks{"[OPTION...] IMAGE -o BARS",
                                             "[OPTION...] --complex rips --max-dim 0 POINTS"};

constexpr std::array kTopicsOfRanks{
    app::Topic{"input", "Input: formats, tables, missing values"},
    app::Topic{"raw", "Raw images and points: numbers without a header"},
    app::Topic{"complexes", "Complexes: images, or points"},
    app::Topic{"cubical", "Cubical complexes of images"},
    app::Topic{"engines", "Homology: dimensions, field"},
    app::Topic{"parts", "Parts: those of a run that died"},
    app::Topic{"output", "Output: barcodes"},
    app::Topic{"pictures", "Pictures: barcodes, diagrams"},
    app::kLimitsTopic,
    app::kMessagesTopic,
};

constexpr std::array<Name, 12> kMostUsedOfRanks{
    "--format",          "--complex", "--max-dim", "--min-dim", "--threshold", "--superlevel",
    "--min-persistence", "--resume",  "--output",  "--plot",    "--verbose",   "--dry-run"};

constexpr std::array kExamplesOfRanks{
    app::Example{"mpirun -n 2 ph-barcode-mpi examples/data/phantom.nii.gz -o bars.csv",
                 "All bars of a volume, half of its layers on each rank"},
    app::Example{"mpirun -n 2 ph-barcode-mpi examples/data/blobs.pgm --superlevel -o bars.csv "
                 "--plot bars.svg",
                 "The bright spots and rings of a picture, as a file and as a picture"},
    app::Example{"mpirun -n 2 ph-barcode-mpi examples/data/torus.csv --complex rips --max-dim 0 -o "
                 "components.csv",
                 "The components of a set of points"},
    app::Example{"mpirun -n 2 ph-barcode-mpi examples/data/blobs.pgm -o bars.csv --resume",
                 "The same command again goes on where a run died"},
    app::Example{"mpirun -n 2 ph-barcode-mpi examples/data/phantom.nii.gz --dry-run",
                 "What the ranks would take and send"},
};

std::vector<app::FormatList> format_lists() {
  std::vector<app::FormatList> lists{{"Read (--format NAME), plain or compressed with gzip", {}},
                                     {"Written (--output-format NAME)", {}}};
  // The vector is static, because the lists refer to the descriptions.
  static const std::vector<std::string> descriptions = [] {
    std::vector<std::string> all;
    for (const FormatInfo& info : formats())
      all.push_back(info.description().in_words(app::kWords));
    return all;
  }();
  for (std::size_t i = 0; i < descriptions.size(); ++i)
    lists[0].formats.push_back({formats()[i].name, descriptions[i], formats()[i].example});
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

constexpr app::Manual kManualOfRanks{
    .program = "ph-barcode-mpi",
    .phrase = "persistent homology of an image, or components of points, on the ranks of MPI",
    .paragraph =
        "Computes the bars of one image of two or three axes (of up to eight: its components, or "
        "the highest dimension but one) on all ranks that mpirun starts, each of which looks at "
        "some layers; or the components of points of up to eight coordinates, of which each rank "
        "has some blocks. The bars are those of ph-barcode, to the last byte. --threads and "
        "--memory-limit are those of a rank. --verbose also says what each rank took and sent, "
        "--progress json has lines of all ranks.",
    .usages = kUsagesOfRanks,
    .commands = {},
    .topics = kTopicsOfRanks,
    .usual = kMostUsedOfRanks,
    .examples = kExamplesOfRanks,
    .formats = format_lists,
    .see_also = "ph-barcode",
    .built_in = built_in,
};

}  // namespace

const app::Manual& manual() { return kManual; }
const app::Manual& manual_of_ranks() { return kManualOfRanks; }

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
