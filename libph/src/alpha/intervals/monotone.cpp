// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <mutex>

#include "libph/src/alpha/intervals/frames.hpp"
#include "libph/src/alpha/intervals/marks.hpp"
#include "libph/src/alpha/intervals/spheres.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// Repairs the values in dimensions 1 and 2, where there are few enough simplices to check all of
/// them in each pass.
class PlaneRepair {
 public:
  PlaneRepair(AlphaCells& cells, const RunContext& context) : cells_(cells), context_(context) {}

  void run() {
    do {
      is_changed_ = false;
      context_.poll();
      if (cells_.dim() == 1)
        look_at_edges();
      else
        look_at_triangles();  // mutant: alpha-repair-plane
    } while (is_changed_);
  }

 private:
  void raise(double& value, double to) {
    if (!(value < to)) return;
    value = to;
    is_changed_ = true;
  }
  void look_at_edges() {
    for (std::size_t t = 0; t < cells_.triangulation.size() && cells_.sites.is_weighted(); ++t) {
      const auto& ends = cells_.triangulation.cells[t];
      double& value = cells_.cell_values[t];
      for (unsigned k = 0; k < 2; ++k) raise(value, cells_.vertex_values[ends[k]]);
      if (const unsigned beyond = cells_.beyond[t]; beyond != 0)
        raise(cells_.vertex_values[ends[beyond == 1 ? 1 : 0]], value);
    }
  }
  void look_at_triangles() {
    auto critical = cells_.facets.begin();
    for (std::size_t t = 0; t < cells_.triangulation.size(); ++t)
      for (uint32_t k = 0; k < 3; ++k) {
        const auto code = static_cast<uint32_t>(4 * t) + k;
        const uint32_t other = cells_.triangulation.across[t][k];
        if (other != kNone && other < code) continue;
        const bool is_critical = critical != cells_.facets.end() && critical->code == code;
        look_at_edge(code, other, is_critical ? &(critical++)->value : nullptr);
      }
  }
  void look_at_edge(uint32_t code, uint32_t other, double* critical) {
    const uint32_t owner = cells_.belongs_to(code)                      ? code
                           : other != kNone && cells_.belongs_to(other) ? other
                                                                        : kNone;
    const auto ends = cells_.facet_vertices(code);
    double* value = owner != kNone ? &cells_.cell_values[owner >> 2] : critical;
    if (value == nullptr)  // a vertex enters with the edge
      for (unsigned k = 0; k < 2 && value == nullptr; ++k)
        if (cells_.vertex_up[ends[k]] == ends[1 - k]) value = &cells_.vertex_values[ends[k]];
    if (cells_.sites.is_weighted())
      for (unsigned k = 0; k < 2; ++k) raise(*value, cells_.vertex_values[ends[k]]);
    const double least = *value;
    for (const uint32_t name : {code, other})
      if (name != kNone) raise_triangle(name >> 2, least);
    if (owner != kNone && cells_.sites.is_weighted()) raise_triangle(owner >> 2, least);
  }
  void raise_triangle(std::size_t t, double to) {
    raise(cells_.cell_values[t], to);
    const unsigned beyond = cells_.beyond[t];
    if (std::popcount(beyond) < 2) return;
    const uint32_t vertex = cells_.triangulation.cells[t][lowest(0b111U & ~beyond)];
    raise(cells_.vertex_values[vertex], cells_.cell_values[t]);
  }

  AlphaCells& cells_;
  const RunContext& context_;
  bool is_changed_ = false;
};

/// Repairs the values in dimension 3, where only the cofaces of a raised interval are checked
/// again.
class SpaceRepair {
 public:
  SpaceRepair(AlphaCells& cells, const Frames& frames, const RunContext& context)
      : cells_(cells),
        frames_(frames),
        context_(context),
        spheres_(frames.places()),
        raised_(&context.memory) {}

  void run() {
    do {
      is_vertex_raised_ = false;
      if (cells_.sites.is_weighted()) look_at_vertices();  // mutant: alpha-repair-vertices
      // mutant: alpha-repair
      for (const uint32_t code : facets_out_of_order()) look_at_facet(code);
      follow();
    } while (is_vertex_raised_);
  }

 private:
  /// An interval as seen from a cell that contains it: `upper` has a bit for the position of each
  /// vertex of the upper end, and `beyond` has a bit for each of these vertices that the lower end
  /// lacks.
  struct Interval {
    uint32_t cell;
    unsigned upper, beyond;
  };

