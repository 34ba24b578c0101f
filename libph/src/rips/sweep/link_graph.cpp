// SPDX-License-Identifier: MIT
#include "libph/src/rips/sweep/link_graph.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "libph/src/core/for_each_target.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph {
namespace {

// The number of edges that a thread takes at a time. Fewer edges do not justify a thread.
constexpr std::size_t kPiece = 1 << 17;

// The neighbours of a vertex in a link of at most 64 vertices, as bits.
template <class Neighbour>
[[gnu::always_inline]] inline bits::Word find_word(std::span<const Neighbour> neighbours,
                                                   const std::uint32_t* local) {
  bits::Word word = 0;
  for (const Neighbour w : neighbours) {
    const std::uint32_t x = local[w];
    word |= bits::Word{x < 64} << (x % 64);
  }
  return word;
}
PH_FOR_EACH_TARGET
bits::Word word_of(std::span<const std::uint16_t> neighbours, const std::uint32_t* local) {
  return find_word(neighbours, local);
}
PH_FOR_EACH_TARGET
bits::Word word_of(std::span<const std::uint32_t> neighbours, const std::uint32_t* local) {
  return find_word(neighbours, local);
}

template <class Vertex>
NeighbourLists<Vertex> lists_if(bool wanted, std::size_t vertices, const BinnedEdges& edges,
                                std::pmr::memory_resource* memory) {
  return wanted ? NeighbourLists<Vertex>(vertices, edges, memory) : NeighbourLists<Vertex>(memory);
}

}  // namespace

LinkGraph::LinkGraph(const ActiveEdges& active, const BinnedEdges& edges, LinkLayout layout,
                     std::pmr::memory_resource* memory)
    : active_(active),
      layout_(layout),
      joined_(layout == LinkLayout::rows ? active.vertex_count() : 0, active.vertex_count(),
              memory),
      landmark_(memory),
      landmarks_at_(memory),
      short_lists_(lists_if<std::uint16_t>(
          layout == LinkLayout::lists && active.vertex_count() <= kMostShort, active.vertex_count(),
          edges, memory)),
      lists_(lists_if<Vertex>(layout == LinkLayout::lists && active.vertex_count() > kMostShort,
                              active.vertex_count(), edges, memory)),
      marks_(memory),
      words_(layout == LinkLayout::rows ? joined_.words() : 0),
      link_(words_, 0, memory),
      vertices_(memory),
      local_(memory),
      local_rows_(memory),
      is_row_made_(memory) {
  if (layout == LinkLayout::rows) {
    landmark_.resize(vertex_count(), 0);
    landmarks_at_.resize(vertex_count(), 0);
    const std::size_t step = (vertex_count() + 63) / 64;
    for (std::size_t k = 0; k * step < vertex_count(); ++k) landmark_[k * step] = Word{1} << k;
    return;
  }
  marks_.resize(vertex_count(), 0);
  local_.resize(vertex_count(), kNone);
}

LinkLayout LinkGraph::choose_layout(std::size_t vertices, std::size_t edges) {
  // Measurements show that rows are faster if the average degree is at least n / 128. Rows then
  // take at most about twice the memory of the edges.
  const auto n = static_cast<double>(vertices), m = static_cast<double>(edges);
  return 2 * m * 128 >= n * n ? LinkLayout::rows : LinkLayout::lists;
}

double LinkGraph::bytes(std::size_t vertices, std::size_t edges) {
  const auto n = static_cast<double>(vertices), m = static_cast<double>(edges);
  if (choose_layout(vertices, edges) == LinkLayout::rows) return n * n / 8;
  const double number = vertices <= kMostShort ? sizeof(std::uint16_t) : sizeof(Vertex);
  return 2 * number * m + (sizeof(std::size_t) + 3 * sizeof(Vertex)) * n;
}

void LinkGraph::add(const FlagEdge& e) {
  if (layout_ == LinkLayout::rows) {
    add_to_row(e.u, e.v);
    add_to_row(e.v, e.u);
  } else if (vertex_count() <= kMostShort) {
    short_lists_.add(e);
  } else {
    lists_.add(e);
  }
}

void LinkGraph::add_all(std::span<const FlagEdge> edges, const RunContext& context) {
  const std::size_t threads = thread_count(context);
  if (layout_ == LinkLayout::lists || threads == 1 || edges.size() <= kPiece) {
    for (const FlagEdge& e : edges) add(e);
    return;
  }
  // Each thread writes to its own rows.
  for_each_piece("edges", threads, 1, context, [&](std::size_t own, std::size_t) {
    for (const FlagEdge& e : edges) {
      if (e.u % threads == own) add_to_row(e.u, e.v);
      if (e.v % threads == own) add_to_row(e.v, e.u);
    }
  });
}

