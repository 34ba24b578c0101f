// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/sweep/active_edges.hpp"
#include "libph/src/rips/sweep/neighbour_lists.hpp"
#include "ph/detail/core/bit_matrix.hpp"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/rips/binned_edges.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// How a sweep of edge links stores the edges so far.
enum class LinkLayout {
  automatic,  ///< the fastest layout that is affordable
  rows,       ///< two bits per pair of vertices, one bit for each order
  lists,      ///< the neighbours of each vertex, with two or four bytes per end of an edge
};

/// Stores the edges of a flag filtration that have entered so far, and the link of a new edge. The
/// link consists of the common neighbours of the two ends of the edge. The graph on the link is
/// stored as rows of bits. In that graph, vertices have local numbers, in the same order as their
/// global numbers. With the layout `lists`, the vertices of the link are numbered 0, 1, …, and a
/// row usually takes one or two words. With the layout `rows`, local and global numbers are the
/// same, and nothing is copied.
class LinkGraph {
 public:
  using Vertex = std::uint32_t;
  using Word = bits::Word;
  static constexpr Vertex kNone = UINT32_MAX;

  /// @param active the active edges among the edges so far. It must outlive this object. With the
  /// layout `lists`, it must have no rows. @param edges all edges that may be added. @param layout
  /// rows or lists.
  LinkGraph(const ActiveEdges& active, const BinnedEdges& edges, LinkLayout layout,
            std::pmr::memory_resource* memory);

  /// The fastest affordable layout.
  static LinkLayout choose_layout(std::size_t vertices, std::size_t edges);
  /// The approximate number of bytes that a graph occupies once all edges are added.
  static double bytes(std::size_t vertices, std::size_t edges);

  std::size_t vertex_count() const { return active_.vertex_count(); }
  void add(const FlagEdge& e);
  /// Adds many edges, on several threads.
  void add_all(std::span<const FlagEdge> edges, const RunContext& context);

  /// Calls `visit(w)` for each neighbour in a set. @param set one bit per vertex; `visit` may
  /// remove vertices from the set.
  template <class Visit>
  void for_each_neighbour(Vertex v, const Word* set, Visit&& visit) const {
    if (layout_ == LinkLayout::lists) {
      with_lists([&](const auto& lists) {
        for (const Vertex w : lists[v])
          if ((set[w / 64] >> (w % 64) & 1) != 0) visit(w);
      });
      return;
    }
    const Word* row = joined_.row(v);
    for (std::size_t k = 0; k < joined_.words(); ++k)
      for (Word rest = row[k] & set[k]; rest != 0; rest &= rest - 1)
        visit(static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(rest))));
  }
  /// True if two vertices have a common neighbour.
  bool has_link(Vertex u, Vertex v) const {
    return (layout_ == LinkLayout::rows && (landmarks_at_[u] & landmarks_at_[v]) != 0) ||
           has_link_anywhere(u, v);
  }
  /// True if the ends of each of the edges have a common neighbour. Uses several threads.
  bool have_links(std::span<const FlagEdge> edges, const RunContext& context) const;
  struct Link {
    bool is_empty;
    bool touches_active;
  };
  /// Examines the link of an edge that is not present yet. Finds out whether the link is empty, and
  /// whether an active edge joins it to an end of the edge. If active edges touch the link or
  /// `wants_graph` is set, the members below refer to this link.
  Link find_link(const FlagEdge& e, bool wants_graph);

  std::size_t words() const { return words_; }  ///< words per row
  const Word* link() const { return link_.data(); }
  /// The neighbours of a vertex of the link, possibly including vertices outside it.
  const Word* row(Vertex v) {
    if (keeps_numbers()) return joined_.row(v);
    if (!is_row_made_[v]) make_row(v);
    return local_rows_.data() + v * words_;
  }
  /// True if vertices have the same numbers in the link as in the graph.
  bool keeps_numbers() const { return layout_ == LinkLayout::rows; }
  /// Converts the number of a vertex in the link to its global number.
  Vertex global(Vertex v) const { return keeps_numbers() ? v : vertices_[v]; }
  /// Converts a global number to the number in the link. Returns kNone if the vertex is not in the
  /// link.
  Vertex local(Vertex v) const {
    if (!keeps_numbers()) return local_[v];
    return link_[v / 64] >> (v % 64) & 1 ? v : kNone;
  }
  /// The smallest vertex of the link.
  Vertex first() const { return static_cast<Vertex>(bits::first_common(link(), link(), words_)); }

 private:
  static constexpr std::size_t kMostShort = std::size_t{UINT16_MAX} + 1;  // vertices
  template <class Use>
  decltype(auto) with_lists(Use&& use) const {
    return vertex_count() <= kMostShort ? use(short_lists_) : use(lists_);
  }
  void add_to_row(Vertex u, Vertex v) {
    joined_.set(u, v);
    landmarks_at_[u] |= landmark_[v];
  }
  bool has_link_anywhere(Vertex u, Vertex v) const;
  Link find_link_in_rows(const FlagEdge& e, bool wants_graph);
  Link find_link_in_lists(const FlagEdge& e, bool wants_graph);
  /// True if `in_link(v, w)` is true for an active edge uw, or `in_link(u, w)` is true for an
  /// active edge vw.
  template <class InLink>
  bool touches_active(const FlagEdge& e, InLink&& in_link) const;
  bool touches_active_in_rows(const FlagEdge& e) const;
  void number_link();
  void make_row(Vertex v);

  const ActiveEdges& active_;
  LinkLayout layout_;
  // The following members are used with rows.
  BitMatrix joined_;
  // Landmarks are up to 64 vertices that are spread over the graph, because most links then contain
  // one of them. For each vertex, these members have the bit of the vertex itself if it is a
  // landmark, and the bits of the landmarks among its neighbours.
  std::pmr::vector<Word> landmark_, landmarks_at_;
  // The following members are used with lists. The first is used if 16-bit numbers are enough.
  NeighbourLists<std::uint16_t> short_lists_;
  NeighbourLists<Vertex> lists_;
  std::pmr::vector<std::uint8_t> marks_;  // 0 for each vertex between uses
  // The following members describe the link.
  std::size_t words_;
  std::pmr::vector<Word> link_;
  std::pmr::vector<Vertex> vertices_;  // global number of each vertex of the link
  std::pmr::vector<Vertex> local_;     // number in the link of each vertex; kNone outside the link
  std::pmr::vector<Word> local_rows_;
  std::pmr::vector<std::uint8_t> is_row_made_;
};

}  // namespace ph
