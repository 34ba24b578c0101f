// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "cubical/graphs/elder_forest.hpp"
#include "cubical/slabs/slab_basins.hpp"
#include "ph/detail/components/disjoint_sets.hpp"

namespace ph::cubical {

/// Persistent components of one of the two graphs of a grid of which a slab is seen at a time. What
/// is kept between two slabs is what the next ones may still change: the components that reach the
/// seam, and of the cells that join them those of a minimum spanning forest.
template <class Graph>
class SlabComponents {
 public:
  /// A bridge.
  struct Place {
    double value;       ///< in the order of the stars
    NumberedCell cell;  ///< in the whole grid
  };

  explicit SlabComponents(const RunContext& context)
      : context_(context),
        roots_(outside_.size(), {0, {}, SlabRoot::Kind::outer}, &context.memory),
        seam_(&context.memory),
        around_(&context.memory),
        around_values_(&context.memory),
        kept_(&context.memory) {}

  /// One more slab: what lies before it has been seen.
  /// @param first the slab's first voxel in the whole grid.
  /// @param cells the critical cells that are the graph's bridges, in their order.
  /// @param on_merge called with (bridge, root that dies; null if both have always been there).
  /// @param on_cycle called with each bridge that joins nothing.
  /// @param on_survivor called with each root that never dies.
  template <class OnMerge, class OnCycle, class OnSurvivor>
  void add(const StarGrid& grid, const Graph& graph, std::uint32_t first,
           const CriticalCells& cells, OnMerge&& on_merge, OnCycle&& on_cycle,
           OnSurvivor&& on_survivor) {
    const bool is_last = grid.slab().is_last;
    std::pmr::vector<Bridge> bridges = find_bridges(grid, graph, first, cells);
    const std::uint32_t outer_count = number_in_age_order(bridges);
    ElderForest<Graph::kBackwards> forest(
        outer_count, roots_.size() - outer_count,
        [&](std::size_t i) { return roots_[outer_count + i].value; }, context_);
    std::pmr::vector<double> reached = when_reached(graph);
    // Roots that are one for all that comes: (the root that stands for it).
    DisjointSets merged(roots_.size(), &context_.memory);
    // Whether a component may have been joined with another one in a later slab by then.
    const auto may_change = [&](std::uint32_t root, double by) {
      return !is_last &&
             (Graph::kBackwards ? reached[root] >= finite(by) : reached[root] <= finite(by));
    };
    Ticker ticker(context_, {});
    kept_.clear();
    for (std::size_t i = 0; i < bridges.size(); ++i) {
      ticker.work();
      const Bridge& bridge = bridges[Graph::kBackwards ? bridges.size() - 1 - i : i];
      const std::uint32_t a = forest.find(bridge.from), b = forest.find(bridge.to);
      if (a == b) {
        on_cycle(bridge.place());
        continue;
      }
      const std::uint32_t dies = forest.join(a, b), stays = dies == a ? b : a;
      // Two that have always been there are equals: it is enough that one is closed.
      const bool is_closed = !may_change(dies, bridge.value);
      const bool is_certain = is_closed || (dies < outer_count && !may_change(stays, bridge.value));
      reached[stays] = earlier(reached[stays], reached[dies]);
      if (!is_certain) {
        kept_.push_back(bridge);
        continue;
      }
      // The closed one has been merged into one root; from now on it is where the bridge leads.
      const auto [closed, other] = (dies == a) == is_closed ? std::pair{bridge.from, bridge.to}
                                                            : std::pair{bridge.to, bridge.from};
      merged.link(merged.find(closed), merged.find(other));
      on_merge(bridge.place(), dies < outer_count ? nullptr : &roots_[dies]);
    }
    for (std::uint32_t i = outer_count; i < roots_.size(); ++i)
      if (forest.is_root(i) && (is_last || reached[i] == kNever)) on_survivor(roots_[i]);
    if (is_last) return;
    if (Graph::kBackwards) std::ranges::reverse(kept_);
    for (Bridge& bridge : kept_) {
      bridge.from = merged.find(bridge.from);
      bridge.to = merged.find(bridge.to);
    }
    for_each_in_seams([&](std::uint32_t& root) { root = merged.find(root); });
    forget_closed();
  }

 private:
  static constexpr std::uint32_t kNone = SlabBasins<Graph>::kNone;
  static constexpr double kNever = Graph::kBackwards ? -std::numeric_limits<double>::infinity()
                                                     : std::numeric_limits<double>::infinity();
  struct Bridge {
    double value;
    NumberedCell cell;
    std::uint32_t from, to;
    Place place() const { return {value, cell}; }
  };
  // kNever is no value of a cell.
  static double finite(double value) {
    constexpr double most = std::numeric_limits<double>::max();
    return std::clamp(value, -most, most);
  }
  static double earlier(double a, double b) {
    return Graph::kBackwards ? std::max(a, b) : std::min(a, b);
  }

