// SPDX-License-Identifier: MIT
#include "libph/src/rips/beta_skeleton/pair_points.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "libph/src/metric/distinct_points.hpp"
#include "libph/src/metric/plain_squares.hpp"
#include "libph/src/rips/beta_skeleton/formal_relations.hpp"
#include "libph/src/rips/beta_skeleton/skeleton_cycles.hpp"
#include "libph/src/rips/beta_skeleton/split_lenses.hpp"
#include "ph/detail/components/disjoint_sets.hpp"

namespace ph {
namespace {

using namespace beta_skeleton;

/// Computes the pairs of birth and death of distinct points in two passes. The first pass finds H0
/// and the births of H1. The second pass finds the deaths of H1.
template <int D, Field K>
class Pairing {
 public:
  Pairing(PointsView points, std::span<const std::uint32_t> rows, const K& field,
          const PointPairRequest& wanted, PointPairObserver& observer, const RunContext& context)
      : tree_(points, rows, context),
        lenses_(tree_),
        field_(field),
        wanted_(wanted),
        observer_(observer),
        context_(context),
        cone_(cone_radius()),
        births_(&context.memory),
        generators_(&context.memory),
        base_(&context.memory),
        relation_(&context.memory) {}

  void run(std::size_t vertices) {
    const double limit = std::min(wanted_.threshold, cone_);
    const std::pmr::vector<FoundEdge> graph = relative_neighbours(tree_, limit, context_);
    std::pmr::vector<std::uint32_t> generators(&context_.memory);
    join(graph, vertices, generators);
    if (!wanted_.loops || births_.empty()) return;
    cycles_.emplace(lenses_, graph, generators, &context_.memory);
    relations_.emplace(births_.size(), field_, &context_.memory);
    is_dead_.resize(births_.size(), false);
    classes_.births = births_;
    SplitLenses<D>(tree_, limit, classes_, context_)
        .run([&](const beta_skeleton::Edge& e, Node holder) { look_at(e, holder); });
    if (classes_.living > 0 && wanted_.threshold >= cone_)
      throw std::logic_error("a class outlives the cone");
    for (std::uint32_t g = 0; g < births_.size(); ++g)
      if (!is_dead_[g]) observer_.on_essential(generators_[g]);
  }

 private:
  using Relations = FormalRelations<K>;
  using Term = typename Relations::Term;
  using Sum = typename Relations::Sum;

  /// The distance from a point w near the middle of the cloud to the point farthest from w. For
  /// every longer edge, w is in the lens and is joined to all other points of the lens. Edges
  /// longer than this distance therefore change nothing.
  double cone_radius() const {
    const Position middle =
        tree_.nearest(1, tree_.centre(1), std::numeric_limits<double>::infinity());
    double largest = 0;
    for (Position p = 0; p < tree_.size(); ++p)
      largest = std::max(largest, tree_.square(middle, p));
    return std::sqrt(largest);  // mutant: beta-cone
  }

  /// Computes H0 by the elder rule, and the births of H1. @param graph the edges with an empty
  /// lens, in their order.
  /// @param generators receives the generator of each edge of the graph.
  void join(std::span<const FoundEdge> graph, std::size_t vertices,
            std::pmr::vector<std::uint32_t>& generators) {
    DisjointSets sets(vertices, &context_.memory);  // the root is the oldest vertex
    generators.reserve(graph.size());
    for (const FoundEdge& e : graph) {
      const auto [smaller, larger] = std::minmax({tree_.row(e.u), tree_.row(e.v)});
      const std::uint32_t a = sets.find(smaller), b = sets.find(larger);
      if (a != b) {
        const auto [elder, younger] = std::minmax(a, b);
        sets.link(younger, elder);
        observer_.on_join(younger, {e.value, larger, smaller});
        generators.push_back(SkeletonCycles<D>::kNoGenerator);
      } else {
        generators.push_back(static_cast<std::uint32_t>(births_.size()));
        births_.push_back(e.value);
        generators_.push_back({e.value, larger, smaller});
      }
    }
    for (Position p = 0; p < tree_.size(); ++p)
      // mutant: beta-components
      if (sets.find(tree_.row(p)) == tree_.row(p)) observer_.on_component(tree_.row(p));
  }

