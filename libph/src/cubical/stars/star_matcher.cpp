// SPDX-License-Identifier: MIT
#include "libph/src/cubical/stars/star_matcher.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <mutex>
#include <utility>

#include "ph/detail/core/parallel.hpp"
#include "ph/detail/core/polled_sort.hpp"

namespace ph::cubical {
namespace {

template <std::size_t... i>
CriticalNames no_names(std::pmr::memory_resource* memory, std::index_sequence<i...>) {
  return {((void)i, std::pmr::vector<CellGrid::Name>(memory))...};
}
CriticalNames no_names(std::pmr::memory_resource* memory) {
  return no_names(memory, std::make_index_sequence<std::tuple_size_v<CriticalNames>>());
}

}  // namespace

StarShapes::StarShapes(int axes, std::pmr::memory_resource* memory) : shapes(memory) {
  std::uint16_t count = 1;
  for (int k = 0; k < axes; ++k) {
    digit[static_cast<std::size_t>(k)] = count;
    count = static_cast<std::uint16_t>(3 * count);
  }
  shapes.resize(count);
  for (std::uint16_t code = 0; code < count; ++code) {
    Shape& shape = shapes[code];
    for (std::size_t k = 0; k < static_cast<std::size_t>(axes); ++k) {
      const int step = code / digit[k] % 3;
      if (step == 0) continue;
      if (step == 1) shape.down = static_cast<std::uint8_t>(shape.down | 1U << k);
      shape.without[shape.steps++] = static_cast<std::uint16_t>(code - step * digit[k]);
    }
  }
}

StarMatcher::StarMatcher(CellGrid& grid, const StarShapes& shapes, const RunContext& context)
    : grid_(grid),
      shapes_(shapes),
      cells_(&context.memory),
      place_(shapes.shapes.size(), kNone, &context.memory),
      rest_(&context.memory),
      reached_(&context.memory),
      stack_(&context.memory),
      critical_(no_names(&context.memory)) {}

void StarMatcher::mark_star(std::uint32_t voxel, const CellGrid::Coordinates& at) {
  find_steps(at);
  find_cells(voxel, at);
  pair_apparent_cells();
  pair_rest();
  mark_cells(voxel);
}

void StarMatcher::find_steps(const CellGrid::Coordinates& at) {
  std::uint32_t border = 0;
  for (int k = 0; k < grid_.dim(); ++k) {
    const std::uint32_t x = at[static_cast<std::size_t>(k)];
    border = border << 2U | (x == 0 ? 1U : 0U) | (x + 1 == grid_.axis(k).extent ? 2U : 0U);
  }
  if (border == border_) return;  // this is the usual case along a row
  border_ = border;
  step_count_ = 0;
  const bool is_t = !grid_.voxels_are_vertices();
  std::uint32_t voxels = 1;
  for (int k = grid_.dim() - 1; k >= 0; --k) {
    const auto i = static_cast<std::size_t>(k);
    const CellGrid::Axis& axis = grid_.axis(k);
    const std::uint32_t x = at[i], last = axis.extent - 1, doubled = 2 * x + (is_t ? 1 : 0);
    const auto add = [&](int side, bool leaves, std::uint32_t to, std::uint32_t next) {
      if (leaves && !axis.periodic && !is_t) return;
      steps_[step_count_++] = {
          (std::int64_t{next} - std::int64_t{doubled}) * std::int64_t{axis.stride},
          (to - x) * voxels,
          0,
          static_cast<std::uint16_t>((1 + side) * shapes_.digit[i]),
          static_cast<std::uint8_t>(2 * k + side),
          leaves && !axis.periodic};
    };
    add(0, x == 0, x == 0 ? last : x - 1, doubled == 0 ? axis.length - 1 : doubled - 1);
    add(1, x == last, x == last ? 0 : x + 1, doubled + 1 == axis.length ? 0 : doubled + 1);
    voxels *= axis.extent;
  }
  const std::span steps(steps_.data(), step_count_);
  std::ranges::sort(steps, [&](const Step& a, const Step& b) {
    return is_t ? a.places > b.places : a.places < b.places;
  });
  for (Step& a : steps)
    for (std::size_t r = 0; r < step_count_; ++r)
      if (steps_[r].direction == (a.direction ^ 1)) a.steps_back = 1U << r;
}

void StarMatcher::find_cells(std::uint32_t voxel, const CellGrid::Coordinates& at) {
  const std::uint32_t rank = grid_.rank(voxel), centre = grid_.voxels_are_vertices() ? 0 : 1;
  std::uint32_t cell = 0;
  for (int k = 0; k < grid_.dim(); ++k)
    cell += (2 * at[static_cast<std::size_t>(k)] + centre) * grid_.axis(k).stride;
  cells_.clear();
  cells_.push_back({cell, voxel, 0, 0});
  place_[0] = 0;
  for (std::size_t r = 0; r < step_count_; ++r) {
    const Step& step = steps_[r];
    const std::size_t before = cells_.size();
    for (std::size_t i = 0; i < before; ++i) {
      const StarCell from = cells_[i];
      if ((from.steps & step.steps_back) != 0) continue;
      const bool is_outside = from.voxel == CellGrid::kNone || step.is_outside;
      const std::uint32_t far = is_outside ? CellGrid::kNone : from.voxel + step.to;
      if (!is_in_star(rank, far)) continue;
      const auto code = static_cast<std::uint16_t>(from.code + step.code);
      const StarShapes::Shape& shape = shapes_.shapes[code];
      bool is_in = true;
      for (std::size_t j = 0; j < shape.steps; ++j)
        is_in = is_in && place_[shape.without[j]] != kNone;
      if (!is_in) continue;
      cells_.push_back(
          {from.cell + static_cast<std::uint32_t>(step.places), far, from.steps | 1U << r, code});
      place_[code] = static_cast<Place>(cells_.size() - 1);
    }
  }
}

void StarMatcher::pair_apparent_cells() {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    StarCell& a = cells_[i];
    const auto first = static_cast<std::size_t>(std::countr_zero(a.steps));
    for (std::size_t r = 0; r < std::min(first, step_count_); ++r) {
      if ((a.steps & steps_[r].steps_back) != 0) continue;
      const Place b = place_[a.code + steps_[r].code];
      if (b == kNone) continue;
      a.partner = b;
      cells_[b].partner = static_cast<Place>(i);
      break;
    }
  }
}

