// SPDX-License-Identifier: MIT
#include "python/src/recipes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "ph/detail/rips/edge_collapse.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/error.hpp"
#include "ph/explicit.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/data/arrays.hpp"

namespace ph::python {
namespace {

// Below these bounds, the chosen engine takes milliseconds, whatever the input is. Starting a
// thread takes a tenth of a millisecond, or more on a busy machine. The first number bounds a power
// of the number of points, n^(max_dim + 2): it allows 215 points up to H1, or 56 points up to H2.
// The second number bounds the cells of an image, 2^d per voxel.
constexpr double kFewSimplices = 1e7;
constexpr double kFewCubes = 1e5;

bool is_c_contiguous(const py::buffer_info& array) {
  py::ssize_t stride = array.itemsize;
  for (auto k = array.ndim; k-- > 0;) {
    const auto axis = static_cast<std::size_t>(k);
    if (array.shape[axis] != 1 && array.strides[axis] != stride) return false;
    stride *= array.shape[axis];
  }
  return true;
}

const std::vector<Index> kNoIds;

}  // namespace

const std::vector<Index>& Recipe::vertex_ids() const { return kNoIds; }

RipsRecipe::RipsRecipe(std::shared_ptr<const MetricSpace> space, RipsOptions options,
                       std::vector<Index> ids)
    : space_(std::move(space)), options_(std::move(options)), ids_(std::move(ids)) {
  if (const PointSet* set = space_->point_set()) {
    options_.distance = set->distance;
    options_.minkowski_p = set->p;
  }
}

std::optional<PointsView> RipsRecipe::points() const {
  const PointSet* set = space_->point_set();
  if (!set || set->points.rows() == 0 || set->points.cols() == 0) return std::nullopt;
  return set->points;
}

bool RipsRecipe::is_euclidean() const {
  return space_->point_set() && options_.distance == PointDistance::euclidean &&
         !options_.subsample && !options_.approximation && !options_.computes_births() &&
         options_.births.empty();
}

Rips RipsRecipe::rips(const RunContext& context) const {
  return space_->visit(context, [&]<class Data>(Data&& data) {
    if constexpr (std::same_as<std::remove_cvref_t<Data>, PointSet>)
      return Rips::borrowed(data.points, options_, context);
    else
      return Rips(std::forward<Data>(data), options_, context);
  });
}

Built RipsRecipe::build(const RunContext& context) const {
  auto data = std::make_shared<const MemoryClaim>(context.memory, space_->bytes_of_pairs());
  return {rips(context), std::move(data)};
}

bool RipsRecipe::is_short(const Options& task) const {
  // A listed simplex has at most max_dim + 2 vertices.
  return task.engine == Engine::automatic && std::pow(static_cast<double>(space_->size()),
                                                      task.max_dim.value_or(1) + 2) < kFewSimplices;
}

RipsGraph RipsRecipe::collapsed(const RunContext& context) const {
  const Rips complex = rips(context);
  Options task;
  task.collapse = Collapse::on;
  return collapse_edges(complex.graph(*plan(complex, task, context).form, context), context);
}

CubicalRecipe::CubicalRecipe(const py::buffer& image, bool is_masked, bool is_file,
                             CubicalOptions options)
    : array_(image.request()),
      type_(voxel_type_of(array_)),
      is_masked_(is_masked),
      is_file_(is_file && is_c_contiguous(array_)),
      options_(std::move(options)) {}

Image CubicalRecipe::image(const RunContext& context) const {
  std::vector<Index> extents(array_.shape.begin(), array_.shape.end());
  Image image;
  if (is_file_) {
    const BorrowedVoxels voxels{type_, array_.ptr, static_cast<std::size_t>(array_.size), nullptr,
                                true};
    image = Image{std::move(extents), Voxels(voxels)};
  } else {
    std::vector<std::ptrdiff_t> strides;
    for (const py::ssize_t bytes : array_.strides) strides.push_back(bytes / array_.itemsize);
    // The image needs a copy.
    if (!is_c_contiguous(array_))
      context.memory.require(static_cast<std::size_t>(array_.size * array_.itemsize));
    image = image_of_array(type_, array_.ptr, std::move(extents), strides);
  }
  image.masked = is_masked_;
  return image;
}

Built CubicalRecipe::build(const RunContext& context) const {
  return {Cubical(image(context), options_, context)};
}

bool CubicalRecipe::is_short(const Options& task) const {
  return task.engine == Engine::automatic &&
         std::ldexp(static_cast<double>(array_.size), static_cast<int>(array_.ndim)) < kFewCubes;
}

Built ListedRecipe::build(const RunContext& context) const {
  auto data = std::make_shared<const MemoryClaim>(context.memory, bytes_);
  ExplicitComplex complex = list_(context);
  if (threshold_) complex.set_threshold(*threshold_);
  return {std::move(complex), std::move(data)};
}

bool ListedRecipe::is_short(const Options& task) const {
  // Columns may become as long as the number of cells.
  constexpr std::size_t few = 1000;
  return task.engine == Engine::automatic && cells_ < few;
}

namespace {

std::vector<std::size_t> sizes_of(const py::buffer& array) {
  const std::vector<std::int64_t> numbers = vector_of<std::int64_t>(array);
  return {numbers.begin(), numbers.end()};
}

std::size_t bytes_of(const SimplexList& list) {
  return list.vertices.size() * sizeof(Index) + list.offsets.size() * sizeof(std::size_t) +
         list.values.size() * sizeof(double);
}

std::unique_ptr<Recipe> simplices(const py::buffer& vertices, const py::buffer& offsets,
                                  const py::buffer& values, std::optional<double> threshold) {
  SimplexList list{vector_of<Index>(vertices), sizes_of(offsets), vector_of<double>(values)};
  const std::size_t cells = list.size(), bytes = bytes_of(list);
  return std::make_unique<ListedRecipe>(
      [list = std::move(list)](const RunContext& context) {
        return ExplicitComplex::from_simplices(list, {}, context);
      },
      threshold, cells, bytes);
}

std::unique_ptr<Recipe> lower_star_of(const py::buffer& vertices, const py::buffer& offsets,
                                      const py::buffer& vertex_values,
                                      std::optional<double> threshold) {
  SimplexList list{vector_of<Index>(vertices), sizes_of(offsets), {}};
  // The values of the simplices are ignored, because they follow from the values of the vertices.
  list.values.resize(list.size());
  std::vector<double> values = vector_of<double>(vertex_values);
  // A simplex of k vertices has fewer than 2^k faces.
  std::size_t cells = values.size();
  for (std::size_t i = 0; i < list.size(); ++i)
    cells += std::size_t{1} << std::min<std::size_t>(list.offsets[i + 1] - list.offsets[i], 32);
  const std::size_t bytes = bytes_of(list) + values.size() * sizeof(double);
  return std::make_unique<ListedRecipe>(
      [list = std::move(list), values = std::move(values)](const RunContext& context) {
        return lower_star(list, values, {}, context);
      },
      threshold, cells, bytes);
}

std::unique_ptr<Recipe> boundary(const py::buffer& dims, const py::buffer& offsets,
                                 const py::buffer& rows, const py::buffer& incidences,
                                 const py::buffer& values, std::optional<double> threshold) {
  BoundaryMatrix matrix{vector_of<int>(dims), sizes_of(offsets), vector_of<Index>(rows),
                        vector_of<int>(incidences), vector_of<double>(values)};
  const std::size_t cells = matrix.size();
  const std::size_t bytes = cells * (sizeof(int) + sizeof(std::size_t) + sizeof(double)) +
                            matrix.rows.size() * (sizeof(Index) + sizeof(int));
  return std::make_unique<ListedRecipe>(
      [matrix = std::move(matrix)](const RunContext& context) {
        return ExplicitComplex::from_boundary(matrix, {}, context);
      },
      threshold, cells, bytes);
}

/// The words for the values that a keyword accepts, such as "'cpu' or 'gpu'".
template <class Value>
std::string expected_of(const Value*) {
  if constexpr (std::is_enum_v<Value>)
    return alternatives(fmt::format("{}", fmt::join(all_names<Value>, "|")), "'");
  else if constexpr (std::is_same_v<Value, bool>)
    return "True or False";
  else
    return std::is_integral_v<Value> ? "a whole number" : "a number";
}
template <class Value>
std::string expected_of(const std::optional<Value>*) {
  return expected_of(static_cast<const Value*>(nullptr));
}

/// Options whose members are set by keywords. Other keywords are ignored.
template <class Options>
Options taken(const py::dict& keywords) {
  Options options;
  const auto take = [&]<class Value>(const Member<Options, Value>& of) {
    const py::str name{std::string(of.name)};
    if (!keywords.contains(name)) return;
    try {
      options.*of.member = keywords[name].template cast<Value>();
    } catch (const py::cast_error&) {
      throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected {}", of.name,
                                                std::string(py::repr(keywords[name])),
                                                expected_of(static_cast<const Value*>(nullptr))));
    }
  };
  std::apply([&](const auto&... all) { (take(all), ...); }, members_of<Options>);
  return options;
}

}  // namespace

