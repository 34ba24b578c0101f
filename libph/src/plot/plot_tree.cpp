// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "libph/src/plot/plot_intervals.hpp"
#include "ph/error.hpp"

namespace ph::plot {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The branches that are drawn, with a row for each.
class Layout {
 public:
  /// @param shown the positions in `tree` of the branches that are drawn, ascending.
  Layout(std::span<const Branch> tree, const std::vector<std::size_t>& shown)
      : tree_(tree), shown_(shown), row_(shown.size()), children_(shown.size()) {
    std::vector<std::size_t> roots;
    for (std::size_t k = 0; k < shown.size(); ++k) {
      const std::size_t elder = shown_elder(shown[k]);
      (elder == kNone ? roots : children_[elder]).push_back(k);
    }
    const auto death = [&](std::size_t k) { return tree[shown[k]].death; };
    for (std::vector<std::size_t>& list : children_) std::ranges::stable_sort(list, {}, death);
    for (const std::size_t root : roots) place(root);
  }

  std::size_t row(std::size_t k) const { return row_[k]; }
  /// The position of the nearest elder among the branches that are drawn, or kNone if no elder is
  /// drawn.
  std::size_t elder(std::size_t k) const { return shown_elder(shown_[k]); }

 private:
  /// The nearest elder that is drawn. The elder itself may be left out if it is only as long as the
  /// branch.
  std::size_t shown_elder(std::size_t branch) const {
    while (!tree_[branch].is_infinite()) {
      branch = static_cast<std::size_t>(tree_[branch].elder);
      const auto found = std::ranges::lower_bound(shown_, branch);
      if (found != shown_.end() && *found == branch)
        return static_cast<std::size_t>(found - shown_.begin());
    }
    return kNone;
  }

  std::size_t rows_of(std::size_t k) const {
    std::size_t rows = 1;
    for (const std::size_t child : children_[k]) rows += rows_of(child);
    return rows;
  }

  /// Places a branch between the branches that join it. Branches that join earlier are placed
  /// nearer to it, which avoids crossings. Each of these branches is placed on the side that has
  /// fewer rows.
  void place(std::size_t k) {
    std::vector<std::size_t> above, below;
    std::size_t rows_above = 0, rows_below = 0;
    for (const std::size_t child : children_[k]) {
      const bool up = rows_above < rows_below;
      (up ? above : below).push_back(child);
      (up ? rows_above : rows_below) += rows_of(child);
    }
    for (auto child = above.rbegin(); child != above.rend(); ++child) place(*child);
    row_[k] = next_++;
    for (const std::size_t child : below) place(child);
  }

  std::span<const Branch> tree_;
  const std::vector<std::size_t>& shown_;
  std::vector<std::size_t> row_;
  std::vector<std::vector<std::size_t>> children_;
  std::size_t next_ = 0;
};

/// Checks a merge tree. @throws Error (bad_data) if a value is NaN, or if the elders of a branch do
/// not lead to a branch that never dies.
void check(std::span<const Branch> tree) {
  const auto refuse = [](std::size_t i, const std::string& found, const std::string& expected) {
    throw Error(ErrorKind::bad_data,
                fmt::format("branch {}: found {}, expected {}", i, found, expected));
  };
  std::vector<std::size_t> seen_from(tree.size(), kNone);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (std::isnan(tree[i].birth) || std::isnan(tree[i].death))
      refuse(i, fmt::format("[{}, {})", tree[i].birth, tree[i].death), "two numbers");
    if (std::cmp_greater_equal(tree[i].elder, tree.size()))
      refuse(i, fmt::format("an elder branch {}", tree[i].elder),
             fmt::format("one below {}", tree.size()));
  }
  for (std::size_t i = 0; i < tree.size(); ++i) {
    for (std::size_t at = i; seen_from[at] == kNone;
         at = static_cast<std::size_t>(tree[at].elder)) {
      seen_from[at] = i;
      if (tree[at].is_infinite()) break;
      if (seen_from[static_cast<std::size_t>(tree[at].elder)] == i)
        refuse(i, "a cycle of elder branches", "a branch that never dies");
    }
  }
}

}  // namespace

Drawing draw_tree(std::span<const Branch> tree, const PlotOptions& options) {
  check(tree);
  Canvas canvas;
  // A branch of length zero is left out, because it is not a bar.
  const PlotAxis limits = limits_of(options);
  std::vector<std::size_t> classes;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!(tree[i].persistence() > 0)) continue;
    if (is_shown(tree[i].birth, tree[i].death, limits))
      classes.push_back(i);
    else
      ++beyond;
  }
  Longest places = longest_of(classes.size(), kRows,
                              [&](std::size_t k) { return tree[classes[k]].persistence(); });
  for (std::size_t& place : places.crisp) place = classes[place];
  for (std::size_t& place : places.rest) place = classes[place];
  const Layout layout(tree, places.crisp);
  const std::size_t rows = places.crisp.size();
  const double pitch = pitch_of(rows);
  const Axis axis(finite_range(tree, classes, options), options, kFirstValue, kLastValue);
  const Colour colour = colour_of_dim(0);

  const double top = options.title.empty() ? 8 : 20;
  const double height = std::max(pitch * static_cast<double>(rows), 22.0);
  const double bottom = top + height + (places.rest.empty() ? 0 : kDensityHeight) + 5;
  if (!options.title.empty()) canvas.title(options.title);
  axis.draw_below(canvas, top, bottom, options.value_label);
  canvas.text(6, top + 8, with_subscript("H", 0), Anchor::start, 9, colour, Look::bold);
  canvas.text(6, top + 15.5, grouped(classes.size()), Anchor::start, 6, kGrey);

  const double first = top + (height - pitch * static_cast<double>(rows)) / 2 + 0.5 * pitch;
  const auto y_of = [&](std::size_t k) {
    return first + pitch * static_cast<double>(layout.row(k));
  };
  Lines lines(axis, pitch);
  Outline joints;
  for (std::size_t k = 0; k < rows; ++k) {
    const Branch& branch = tree[places.crisp[k]];
    lines.add(branch.birth, branch.death, y_of(k));
    if (const std::size_t elder = layout.elder(k); elder != kNone)
      joints.move_to(std::max(axis.at(branch.death), lines.start(branch.birth) + 0.5), y_of(k))
          .vertical_to(y_of(elder));
  }
  canvas.shape(std::move(joints), {.stroke = colour, .stroke_width = 0.6});
  lines.draw(canvas, colour);
  if (!places.rest.empty()) {
    Density density(axis);
    for (const std::size_t i : places.rest) density.add(tree[i].birth, tree[i].death);
    density.draw(canvas, top + height, colour);
  }
  const auto infinite = static_cast<std::size_t>(std::ranges::count_if(tree, &Branch::is_infinite));
  if (infinite > 0) explain_triangles(canvas, bottom);
  explain_beyond(canvas, beyond, bottom);
  return canvas.finish(
      bottom + 25, options.title.empty() ? "Merge tree" : options.title,
      fmt::format("Merge tree: {} classes of {}, {} never die", grouped(classes.size()),
                  with_subscript("H", 0), grouped(infinite)));
}

}  // namespace ph::plot
