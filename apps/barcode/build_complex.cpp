// SPDX-License-Identifier: MIT
#include "build_complex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ph/complex/lower_star.hpp"

namespace ph::barcode {
namespace {

constexpr std::string_view kComplexNames[] = {"auto",  "rips",     "cubical",
                                              "alpha", "explicit", "lower-star"};

/// Builds from each kind of data the complexes that make sense of it.
class Builder {
 public:
  /// @param periodic axes of an image that its file says close up.
  Builder(const std::string& name, const Arguments& arguments, const RunContext& context,
          const std::vector<bool>& periodic)
      : name_(name), arguments_(arguments), context_(context), periodic_(periodic) {}

  BuiltComplex operator()(const Points& points) const {
    expect("points", {ComplexKind::rips});
    return rips(points, points.rows() == 0);
  }
  BuiltComplex operator()(const DistanceMatrix& distances) const {
    expect("distances", {ComplexKind::rips});
    refuse(arguments_.points_option, "points", "distances");
    return rips(distances, distances.size() == 0);
  }
  BuiltComplex operator()(const SparseDistances& distances) const {
    expect("distances", {ComplexKind::rips});
    refuse(arguments_.points_option, "points", "distances");
    return rips(distances, distances.size() == 0);
  }
  BuiltComplex operator()(const Image& image) const {
    expect("an image", {ComplexKind::cubical});
    refuse(arguments_.points_option, "points", "an image");
    CubicalOptions options = arguments_.cubical;
    options.threshold = arguments_.threshold;
    if (options.periodic.empty()) options.periodic = periodic_;
    const auto axes = static_cast<std::size_t>(image.dim());
    const bool all = options.periodic.size() == static_cast<std::size_t>(Cubical::kMaxDim) &&
                     std::ranges::all_of(options.periodic, [](bool on) { return on; });
    if (all) options.periodic.assign(axes, true);
    if (options.periodic.size() > axes)
      throw Error(ErrorKind::usage, fmt::format("--periodic: found axis {}, expected 0 to {}",
                                                options.periodic.size() - 1, axes - 1));
    return {Cubical(image, options, context_), "cubical", arguments_.threshold,
            image.values.empty(), std::nullopt};
  }
  BuiltComplex operator()(SimplicesInput&& input) const {
    const ComplexKind kind =
        expect("simplices", {ComplexKind::explicit_cells, ComplexKind::lower_star});
    refuse(arguments_.points_option, "points", "simplices");
    if (kind == ComplexKind::explicit_cells) {
      if (!input.vertex_values.empty())
        throw Error(ErrorKind::usage,
                    "--values: simplices have values of their own; values of the vertices need "
                    "--complex lower-star");
      return stored(
          ExplicitComplex::from_simplices(std::move(input.simplices), input.namer(), context_),
          "explicit");
    }
    return stored(lower_star(input.simplices, vertex_values(input), input.namer(), context_),
                  "lower-star");
  }
  BuiltComplex operator()(const SimplicesInput& input) const {
    return (*this)(SimplicesInput(input));
  }
  BuiltComplex operator()(const BoundaryInput& input) const {
    expect("a boundary matrix", {ComplexKind::explicit_cells});
    refuse(arguments_.points_option, "points", "a boundary matrix");
    const bool has_incidences = !input.matrix.incidences.empty() || input.matrix.rows.empty();
    if (!has_incidences && arguments_.options.field != 2)
      throw Error(ErrorKind::usage,
                  fmt::format("--field: found {}, expected 2: this boundary matrix has no "
                              "incidence numbers; simplices have them",
                              arguments_.options.field));
    return stored(ExplicitComplex::from_boundary(input.matrix, input.namer(), context_),
                  "explicit");
  }
  BuiltComplex operator()(const Mesh& mesh) const {
    const bool with_values = !mesh.values.empty();
    const ComplexKind kind = with_values ? expect("a mesh with values", {ComplexKind::lower_star})
                                         : expect("a mesh without values", {ComplexKind::rips});
    if (kind == ComplexKind::rips) return rips(mesh.vertices, mesh.vertices.rows() == 0);
    refuse(arguments_.points_option, "points", "a mesh");
    return stored(lower_star(triangles_of(mesh), mesh.values, {}, context_), "lower-star");
  }