  uint32_t edge_at(std::size_t cell, unsigned places) const {
    const unsigned i = lowest(places), k = lowest(places & (places - 1));
    return cells_.edge_between(cell, i, k);
  }
  static unsigned facet_places(uint32_t code) { return 0b1111U & ~(1U << (code & 3)); }
  uint32_t across(uint32_t code) const { return cells_.across(code); }

  double facet_value(uint32_t code) const { return alpha::facet_value(cells_, code); }

  /// The facets whose value is smaller than the value of one of their edges, or larger than the
  /// value of an adjacent cell. Edges are compared only with facets that do not lie in the interval
  /// of a cell. This comparison is enough for the following reason. Let facet f lie in the interval
  /// of cell t, let e be an edge of f, and let g be the other facet of t at e. If g also lies in
  /// the interval of t, then e lies in this interval, and e has the value of f. Otherwise f has the
  /// value of t, which is at least the value of g. In that case it is enough that the value of e
  /// does not exceed the value of g, and the same argument applies to g. Repeating the argument
  /// leads around e from facet to facet. The repetition ends, because radii fall strictly from f to
  /// g.
  std::vector<uint32_t> facets_out_of_order() const {
    std::mutex mutex;
    std::vector<uint32_t> found;
    for_each_piece("order of values", cells_.triangulation.size(), FacetPieces::kPiece, context_,
                   [&](std::size_t from, std::size_t to) {
                     auto next = std::ranges::lower_bound(
                         cells_.facets, static_cast<uint32_t>(4 * from), {}, &CriticalFacet::code);
                     for (std::size_t t = from; t < to; ++t)
                       for (uint32_t k = 0; k < 4; ++k) {
                         const auto code = static_cast<uint32_t>(4 * t) + k;
                         const uint32_t other = cells_.triangulation.across[t][k];
                         if (other != kNone && other < code) continue;
                         const bool is_critical = next != cells_.facets.end() && next->code == code;
                         if (is_ordered(code, other, is_critical ? &*next++ : nullptr)) continue;
                         const std::lock_guard lock(mutex);
                         found.push_back(code);
                       }
                   });
    return found;
  }
  bool is_ordered(uint32_t code, uint32_t other, const CriticalFacet* critical) const {
    const double here = cells_.cell_values[code >> 2];
    const double there =
        other != kNone ? cells_.cell_values[other >> 2] : std::numeric_limits<double>::infinity();
    if (cells_.belongs_to(code)) return here <= there;
    if (other != kNone && cells_.belongs_to(other)) return there <= here;
    const double value = alpha::facet_value(cells_, code, critical);
    return value <= here && value <= there &&
           std::ranges::all_of(cells_.facet_edges(code),
                               [&](uint32_t e) { return cells_.edge_states[e].value <= value; });
  }

