// SPDX-License-Identifier: MIT
#include "libph/src/loops/cover_search.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace ph::detail {

CoverSearch::CoverSearch(const EarlyGraph& graph, const EdgeCocycles& cocycles, std::int64_t field,
                         const RunContext& context)
    : graph_(graph),
      cocycles_(cocycles),
      p_(static_cast<std::uint64_t>(field)),
      context_(context),
      slot_(cocycles.lifetimes().size(), kNone, &context.memory),
      stamp_(graph.vertices(), 0, &context.memory),
      towards_(graph.vertices(), kNone, &context.memory),
      distance_(graph.vertices(), Distance{0, 0}, &context.memory) {}

void CoverSearch::set_target(std::span<const std::uint32_t> cocycles,
                             std::span<const std::uint32_t> values) {
  for (const std::uint32_t k : counted_) slot_[k] = kNone;
  counted_.assign(cocycles.begin(), cocycles.end());
  for (std::size_t i = 0; i < counted_.size(); ++i)
    slot_[counted_[i]] = static_cast<std::uint32_t>(i);
  target_.assign(values.begin(), values.end());
}

bool CoverSearch::add_step(Values& values, std::uint32_t from, std::uint32_t to,
                           EarlyGraph::Key key) const {
  bool changed = false;
  for (const auto [cocycle, value] : cocycles_.on(key)) {
    const std::uint32_t slot = slot_[cocycle];
    if (slot == kNone) continue;
    const std::uint64_t step = from < to ? value : p_ - value;  // mutant: loops-cocycle-sign
    values[slot] = static_cast<std::uint32_t>((values[slot] + step) % p_);
    changed = true;
  }
  return changed;
}

/// @return true if the budget was enough.
bool CoverSearch::measure_distances(std::uint32_t from, std::uint32_t to, const Around& around,
                                    double bound, StepBudget& budget) {
  using Entry = std::tuple<Distance, std::uint32_t>;
  std::priority_queue<Entry, std::pmr::vector<Entry>, std::greater<>> queue(
      std::greater<>(), std::pmr::vector<Entry>(&context_.memory));
  ++run_;
  const auto reach = [&](std::uint32_t v, const Distance& d, std::uint32_t towards) {
    if (is_near(v) && distance_[v] <= d) return;
    stamp_[v] = run_;
    distance_[v] = d;
    towards_[v] = towards;
    queue.push({d, v});
  };
  reach(to, {0, 0}, kNone);
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d.length >= bound) return true;
    if (v == from && target_.empty()) return true;
    if (distance_[v] < d) continue;
    bool goes_on = true;
    graph_.for_each_neighbour(v, around.limit, around.birth,
                              [&](std::uint32_t w, EarlyGraph::Key key) {
                                goes_on = budget.take();
                                reach(w, {d.length + graph_.value(key), d.steps + 1}, v);
                              });
    if (!goes_on) return false;
  }
  return true;
}

Verdict CoverSearch::find(std::uint32_t from, std::uint32_t to, const Around& around, double bound,
                          StepBudget& budget, Path& path) {
  if (!measure_distances(from, to, around, bound, budget)) return Verdict::gave_up;
  if (!is_near(from) || distance_[from].length >= bound) return Verdict::none;
  Values values(target_.size(), 0);
  path.assign(1, from);
  while (path.back() != to) {
    const std::uint32_t here = path.back(), next = towards_[here];
    if (!target_.empty()) add_step(values, here, next, *graph_.key_of(here, next));
    path.push_back(next);
  }
  if (values == target_) return Verdict::found;
  return search_cover(from, to, around, bound, budget, path);
}

Verdict CoverSearch::search_cover(std::uint32_t from, std::uint32_t to, const Around& around,
                                  double bound, StepBudget& budget, Path& path) {
  const std::size_t most = std::min(kMostStates, kMostNumbers / target_.size());
  const std::size_t bytes = most * (sizeof(State) + 64 + 4 * target_.size() + 96);
  if (bytes > context_.memory.left()) return Verdict::gave_up;
  const MemoryClaim claim(context_.memory, bytes);

  std::vector<State> states;
  std::unordered_map<std::uint64_t, std::uint32_t> state_at;
  std::map<Values, std::uint32_t> numbers;
  std::vector<const Values*> values_of;
  const auto number_of = [&](const Values& values) {
    const auto [it, is_new] =
        numbers.try_emplace(values, static_cast<std::uint32_t>(values_of.size()));
    if (is_new) values_of.push_back(&it->first);
    return it->second;
  };
  struct Entry {
    double estimate;  // lower bound for the length of a path through the state
    std::uint32_t steps, state;
    Distance from_start;
    bool operator>(const Entry& other) const {
      return std::tie(estimate, steps, state) > std::tie(other.estimate, other.steps, other.state);
    }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](std::uint32_t v, std::uint32_t values, const Distance& d,
                         std::uint32_t parent) {
    if (!is_near(v)) return;
    const double estimate = d.length + distance_[v].length;  // mutant: loops-estimate
    if (estimate >= bound) return;
    const auto [it, is_new] = state_at.try_emplace(std::uint64_t{values} << 32 | v,
                                                   static_cast<std::uint32_t>(states.size()));
    if (is_new) {
      states.push_back({v, values, parent, d, false});
    } else {
      State& state = states[it->second];
      if (state.is_settled || state.from_start <= d) return;
      state.from_start = d;
      state.parent = parent;
    }
    queue.push({estimate, d.steps, it->second, d});
  };
  const std::uint32_t wanted = number_of(target_);
  reach(from, number_of(Values(target_.size(), 0)), {0, 0}, kNone);
  Values values;
  while (!queue.empty()) {
    const Entry entry = queue.top();
    queue.pop();
    State& state = states[entry.state];
    if (state.is_settled || state.from_start < entry.from_start) continue;
    state.is_settled = true;
    const auto [vertex, values_here, parent, d, settled] = state;
    if (vertex == to && values_here == wanted) {  // mutant: loops-path
      path.clear();
      for (std::uint32_t s = entry.state; s != kNone; s = states[s].parent)
        path.push_back(states[s].vertex);
      std::ranges::reverse(path);
      return Verdict::found;
    }
    bool goes_on = true;
    graph_.for_each_neighbour(vertex, around.limit, around.birth,
                              [&](std::uint32_t w, EarlyGraph::Key key) {
                                goes_on = budget.take(1 + cocycles_.on(key).size());
                                values = *values_of[values_here];
                                const bool changed = add_step(values, vertex, w, key);
                                reach(w, changed ? number_of(values) : values_here,
                                      {d.length + graph_.value(key), d.steps + 1}, entry.state);
                              });
    if (!goes_on || states.size() > most || values_of.size() > most || queue.size() > 4 * most)
      return Verdict::gave_up;
  }
  return Verdict::none;
}

}  // namespace ph::detail
