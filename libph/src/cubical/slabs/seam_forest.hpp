// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory_resource>
#include <ranges>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "libph/src/cubical/graphs/elder_forest.hpp"
#include "libph/src/cubical/slabs/free_cells.hpp"
#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/error.hpp"

namespace ph::cubical {

/// The root of a tree of arrows. It stands for a component that bridges may join with other
/// components.
struct SeamRoot {
  enum class Kind : std::uint32_t {
    outer,        ///< the root was always there and has no cell
    critical,     ///< a critical cell
    open_before,  ///< a node of the seam before the layers; its arrows continue beyond the seam
    open_after,   ///< a node of the seam after the layers; its arrows continue beyond the seam
  };
  double value;   ///< in the order of the stars (GridFrame); unset if the root was always there
  GridCell cell;  ///< set only if the root is a critical cell
  Kind kind;
};

/// A critical cell that joins two roots.
struct SeamBridge {
  double value;  ///< in the order of the stars
  GridCell cell;
  std::uint32_t from, to;
};

/// The nodes that some consecutive layers share with the layer before or after them, indexed by
/// place.
struct Seam {
  static constexpr std::uint32_t kNone = UINT32_MAX;

  explicit Seam(std::pmr::memory_resource* memory) : roots(memory), values(memory) {}
  bool is_open() const { return !roots.empty(); }
  void close() { *this = Seam(roots.get_allocator().resource()); }
  /// Frees the values, which are not needed after the joining of the seam has begun.
  void forget_values() { decltype(values)(values.get_allocator()).swap(values); }

  std::pmr::vector<std::uint32_t> roots;  ///< indexed by place; kNone if the node never enters
  std::pmr::vector<double> values;        ///< in the order of the stars
};

/// The persistent components in one of a grid's two graphs, as far as some consecutive layers
/// determine them. Only the parts that adjacent layers may still change are stored. These parts are
/// the components that reach a seam, and a minimum spanning forest of the bridges that join these
/// components.
///
/// Joining is associative: the pairs do not depend on how the layers are grouped.
/// @tparam backwards true for the graph of the top cells.
template <bool backwards>
class SeamForest {
 public:
  explicit SeamForest(const RunContext& context)
      : roots(&context.memory),
        before(&context.memory),
        after(&context.memory),
        bridges(&context.memory),
        context_(context) {}

