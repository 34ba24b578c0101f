// SPDX-License-Identifier: MIT
#include "ph/detail/rips/edge_collapse.hpp"
#include "ph/detail/rips/rips_graph.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "libph/src/rips/collapse/collapse_lists.hpp"
#include "libph/src/rips/collapse/collapse_rows.hpp"

namespace ph {
namespace collapse {
namespace {

/// The collapse of one graph, stored as `Graph` (see collapse_graph.hpp).
template <class Graph>
class EdgeCollapse {
 public:
  EdgeCollapse(const RipsGraph& input, const RunContext& context)
      : input_(input),
        context_(context),
        graph_(input, &context.memory),
        link_(graph_.make_set()),
        candidates_(graph_.make_set()),
        arrivals_(&context.memory),
        last_dominator_(static_cast<std::size_t>(input.size()), 0, &context.memory) {}

  RipsGraph run() {
    const auto count = static_cast<Key>(input_.edge_count());
    std::pmr::vector<Move> kept(&context_.memory);
    Ticker ticker(context_, "edge collapse", count);
    graph_.enter_until(count);
    for (Key last = count; last > 0;) {
      const std::size_t kept_before = kept.size();
      const double value = input_.value(last);
      Key key = last;
      for (; key > 0 && input_.value(key) == value; --key) {
        const Key to = first_key_not_dominated(input_.edge(key), last, ticker);
        if (to != last) graph_.move(input_.edge(key), to);
        if (to != kNever) kept.push_back({to, key});
        ticker.tick();
      }
      for (std::size_t i = kept_before; i < kept.size(); ++i)
        // mutant: collapse-leave
        if (kept[i].to == last) graph_.leave(input_.edge(kept[i].edge), last);
      last = key;
    }
    return collapsed(std::move(kept));
  }

  /// The share of edges that are dominated when they enter, among `sample` edges spread evenly over
  /// the order.
  double dominated_share(std::size_t sample) {
    const std::size_t count = input_.edge_count();
    sample = std::min(sample, count);
    if (sample == 0) return 0;
    Ticker ticker(context_, "sample of edges", sample);
    std::size_t dominated = 0;
    for (std::size_t i = 0; i < sample; ++i) {
      const Key key = static_cast<Key>((2 * i + 1) * count / (2 * sample)) + 1;
      Key last = key;
      while (last < count && input_.value(last + 1) == input_.value(key)) ++last;
      graph_.enter_until(last);
      graph_.find_link(input_.edge(key), last, link_);
      dominated += find_dominator(input_.edge(key), last, ticker) != kNone;
      ticker.tick();
    }
    return static_cast<double>(dominated) / static_cast<double>(sample);
  }

 private:
  struct Move {
    Key to, edge;
    friend auto operator<=>(const Move&, const Move&) = default;
  };

  /// The first key that is not less than `now` and at which the edge is not dominated. Returns
  /// kNever if there is no such key.
  Key first_key_not_dominated(const FlagEdge& e, Key now, Ticker& ticker) {
    graph_.find_link(e, now, link_);
    Vertex dominator = find_dominator(e, now, ticker);
    if (dominator == kNone) return now;
    // A dominator remains a dominator until a vertex that is not joined to it enters the link.
    graph_.find_arrivals(e, now, arrivals_);
    std::ranges::make_heap(arrivals_, std::greater{});
    while (!arrivals_.empty()) {
      now = arrivals_.front().key;
      bool dominates = true;
      while (!arrivals_.empty() && arrivals_.front().key == now) {
        const Vertex x = arrivals_.front().vertex;
        std::ranges::pop_heap(arrivals_, std::greater{});
        arrivals_.pop_back();
        graph_.insert(link_, x);
        // mutant: collapse-dominator
        dominates = dominates && graph_.are_joined(dominator, x, now);
      }
      if (dominates) continue;
      dominator = find_dominator(e, now, ticker);
      if (dominator == kNone) return now;
    }
    return kNever;
  }