  void look_at_vertices() {
    for (uint32_t t = 0; t < cells_.triangulation.size(); ++t)
      for (const auto& ends : kEdgeEnds) {
        const unsigned places = 1U << ends[0] | 1U << ends[1];
        for (const unsigned k : ends) {
          const double value = cells_.vertex_values[cells_.triangulation.cells[t][k]];
          if (cells_.edge_states[edge_at(t, places)].value < value) raise_edge(t, places, value);
        }
      }
  }
  /// Raises a facet to the values of its edges, and its cofaces to the value of the facet.
  void look_at_facet(uint32_t code) {
    const auto& places = kFacetPlaces[code & 3];
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned edge = 1U << places[i] | 1U << places[(i + 1) % 3];
      const double value = cells_.edge_states[edge_at(code >> 2, edge)].value;
      if (facet_value(code) < value) raise_facet(code, value);
    }
    look_above_facet(code);
  }
  void look_above_facet(uint32_t code) {
    const double value = facet_value(code);
    for (const uint32_t name : {code, across(code)})
      if (name != kNone && cells_.cell_values[name >> 2] < value)
        raise({name >> 2, 0b1111, cells_.beyond[name >> 2]}, value);
  }
  /// Raises all facets at an edge to the value of the edge. @param places the positions of the
  /// edge's ends in `cell`, one of the cells around it.
  void look_above_edge(uint32_t cell, unsigned places) {
    const double value = cells_.edge_states[edge_at(cell, places)].value;
    const unsigned opposite = 0b1111U & ~places;
    const std::array<unsigned, 2> sides{lowest(opposite), lowest(opposite & (opposite - 1))};
    for (const unsigned side : sides) {
      uint32_t code = 4 * cell + side;
      unsigned edge = places;
      for (;;) {
        if (facet_value(code) < value) raise_facet(code, value);
        const uint32_t other = across(code);
        if (other == kNone || other >> 2 == cell) break;
        // Finds the edge in the next cell, which has the vertices of the shared facet in the same
        // order.
        unsigned there = 0;
        for (unsigned i = 0; i < 3; ++i)
          if ((edge >> kFacetPlaces[code & 3][i] & 1) != 0)
            there |= 1U << kFacetPlaces[other & 3][i];
        edge = there;
        const unsigned last = 0b1111U & ~edge & ~(1U << (other & 3));
        code = (other & ~3U) + lowest(last);
      }
    }
  }

  void raise_edge(uint32_t cell, unsigned places, double value) {
    const uint32_t e = edge_at(cell, places);
    const uint32_t up = cells_.edge_states[e].up;
    if (up == kCritical) return raise({cell, places, 0}, value);
    if (up != kJoins) return raise_facet(up, value);
    for (unsigned left = places; left != 0; left &= left - 1) {
      const uint32_t v = cells_.triangulation.cells[cell][lowest(left)];
      if (cells_.vertex_up[v] != e) continue;
      const uint32_t facet = cells_.vertex_facet[v];
      if (facet != kNone) return raise_facet(facet, value);
      return raise({cell, places, places & ~(1U << lowest(left))}, value);
    }
  }
  void raise_facet(uint32_t code, double value) {
    for (const uint32_t name : {code, across(code)})
      if (name != kNone && cells_.belongs_to(name))
        return raise({name >> 2, 0b1111, cells_.beyond[name >> 2]}, value);
    const auto at = frames_.of_facet(code);
    const unsigned beyond = spheres_.beyond_triangle(at[0], at[1], at[2]);
    unsigned places = 0;
    for (unsigned i = 0; i < 3; ++i)
      if ((beyond >> i & 1) != 0) places |= 1U << kFacetPlaces[code & 3][i];
    raise({code >> 2, facet_places(code), places}, value);
  }
  template <class Use>
  static void for_each_member(const Interval& interval, Use&& use) {
    // Visits all sets of vertices that may be added to the lower end.
    for (unsigned added = interval.beyond;; added = (added - 1) & interval.beyond) {
      use((interval.upper & ~interval.beyond) | added);
      if (added == 0) return;
    }
  }
  void raise(const Interval& interval, double value) {
    for_each_member(interval, [&](unsigned places) {
      const int size = std::popcount(places);
      if (size == 4) cells_.cell_values[interval.cell] = value;
      if (size == 3 && places == interval.upper && interval.beyond == 0)
        set_critical(4 * interval.cell + lowest(0b1111U & ~places), value);
      if (size == 2) cells_.edge_states[edge_at(interval.cell, places)].value = value;
      if (size == 1) {
        cells_.vertex_values[cells_.triangulation.cells[interval.cell][lowest(places)]] = value;
        is_vertex_raised_ = true;
      }
    });
    raised_.push_back(interval);  // mutant: alpha-repair-raised
  }
  void set_critical(uint32_t code, double value) {
    const auto at = critical_facet(cells_, code) - cells_.facets.data();
    cells_.facets[static_cast<std::size_t>(at)].value = value;
  }
  void follow() {
    Ticker ticker(context_, {});
    while (!raised_.empty()) {
      ticker.work();
      const Interval interval = raised_.back();
      raised_.pop_back();
      for_each_member(interval, [&](unsigned places) {
        if (std::popcount(places) == 3)
          look_above_facet(4 * interval.cell + lowest(0b1111U & ~places));
        if (std::popcount(places) == 2) look_above_edge(interval.cell, places);
      });
    }
  }

  AlphaCells& cells_;
  const Frames& frames_;
  const RunContext& context_;
  const Spheres spheres_;
  std::pmr::vector<Interval> raised_;
  bool is_vertex_raised_ = false;
};

}  // namespace

void make_monotone(AlphaCells& cells, const Frames& frames, const RunContext& context) {
  if (cells.dim() == 3)
    SpaceRepair(cells, frames, context).run();
  else
    PlaneRepair(cells, context).run();
}

}  // namespace ph::alpha
