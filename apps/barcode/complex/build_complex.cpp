// SPDX-License-Identifier: MIT
#include "apps/barcode/complex/build_complex.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "apps/barcode/arguments/scopes.hpp"
#include "apps/barcode/complex/cubical_options.hpp"
#include "apps/barcode/job/own_complex.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/complex/listed_cubes.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/detail/report/shown_tree.hpp"
#include "ph/error.hpp"
#include "ph/explicit.hpp"
#include "ph/voxel_image.hpp"

namespace ph::barcode {
namespace {

/// Builds the complexes that are possible for each kind of data.
class Builder {
 public:
  /// @param read the input as it was read; its data are visited by this object. @param dropped the
  /// number of points of the input that were left out of the data.
  Builder(const std::string& name, const Job& job, const RunContext& context,
          const ReadResult& read, std::size_t dropped)
      : name_(name),
        job_(job),
        context_(context),
        format_(read.format),
        periodic_(read.periodic),
        ids_(read.point_ids),
        dropped_(dropped) {}

  BuiltComplex operator()(const Points& points) const { return of_points(points, "points"); }
  BuiltComplex operator()(const DistanceMatrix& distances) const {
    expect("distances", {ComplexKind::rips});
    const bool is_half = format_ == Format::lower_distance || format_ == Format::upper_distance ||
                         format_ == Format::binary;
    require_in_scope(is_half ? kTriangle : kMatrix);
    return rips(distances, distances.size() == 0);
  }
  BuiltComplex operator()(const SparseDistances& distances) const {
    expect("distances", {ComplexKind::rips});
    require_in_scope(kSomePairs);
    return rips(distances, distances.size() == 0);
  }
  BuiltComplex operator()(const Image& image) const {
    expect("an image", {ComplexKind::cubical});
    require_in_scope(kImage);
    return cubical(image);
  }
  BuiltComplex operator()(SimplicesInput&& input) const {
    const ComplexKind kind =
        expect("simplices", {ComplexKind::explicit_cells, ComplexKind::lower_star});
    require_in_scope(kind == ComplexKind::explicit_cells ? kSimplices : kLowerStar);
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
    require_in_scope(kBoundary);
    const bool has_incidences = !input.matrix.incidences.empty() || input.matrix.rows.empty();
    if (!has_incidences && job_.question.options.field != 2)
      throw Error(ErrorKind::usage,
                  fmt::format("--field: found {}, expected 2, because this boundary matrix has no "
                              "incidence numbers; simplices allow other fields",
                              job_.question.options.field));
    return stored(ExplicitComplex::from_boundary(input.matrix, input.namer(), context_),
                  "explicit");
  }
  BuiltComplex operator()(const Mesh& mesh) const {
    if (mesh.values.empty()) return of_points(mesh.vertices, "a mesh without values");
    expect("a mesh with values", {ComplexKind::lower_star});
    require_in_scope(kMesh);
    const auto namer = [&](std::size_t) { return name_ + ": a face"; };
    return stored(lower_star(triangles_of(mesh), mesh.values, namer, context_), "lower-star");
  }

 private:
  /// The complex to build: the requested one or, without a request, the first of `kinds`. @throws
  /// Error (usage) if the request is not one of `kinds`.
  ComplexKind expect(std::string_view data, std::initializer_list<ComplexKind> kinds) const {
    const bool is_free = job_.question.complex == ComplexKind::automatic;
    const ComplexKind kind = is_free ? *kinds.begin() : job_.question.complex;
    if (std::ranges::find(kinds, kind) == kinds.end()) {
      const auto name = [](ComplexKind k) { return complex_names()[static_cast<std::size_t>(k)]; };
      std::vector<std::string_view> possible;
      for (const ComplexKind k : kinds)
        if (k != ComplexKind::own) possible.push_back(name(k));
      if (std::ranges::find(kinds, ComplexKind::own) != kinds.end())
        for (const OwnComplex& own : own_complexes()) possible.emplace_back(own.name);
      throw Error(
          ErrorKind::usage,
          fmt::format("--complex: found {}, expected {} for {}{}",
                      job_.question.own_complex ? job_.question.own_complex->name : name(kind),
                      ph::alternatives(fmt::format("{}", fmt::join(possible, "|"))), data,
                      kind == ComplexKind::lower_star
                          ? "; --values gives the values of the vertices"
                          : ""));
    }
    return kind;
  }

  /// Refuses an option that has no effect here, because ignoring it would hide a misunderstanding.
  void require_in_scope(Situation here) const {
    app::require_in_scope(job_.given, here, name_of(here));
  }

