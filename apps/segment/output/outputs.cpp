// SPDX-License-Identifier: MIT
#include "apps/segment/output/outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "apps/common/system/process.hpp"
#include "apps/segment/output/summary.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/segment/cloud_files.hpp"
#include "ph/detail/segment/cloud_legend.hpp"
#include "ph/detail/segment/colouring.hpp"
#include "ph/detail/segment/label_files.hpp"
#include "ph/detail/segment/tree_barcode.hpp"
#include "ph/error.hpp"
#include "ph/io/write.hpp"
#include "ph/scene_report.hpp"

namespace ph::segment {
namespace {

std::string extension_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos || path.find('/', dot) != std::string_view::npos) return {};
  return lower_case(path.substr(dot));
}

/// @throws Error (usage) unless the path is "-" or has an ending that the option can write.
void require_extension(const OutputOption& of, const std::string& path) {
  if (of.extensions.empty() || path == "-") return;
  if (std::ranges::count(of.extensions, extension_of(path)) > 0) return;
  // Barcodes may also have the other extensions of barcode formats.
  if (of.kind == OutputKind::barcode && barcode_format_of_path(path)) return;
  throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected a file name that ends in {}",
                                            of.option, path, fmt::join(of.extensions, " or ")));
}

template <class Write>
std::string text_of(Write&& write) {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // otherwise the stream would hide a lack of memory
  write(out);
  return std::move(out).str();
}

std::vector<std::uint32_t> numbers_of(std::span<const std::uint32_t> labels, const RunInfo& info) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(labels.size());
  for (const std::uint32_t label : labels) numbers.push_back(info.number_of(label));
  return numbers;
}

LabelFormat label_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".npy"   ? LabelFormat::npy
         : extension == ".png" ? LabelFormat::png
                               : LabelFormat::csv;
}

}  // namespace

BarcodeInfo barcode_info(const Segmentation& s, const RunInfo& info) {
  BarcodeInfo result = info_of_barcode(s);
  result.program = info.program;
  result.input = info.input;
  result.peak_memory = app::peak_memory();
  return result;
}

Outputs::Outputs(const Arguments& a) : arguments_(a) {
  a.files.each([](const OutputOption& of, const std::string& path, const app::Plot* plot) {
    if (!plot) return require_extension(of, path);
    if (path != "-") app::require_known_format(*plot);
  });
  a.files.each([&](const OutputOption& of, const std::string& path, const app::Plot* plot) {
    files_.push_back({of.kind, app::Output(path), plot});
  });
}

void Outputs::require_suitable(Index height) const {
  const OutputPaths& f = arguments_.files;
  if (height > 1) return;
  const auto refuse = [&](std::string_view option, std::string_view hint) {
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: found an unorganised cloud, expected one with rows and columns; {}",
                    option, hint));
  };
  if (extension_of(f.labels) == ".png") refuse("--labels", "use .npy or .csv");
  if (extension_of(f.surfaces) == ".png") refuse("--surfaces", "use .npy or .csv");
  if (!f.picture.empty()) refuse("--picture", "use --coloured");
}

std::string Outputs::plot(const app::Plot& plot, const Cloud* cloud, const Segmentation& s,
                          const RunInfo& info, const RunContext& context) const {
  PlotOptions options = arguments_.files.look;
  if (plot.kind == "cloud") {
    const std::vector<std::uint32_t> palette = shown_colours(cloud, s.cut, info.numbers);
    CloudPicture seen =
        cloud_picture(cloud, s.tree, s.cut.labels, palette, arguments_.plot_view, context);
    return app::drawn(plot, with_legend(std::move(seen), palette, info.numbers), options, context);
  }
  options.value_label = s.tree.method == Method::surface ? "Concavity (noise)" : "Distance (m)";
  if (plot.kind == "tree") {
    const MemoryClaim claim(context.memory, s.tree.merge_tree.births.size() * sizeof(Branch));
    const std::vector<Branch> branches = s.tree.merge_tree.branches();
    return app::drawn(plot, std::span(branches), options, context);
  }
  options.kind = plot_kind_named(plot.kind).value();
  return app::drawn(plot, s.barcode, options, context);
}

report::ScenePage Outputs::report_page(const Cloud* cloud, const Segmentation& s,
                                       const RunInfo& info) const {
  const Arguments& a = arguments_;
  report::ScenePage page{report::title_of(info.input), s, cloud};
  std::vector<std::string>& command = page.cut_command = {"ph-segment"};
  if (!a.input.empty()) command.push_back(info.input);
  command.insert(command.end(), a.scene_options.begin(), a.scene_options.end());
  command.insert(command.end(), {"--cut", "{cut}"});
  if (s.tree.method == Method::surface) command.push_back("--parts");
  command.insert(command.end(), {"--labels", "labels.npy"});
  page.numbers = info.numbers;
  page.provenance.command = a.command;
  page.provenance.sha256 = info.sha256;
  page.provenance.run = barcode_info(s, info);
  page.provenance.warnings = info.warnings;
  return page;
}

void Outputs::write_file(File& file, const Cloud* cloud, const Segmentation& s, const RunInfo& info,
                         const RunContext& context) const {
  const OutputPaths& f = arguments_.files;
  app::Output& out = file.output;
  switch (file.kind) {
    case OutputKind::cloud:
      return out.write(cloud_bytes(with_labels(*cloud, numbers_of(s.cut.labels, info)),
                                   cloud_format_of(f.output)));
    case OutputKind::labels:
      return out.write(
          label_bytes(s.tree, numbers_of(s.cut.labels, info), label_format_of(f.labels)));
    case OutputKind::surfaces: {
      const std::vector<std::uint32_t> numbers(s.cut.surface_labels.begin(),
                                               s.cut.surface_labels.end());
      return out.write(label_bytes(s.tree, numbers, label_format_of(f.surfaces)));
    }
    case OutputKind::json:
      return out.write(json_summary(arguments_, s, info));
    case OutputKind::tree:
      return out.write(extension_of(f.tree) == ".json" ? tree_json(s.tree) : tree_bytes(s.tree));
    case OutputKind::barcode: {
      const BarcodeInfo origin = barcode_info(s, info);
      return write_barcode(out.file(), s.barcode,
                           barcode_format_of_path(f.barcode).value_or(BarcodeFormat::csv),
                           {.info = &origin});
    }
    case OutputKind::plot:
      return out.write(plot(*file.plot, cloud, s, info, context));
    case OutputKind::coloured:
      return out.write(cloud_bytes(
          coloured_cloud(*cloud, s.cut.labels, shown_colours(cloud, s.cut, info.numbers)),
          cloud_format_of(f.coloured)));
    case OutputKind::picture:
      return out.write(text_of([&](std::ostream& o) {
        write_png(o, ph::segment::picture(*cloud, s.cut.labels,
                                          shown_colours(cloud, s.cut, info.numbers)));
      }));
    case OutputKind::report:
      return report::write_page([&](std::string_view text) { out.write(text); },
                                report_page(cloud, s, info), context);
  }
}

void Outputs::write(const Cloud* cloud, const Segmentation& segmentation, const RunInfo& info,
                    const RunContext& context) {
  for (File& file : files_) write_file(file, cloud, segmentation, info, context);
  for (File& file : files_) file.output.commit();
}

}  // namespace ph::segment
