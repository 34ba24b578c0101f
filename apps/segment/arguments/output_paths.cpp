// SPDX-License-Identifier: MIT
#include "apps/segment/arguments/output_paths.hpp"

#include <algorithm>
#include <array>

#include "apps/common/files/batch_names.hpp"
#include "apps/segment/arguments/scopes.hpp"

namespace ph::segment {
namespace {

using Name = std::string_view;
constexpr std::array<Name, 2> kClouds{".pcd", ".ply"}, kTrees{".tree", ".json"},
    kPages{".html", ".htm"}, kFigures{".svg", ".png"};
constexpr std::array<Name, 3> kLabels{".npy", ".csv", ".png"};
constexpr std::array<Name, 6> kBarcodes{".csv", ".json", ".txt", ".pers", ".dipha", ".npy"};
constexpr std::array<Name, 1> kPictures{".png"};

constexpr std::array kOutputs{
    OutputOption{.kind = OutputKind::cloud,
                 .option = "--output",
                 .path = &OutputPaths::output,
                 .names = "-o,--output",
                 .help = "the same points in the same order with all their fields and `label` (an "
                         "existing `label` becomes `label_in`)",
                 .scope = kOfScenes,
                 .extensions = kClouds,
                 .shows_labels = true,
                 .shows_colours = true},
    OutputOption{.kind = OutputKind::labels,
                 .option = "--labels",
                 .path = &OutputPaths::labels,
                 .names = "--labels",
                 .help = "one label per point: 0 no segment, 1…k by decreasing number of points "
                         "(csv: one per line; png: 16 bits, organised clouds)",
                 .extensions = kLabels,
                 .shows_labels = true},
    OutputOption{.kind = OutputKind::surfaces,
                 .option = "--surfaces",
                 .path = &OutputPaths::surfaces,
                 .names = "--surfaces",
                 .help =
                     "what bounds the scene, one number per point: 0 none, else the number that "
                     "a support or a wall has in --json",
                 .extensions = kLabels},
    OutputOption{.kind = OutputKind::json,
                 .option = "--json",
                 .path = &OutputPaths::json,
                 .names = "--json",
                 .help = "summary: stages, complex, plane, surfaces, noise, segments",
                 .extensions = {},
                 .shows_labels = true},
    OutputOption{.kind = OutputKind::tree,
                 .option = "--tree",
                 .path = &OutputPaths::tree,
                 .names = "--tree",
                 .help = "the merge tree and what other cuts need: .tree is an INPUT for --cut and "
                         "--explain, .json is for other programs",
                 .extensions = kTrees},
    OutputOption{.kind = OutputKind::barcode,
                 .option = "--barcode",
                 .path = &OutputPaths::barcode,
                 .names = "--barcode",
                 .help = "barcode of H0",
                 .extensions = kBarcodes},
    OutputOption{.kind = OutputKind::plot,
                 .option = "--plot",
                 .path = nullptr,
                 .names = "--plot",
                 .help = "figure of the barcode, of the merge tree, or of the cloud with a colour "
                         "a segment (repeatable)",
                 .extensions = kFigures},
    OutputOption{.kind = OutputKind::coloured,
                 .option = "--coloured",
                 .path = &OutputPaths::coloured,
                 .names = "--coloured,--colored",
                 .help =
                     "the points with one colour per segment, safe for the colour-blind, and the "
                     "rest in grey",
                 .scope = kOfScenes,
                 .extensions = kClouds,
                 .shows_labels = true,
                 .shows_colours = true},
    OutputOption{.kind = OutputKind::picture,
                 .option = "--picture",
                 .path = &OutputPaths::picture,
                 .names = "--picture",
                 .help = "the image with its segments coloured (organised clouds)",
                 .scope = kOfScenes,
                 .extensions = kPictures,
                 .shows_labels = true,
                 .shows_colours = true},
    OutputOption{.kind = OutputKind::report,
                 .option = "--report",
                 .path = &OutputPaths::report,
                 .names = "--report",
                 .help = "one page to look at: cloud, segments, merge tree and barcode, linked, "
                         "with a slider that cuts anew; needs no network",
                 .extensions = kPages,
                 .shows_labels = true,
                 .shows_colours = true},
};

bool shows_cloud(const app::Plot* plot) { return plot && plot->kind == "cloud"; }

}  // namespace

std::span<const OutputOption> output_options() { return kOutputs; }

std::vector<app::Written> OutputPaths::written() const {
  std::vector<app::Written> files;
  each([&](const OutputOption& of, const std::string& path, const app::Plot*) {
    files.push_back({of.option, path});
  });
  return files;
}

std::vector<app::Written> OutputPaths::of_each_frame() const {
  OutputPaths rest = *this;
  rest.json.clear();  // there is one file for all frames
  return rest.written();
}

OutputPaths OutputPaths::filled(const std::string& name) const {
  OutputPaths files = *this;
  files.json.clear();
  each_of(files, [&](const OutputOption& of, std::string& path, const app::Plot* plot) {
    const bool as_pixels = shows_cloud(plot) && !png_plot_support().empty();
    path = app::filled(path, name, as_pixels ? ".png" : of.extensions.front());
  });
  return files;
}

bool OutputPaths::to_standard_output() const {
  return std::ranges::count(written(), "-", &app::Written::path) > 0;
}

bool OutputPaths::show(bool OutputOption::*what) const {
  bool shown = false;
  each([&](const OutputOption& of, const std::string&, const app::Plot* plot) {
    shown = shown || of.*what || shows_cloud(plot);
  });
  return shown;
}

}  // namespace ph::segment
