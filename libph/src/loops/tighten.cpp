// SPDX-License-Identifier: MIT
#include "libph/src/loops/tighten.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <optional>

#include "libph/src/loops/cover_search.hpp"
#include "libph/src/loops/early_graph.hpp"
#include "libph/src/loops/edge_cocycles.hpp"
#include "libph/src/loops/edge_sum.hpp"
#include "libph/src/loops/shortcuts.hpp"
#include "ph/custom.hpp"
#include "ph/detail/rips/rips_filtration.hpp"
#include "ph/error.hpp"

namespace ph::detail {
namespace {

// The limits for the number of search steps along edges, for all loops together and for one loop. A
// step takes a few nanoseconds.
constexpr std::uint64_t kMostSteps = 300'000'000, kMostStepsOfOne = 20'000'000;
// The limit for the number of cofacets of edges that are listed to compute cocycles. Persistent
// cohomology takes about a second for this number of cofacets.
constexpr double kMostCofacets = 5e7;
// The relative difference that the order of summation may make in a sum of lengths.
constexpr double kRounding = 1e-12;

using Key = EarlyGraph::Key;
using Walk = Shortcuts::Walk;

double length_of(const std::vector<Loop>& loops) {
  return std::accumulate(loops.begin(), loops.end(), 0.0,
                         [](double sum, const Loop& loop) { return sum + *loop.length; });
}

/// A bar whose loops are to be tightened.
struct Candidate {
  std::size_t bar;
  Lifetime lifetime;
  bool needs_cocycles;
};

/// The latest birth of a bar of H1 that has loops. Returns nothing if no bar has loops.
std::optional<double> last_birth(const Barcode& cycles, const std::vector<BarLoops>& loops) {
  std::optional<double> last;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (!loops[i].loops.empty()) last = std::max(last.value_or(0), cycles[i].birth);
  return last;
}

class Tightener {
 public:
  Tightener(const RipsGraph& graph, const Barcode& cycles, double last, const Options& options,
            const RunContext& context)
      : all_(graph),
        cycles_(cycles),
        options_(options),
        context_(context),
        graph_(graph, last, context),
        elders_(options.collapse != Collapse::off) {}

  void measure(std::vector<Loop>& loops) const {
    for (Loop& loop : loops) {
      double length = 0;
      const Walk walk = vertices_of(loop);
      for (std::size_t i = 0; i < walk.size(); ++i)
        length += graph_.value(key_of(walk[i], walk[(i + 1) % walk.size()]));
      loop.length = length;
    }
  }

  void tighten(std::vector<BarLoops>& all) {
    std::vector<Candidate> candidates = list_candidates(all);
    EdgeCocycles cocycles(context_);
    const double reach = compute_cocycles(candidates, cocycles);
    // The most persistent bars come first, because the budget may not be enough for all.
    std::ranges::stable_sort(candidates, std::greater<>(),
                             [&](const Candidate& c) { return cycles_[c.bar].persistence(); });
    CoverSearch search(graph_, cocycles, options_.field, context_);
    Shortcuts shortcuts(graph_, context_);
    StepBudget budget{kMostSteps};
    Ticker ticker(context_, "loops", candidates.size());
    for (const Candidate& c : candidates) {
      budget.begin(kMostStepsOfOne);
      const bool is_decided = !c.needs_cocycles || c.lifetime.death <= reach;
      tighten_one(c, is_decided, cocycles, search, shortcuts, budget, all[c.bar]);
      ticker.tick();
      ticker.poll();
    }
  }

 private:
  Walk vertices_of(const Loop& loop) const {
    Walk walk;
    for (const Index point : loop.numbers) walk.push_back(graph_.vertex_of(point));
    return walk;
  }
  Key key_of(std::uint32_t u, std::uint32_t v) const {
    if (const auto key = graph_.key_of(u, v)) return *key;
    throw Error(ErrorKind::usage, "loops: found a cycle with an edge that is not in this complex");
  }
  Key key_of(const InputCell& edge) const {
    return key_of(graph_.vertex_of(edge.numbers[0]), graph_.vertex_of(edge.numbers[1]));
  }