  BuiltComplex of_points(const Points& points, std::string_view data) const {
    const ComplexKind kind =
        expect(data, {ComplexKind::rips, ComplexKind::alpha, ComplexKind::delaunay_cech,
                      ComplexKind::delaunay_rips, ComplexKind::cubical, ComplexKind::own});
    if (is_triangulated(kind)) {
      require_in_scope(kAlpha);
      return build_alpha(points, values_by_point(job_.question.weights, points.rows()), ids_, name_,
                         job_, context_);
    }
    if (kind == ComplexKind::own) {
      require_in_scope(kOwn);
      const OwnComplex& own = *job_.question.own_complex;
      return stored(own.of_points(points, context_), std::string(own.name));
    }
    require_in_scope(kind == ComplexKind::rips ? kPoints : kVoxels);
    if (kind == ComplexKind::rips) return rips(points, points.rows() == 0);
    if (!job_.question.voxel)
      throw Error(ErrorKind::usage,
                  fmt::format("--complex: found cubical, which needs --voxel X for {}{}", data,
                              data == "points" ? "; --format grid reads them as an image" : ""));
    if (points.rows() == 0) return cubical(Image{{0}, {}});
    PointImage made =
        voxel_image(points, *job_.question.voxel, job_.question.voxel_value, 1, context_);
    BuiltComplex built = cubical(made.image);
    built.voxels = {made.voxel, std::move(made.first),
                    std::string(name_of(job_.question.voxel_value))};
    return built;
  }

  BuiltComplex cubical(const Image& image) const {
    const CubicalOptions options = cubical_options(job_, image, periodic_);
    BuiltComplex built{Cubical(image, options, context_), "cubical", job_.question.threshold,
                       image.values.empty()};
    built.cubical = options;
    if (job_.results.check)
      built.by_definition = [image, options](const RunContext& context) {
        return listed_cubes(image, options, context);
      };
    return built;
  }

  template <class Data>
  BuiltComplex rips(const Data& data, bool empty) const {
    RipsOptions options = job_.question.rips;
    const Options& wanted = job_.question.options;
    options.threshold = job_.question.threshold;
    if (options.threshold && *options.threshold < 0)
      throw Error(ErrorKind::usage, fmt::format("--threshold: found {}, expected a distance, at "
                                                "least 0",
                                                *options.threshold));
    if (!wanted.max_dim && wanted.min_dim > 1)
      throw Error(ErrorKind::usage, fmt::format("--min-dim: found {}, expected at most 1, the "
                                                "default of --max-dim for a Rips complex",
                                                wanted.min_dim));
    const Index size = size_of(data);
    if (options.dtm_neighbours && size > 0 && *options.dtm_neighbours > size)
      throw Error(ErrorKind::usage,
                  fmt::format("--dtm: found {}, expected at most the number of points, {}",
                              *options.dtm_neighbours, size));
    if (options.core_neighbours && size > 0 && *options.core_neighbours >= size)
      throw Error(ErrorKind::usage,
                  fmt::format("--core: found {}, expected at most the number of other points, {}",
                              *options.core_neighbours, size - 1));
    if (!std::same_as<Data, Points> && wanted.engine == Engine::beta_skeleton)
      throw Error(
          ErrorKind::usage,
          fmt::format("--engine: found {}, which needs points, expected an engine for distances",
                      wanted.engine.name()));
    options.births = values_by_point(job_.question.vertex_weights, size, 0, "a finite number >= 0");
    return in_name_of(name_, [&] {
      return BuiltComplex{rips_of(data, std::move(options)), "rips", std::nullopt, empty,
                          weights_text()};
    });
  }
  /// The complex refers to the points, which must therefore stay in place; see build_complex.
  Rips rips_of(const Points& points, RipsOptions options) const {
    return Rips::borrowed(points, std::move(options), context_);
  }
  template <class Distances>
  Rips rips_of(const Distances& distances, RipsOptions options) const {
    return Rips(distances, std::move(options), context_);
  }

  /// The numbers of the points, from a file that has one number for each point of the input. The
  /// file also has numbers for the points that were left out.
  /// @param path the file; if it is empty, there are no numbers.
  std::vector<double> values_by_point(const std::string& path, Index points,
                                      double least = std::numeric_limits<double>::lowest(),
                                      const char* expected = "a finite number") const {
    if (path.empty()) return {};
    const Input input =
        Input::open(files::path_of(path), &context_, Input::Excess::refused, detail::start_check());
    std::vector<double> all = read_values(input, static_cast<std::size_t>(points) + dropped_,
                                          job_.reading.options, "point");
    for (std::size_t v = 0; v < all.size(); ++v)
      if (!(all[v] >= least && std::isfinite(all[v])))
        input.fail(
            {"not a weight", fmt::format("{} for point {}", shortest(all[v]), v), expected, {}});
    if (ids_.empty()) return all;
    std::vector<double> kept;
    kept.reserve(ids_.size());
    for (const Index id : ids_) kept.push_back(all[static_cast<std::size_t>(id)]);
    return kept;
  }