  /// Adds the relations of an edge whose lens has several components.
  void look_at(const beta_skeleton::Edge& e, Node holder) {
    bear_before(e);
    if (classes_.living == 0) return;
    lenses_.find_components(e, kNone, holder, components_);
    // If there are several other components, their order determines which triangle kills which
    // class.
    auto& others = components_.others;
    Position base = components_.first;
    std::uint32_t smallest = UINT32_MAX;
    if (wanted_.apexes && others.size() > 1) {
      smallest = lenses_.smallest_of_first(e, holder, components_);
      others.push_back({base, smallest});
      // mutant: beta-component-order
      std::sort(others.begin(), others.end(),
                [](const auto& a, const auto& b) { return a.smallest < b.smallest; });
      base = others.front().any;
      others.erase(others.begin());
    }
    base_.clear();
    append(e, base, field_.from_int(-1), base_);
    for (const auto& other : others) {
      relation_ = base_;
      append(e, other.any, field_.from_int(1), relation_);
      relations_->collect(relation_);
      const auto dead = relations_->add(relation_);
      if (!dead) continue;
      is_dead_[*dead] = true;
      --classes_.living;
      if (generators_[*dead].value < e.value) {
        std::uint32_t apex = 0;
        if (wanted_.apexes) {
          if (others.size() == 1) smallest = lenses_.smallest_of_first(e, holder, components_);
          // mutant: beta-apex
          apex = others.size() == 1 ? std::max(smallest, other.smallest) : other.smallest;
        }
        observer_.on_death(generators_[*dead], {e.value, e.larger, e.smaller}, apex);
      }
      if (classes_.living == 0) return;
    }
  }
  /// Computes sum += scale * (annotation of u -> w + annotation of w -> v).
  void append(const beta_skeleton::Edge& e, Position w, typename K::Element scale, Sum& sum) {
    const auto minus = field_.negate(scale);
    const auto visit = [&](std::uint32_t generator, bool is_positive) {
      sum.emplace_back(generator, is_positive ? scale : minus);
    };
    cycles_->annotate(e.u, w, visit);
    cycles_->annotate(w, e.v, visit);
  }
  void bear_before(const beta_skeleton::Edge& e) {
    for (; classes_.born < births_.size(); ++classes_.born, ++classes_.living) {
      const auto& birth = generators_[classes_.born];
      const bool is_before = birth.value != e.value     ? birth.value < e.value
                             : birth.larger != e.larger ? birth.larger < e.larger
                                                        : birth.smaller < e.smaller;
      if (!is_before) return;
    }
  }

  PointTree<D> tree_;
  Lenses<D> lenses_;
  const K& field_;
  const PointPairRequest& wanted_;
  PointPairObserver& observer_;
  const RunContext& context_;
  const double cone_;
  std::pmr::vector<double> births_;                       // birth of each generator
  std::pmr::vector<PointPairObserver::Edge> generators_;  // the edges that give birth to them
  std::vector<bool> is_dead_;
  Classes classes_;
  std::optional<SkeletonCycles<D>> cycles_;
  std::optional<Relations> relations_;
  LensComponents components_;  // scratch, like the members below
  Sum base_, relation_;
};

}  // namespace

template <Field K>
void pair_points(PointsView points, const K& field, const PointPairRequest& wanted,
                 PointPairObserver& observer, const RunContext& context) {
  if (points.rows() == 0) return;
  const WholeRows whole(points);
  // The first of several equal points represents all of them, because the others cause only pairs
  // of length zero.
  const std::pmr::vector<std::uint32_t> rows =
      distinct_points(first_equal_points(whole.view(), context), context);
  const auto vertices = static_cast<std::size_t>(points.rows());
  const auto run = [&]<int D>(PointsView view) {
    Pairing<D, K>(view, rows, field, wanted, observer, context).run(vertices);
  };
  if (points.cols() == 1) {  // points of R^1 become points on a line in the plane
    Points plane(points.rows(), 2);
    const MemoryClaim claim(context.memory, vertices * 2 * sizeof(double));
    for (Index i = 0; i < points.rows(); ++i) plane(i, 0) = points(i, 0);
    return run.template operator()<2>(plane);
  }
  if (points.cols() == 2) return run.template operator()<2>(whole.view());
  if (points.cols() == 3) return run.template operator()<3>(whole.view());
  run.template operator()<4>(whole.view());
}

template void pair_points<Z2>(PointsView, const Z2&, const PointPairRequest&, PointPairObserver&,
                              const RunContext&);
template void pair_points<Zp>(PointsView, const Zp&, const PointPairRequest&, PointPairObserver&,
                              const RunContext&);

bool has_plain_coordinates(PointsView points) {
  constexpr double least = 1e-120;
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k) {
      const double x = std::abs(points(i, k));
      if (x != 0 && !(least <= x && x <= kLargestPlain)) return false;
    }
  return true;
}

}  // namespace ph
