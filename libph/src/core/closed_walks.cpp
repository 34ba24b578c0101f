// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory_resource>
#include <numeric>
#include <utility>

#include "ph/detail/core/field.hpp"
#include "ph/detail/core/loop.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

[[noreturn]] void fail(std::string_view found, std::string_view expected) {
  throw Error(ErrorKind::usage, fmt::format("chain: found {}, expected {}", found, expected));
}

/// Appends the numbers that name the start of an edge, then the numbers that name its end.
void append_ends(const InputCell& edge, std::span<const Index> periods,
                 std::pmr::vector<Index>& ends) {
  const std::span<const Index> numbers = edge.numbers;
  if (edge.kind == CellKind::row) fail("rows of a boundary matrix", "edges with their vertices");
  if (edge.kind == CellKind::vertices) {
    if (numbers.size() != 2) fail(fmt::format("{} vertices in a cell", numbers.size()), "2");
    ends.insert(ends.end(), numbers.begin(), numbers.end());
    return;
  }
  const auto is_odd = [](Index x) { return x % 2 != 0; };
  if (std::ranges::count_if(numbers, is_odd) != 1)
    fail("a cube that is not an edge", "edges of the grid");
  const auto axis =
      static_cast<std::size_t>(std::ranges::find_if(numbers, is_odd) - numbers.begin());
  for (const Index step : {-1, 1}) {
    const std::size_t begin = ends.size();
    ends.insert(ends.end(), numbers.begin(), numbers.end());
    Index& x = ends[begin + axis];
    x += step;
    if (axis < periods.size() && x == periods[axis]) x = 0;  // mutant: walk-period
  }
}

/// A chain of edges between vertices 0, 1, … Closed walks are removed from the chain until nothing
/// is left.
class Decomposition {
 public:
  Decomposition(const InputChain& chain, std::int64_t field, std::span<const Index> periods,
                const RunContext& context)
      : p_(field),
        size_(chain.size()),
        ticker_(context, {}),
        numbers_(&context.memory),
        first_of_(&context.memory),
        tail_(&context.memory),
        head_(&context.memory),
        left_(&context.memory),
        offsets_(&context.memory),
        arcs_(&context.memory),
        next_(&context.memory),
        place_(&context.memory),
        path_(&context.memory) {
    if (size_ == 0) return;
    for (std::size_t i = 0; i < size_; ++i) append_ends(chain.cell(i), periods, numbers_);
    arity_ = numbers_.size() / (2 * size_);
    number_vertices(context);
    left_.reserve(size_);
    for (std::size_t i = 0; i < size_; ++i) left_.push_back(modulo(chain.coefficient(i)));
    check_closed(context);
    sort_arcs();
  }

  std::vector<Loop> take_apart() {
    for (std::uint32_t v = 0; v < vertices(); ++v) walk_from(v);
    std::ranges::sort(found_, [](const Walk& a, const Walk& b) {
      if (a.vertices.size() != b.vertices.size()) return a.vertices.size() > b.vertices.size();
      return std::tie(a.vertices, a.coefficient) < std::tie(b.vertices, b.coefficient);
    });
    std::vector<Loop> loops;
    loops.reserve(found_.size());
    for (Walk& walk : found_) {
      Loop& loop = loops.emplace_back();
      loop.coefficient = walk.coefficient;
      loop.numbers.reserve(walk.vertices.size() * arity_);
      for (const std::uint32_t v : walk.vertices) {
        const auto tuple = tuple_of(first_of_[v]);
        loop.numbers.insert(loop.numbers.end(), tuple.begin(), tuple.end());
      }
      walk.vertices = {};
    }
    return loops;
  }

 private:
  struct Arc {
    std::uint32_t to, edge;
  };
  struct Step {
    std::uint32_t from, edge;
  };
  struct Walk {
    std::vector<std::uint32_t> vertices;
    std::int64_t coefficient;
  };
  static constexpr std::uint32_t kNowhere = UINT32_MAX;

  std::int64_t modulo(std::int64_t a) const { return (a % p_ + p_) % p_; }
  std::size_t vertices() const { return first_of_.size(); }
  std::span<const Index> tuple_of(std::size_t end) const {
    return std::span<const Index>(numbers_).subspan(end * arity_, arity_);
  }
  /// The coefficient of an edge when it is traversed from the vertex `from`.
  std::int64_t directed(std::uint32_t edge, std::uint32_t from) const {
    return tail_[edge] == from ? left_[edge] : modulo(-left_[edge]);
  }