  std::string weights_text() const {
    std::string source = !job_.question.vertex_weights.empty()               ? "file"
                         : job_.reading.options.diagonal == Diagonal::births ? "diagonal"
                                                                             : "";
    const RipsOptions& rips = job_.question.rips;
    if (rips.dtm_neighbours) source = fmt::format("dtm {}", *rips.dtm_neighbours);
    if (rips.core_neighbours) source = fmt::format("core {}", *rips.core_neighbours);
    if (source.empty()) return source;
    return fmt::format("{}, exponent {}", source,
                       name_of(rips.weight_exponent.value_or(
                           rips.dtm_neighbours ? WeightExponent::one : WeightExponent::infinity)));
  }

  static Index size_of(const Points& points) { return points.rows(); }
  template <class Distances>
  static Index size_of(const Distances& distances) {
    return distances.size();
  }

  BuiltComplex stored(ExplicitComplex complex, std::string name) const {
    const bool empty = complex.size() == 0;
    if (job_.question.threshold) complex.set_threshold(*job_.question.threshold);
    return {std::move(complex), std::move(name), job_.question.threshold, empty};
  }

  /// The values of the vertices for the lower star of listed simplices. They are read from --values
  /// or from the lines of the vertices.
  std::vector<double> vertex_values(const SimplicesInput& input) const {
    if (!input.vertex_values.empty()) return input.vertex_values;
    const SimplexList& list = input.simplices;
    Index largest = -1;
    for (const Index v : list.vertices) largest = std::max(largest, v);
    const auto fail_at = [&](Index v) {
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: vertex {} has no value, expected a line for each vertex; "
                              "--values FILE gives values to the vertices",
                              mark_place(input.name), v));
    };
    // Each vertex needs a line. If an id is at least the number of simplices, a line is missing.
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

  /// Splits faces into triangles around their first corner.
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
  const Job& job_;
  const RunContext& context_;
  const Format format_;
  const std::vector<bool>& periodic_;  // the axes that the image file declares periodic
  // The numbers of the points in the input; empty if all points are present.
  const std::vector<Index>& ids_;
  const std::size_t dropped_;
};

/// 1 + x as text, with the digits of x that would be lost if the sum were computed first.
std::string one_and(double x) {
  constexpr double least = 1e-6;
  return x < least ? "1 + " + shortest(x) : shortest(1 + x);
}

}  // namespace

void take_facts(BuiltComplex& built, const RunFacts& facts) {
  const auto* rips = std::get_if<Rips>(&built.complex);
  if (!rips || !facts.vertices) return;
  built.threshold = facts.threshold;
  if (facts.covering_radius)
    built.subsample = {*facts.vertices, rips->size(), *facts.covering_radius};
}

std::optional<std::string> promise_of(const BuiltComplex& built, const RunFacts& facts) {
  const auto* rips = std::get_if<Rips>(&built.complex);
  if (!rips || !facts.vertices) return std::nullopt;
  std::string text;
  if (const auto& sample = built.subsample) {
    const double late = 2 * sample->covering_radius;
    text = fmt::format(
        "{} of {} points, covering radius {}: bars longer than {} are real, and their births and "
        "deaths are too late by at most the same amount",
        sample->points, sample->of, shortest(sample->covering_radius), shortest(late));
  }
  if (const auto& epsilon = rips->options().approximation; epsilon && facts.edges) {
    const auto n = static_cast<double>(*facts.vertices);
    text += fmt::format(
        "{}{} of {:.0f} edges: births and deaths are too late by a factor of at most {}",
        text.empty() ? "" : "; ", *facts.edges, n * (n - 1) / 2, one_and(*epsilon));
  }
  if (text.empty()) return std::nullopt;
  const bool may_be_no_metric =
      !rips->points() || rips->options().distance == PointDistance::cosine;
  return text + (may_be_no_metric ? ", if the triangle inequality holds" : "");
}

std::optional<MergeTree> tree_of(const BuiltComplex& built, const RunContext& context) {
  if (built.empty) return std::nullopt;
  return report::whole_tree(built.complex, context);
}

std::optional<std::string> hidden_points(const BuiltComplex& built) {
  constexpr std::size_t most_named = 10;
  if (!built.alpha || built.alpha->hidden.empty()) return std::nullopt;
  const std::span<const Index> hidden(built.alpha->hidden);
  return fmt::format("{} not in the complex, hidden by points with larger weights: {}{}",
                     app::count_of(hidden.size(), "point"),
                     fmt::join(hidden.first(std::min(hidden.size(), most_named)), ", "),
                     hidden.size() > most_named ? ", …" : "");
}

BuiltComplex build_complex(ReadResult&& input, const std::string& name, std::size_t dropped,
                           const Job& job, const RunContext& context) {
  return std::visit(Builder(name, job, context, input, dropped), std::move(input.data));
}

BuiltComplex build_complex(const ReadResult& input, const std::string& name, std::size_t dropped,
                           const Job& job, const RunContext& context) {
  return std::visit(Builder(name, job, context, input, dropped), input.data);
}

}  // namespace ph::barcode