  // Those kept and those of the slab, in the order of the filtration.
  std::pmr::vector<Bridge> find_bridges(const StarGrid& grid, const Graph& graph,
                                        std::uint32_t first, const CriticalCells& cells) {
    const SlabPlace& slab = grid.slab();
    const SlabSeams seams{seam_, slab.is_last ? around_ : std::span<const std::uint32_t>()};
    SlabBasins<Graph> basins(grid, graph, first, roots_, outside_, seams, context_);
    std::pmr::vector<Bridge> all(&context_.memory), own(cells.order.size(), &context_.memory);
    constexpr std::size_t piece = 1 << 14;
    for_each_piece("basins", own.size(), piece, context_, [&](std::size_t i, std::size_t end) {
      for (; i < end; ++i) {
        const auto [value, place] = cells.order[i];
        const auto [voxel, number] = cells.cells[place];
        const auto [from, to] = graph.ends(voxel, number);
        own[i] = {value, {voxel + first, number}, basins.number(from), basins.number(to)};
      }
    });
    all.reserve(kept_.size() + own.size());
    std::ranges::merge(kept_, own, std::back_inserter(all), {}, &Bridge::value, &Bridge::value);
    for (Bridge& bridge : all) {
      bridge.from = basins.same(bridge.from);
      bridge.to = basins.same(bridge.to);
    }
    if (!slab.is_last) {
      for (std::uint32_t& root : around_)
        if (root != kNone) root = basins.same(root);
      seam_ = basins.seam(true);
      if (slab.is_first && slab.is_in_ring) {
        around_ = basins.seam(false);
        around_values_ = values_of_seam(graph, false);
      }
    } else {
      seam_.clear();
      around_.clear();
    }
    for (std::uint32_t& part : outside_) part = basins.same(part);
    stands_for_itself_.assign(roots_.size(), false);
    for (std::uint32_t i = 0; i < roots_.size(); ++i) stands_for_itself_[i] = basins.same(i) == i;
    return all;
  }
  // Leaves out roots that turned out to be others. What has always been there comes first, what is
  // open last: nothing is taken for younger than that on account of their numbers.
  // @return how many have always been there.
  std::uint32_t number_in_age_order(std::span<Bridge> bridges) {
    std::uint32_t outer_count = 0;
    std::pmr::vector<std::uint32_t> number(roots_.size(), kNone, &context_.memory);
    std::pmr::vector<SlabRoot> left(&context_.memory);
    using Kind = SlabRoot::Kind;
    for (const Kind kind :
         {Kind::outer, Kind::critical, Kind::open_to_around, Kind::open_to_next}) {
      for (std::uint32_t i = 0; i < roots_.size(); ++i) {
        if (!stands_for_itself_[i] || roots_[i].kind != kind) continue;
        number[i] = static_cast<std::uint32_t>(left.size());
        left.push_back(roots_[i]);
      }
      if (kind == Kind::outer) outer_count = static_cast<std::uint32_t>(left.size());
    }
    roots_ = std::move(left);
    renumber(number, bridges);
    return outer_count;
  }
  void renumber(std::span<const std::uint32_t> number, std::span<Bridge> bridges) {
    for (Bridge& bridge : bridges) {
      bridge.from = number[bridge.from];
      bridge.to = number[bridge.to];
    }
    for_each_in_seams([&](std::uint32_t& root) { root = number[root]; });
    for (std::uint32_t& part : outside_) part = number[part];
  }
  // By place: when a node of a seam enters; of those that never do anything.
  std::pmr::vector<double> values_of_seam(const Graph& graph, bool after) const {
    const auto [begin, count] = graph.seam(after);
    std::pmr::vector<double> values(count, 0, &context_.memory);
    for (std::uint32_t k = 0; k < count; ++k) values[k] = graph.seam_value(begin + k).value_or(0);
    return values;
  }
  // By root: the value from which on it hangs together with a node that later slabs share.
  std::pmr::vector<double> when_reached(const Graph& graph) const {
    std::pmr::vector<double> reached(roots_.size(), kNever, &context_.memory);
    if (seam_.empty()) return reached;
    const auto add_seam = [&](std::span<const std::uint32_t> seam, std::span<const double> values) {
      for (std::size_t k = 0; k < seam.size(); ++k) {
        const std::uint32_t root = seam[k];
        if (root == kNone) continue;
        const bool always = roots_[root].kind == SlabRoot::Kind::outer;
        reached[root] = earlier(reached[root], always ? -kNever : finite(values[k]));
      }
    };
    add_seam(seam_, values_of_seam(graph, true));
    add_seam(around_, around_values_);
    for (const std::uint32_t part : outside_) reached[part] = -kNever;
    return reached;
  }
  // Calls `use(root)` for the roots of the nodes that later slabs share.
  template <class Use>
  void for_each_in_seams(Use&& use) {
    for (auto* const seam : {&seam_, &around_})
      for (std::uint32_t& root : *seam)
        if (root != kNone) use(root);
  }
  // Keeps what a seam or a kept bridge names, and the outside.
  void forget_closed() {
    std::pmr::vector<std::uint32_t> number(roots_.size(), kNone, &context_.memory);
    for (const std::uint32_t part : outside_) number[part] = 0;
    for (const Bridge& bridge : kept_) number[bridge.from] = number[bridge.to] = 0;
    for_each_in_seams([&](std::uint32_t root) { number[root] = 0; });
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < roots_.size(); ++i) {
      if (number[i] == kNone) continue;
      roots_[count] = roots_[i];
      number[i] = count++;
    }
    roots_.resize(count);
    roots_.shrink_to_fit();
    renumber(number, kept_);
  }

  const RunContext& context_;
  std::array<std::uint32_t, 2> outside_{0, 1};
  std::pmr::vector<SlabRoot> roots_;  // by age, but for what is open
  // Roots of the nodes shared with the next slab; of a ring those that the first slab shares with
  // the last one, and their values.
  std::pmr::vector<std::uint32_t> seam_, around_;
  std::pmr::vector<double> around_values_;
  std::pmr::vector<Bridge> kept_;        // that join what may change, in their order
  std::vector<bool> stands_for_itself_;  // while a slab is added
};

}  // namespace ph::cubical
