// SPDX-License-Identifier: MIT
#include "ph/io/svg_plot.hpp"

#include "svg_plot_canvas.hpp"

namespace ph {

std::optional<PlotKind> plot_kind_named(std::string_view name) {
  if (name == "barcode") return PlotKind::barcode;
  if (name == "diagram") return PlotKind::diagram;
  if (name == "betti") return PlotKind::betti;
  return std::nullopt;
}

std::string svg_plot(const Barcode& barcode, const PlotOptions& options) {
  switch (options.kind) {
    case PlotKind::barcode:
      return svg::draw_barcode(barcode, options);
    case PlotKind::diagram:
      return svg::draw_diagram(barcode, options);
    case PlotKind::betti:
      return svg::draw_betti(barcode, options);
  }
  return {};
}

std::string svg_plot(std::span<const Branch> tree, const PlotOptions& options) {
  return svg::draw_tree(tree, options);
}

}  // namespace ph