  /// True if the layers of `next` may come right after these layers: both have the same nodes at
  /// the seam between them.
  bool is_before(const SeamForest& next) const {
    const auto counts = [](std::uint32_t root) { return root != Seam::kNone; };
    // mutant: seam-compared
    return after.is_open() && after.values == next.before.values &&
           std::ranges::equal(after.roots, next.before.roots, {}, counts, counts);
  }
  /// Joins the layers that come right after these layers. No pair is passed on before `settle`.
  /// Precondition: is_before(next).
  void join(SeamForest next) {
    const auto shift = static_cast<std::uint32_t>(roots.size());
    const std::size_t count = roots.size() + next.roots.size() + next.resolved;
    if (count >= Seam::kNone) throw Error(ErrorKind::resource, "image: found too many components");
    DisjointSets same(count, &context_.memory);
    const auto shifted = [&](std::uint32_t root) {
      return root == Seam::kNone ? root : root + shift;
    };
    const auto rank = [&](std::uint32_t root) {
      const bool is_here = root < shift;
      const std::size_t there = is_here ? 0 : root - shift;
      const Kind kind = is_here                     ? roots[root].kind
                        : there < next.roots.size() ? next.roots[there].kind
                                                    : Kind::open_before;
      const bool is_resolved = kind == (is_here ? Kind::open_after : Kind::open_before);
      return std::tuple(is_resolved, kind, root);
    };
    for (const std::size_t part : {0U, 1U})
      unite(same, outside[part], shifted(next.outside[part]), rank);
    unite_seams(same, after.roots, next.before.roots, shifted, rank);

    const auto moved = [shift](SeamBridge bridge) {
      bridge.from += shift;
      bridge.to += shift;
      return bridge;
    };
    std::pmr::vector<SeamBridge> all(&context_.memory);
    all.reserve(bridges.size() + next.bridges.size());
    // Among bridges of equal value, the bridges of the earlier layers come first, as in the grid.
    std::ranges::merge(bridges, next.bridges | std::views::transform(moved),
                       std::back_inserter(all), {}, &SeamBridge::value, &SeamBridge::value);
    bridges.swap(all);
    next.bridges = decltype(bridges)(bridges.get_allocator());
    after = std::move(next.after);
    for (std::uint32_t& root : after.roots) root = shifted(root);
    identify(same, count, next.roots);
  }
  /// Joins the last layer to the first layer, if the layers are all layers of a periodic axis.
  /// Precondition: is_before(*this).
  void close_ring() {
    DisjointSets same(roots.size(), &context_.memory);
    unite_seams(
        same, after.roots, before.roots, [](std::uint32_t root) { return root; },
        [&](std::uint32_t root) {
          const Kind kind = roots[root].kind;
          return std::tuple(kind >= Kind::open_before, kind, root);
        });
    before.close();
    after.close();
    identify(same, roots.size(), {});
  }
  /// Passes on the pairs that other layers can no longer change. If no seam is left, passes on all
  /// remaining pairs.
  /// @param on_merge called with (bridge, root that dies); the root is null if both components were
  /// always there.
  /// @param on_cycle called with each bridge whose ends are already connected.
  /// @param on_survivor called with each root that never dies.
  template <class OnMerge, class OnCycle, class OnSurvivor>
  void settle(OnMerge&& on_merge, OnCycle&& on_cycle, OnSurvivor&& on_survivor) {
    const bool is_whole = !before.is_open() && !after.is_open();
    const auto outer_count =
        static_cast<std::uint32_t>(std::ranges::count(roots, Kind::outer, &SeamRoot::kind));
    ElderForest<backwards> forest(
        outer_count, roots.size() - outer_count,
        [&](std::size_t i) { return roots[outer_count + i].value; }, context_);
    std::pmr::vector<double> reached = when_reached();
    // Sets of roots that have become one component; each set is represented by one root.
    DisjointSets merged(roots.size(), &context_.memory);
    // True if other layers may join the component with another component before the value `by`.
    const auto may_change = [&](std::uint32_t root, double by) {
      return !is_whole && (backwards ? reached[root] >= finite(by) : reached[root] <= finite(by));
    };
    Ticker ticker(context_, {});
    std::size_t kept = 0;
    const auto place = [&](std::size_t i) { return backwards ? bridges.size() - 1 - i : i; };
    for (std::size_t i = 0; i < bridges.size(); ++i) {
      ticker.work();
      const SeamBridge bridge = bridges[place(i)];
      const std::uint32_t a = forest.find(bridge.from), b = forest.find(bridge.to);
      if (a == b) {
        on_cycle(bridge);
        continue;
      }
      const std::uint32_t dies = forest.join(a, b), stays = dies == a ? b : a;
      // If both components were always there, either of them may die. It is then enough that one of
      // them is closed.
      const bool is_closed = !may_change(dies, bridge.value);
      const bool is_certain = is_closed || (dies < outer_count && !may_change(stays, bridge.value));
      reached[stays] = earlier(reached[stays], reached[dies]);
      if (!is_certain) {
        bridges[place(kept++)] = bridge;
        continue;
      }
      // From now on, a single root represents the closed component: the root to which the bridge
      // leads.
      const auto [closed, other] = (dies == a) == is_closed ? std::pair{bridge.from, bridge.to}
                                                            : std::pair{bridge.to, bridge.from};
      merged.link(merged.find(closed), merged.find(other));
      on_merge(bridge, dies < outer_count ? nullptr : &roots[dies]);
    }
    for (std::uint32_t i = outer_count; i < roots.size(); ++i)
      if (forest.is_root(i) && (is_whole || reached[i] == kNever)) on_survivor(roots[i]);
    keep(kept);
    for (SeamBridge& bridge : bridges) {
      bridge.from = merged.find(bridge.from);
      bridge.to = merged.find(bridge.to);
    }
    for_each_in_seams([&](std::uint32_t& root) { root = merged.find(root); });
    forget_closed();
  }

  /// Roots that were always there come first. Critical cells follow, in the order of the grid. Open
  /// roots come before all other roots or after them, depending on the kind of graph. Their place
  /// is chosen so that an open root counts as the youngest among roots of equal value. No other
  /// component therefore dies because of the number of an open root.
  std::pmr::vector<SeamRoot> roots;
  /// The number of resolved roots, which are nodes of the seam before the layers and are numbered
  /// after `roots`. The number is 0 unless these layers are about to be joined to the preceding
  /// layers. Joining replaces the resolved roots, which therefore need no data.
  std::uint32_t resolved = 0;
  std::array<std::uint32_t, 2> outside{};  ///< the roots of the two parts of the outside
  Seam before, after;                      ///< empty where the grid ends
  std::pmr::vector<SeamBridge> bridges;    ///< ascending; equal values are in the order of the grid

  bool is_in_order() const { return std::ranges::is_sorted(roots, {}, &SeamForest::age_of); }

 private:
  using Kind = SeamRoot::Kind;
  static constexpr double kNever = backwards ? -std::numeric_limits<double>::infinity()
                                             : std::numeric_limits<double>::infinity();

  static int age_of(const SeamRoot& root) {
    if (root.kind == Kind::outer) return 0;
    return (root.kind == Kind::critical) == backwards ? 2 : 1;  // mutant: seam-age
  }
  // Makes infinite values of cells finite, so that they differ from kNever.
  static double finite(double value) {
    constexpr double most = std::numeric_limits<double>::max();
    return std::clamp(value, -most, most);
  }
  static double earlier(double a, double b) { return backwards ? std::max(a, b) : std::min(a, b); }