  /// Lists the bars of positive length that have loops, and marks the bars that need cocycles
  /// because they may have elders.
  std::vector<Candidate> list_candidates(const std::vector<BarLoops>& all) const {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].loops.empty() || cycles_.birth_cell(i).numbers.empty()) continue;
      const Bar& bar = cycles_[i];
      if (bar.birth < bar.death)
        candidates.push_back({i, {bar.birth, bar.death, key_of(cycles_.birth_cell(i))}, false});
    }
    std::ranges::stable_sort(candidates, [&](const Candidate& a, const Candidate& b) {
      return elders_.is_born_before(a.lifetime, b.lifetime);
    });
    double last_death = -kInfinity;  // last death among the bars of earlier groups
    for (std::size_t begin = 0, end; begin < candidates.size(); begin = end) {
      // A group consists of bars none of which is born before another. It is a single bar if births
      // are compared by edge. Otherwise it consists of all bars with the same birth.
      double last_of_group = -kInfinity;
      for (end = begin;
           end < candidates.size() &&
           !elders_.is_born_before(candidates[begin].lifetime, candidates[end].lifetime);
           ++end)
        last_of_group = std::max(last_of_group, candidates[end].lifetime.death);
      for (std::size_t i = begin; i < end; ++i) {
        Candidate& c = candidates[i];
        // mutant: loops-needs-cocycles
        c.needs_cocycles = last_death >= c.lifetime.death ||
                           (elders_.by_value() && shares_value(c.lifetime.birth_key));
      }
      last_death = std::max(last_death, last_of_group);
    }
    return candidates;
  }
  bool shares_value(Key key) const {
    const double value = graph_.value(key);
    return (key > 1 && graph_.value(key - 1) == value) ||
           (key < graph_.edges() && graph_.value(key + 1) == value);
  }

  /// Computes the cocycles that bars need, but only for the bars that die early enough to keep the
  /// computation short.
  /// @return the latest death among the bars for which the needed cocycles were computed; -infinity
  /// if there is no such bar.
  double compute_cocycles(const std::vector<Candidate>& candidates, EdgeCocycles& cocycles) const {
    std::vector<Candidate> asking;  // sorted by birth
    for (const Candidate& c : candidates)
      if (c.needs_cocycles) asking.push_back(c);
    if (asking.empty()) return -kInfinity;
    const double affordable = last_affordable_value();
    std::erase_if(asking, [&](const Candidate& c) { return c.lifetime.death > affordable; });
    if (asking.empty()) return -kInfinity;
    double reach = -kInfinity;
    for (const Candidate& c : asking) reach = std::max(reach, c.lifetime.death);
    // For each position in `asking`, the earliest death among the bars from there to the end.
    std::vector<double> first_death(asking.size());
    for (std::size_t i = asking.size(); i-- > 0;)
      first_death[i] = std::min(asking[i].lifetime.death,
                                i + 1 < asking.size() ? first_death[i + 1] : kInfinity);
    const auto is_elder_of_some = [&](const Lifetime& elder) {
      const auto first = std::ranges::partition_point(asking, [&](const Candidate& c) {
        return elders_.by_value() ? c.lifetime.birth < elder.birth
                                  : c.lifetime.birth_key <= elder.birth_key;
      });
      return first != asking.end() &&
             first_death[static_cast<std::size_t>(first - asking.begin())] <= elder.death;
    };
    try {
      const Barcode bars =
          persistence(rips_until(reach),
                      Options{.max_dim = 1,
                              .min_dim = 1,
                              .field = options_.field,
                              .collapse = Collapse::off,
                              .min_persistence = std::max(0.0, options_.min_persistence),
                              .representatives = Representatives::cocycles},
                      context_);
      const MemoryClaim claim(context_.memory, bars.bytes());
      Ticker ticker(context_, "loops");
      cocycles.take(graph_, bars, options_.field, is_elder_of_some, ticker);
      return reach;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::resource) throw;
    } catch (const std::bad_alloc&) {
    }
    cocycles = EdgeCocycles(context_);
    return -kInfinity;
  }

  /// The value of the first edge at which the estimated number of cofacets of all edges so far
  /// exceeds kMostCofacets; infinity if there is no such edge.
  double last_affordable_value() const {
    std::pmr::vector<std::uint32_t> degrees(static_cast<std::size_t>(all_.size()), 0,
                                            &context_.memory);
    double cofacets = 0;  // an upper bound, from the degrees of the ends of edges
    for (Key key = 1; key <= all_.edge_count(); ++key) {
      const FlagEdge& e = all_.edge(key);
      cofacets += 2.0 * degrees[e.u]++ + 2.0 * degrees[e.v]++ + 2;
      if (cofacets > kMostCofacets) return e.value;
    }
    return kInfinity;
  }
  Rips rips_until(double value) const {
    FlagEdges edges(&context_.memory);
    for (Key key = 1; key <= all_.edge_count() && all_.value(key) < value; ++key)
      edges.push_back(all_.edge(key));
    return Rips(RipsGraph::with_edges(all_, std::move(edges), context_));
  }

  void tighten_one(const Candidate& c, bool is_decided, const EdgeCocycles& cocycles,
                   CoverSearch& search, Shortcuts& shortcuts, StepBudget& budget, BarLoops& out) {
    const Key birth = c.lifetime.birth_key;
    const Around around{elders_.by_value() ? graph_.edges_up_to(c.lifetime.birth) : birth, birth};
    const std::uint32_t low = graph_.edge(birth).v, high = graph_.edge(birth).u;
    const InputChain chain = cycles_.representative(c.bar);
    for (std::size_t i = 0; i < chain.size(); ++i)
      if (key_of(chain.cell(i)) > around.limit)
        throw Error(ErrorKind::usage,
                    "loops: found a cycle with an edge that enters after the birth of its bar");

    for (bool goes_on = true; goes_on;) {
      EdgeSum sum(options_.field);
      for (const Loop& loop : out.loops) {
        Walk walk = vertices_of(loop);
        const bool is_born = turn_to(walk, low, high);
        shortcuts.shorten(walk, is_born, around, budget);
        sum.add(graph_, walk, loop.coefficient);
      }
      // The sum is split again, which may allow further shortening.
      std::vector<Loop> shorter = sum.loops(context_);
      measure(shorter);
      goes_on = shorter != out.loops;
      out.loops = std::move(shorter);
    }
    if (budget.of_one == 0) return;
    out.tightness = Tightness::locally;
    if (!is_decided) return;

    const std::int64_t coefficient = set_target(c, chain, cocycles, search);
    const bool is_one = out.loops.size() == 1;
    const double bound =
        is_one ? (*out.loops[0].length - graph_.value(birth)) * (1 - kRounding) : kInfinity;
    Walk path;
    const Verdict verdict = search.find(high, low, around, bound, budget, path);
    if (verdict == Verdict::found) {
      // Moves the last vertex of the path to the front. The closed walk then begins with the birth
      // edge.
      std::rotate(path.begin(), path.end() - 1, path.end());
      EdgeSum found(options_.field);
      found.add(graph_, path, coefficient);
      std::vector<Loop> loops = found.loops(context_);
      measure(loops);
      // Over Z/p, the loops that result from splitting the sum of edges may be longer than the
      // walk. The parts of the walk are never longer.
      std::vector<Loop> parts = parts_of(path, graph_, coefficient, options_.field, context_);
      measure(parts);
      // mutant: loops-taken-apart
      if (length_of(parts) < length_of(loops)) loops = std::move(parts);
      if (is_one || length_of(loops) < length_of(out.loops)) out.loops = std::move(loops);
    }
    if (verdict == Verdict::found || (verdict == Verdict::none && is_one))
      out.tightness = Tightness::shortest;
  }

  /// Rotates or reverses a walk to make the birth edge its last step. @return true if the walk has
  /// that edge.
  static bool turn_to(Walk& walk, std::uint32_t low, std::uint32_t high) {
    for (std::size_t i = 0; i < walk.size(); ++i) {
      const std::uint32_t next = walk[(i + 1) % walk.size()];
      if ((walk[i] != low || next != high) && (walk[i] != high || next != low)) continue;
      std::rotate(walk.begin(), walk.begin() + static_cast<std::ptrdiff_t>((i + 1) % walk.size()),
                  walk.end());
      return true;
    }
    return false;
  }

  /// Sets the target of the search. The target consists of the cocycles that count, and the values
  /// that they must have on a path that forms a loop with the birth edge.
  /// @return the coefficient of the birth edge in the chain.
  std::int64_t set_target(const Candidate& c, const InputChain& chain, const EdgeCocycles& cocycles,
                          CoverSearch& search) const {
    const std::int64_t p = options_.field;
    std::vector<std::uint32_t> counted;
    std::vector<std::int64_t> slot(cocycles.lifetimes().size(), -1);
    for (std::uint32_t k = 0; k < slot.size(); ++k) {
      // A bar that needs no cocycles has no elder except perhaps itself. Lifetimes are not compared
      // for it, because a cocycle whose bar dies after the last computed value seems to live
      // forever.
      if (!c.needs_cocycles || !elders_.is_elder(cocycles.lifetimes()[k], c.lifetime)) continue;
      slot[k] = static_cast<std::int64_t>(counted.size());
      counted.push_back(k);
    }
    std::vector<std::int64_t> on_chain(counted.size(), 0), on_birth(counted.size(), 0);
    std::int64_t coefficient = 0;
    const auto add = [&](std::vector<std::int64_t>& sums, Key key, std::int64_t a) {
      for (const auto [k, value] : cocycles.on(key))
        if (slot[k] >= 0) {
          std::int64_t& sum = sums[static_cast<std::size_t>(slot[k])];
          sum = ((sum + a * std::int64_t{value}) % p + p) % p;
        }
    };
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Key key = key_of(chain.cell(i));
      if (key == c.lifetime.birth_key) coefficient = chain.coefficient(i);
      add(on_chain, key, chain.coefficient(i));
    }
    add(on_birth, c.lifetime.birth_key, 1);
    const std::int64_t inverse = inverse_of(coefficient);
    std::vector<std::uint32_t> target;
    for (std::size_t i = 0; i < counted.size(); ++i)
      target.push_back(
          static_cast<std::uint32_t>(((on_chain[i] * inverse - on_birth[i]) % p + p) % p));
    search.set_target(counted, target);
    return coefficient;
  }
  std::int64_t inverse_of(std::int64_t a) const {
    return with_field(options_.field, [&](const auto& field) {
      return field.to_int(field.inverse(field.from_int(static_cast<int>(a))));
    });
  }

  const RipsGraph& all_;
  const Barcode& cycles_;
  const Options& options_;
  const RunContext& context_;
  EarlyGraph graph_;
  Elders elders_;
};

}  // namespace

void measure_and_tighten(const RipsGraph& graph, const Barcode& cycles, const Options& options,
                         bool tighten, std::vector<BarLoops>& loops, const RunContext& context) {
  const std::optional<double> last = last_birth(cycles, loops);
  if (!last) return;
  try {
    Tightener tightener(graph, cycles, *last, options, context);
    for (BarLoops& of_bar : loops) tightener.measure(of_bar.loops);
    if (tighten) tightener.tighten(loops);
  } catch (const Error& error) {  // each bar has its old or its new loops, both of which are valid
    if (error.kind() != ErrorKind::resource) throw;
  } catch (const std::bad_alloc&) {
  }
}

}  // namespace ph::detail