void StarMatcher::pair_rest() {
  rest_.clear();
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (cells_[i].partner == kNone) rest_.push_back(static_cast<Place>(i));
  if (rest_.size() < 2) return;
  const auto level = [&](Place i) { return std::popcount(cells_[i].steps); };
  std::ranges::sort(rest_, [&](Place a, Place b) {
    return level(a) != level(b) ? level(a) < level(b) : is_younger(b, a);
  });
  // The level of the last undecided cell. Later pairs in this level would depend on that cell.
  int undecided = -1;
  for (const Place i : rest_)
    if (level(i) != undecided && !pair_along_path(i)) undecided = level(i);
}

template <class Visit>
void StarMatcher::for_each_next(Place cell, Visit&& visit) {
  const StarShapes::Shape& shape = shapes_.shapes[cells_[cell].code];
  for (std::size_t j = 0; j < shape.steps; ++j) {
    const Place below = place_[shape.without[j]];
    if (below != cells_[cell].partner && !is_upper(cells_[below])) visit(below);
  }
}

void StarMatcher::count_paths(Place cell) {
  reached_.clear();
  stack_.assign(1, cell);
  while (!stack_.empty()) {
    const Place from = stack_.back();
    stack_.pop_back();
    for_each_next(from, [&](Place to) {
      StarCell& c = cells_[to];
      if (++c.paths_in > 1) return;
      c.paths = 0;
      reached_.push_back(to);
      if (c.partner != kNone) stack_.push_back(c.partner);
    });
  }
  // A cell passes on its count only after all cells that lead to it have passed on their counts.
  cells_[cell].paths = 1;
  stack_.assign(1, cell);
  while (!stack_.empty()) {
    const Place from = stack_.back();
    stack_.pop_back();
    for_each_next(from, [&](Place to) {
      StarCell& c = cells_[to];
      c.paths = std::min<Place>(2, static_cast<Place>(c.paths + cells_[from].paths));
      c.from = from;
      if (--c.paths_in > 0 || c.partner == kNone) return;
      cells_[c.partner].paths = c.paths;
      stack_.push_back(c.partner);
    });
  }
}