bool LinkGraph::has_link_anywhere(Vertex u, Vertex v) const {
  if (layout_ == LinkLayout::rows) return bits::any_common(joined_.row(u), joined_.row(v), words_);
  return with_lists([&](const auto& lists) {
    const auto a = lists[u], b = lists[v];
    auto i = a.begin(), j = b.begin();
    while (i != a.end() && j != b.end()) {
      if (*i == *j) return true;
      *i < *j ? ++i : ++j;
    }
    return false;
  });
}

bool LinkGraph::have_links(std::span<const FlagEdge> edges, const RunContext& context) const {
  std::atomic<bool> all = true;
  for_each_piece("edges", edges.size(), kPiece, context, [&](std::size_t begin, std::size_t end) {
    if (!all.load(std::memory_order_relaxed)) return;
    const auto piece = edges.subspan(begin, end - begin);
    if (!std::ranges::all_of(piece, [&](const FlagEdge& e) { return has_link(e.u, e.v); }))
      all.store(false, std::memory_order_relaxed);
  });
  return all;
}

LinkGraph::Link LinkGraph::find_link(const FlagEdge& e, bool wants_graph) {
  return layout_ == LinkLayout::rows ? find_link_in_rows(e, wants_graph)
                                     : find_link_in_lists(e, wants_graph);
}

template <class InLink>
bool LinkGraph::touches_active(const FlagEdge& e, InLink&& in_link) const {
  // mutant: active-ends
  return std::ranges::any_of(active_.neighbours(e.u), [&](Vertex w) { return in_link(e.v, w); }) ||
         std::ranges::any_of(active_.neighbours(e.v), [&](Vertex w) { return in_link(e.u, w); });
}

bool LinkGraph::touches_active_in_rows(const FlagEdge& e) const {
  if (active_.degree(e.u) + active_.degree(e.v) == 0) return false;
  if (!active_.has_rows())
    return touches_active(e, [&](Vertex v, Vertex w) { return joined_.test(v, w); });
  const auto sees = [&](Vertex u, Vertex v) {
    return active_.degree(u) != 0 && bits::any_common(active_.row(u), joined_.row(v), words_);
  };
  return sees(e.u, e.v) || sees(e.v, e.u);
}

LinkGraph::Link LinkGraph::find_link_in_rows(const FlagEdge& e, bool wants_graph) {
  const bool touches = touches_active_in_rows(e);
  // If nothing can happen, it is enough to know whether there is any common neighbour.
  if (!touches && !wants_graph) return {!has_link(e.u, e.v), false};
  return {!bits::intersect(joined_.row(e.u), joined_.row(e.v), link_.data(), words_), touches};
}

LinkGraph::Link LinkGraph::find_link_in_lists(const FlagEdge& e, bool wants_graph) {
  for (const Vertex v : vertices_) local_[v] = kNone;
  // Marks need three passes but no branches. Merging two sorted lists would need branches that
  // cannot be predicted.
  constexpr std::uint8_t of_one = 1, of_both = 2;
  std::size_t count = 0;
  const bool touches = with_lists([&](const auto& lists) {
    auto few = lists[e.u], many = lists[e.v];
    if (many.size() < few.size()) std::swap(few, many);
    // A vertex with many neighbours also has many edges. Reading all its neighbours for each of its
    // edges would take too long.
    constexpr std::size_t times = 32;
    const bool is_hub = many.size() / times > few.size();
    vertices_.resize(few.size() + 1);
    if (is_hub) {
      for (const Vertex w : few) {
        if (!std::ranges::binary_search(many, w)) continue;  // mutant: hub-neighbours
        vertices_[count++] = w;
        marks_[w] = of_both;
      }
    } else {
      for (const Vertex w : few) marks_[w] = of_one;
      for (const Vertex w : many) {
        vertices_[count] = w;
        count += marks_[w];
        marks_[w] *= of_both;
      }
    }
    // mutant: active-of-both
    const bool found = touches_active(e, [&](Vertex, Vertex w) { return marks_[w] == of_both; });
    for (const Vertex w : few) marks_[w] = 0;
    return found;
  });
  vertices_.resize(count);
  if (touches || wants_graph) number_link();
  return {count == 0, touches};
}

void LinkGraph::number_link() {
  const std::size_t count = vertices_.size();
  words_ = (count + 63) / 64;
  link_.assign(words_, ~Word{0});
  if (count % 64 != 0) link_.back() = ~Word{0} >> (64 - count % 64);
  is_row_made_.assign(count, 0);
  local_rows_.resize(count * words_);
  for (std::size_t k = 0; k < count; ++k) local_[vertices_[k]] = static_cast<Vertex>(k);
}

void LinkGraph::make_row(Vertex v) {
  is_row_made_[v] = 1;
  Word* row = local_rows_.data() + v * words_;
  std::fill_n(row, words_, Word{0});
  with_lists([&](const auto& lists) {
    const auto list = lists[vertices_[v]];
    if (words_ == 1)
      *row = word_of(list, local_.data());
    else
      for (const Vertex w : list)
        if (const Vertex x = local_[w]; x != kNone) row[x / 64] |= Word{1} << (x % 64);
  });
}

}  // namespace ph
