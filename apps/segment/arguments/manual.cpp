// SPDX-License-Identifier: MIT
#include "apps/segment/arguments/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>

#include "ph/segment.hpp"

namespace ph::segment {
namespace {

using Name = std::string_view;

constexpr std::array<Name, 2> kUsages{"[OPTION...] INPUT...",
                                      "[OPTION...] --depth FILE --color FILE --camera FILE|NAME"};

constexpr std::array kTopics{
    app::Topic{"input", "Input: clouds, depth images and their cameras"},
    app::Topic{"streams", "Streams of frames"},
    app::Topic{"scenes", "Scenes: range, box, supporting plane, viewpoint"},
    app::Topic{"methods", "Methods: voxels, distances, steps"},
    app::Topic{"cuts", "Cuts of the merge tree: parts, objects, sizes"},
    app::Topic{"output", "Output: clouds, labels, summaries, trees, reports"},
    app::Topic{"pictures", "Pictures: barcodes, trees, coloured clouds"},
    app::kLimitsTopic,
    app::kMessagesTopic,
};

constexpr std::array<Name, 12> kMostUsed{"--camera", "--max-range",       "--crop",     "--plane",
                                         "--voxel",  "--min-persistence", "--min-size", "--parts",
                                         "--output", "--labels",          "--json",     "--report"};

constexpr std::array kExamples{
    app::Example{"ph-segment examples/data/table.pcd",
                 "The objects on a table, with their places and sizes in metres"},
    app::Example{"ph-segment examples/data/table.pcd -o labelled.pcd --json summary.json",
                 "The same points with a label each, and a summary"},
    app::Example{"ph-segment examples/data/table.pcd --report table.html",
                 "A page with the cloud, its objects and the merge tree"},
    app::Example{"ph-segment examples/data/stack.pcd --parts --plot parts.svg --plot-kind cloud",
                 "A picture of the visible parts of a stack, one colour per part"},
    app::Example{"ph-segment examples/data/stack.pcd --explain 1,2",
                 "Where, and at which value, the first two objects of a stack join"},
};

constexpr std::array kRead{
    app::FormatText{"pcd", "a point cloud in PCD, organised or not", {}},
    app::FormatText{"ply", "a point cloud, or the vertices of a mesh, in PLY", {}},
    app::FormatText{"xyz", "text: x y z in each line, then colours and others",
                    "0.5 1.25 2 255 0 0"},
    app::FormatText{"csv", "text: the same with commas, and a header of names", "x,y,z"},
    app::FormatText{"pts", "text: the same behind a line with the number of points", "1024"},
    app::FormatText{"npy",
                    "NumPy: coordinates of points, in rows or in rows and columns, with colours or "
                    "without; or a depth image",
                    {}},
    app::FormatText{"png", "a depth image, or its colours", {}},
    app::FormatText{"pgm", "a depth image", {}},
    app::FormatText{"tree", "a merge tree that --tree wrote", {}},
};
constexpr std::array kWritten{
    app::FormatText{"pcd", "the points with their labels or colours", {}},
    app::FormatText{"ply", "the same", {}},
    app::FormatText{"npy", "labels, or the barcode", {}},
    app::FormatText{"csv", "labels, or the barcode", {}},
    app::FormatText{"png", "labels, pictures, figures", {}},
    app::FormatText{"json", "the summary, the merge tree, or the barcode", {}},
    app::FormatText{"svg", "figures", {}},
    app::FormatText{"tree", "the merge tree and what other cuts need", {}},
};

std::vector<app::FormatList> format_lists() {
  return {{"Read, by extension", {kRead.begin(), kRead.end()}},
          {"Written, by extension", {kWritten.begin(), kWritten.end()}}};
}

std::string built_in() {
  std::string read, written;
  for (const app::FormatText& format : kRead) read += fmt::format(" {}", format.name);
  for (const app::FormatText& format : kWritten) written += fmt::format(" {}", format.name);
  return fmt::format("methods     {}\nreads      {}\nwrites     {}\n", fmt::join(kMethodNames, " "),
                     read, written);
}

constexpr app::Manual kManual{
    .program = "ph-segment",
    .phrase = "objects of point clouds and depth images, by persistent homology",
    .paragraph =
        "Segments a point cloud or a depth image by zero-dimensional persistent homology. It "
        "removes the supporting plane, and prints the objects that are left, largest first; files "
        "have their points, labels and pictures. Lengths are metres.",
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

}  // namespace ph::segment