bool StarMatcher::pair_along_path(Place cell) {
  count_paths(cell);
  Place youngest = kNone;
  for (const Place i : reached_)
    if (cells_[i].partner == kNone && (youngest == kNone || is_younger(i, youngest))) youngest = i;
  if (youngest == kNone) return true;
  if (cells_[youngest].paths > 1) return false;
  for (Place lower = youngest;;) {
    const Place upper = cells_[lower].from;
    const Place next = std::exchange(cells_[upper].partner, lower);
    cells_[lower].partner = upper;
    if (upper == cell) return true;
    lower = next;
  }
}

void StarMatcher::mark_cells(std::uint32_t voxel) {
  const CellGrid::Name rank = CellGrid::Name{grid_.rank(voxel)} << 32U;
  const bool is_v = grid_.voxels_are_vertices();
  const auto dim = static_cast<std::size_t>(grid_.dim());
  for (const StarCell& c : cells_) {
    place_[c.code] = kNone;
    const StarShapes::Shape& shape = shapes_.shapes[c.code];
    if (c.partner == kNone) {
      grid_.set_mark(c.cell, CellMark::critical(shape.down));
      critical_[is_v ? shape.steps : dim - shape.steps].push_back(rank | c.cell);
      continue;
    }
    const bool upper = is_upper(c);
    const Step& step =
        steps_[static_cast<std::size_t>(std::countr_zero(c.steps ^ cells_[c.partner].steps))];
    const int to_partner = upper ? step.direction ^ 1 : int{step.direction};
    grid_.set_mark(c.cell, upper == is_v ? CellMark::killing(to_partner, shape.down)
                                         : CellMark::killed_by(to_partner, shape.down));
  }
}

CriticalNames mark_cells(CellGrid& grid, const RunContext& context) {
  constexpr std::size_t piece = 1 << 12;
  const StarShapes shapes(grid.dim(), &context.memory);
  std::mutex mutex;
  std::vector<std::unique_ptr<StarMatcher>> matchers;
  std::vector<StarMatcher*> idle;
  for_each_piece("stars", grid.voxel_count(), piece, context,
                 [&](std::size_t begin, std::size_t end) {
                   StarMatcher* matcher = nullptr;
                   {
                     const std::lock_guard lock(mutex);
                     if (idle.empty()) {
                       matchers.push_back(std::make_unique<StarMatcher>(grid, shapes, context));
                       idle.push_back(matchers.back().get());
                     }
                     matcher = idle.back();
                     idle.pop_back();
                   }
                   CellGrid::Coordinates at{};
                   auto rest = static_cast<std::uint32_t>(begin);
                   for (int k = grid.dim() - 1; k >= 0; --k) {
                     at[static_cast<std::size_t>(k)] = rest % grid.axis(k).extent;
                     rest /= grid.axis(k).extent;
                   }
                   Ticker ticker(context, {});
                   for (auto voxel = static_cast<std::uint32_t>(begin); voxel < end; ++voxel) {
                     if (grid.rank(voxel) != CellGrid::kNone) matcher->mark_star(voxel, at);
                     ticker.work();
                     for (int k = grid.dim() - 1; k >= 0; --k) {
                       auto& x = at[static_cast<std::size_t>(k)];
                       if (++x < grid.axis(k).extent) break;
                       x = 0;
                     }
                   }
                   const std::lock_guard lock(mutex);
                   idle.push_back(matcher);
                 });
  CriticalNames all = no_names(&context.memory);
  Ticker ticker(context, "critical cells");
  for (std::size_t dim = 0; dim < all.size(); ++dim) {
    std::size_t count = 0;
    for (const auto& matcher : matchers) count += matcher->critical()[dim].size();
    all[dim].reserve(count);
    for (const auto& matcher : matchers) {
      auto& some = matcher->critical()[dim];
      all[dim].insert(all[dim].end(), some.begin(), some.end());
      some = std::pmr::vector<CellGrid::Name>(&context.memory);
    }
    polled_sort(all[dim], std::less<>(), ticker);
  }
  return all;
}

}  // namespace ph::cubical