  // Unites two sets of roots. The representative of a set is, in order of preference, the first
  // root that was always there, a critical cell, an open root, or a resolved root.
  template <class Rank>
  static void unite(DisjointSets& same, std::uint32_t a, std::uint32_t b, Rank&& rank) {
    a = same.find(a);
    b = same.find(b);
    if (a == b) return;
    const bool a_stays = rank(a) < rank(b);
    same.link(a_stays ? b : a, a_stays ? a : b);
  }
  template <class Shift, class Rank>
  static void unite_seams(DisjointSets& same, std::span<const std::uint32_t> ends,
                          std::span<const std::uint32_t> begins, Shift&& shift, Rank&& rank) {
    for (std::size_t k = 0; k < ends.size(); ++k)
      if (ends[k] != Seam::kNone) unite(same, ends[k], shift(begins[k]), rank);
  }
  // Removes roots that have turned out to equal other roots, and sorts the rest. @param count the
  // number of all roots, including `others`. @param others roots that are numbered after `roots`.
  void identify(DisjointSets& same, std::size_t count, std::span<const SeamRoot> others) {
    std::pmr::vector<std::uint32_t> number(count, Seam::kNone, &context_.memory);
    std::pmr::vector<SeamRoot> left(&context_.memory);
    const std::size_t stored = roots.size() + others.size();
    const auto stays = [&](std::size_t i) { return same.find(static_cast<std::uint32_t>(i)) == i; };
    std::size_t size = 0;
    for (std::size_t i = 0; i < stored; ++i) size += stays(i) ? 1 : 0;
    left.reserve(size);
    for (const int age : {0, 1, 2})
      for (std::size_t i = 0; i < stored; ++i) {
        const SeamRoot& root = i < roots.size() ? roots[i] : others[i - roots.size()];
        if (age_of(root) != age || !stays(i)) continue;
        number[i] = static_cast<std::uint32_t>(left.size());
        left.push_back(root);
      }
    roots.swap(left);
    for (std::uint32_t i = 0; i < count; ++i) number[i] = number[same.find(i)];
    renumber(number);
  }
  // Removes the roots for which `is_kept(number)` is false. @param number receives the new number
  // of each root that is kept.
  template <class IsKept>
  void keep_roots(std::span<std::uint32_t> number, IsKept&& is_kept) {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < roots.size(); ++i)
      if (is_kept(i)) {
        roots[count] = roots[i];
        number[i] = count++;
      }
    roots.resize(count);
  }
  void renumber(std::span<const std::uint32_t> number) {
    for (SeamBridge& bridge : bridges) {
      bridge.from = number[bridge.from];
      bridge.to = number[bridge.to];
    }
    for_each_in_seams([&](std::uint32_t& root) { root = number[root]; });
    for (std::uint32_t& part : outside) part = number[part];
  }
  // For each root, the first value at which it is connected to a node that is shared with other
  // layers. The first value is the highest in the graph of the top cells, and the lowest in the
  // other graph.
  std::pmr::vector<double> when_reached() const {
    std::pmr::vector<double> reached(roots.size(), kNever, &context_.memory);
    for (const Seam* const seam : {&before, &after})  // mutant: seam-before
      for (std::size_t k = 0; k < seam->roots.size(); ++k) {
        const std::uint32_t root = seam->roots[k];
        if (root == Seam::kNone) continue;
        const bool always = roots[root].kind == Kind::outer;
        reached[root] = earlier(reached[root], always ? -kNever : finite(seam->values[k]));
      }
    for (const std::uint32_t part : outside) reached[part] = -kNever;
    return reached;
  }
  // Calls `use(root)` for the roots of the nodes that are shared with other layers.
  template <class Use>
  void for_each_in_seams(Use&& use) {
    for (Seam* const seam : {&before, &after})
      for (std::uint32_t& root : seam->roots)
        if (root != Seam::kNone) use(root);
  }
  // Keeps `count` bridges, the first in the order of the graph. Only these bridges are still
  // needed.
  void keep(std::size_t count) {
    if (backwards)
      bridges.erase(bridges.begin(), bridges.end() - static_cast<std::ptrdiff_t>(count));
    else
      bridges.resize(count);
    bridges.shrink_to_fit();
  }
  // Removes all roots except the roots of the outside, and the roots that a seam or a bridge refers
  // to.
  void forget_closed() {
    std::pmr::vector<std::uint32_t> number(roots.size(), Seam::kNone, &context_.memory);
    for (const std::uint32_t part : outside) number[part] = 0;
    for (const SeamBridge& bridge : bridges) number[bridge.from] = number[bridge.to] = 0;
    for_each_in_seams([&](std::uint32_t root) { number[root] = 0; });
    keep_roots(number, [&](std::uint32_t i) { return number[i] != Seam::kNone; });
    roots.shrink_to_fit();
    renumber(number);
  }

  const RunContext& context_;
};

}  // namespace ph::cubical
