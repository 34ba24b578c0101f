// SPDX-License-Identifier: MIT
// This file computes and joins parts of an image, and computes bars from them. Python passes parts
// as bytes.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "ph/detail/facade/bar_bytes.hpp"
#include "ph/parts/image_part.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/parts/image_loops.hpp"
#include "python/src/parts/part_bytes.hpp"
#include "python/src/recipes.hpp"

namespace ph::python {
namespace {

/// @param recipe a CubicalRecipe. @return the bytes, and the part itself if it has loops, otherwise
/// None.
py::tuple image_part(const py::object& recipe, int part, int parts, int min_dim,
                     std::optional<int> max_dim, bool cells, bool loops,
                     const RunOptions& options) {
  const auto& cubical = recipe.cast<const CubicalRecipe&>();
  std::vector<std::byte> bytes;
  std::shared_ptr<HeldPart> held;
  run_task(options, false, [&](const SharedContext& context) {
    const ImagePartOptions wanted{cubical.options(), min_dim, max_dim, cells, loops};
    ImagePart made(cubical.image(*context), part, parts, wanted, *context);
    bytes = made.bytes();
    if (made.has_loops()) held = std::make_shared<HeldPart>(context, std::move(made));
  });
  if (held) held->recipe = recipe;
  return py::make_tuple(to_python(bytes), held);
}

py::bytes join_image_parts(const std::vector<py::bytes>& parts, const RunOptions& options) {
  const auto views = views_of(parts);
  return to_python(run(options, false, [&](const RunContext& context) {
    std::vector<ImagePart> all;
    for (const auto view : views) all.push_back(ImagePart::of_bytes(view, context));
    std::ranges::stable_sort(all, {}, &ImagePart::first);
    for (std::size_t i = 1; i < all.size(); ++i) all.front().join(std::move(all[i]), context);
    return all.front().bytes();
  }));
}

ImagePart whole_of(std::span<const std::byte> bytes, const RunContext& context) {
  ImagePart part = ImagePart::of_bytes(bytes, context);
  if (!part.is_whole())
    throw Error(ErrorKind::bad_data, fmt::format("parts of an image: found {} of {}, expected all",
                                                 part.last() - part.first() + 1, part.parts()));
  return part;
}

/// @param loops the results of ImageLoops for each part, which are the bars that joining the parts
/// does not give.
Bars image_part_bars(const py::bytes& bytes, const std::vector<const Bars*>& loops,
                     std::int64_t field, const RunOptions& options) {
  const auto view = view_of(bytes);
  return run(options, false, [&](const RunContext& context) {
    const ImagePart part = whole_of(view, context);
    Bars bars{part.barcode(context)};
    for (const Bars* some : loops) add_bars(bars.barcode, some->barcode);
    if (!loops.empty()) bars.barcode.sort(context);
    bars.set_max_dim(highest_dim(part));
    bars.field = field;
    return bars;
  });
}

/// Returns the messages for the loops of each part.
py::list told_to_loops(const py::bytes& bytes, const RunOptions& options) {
  const auto view = view_of(bytes);
  const auto all = run(options, false, [&](const RunContext& context) {
    const ImagePart part = whole_of(view, context);
    std::vector<std::vector<std::byte>> told;
    for (int i = 0; i < part.parts(); ++i) told.push_back(part.told_to_loops(i));
    return told;
  });
  py::list told;
  for (const auto& some : all) told.append(to_python(some));
  return told;
}

py::dict image_part_facts(const py::bytes& bytes) {
  const ImagePart part = ImagePart::of_bytes(view_of(bytes));
  const ImagePartOptions& options = part.options();
  py::dict facts;
  facts["first"] = part.first();
  facts["last"] = part.last();
  facts["parts"] = part.parts();
  facts["shape"] = py::tuple(py::cast(part.extents()));
  facts["construction"] = options.cubical.construction;
  facts["superlevel"] = options.cubical.superlevel;
  facts["periodic"] = options.cubical.periodic;
  facts["threshold"] = options.cubical.threshold;
  facts["has_loops"] = part.has_loops();
  return facts;
}

}  // namespace

void bind_image_parts(py::module_& m) {
  m.def("image_part", &image_part, py::arg("recipe"), py::arg("part"), py::arg("parts"),
        py::arg("min_dim"), py::arg("max_dim"), py::arg("cells"), py::arg("loops"), py::arg("run"));
  m.def("join_image_parts", &join_image_parts, py::arg("parts"), py::arg("run"));
  m.def("image_part_bars", &image_part_bars, py::arg("part"), py::arg("loops"), py::arg("field"),
        py::arg("run"));
  m.def("told_to_loops", &told_to_loops, py::arg("part"), py::arg("run"));
  m.def("image_part_facts", &image_part_facts, py::arg("part"));
}

}  // namespace ph::python
