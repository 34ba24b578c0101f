// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "free_edges.hpp"
#include "slabs.hpp"

namespace ph::cubical {

/// The stars of a grid of which only some slabs are in memory at a time: those that were asked for
/// last; others are found again from the image. For one thread.
class StarPages : public GridFrame {
 public:
  /// @param free which critical edges bear no mark. @param most how many slabs may be held, > 1.
  StarPages(const Slabs& slabs, const FreeEdges& free, std::size_t most)
      : GridFrame(slabs.frame()), slabs_(slabs), free_(free), most_(most), pages_(slabs.count()) {}

  std::uint32_t star(std::uint32_t v) {
    const Page& page = page_of(v);
    return page.grid->star(v - page.first);
  }
  bool enters(std::uint32_t v) { return star(v) != kAbsent; }

 private:
  struct Page {
    std::unique_ptr<StarGrid> grid = nullptr;
    std::uint32_t first = 0;  // voxel, a ghost
    std::uint64_t last_use = 0;
  };

  Page& page_of(std::uint32_t v) {
    const std::uint32_t number = slabs_.slab_of(v);
    Page& page = pages_[number];
    if (page.grid == nullptr) load(number);
    if (page.last_use != now_) page.last_use = ++now_;
    return page;
  }
  void load(std::uint32_t number) {
    if (held_.size() >= most_) {
      const auto oldest =
          std::ranges::min_element(held_, {}, [&](std::uint32_t i) { return pages_[i].last_use; });
      pages_[*oldest] = {};
      slabs_.forget(*oldest);
      held_.erase(oldest);
    }
    held_.push_back(number);
    Page& page = pages_[number];
    page.first = slabs_.first_voxel(number);
    page.grid = std::make_unique<StarGrid>(slabs_.stars(number));
    StarGrid& grid = *page.grid;
    // Edges that kill a component are marked: all critical ones that are not free.
    std::uint32_t next = 0;
    const auto critical = grid.critical();
    const auto mark_until = [&](std::uint32_t end) {
      for (; next < critical.size() && critical[next] < end; ++next) mark(grid, critical[next], 0);
    };
    free_.for_each(page.first, page.first + grid.size(), [&](std::uint32_t v, unsigned edges) {
      if (grid.is_ghost(v - page.first)) return;
      mark_until(v - page.first);
      mark(grid, critical[next++], edges);
    });
    mark_until(grid.size());
  }
  static void mark(StarGrid& grid, std::uint32_t v, unsigned free) {
    const StarTables& tables = grid.tables(v);
    tables.edge_order().for_each(tables.critical_edges(grid.star(v)) & ~free,
                                 [&](int edge) { grid.mark(v, tables.taken_mark(edge)); });
  }

  const Slabs& slabs_;
  const FreeEdges& free_;
  const std::size_t most_;
  std::vector<Page> pages_;          // by slab
  std::vector<std::uint32_t> held_;  // slabs
  std::uint64_t now_ = 0;
};

}  // namespace ph::cubical
