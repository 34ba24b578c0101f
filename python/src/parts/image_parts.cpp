// SPDX-License-Identifier: MIT
// Parts of an image, as bytes: what travels between processes and what lies in a file.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "ph/parts/image_part.hpp"
#include "recipes.hpp"
#include "run.hpp"

namespace ph::python {
namespace {

using PartBytes = std::vector<std::byte>;

py::bytes to_python(const PartBytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
/// As long as Python holds them.
std::span<const std::byte> view_of(const py::bytes& bytes) {
  const std::string_view text = bytes;
  return std::as_bytes(std::span(text));
}

py::bytes image_part(const CubicalRecipe& recipe, int part, int parts, int min_dim,
                     std::optional<int> max_dim, bool cells, const RunOptions& options) {
  return to_python(run(options, false, [&](const RunContext& context) {
    const ImagePartOptions wanted{recipe.options(), min_dim, max_dim, cells};
    return ImagePart(recipe.image(context), part, parts, wanted, context).bytes();
  }));
}

py::bytes join_parts(const std::vector<py::bytes>& parts, const RunOptions& options) {
  std::vector<std::span<const std::byte>> views;
  for (const py::bytes& part : parts) views.push_back(view_of(part));
  return to_python(run(options, false, [&](const RunContext& context) {
    std::vector<ImagePart> all;
    for (const auto view : views) all.push_back(ImagePart::of_bytes(view, context));
    std::ranges::stable_sort(all, {}, &ImagePart::first);
    for (std::size_t i = 1; i < all.size(); ++i) all.front().join(std::move(all[i]), context);
    return all.front().bytes();
  }));
}

Bars part_bars(const py::bytes& bytes, const RunOptions& options) {
  const auto view = view_of(bytes);
  return run(options, false, [&](const RunContext& context) {
    const ImagePart part = ImagePart::of_bytes(view, context);
    if (!part.is_whole())
      throw Error(ErrorKind::bad_data,
                  fmt::format("parts of an image: found {} of {}, expected all",
                              part.last() - part.first() + 1, part.parts()));
    Bars bars{part.barcode(context)};
    bars.facts.engine = Engine(Engine::gradient).name();
    bars.facts.threshold = part.options().cubical.threshold;
    bars.facts.max_dim =
        std::min(part.options().max_dim.value_or(0), static_cast<int>(part.extents().size()) - 1);
    return bars;
  });
}

py::dict part_facts(const py::bytes& bytes) {
  const ImagePart part = ImagePart::of_bytes(view_of(bytes));
  const ImagePartOptions& options = part.options();
  py::dict facts;
  facts["first"] = part.first();
  facts["last"] = part.last();
  facts["parts"] = part.parts();
  facts["shape"] = py::tuple(py::cast(part.extents()));
  facts["construction"] =
      options.cubical.construction == CubicalOptions::Construction::vertices ? "vertices" : "cells";
  facts["superlevel"] = options.cubical.superlevel;
  facts["periodic"] = options.cubical.periodic;
  return facts;
}

}  // namespace

void bind_parts(py::module_& m) {
  m.def("image_part", &image_part, py::arg("recipe"), py::arg("part"), py::arg("parts"),
        py::arg("min_dim"), py::arg("max_dim"), py::arg("cells"), py::arg("run"));
  m.def("join_parts", &join_parts, py::arg("parts"), py::arg("run"));
  m.def("part_bars", &part_bars, py::arg("part"), py::arg("run"));
  m.def("part_facts", &part_facts, py::arg("part"));
}

}  // namespace ph::python