void bind_complexes(py::module_& m) {
  py::class_<Recipe>(m, "Recipe");
  py::class_<RipsRecipe, Recipe>(m, "RipsRecipe")
      .def(py::init([](std::shared_ptr<MetricSpace> space, const py::dict& keywords,
                       const std::optional<py::buffer>& births, std::optional<Index> subsample,
                       std::optional<double> subsample_radius,
                       const std::optional<py::buffer>& ids) {
             auto options = taken<RipsOptions>(keywords);
             if (births) options.births = vector_of<double>(*births);
             if (subsample || subsample_radius) {
               options.subsample.emplace();
               if (subsample) options.subsample->points = *subsample;
               if (subsample_radius) options.subsample->radius = *subsample_radius;
             }
             return std::make_unique<RipsRecipe>(
                 std::move(space), std::move(options),
                 ids ? vector_of<Index>(*ids) : std::vector<Index>());
           }),
           py::arg("space"), py::arg("keywords"), py::arg("births"), py::arg("subsample"),
           py::arg("subsample_radius"), py::arg("ids"));
  py::class_<CubicalRecipe, Recipe>(m, "CubicalRecipe");
  using Construction = CubicalOptions::Construction;
  m.def(
      "cubical_recipe",
      [](const py::buffer& image, bool is_masked, bool is_file, bool voxels_are_vertices,
         bool superlevel, std::vector<bool> periodic,
         std::optional<double> threshold) -> std::unique_ptr<Recipe> {
        CubicalOptions options;
        options.construction = voxels_are_vertices ? Construction::vertices : Construction::cells;
        options.superlevel = superlevel;
        options.periodic = std::move(periodic);
        options.threshold = threshold;
        return std::make_unique<CubicalRecipe>(image, is_masked, is_file, std::move(options));
      },
      py::arg("image"), py::arg("is_masked"), py::arg("is_file"), py::arg("voxels_are_vertices"),
      py::arg("superlevel"), py::arg("periodic"), py::arg("threshold"));
  m.def("simplices_recipe", &simplices, py::arg("vertices"), py::arg("offsets"), py::arg("values"),
        py::arg("threshold"));
  m.def("lower_star_recipe", &lower_star_of, py::arg("vertices"), py::arg("offsets"),
        py::arg("vertex_values"), py::arg("threshold"));
  m.def("boundary_recipe", &boundary, py::arg("dims"), py::arg("offsets"), py::arg("rows"),
        py::arg("incidences"), py::arg("values"), py::arg("threshold"));
}

}  // namespace ph::python