 private:
  /// The complex to build: the one asked for, or the first that makes sense.
  ComplexKind expect(std::string_view data, std::initializer_list<ComplexKind> kinds) const {
    if (*kinds.begin() != ComplexKind::cubical) refuse(arguments_.cubical_option, "images", data);
    if (*kinds.begin() != ComplexKind::rips && arguments_.options.collapse == Collapse::on)
      refuse("--collapse on", "points and distances", data);
    if (arguments_.complex == ComplexKind::automatic) return *kinds.begin();
    if (std::ranges::find(kinds, arguments_.complex) != kinds.end()) return arguments_.complex;
    const auto name = [](ComplexKind kind) { return kComplexNames[static_cast<int>(kind)]; };
    throw Error(ErrorKind::usage, fmt::format("--complex: found {}, expected {} for {}{}",
                                              name(arguments_.complex), name(*kinds.begin()), data,
                                              arguments_.complex == ComplexKind::lower_star
                                                  ? "; --values names the values of the vertices"
                                                  : ""));
  }

  /// An option that has no effect is a misunderstanding.
  void refuse(const std::optional<std::string>& option, std::string_view meant_for,
              std::string_view found) const {
    if (option)
      throw Error(ErrorKind::usage,
                  fmt::format("{}: makes sense for {} only, found {}", *option, meant_for, found));
  }

  template <class Data>
  BuiltComplex rips(const Data& data, bool empty) const {
    RipsOptions options = arguments_.rips;
    const Options& wanted = arguments_.options;
    options.threshold = arguments_.threshold;
    // The oracle checks the whole filtration; an engine asked for by name has its reasons.
    options.only_components =
        wanted.max_dim == 0 && !arguments_.check &&
        (wanted.engine == Engine::automatic || wanted.engine == Engine::union_find);
    options.merge_equal_points = !options.only_components && wanted.min_persistence >= 0 &&
                                 wanted.representatives != Representatives::cocycles;
    if (options.threshold && *options.threshold < 0)
      throw Error(ErrorKind::usage, fmt::format("--threshold: found {}, expected a distance, at "
                                                "least 0",
                                                *options.threshold));
    Rips complex = rips_complex(data, options);
    const double threshold = complex.threshold();
    return {std::move(complex), "rips",
            std::isfinite(threshold) ? std::optional(threshold) : std::nullopt, empty,
            std::nullopt};
  }

  /// Data that no reader can know to be wrong: a point without direction, distances that overflow.
  template <class Data>
  Rips rips_complex(const Data& data, const RipsOptions& options) const {
    try {
      return Rips(data, options, context_);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::bad_data) throw;
      throw Error(error.kind(), fmt::format("{}: {}", name_, error.what()));
    }
  }

  BuiltComplex stored(ExplicitComplex complex, std::string name) const {
    const bool empty = complex.size() == 0;
    return {std::move(complex), std::move(name), arguments_.threshold, empty, arguments_.threshold};
  }

  /// Values of the vertices for the lower star of listed simplices: from --values, or from the
  /// vertices' own lines.
  std::vector<double> vertex_values(const SimplicesInput& input) const {
    if (!input.vertex_values.empty()) return input.vertex_values;
    const SimplexList& list = input.simplices;
    Index largest = -1;
    for (const Index v : list.vertices) largest = std::max(largest, v);
    const auto fail_at = [&](Index v) {
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: vertex {} has no value, expected a line for each vertex; "
                              "--values gives them in a file",
                              input.name, v));
    };
    // Each vertex needs a line: where ids go beyond the lines, one is missing.
    if (largest >= static_cast<Index>(list.size())) fail_at(largest);
    std::vector<double> values(static_cast<std::size_t>(largest + 1),
                               std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < list.size(); ++i)
      if (list.simplex(i).size() == 1)
        values[static_cast<std::size_t>(list.simplex(i).front())] = list.values[i];
    for (std::size_t v = 0; v < values.size(); ++v)
      if (std::isnan(values[v])) fail_at(static_cast<Index>(v));
    return values;
  }

  /// Faces as triangles around their first corner.
  static SimplexList triangles_of(const Mesh& mesh) {
    SimplexList list;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
      const auto face =
          std::span(mesh.corners).subspan(mesh.offsets[f], mesh.offsets[f + 1] - mesh.offsets[f]);
      if (face.size() <= 3) {
        if (!face.empty()) list.add(face, 0);
        continue;
      }
      for (std::size_t i = 1; i + 1 < face.size(); ++i)
        list.add(std::array{face[0], face[i], face[i + 1]}, 0);
    }
    return list;
  }

  const std::string& name_;
  const Arguments& arguments_;
  const RunContext& context_;
  const std::vector<bool>& periodic_;
};

}  // namespace

BuiltComplex build_complex(ReadResult&& input, const std::string& name, const Arguments& arguments,
                           const RunContext& context) {
  return std::visit(Builder(name, arguments, context, input.periodic), std::move(input.data));
}

BuiltComplex build_complex(const ReadResult& input, const std::string& name,
                           const Arguments& arguments, const RunContext& context) {
  return std::visit(Builder(name, arguments, context, input.periodic), input.data);
}

}  // namespace ph::barcode
