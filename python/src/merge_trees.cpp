// SPDX-License-Identifier: MIT
#include "ph/merge_tree.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "ph/detail/facade/adjust.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/recipes.hpp"

namespace ph::python {
namespace {

/// @param size the number of points of the input, some of which may have been left out; 0 for an
/// image.
MergeTree merge_tree_of(const Recipe& recipe, const RunOptions& options, std::size_t size) {
  Options components;
  components.max_dim = 0;
  components.min_persistence = -1;  // with this value, equal points stay separate
  return run(options, recipe.is_short(components), [&](const RunContext& context) {
    const Built built = recipe.build(context);
    MergeTree tree = std::visit([&](const auto& complex) { return merge_tree(complex, context); },
                                built.complex);
    if (tree.births.size() >= size) return tree;
    return with_input_ids(std::move(tree), recipe.vertex_ids(), size);
  });
}

/// Returns one member of the merges, as an array with one entry per merge.
template <class Number, class Member>
Block column(const MergeTree& tree, Member Merge::*member) {
  std::vector<Number> numbers;
  numbers.reserve(tree.merges.size());
  for (const Merge& merge : tree.merges) numbers.push_back(merge.*member);
  return Block::of(std::move(numbers));
}

/// Restores a tree from its arrays. @throws Error (bad_data) if no tree has these arrays.
MergeTree restored(const py::buffer& births, const py::buffer& values, const py::buffer& ends,
                   const py::buffer& sizes) {
  MergeTree tree{vector_of<double>(births), {}};
  const std::vector<double> value = vector_of<double>(values);
  const std::vector<Index> end = vector_of<Index>(ends), size = vector_of<Index>(sizes);
  const bool are_there =
      std::ranges::all_of(end, [&](Index v) { return v >= 0 && v < tree.size(); });
  if (end.size() != 4 * value.size() || size.size() != 2 * value.size() || !are_there)
    throw Error(ErrorKind::bad_data,
                "merge tree: found arrays of different trees, expected the arrays of one tree");
  for (std::size_t i = 0; i < value.size(); ++i) {
    Merge merge{.value = value[i],
                .u = end[4 * i],
                .v = end[4 * i + 1],
                .elder = end[4 * i + 2],
                .younger = end[4 * i + 3],
                .elder_size = size[2 * i],
                .younger_size = size[2 * i + 1]};
    merge.elder_birth = tree.births[static_cast<std::size_t>(merge.elder)];
    merge.younger_birth = tree.births[static_cast<std::size_t>(merge.younger)];
    tree.merges.push_back(merge);
  }
  return tree;
}

/// Returns the merges in SciPy's form. Each row has two clusters, the value at which they join, and
/// the number of vertices of both clusters together.
Block linkage_of(const MergeTree& tree) {
  const std::vector<LinkageRow> rows = linkage(tree);
  std::vector<double> numbers;
  numbers.reserve(4 * rows.size());
  for (const LinkageRow& row : rows)
    for (const double number : {static_cast<double>(row.first), static_cast<double>(row.second),
                                row.value, static_cast<double>(row.size)})
      numbers.push_back(number);
  return Block::of(std::move(numbers), {static_cast<py::ssize_t>(rows.size()), 4});
}

}  // namespace

void bind_merge_trees(py::module_& m) {
  py::class_<MergeTree>(m, "MergeTree")
      .def_property_readonly("births",
                             [](const MergeTree& t) { return Block::of(std::vector(t.births)); })
      .def_property_readonly("values",
                             [](const MergeTree& t) { return column<double>(t, &Merge::value); })
      .def_property_readonly("u", [](const MergeTree& t) { return column<Index>(t, &Merge::u); })
      .def_property_readonly("v", [](const MergeTree& t) { return column<Index>(t, &Merge::v); })
      .def_property_readonly("elder",
                             [](const MergeTree& t) { return column<Index>(t, &Merge::elder); })
      .def_property_readonly("younger",
                             [](const MergeTree& t) { return column<Index>(t, &Merge::younger); })
      .def_property_readonly(
          "elder_sizes", [](const MergeTree& t) { return column<Index>(t, &Merge::elder_size); })
      .def_property_readonly(
          "younger_sizes",
          [](const MergeTree& t) { return column<Index>(t, &Merge::younger_size); })
      .def_property_readonly("linkage", &linkage_of)
      .def("equals", [](const MergeTree& a, const MergeTree& b) { return a == b; },
           py::arg("other"))
      .def(
          "components",
          [](const MergeTree& t, double value) { return Block::of(t.components(value)); },
          py::arg("value"))
      .def(
          "basins",
          [](const MergeTree& t, double min_persistence, Index min_size) {
            return Block::of(t.basins(min_persistence, min_size));
          },
          py::arg("min_persistence"), py::arg("min_size"));
  m.def("restored_tree", &restored, py::arg("births"), py::arg("values"), py::arg("ends"),
        py::arg("sizes"));
  m.def("merge_tree", &merge_tree_of, py::arg("recipe"), py::arg("run"), py::arg("size"));
}

}  // namespace ph::python