  /// Numbers the vertices in the order of their coordinates.
  void number_vertices(const RunContext& context) {
    std::pmr::vector<std::uint32_t> order(2 * size_, &context.memory);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      ticker_.work();
      return std::ranges::lexicographical_compare(tuple_of(a), tuple_of(b));
    });
    tail_.resize(size_);
    head_.resize(size_);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::uint32_t end = order[i];
      if (i == 0 || !std::ranges::equal(tuple_of(end), tuple_of(order[i - 1])))
        first_of_.push_back(end);
      (end % 2 == 0 ? tail_ : head_)[end / 2] = static_cast<std::uint32_t>(vertices() - 1);
    }
  }

  void check_closed(const RunContext& context) {
    std::pmr::vector<std::int64_t> boundary(vertices(), 0, &context.memory);
    for (std::size_t i = 0; i < size_; ++i) {
      boundary[head_[i]] = modulo(boundary[head_[i]] + left_[i]);
      boundary[tail_[i]] = modulo(boundary[tail_[i]] - left_[i]);
    }
    if (std::ranges::any_of(boundary, [](std::int64_t a) { return a != 0; }))
      fail("a boundary that is not zero", fmt::format("a cycle over Z/{}", p_));
  }

  /// Sorts the edges at each vertex by their other ends.
  void sort_arcs() {
    offsets_.assign(vertices() + 1, 0);
    for (std::size_t i = 0; i < size_; ++i) {
      ++offsets_[tail_[i] + 1];
      if (tail_[i] != head_[i]) ++offsets_[head_[i] + 1];
    }
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    next_.assign(offsets_.begin(), offsets_.end() - 1);
    arcs_.resize(offsets_.back());
    for (std::uint32_t i = 0; i < size_; ++i) {
      arcs_[next_[tail_[i]]++] = {head_[i], i};
      if (tail_[i] != head_[i]) arcs_[next_[head_[i]]++] = {tail_[i], i};
    }
    for (std::size_t v = 0; v < vertices(); ++v) {
      next_[v] = offsets_[v];
      std::sort(arcs_.begin() + static_cast<std::ptrdiff_t>(offsets_[v]),
                arcs_.begin() + static_cast<std::ptrdiff_t>(offsets_[v + 1]),
                [](const Arc& a, const Arc& b) {
                  return std::tie(a.to, a.edge) < std::tie(b.to, b.edge);
                });
    }
    place_.assign(vertices(), kNowhere);
  }

  /// The edge by which a path leaves the vertex `from`. It differs from `came_by`, the edge by
  /// which the path arrived. Edges with coefficient `wanted` are preferred, because using them
  /// removes much of the chain at once.
  const Arc* way_on(std::uint32_t from, std::uint32_t came_by, std::int64_t wanted) {
    std::size_t& first = next_[from];
    while (first < offsets_[from + 1] && left_[arcs_[first].edge] == 0) ++first;
    const Arc* any = nullptr;
    for (std::size_t i = first; i < offsets_[from + 1]; ++i) {
      ticker_.work();
      const Arc& arc = arcs_[i];
      if (left_[arc.edge] == 0 || arc.edge == came_by) continue;
      if (wanted == 0 || directed(arc.edge, from) == wanted) return &arc;
      if (!any) any = &arc;
    }
    return any;
  }

  /// Removes closed walks until a vertex has no edge left. Walks that are met on the way are
  /// removed as well. The rest of the chain is a cycle. Each vertex on a path therefore has another
  /// edge, and the path gets stuck only at its start.
  void walk_from(std::uint32_t start) {
    path_.clear();
    place_[start] = 0;
    for (std::uint32_t here = start, came_by = kNowhere;;) {
      const std::int64_t wanted =
          path_.empty() ? 0 : directed(path_.front().edge, path_.front().from);
      const Arc* arc = way_on(here, came_by, wanted);
      if (!arc) break;  // the path is back at its start, where no edge is left
      path_.push_back({here, arc->edge});
      if (place_[arc->to] == kNowhere) {
        here = arc->to;
        came_by = arc->edge;
        place_[here] = static_cast<std::uint32_t>(path_.size());
        continue;
      }
      here = arc->to;
      cut_off(place_[here]);
      came_by = path_.empty() ? kNowhere : path_.back().edge;
    }
    place_[start] = kNowhere;
  }

  /// Moves the closed walk at the end of the path to the list of walks. The walk gets the
  /// coefficient of its first edge.
  void cut_off(std::size_t begin) {
    const std::int64_t a = directed(path_[begin].edge, path_[begin].from);
    Walk walk{{}, a};
    for (std::size_t i = begin; i < path_.size(); ++i) {
      const auto [from, edge] = path_[i];
      walk.vertices.push_back(from);
      left_[edge] = modulo(left_[edge] + (tail_[edge] == from ? -a : a));
      if (i > begin) place_[from] = kNowhere;
    }
    path_.resize(begin);
    auto& v = walk.vertices;
    std::ranges::rotate(v, std::ranges::min_element(v));
    const bool turns = p_ == 2 ? v.size() > 2 && v[1] > v.back() : a > p_ / 2;
    if (turns) std::reverse(v.begin() + 1, v.end());
    if (p_ > 2 && turns) walk.coefficient = p_ - a;  // mutant: walk-turns
    found_.push_back(std::move(walk));
  }

  std::int64_t p_;
  std::size_t size_, arity_ = 1;
  Ticker ticker_;
  std::pmr::vector<Index> numbers_;  // the numbers that name the start and the end of each edge
  std::pmr::vector<std::uint32_t> first_of_;  // for each vertex, one of the edge ends at the vertex
  std::pmr::vector<std::uint32_t> tail_, head_;
  std::pmr::vector<std::int64_t> left_;  // remaining coefficient of each edge, from 0 to p - 1
  std::pmr::vector<std::size_t> offsets_;
  std::pmr::vector<Arc> arcs_;
  // For each vertex, its first arc whose edge may have a nonzero coefficient.
  std::pmr::vector<std::size_t> next_;
  std::pmr::vector<std::uint32_t> place_;  // for each vertex, its position on the path
  std::pmr::vector<Step> path_;
  std::vector<Walk> found_;
};

}  // namespace

std::size_t bytes_of(std::span<const BarLoops> loops) {
  std::size_t bytes = loops.size_bytes();
  for (const BarLoops& of_bar : loops)
    for (const Loop& loop : of_bar.loops)
      bytes += sizeof(Loop) + loop.numbers.capacity() * sizeof(Index);
  return bytes;
}

std::vector<Loop> closed_walks(const InputChain& cycle, std::int64_t field,
                               std::span<const Index> periods, const RunContext& context) {
  if (!is_field_characteristic(field))
    throw Error(ErrorKind::usage,
                fmt::format("field: found {}, expected a prime below 2^31", field));
  return Decomposition(cycle, field, periods, context).take_apart();
}

}  // namespace ph