  /// A vertex of the link that, at key `now`, is joined to all other vertices of the link. Returns
  /// kNone if there is no such vertex.
  Vertex find_dominator(const FlagEdge& e, Key now, Ticker& ticker) {
    Vertex& last = last_dominator_[e.u];
    Vertex c = graph_.contains(link_, last) ? last : graph_.first(link_);
    candidates_ = link_;
    while (c != kNone) {
      ticker.work();
      const Vertex apart = graph_.first_apart(link_, c, now);
      if (apart == kNone) return last = c;
      // A dominator is joined to `apart`, which rules out c, `apart` itself and usually most
      // candidates.
      graph_.keep_neighbours(candidates_, apart, now);
      c = graph_.first(candidates_);
    }
    return kNone;
  }

  RipsGraph collapsed(std::pmr::vector<Move>&& kept) const {
    // mutant: collapse-equal-edges
    std::ranges::sort(kept);  // among edges of equal value, edges that were moved come first
    FlagEdges edges(&context_.memory);
    edges.reserve(kept.size());
    for (const auto& [to, key] : kept) {
      const FlagEdge& e = input_.edge(key);
      edges.push_back({input_.value(to), e.u, e.v});  // mutant: collapse-moved
    }
    return RipsGraph::with_edges(input_, std::move(edges), context_);
  }

  const RipsGraph& input_;
  const RunContext& context_;
  Graph graph_;
  typename Graph::Set link_, candidates_;
  std::pmr::vector<Arrival> arrivals_;  // a heap with the next arrival on top
  // For each vertex, the last dominator of an edge whose larger end is this vertex. It is a good
  // guess for the next such edge.
  std::pmr::vector<Vertex> last_dominator_;
};

constexpr double kAlwaysAffordable = 1 << 25;  // bytes
constexpr std::size_t kSample = 500;           // number of edges
// Another pass follows if a pass dropped at least one of every 8 edges. Measurements show that
// after a pass that dropped fewer edges, the next pass takes longer than it saves in the reduction.
constexpr std::size_t kWorthAnotherPass = 8;

// Measurements show that rows are 2 to 15 times as fast as lists wherever their memory is
// affordable.
bool are_rows_affordable(const RipsGraph& graph) {
  return RowGraph::bytes(graph) <= std::max(kAlwaysAffordable, ListGraph::bytes(graph));
}

template <class Use>
auto with_collapse(const RipsGraph& graph, const RunContext& context, CollapseLayout layout,
                   Use&& use) {
  if (layout == CollapseLayout::rows ||
      (layout == CollapseLayout::automatic && are_rows_affordable(graph)))
    return use(EdgeCollapse<RowGraph>(graph, context));
  return use(EdgeCollapse<ListGraph>(graph, context));
}

}  // namespace
}  // namespace collapse

RipsGraph collapse_edges(const RipsGraph& graph, const RunContext& context, CollapseLayout layout) {
  // The decision about an edge depends on the edges present at that time. If shorter edges are
  // moved to later values afterwards, the edge may become dominated. Another pass may therefore
  // drop more edges.
  const auto pass = [&](const RipsGraph& input) {
    return collapse::with_collapse(input, context, layout, [](auto&& c) { return c.run(); });
  };
  const auto is_next_worth = [](std::size_t before, std::size_t after) {
    return before - after >= before / collapse::kWorthAnotherPass && after < before;
  };
  std::size_t before = graph.edge_count();
  RipsGraph collapsed = pass(graph);
  while (is_next_worth(before, collapsed.edge_count())) {  // mutant: collapse-passes
    before = collapsed.edge_count();
    collapsed = pass(collapsed);
  }
  return collapsed;
}

double dominated_share(const RipsGraph& graph, const RunContext& context) {
  return collapse::with_collapse(graph, context, CollapseLayout::automatic,
                                 [](auto&& c) { return c.dominated_share(collapse::kSample); });
}

double collapse_bytes(const RipsGraph& graph) {
  return collapse::are_rows_affordable(graph) ? collapse::RowGraph::bytes(graph)
                                              : collapse::ListGraph::bytes(graph);
}

}  // namespace ph
