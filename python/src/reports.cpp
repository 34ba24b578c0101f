// SPDX-License-Identifier: MIT
// This file makes pages that show a barcode or a segmentation with the data from which it was
// computed.
#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/detail/io/output_file.hpp"
#include "ph/detail/report/page_template.hpp"
#include "ph/detail/segment/tree_barcode.hpp"
#include "ph/report.hpp"
#include "ph/scene_report.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/recipes.hpp"
#include "python/src/results/origin.hpp"
#include "python/src/scenes/scene.hpp"

namespace ph::python {
namespace {

/// The text of a page. Its memory counts in the budget while it grows.
template <class Page>
std::string text_of(const Page& page, const RunContext& context) {
  std::string text;
  MemoryClaim claim(context.memory, 0);
  report::write_page(
      [&](std::string_view piece) {
        claim.grow_to(text.size() + piece.size());
        text += piece;
      },
      page, context);
  return text;
}

report::Provenance provenance_of(const py::dict& meta,
                                 std::vector<std::pair<std::string, std::string>> notes) {
  report::Provenance provenance;
  provenance.run = info_of(meta);
  provenance.has_homology = !provenance.run.complex.empty();
  provenance.notes = std::move(notes);
  return provenance;
}

/// Refuses a tree that lacks some of the bars, because it belongs to other data. @throws Error
/// (bad_data).
void require_bars(const report::ShownTree& tree, const Barcode& barcode) {
  std::vector<bool> is_linked(barcode.bars(0).size());
  for (const auto* bars : {&tree.bars.of_merge, &tree.bars.of_vertex})
    for (const std::uint32_t bar : *bars)
      if (bar != report::kNone) is_linked[bar] = true;
  for (std::size_t i = 0; i < is_linked.size(); ++i) {
    const Bar& bar = barcode[i];
    if (is_linked[i] || !(bar.persistence() > 0)) continue;
    throw Error(ErrorKind::bad_data,
                fmt::format("X: its merge tree has no class [{}, {}), which is a bar of H0; are "
                            "these the data and the options from which the bars were computed?",
                            bar.birth, bar.death));
  }
}

/// @param recipe if it is null, the page shows only the bars.
/// @param vertices float64, one vertex of the complex per row; if not given, the vertices of the
/// recipe.
py::bytes page_of_bars(const Bars& bars, const Recipe* recipe, const Task& task,
                       const std::optional<py::buffer>& vertices, bool has_axes_of_space,
                       const std::string& title, const py::dict& meta,
                       std::vector<std::pair<std::string, std::string>> notes,
                       const RunOptions& options) {
  report::BarcodePage page{title, bars.barcode};
  page.provenance = provenance_of(meta, std::move(notes));
  page.negated = page.provenance.run.superlevel;
  page.has_axes_of_space = has_axes_of_space;
  std::optional<py::buffer_info> array;
  if (vertices) array = vertices->request();
  if (recipe) page.points = array ? points_of(*array) : recipe->points();
  const std::string text = run(options, false, [&](const RunContext& context) {
    if (!recipe) return text_of(page, context);
    const Built built = recipe->build(context);
    page.complex = &built.complex;
    page.form = plan(built.complex, task.options, context).form;
    page.point_ids = recipe->vertex_ids();
    page.is_euclidean = recipe->is_euclidean();
    std::optional<report::ShownTree> shown;
    auto tree = report::whole_tree(built.complex, context);
    if (tree) {
      shown = report::shown_tree(std::move(*tree), bars.barcode, built.complex, context);
      require_bars(*shown, bars.barcode);
    }
    page.tree = shown ? &*shown : nullptr;
    return text_of(page, context);
  });
  return text;
}

py::bytes page_of_scene(const SegmentedScene& scene, const std::string& title, const py::dict& meta,
                        std::vector<std::string> warnings, const RunOptions& options) {
  report::ScenePage page{title, scene.result, scene.cloud()};
  const BarcodeInfo given = info_of(meta);
  page.provenance.run = segment::info_of_barcode(scene.result);
  page.provenance.run.program = given.program;
  page.provenance.run.input = given.input;
  page.provenance.warnings = std::move(warnings);
  return run(options, false, [&](const RunContext& context) { return text_of(page, context); });
}

void write_bytes(const std::string& path, const py::bytes& content, const RunOptions& options) {
  const auto text = static_cast<std::string_view>(content);
  run_task(options, false, [&](const SharedContext&) { write_file(path, text); });
}

}  // namespace

void bind_reports(py::module_& m) {
  m.def("has_page", [] { return !report::page_template().empty(); });
  m.def("page_of_bars", &page_of_bars, py::arg("bars"), py::arg("recipe"), py::arg("task"),
        py::arg("vertices"), py::arg("has_axes_of_space"), py::arg("title"), py::arg("meta"),
        py::arg("notes"), py::arg("run"));
  m.def("page_of_scene", &page_of_scene, py::arg("scene"), py::arg("title"), py::arg("meta"),
        py::arg("warnings"), py::arg("run"));
  m.def("write_file", &write_bytes, py::arg("path"), py::arg("content"), py::arg("run"));
}

}  // namespace ph::python
