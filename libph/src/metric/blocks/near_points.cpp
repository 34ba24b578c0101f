// SPDX-License-Identifier: MIT
#include "libph/src/metric/blocks/near_points.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ph {
namespace {

double squared(double x) { return x * x; }

}  // namespace

CellRegions::CellRegions(const SampleTree& tree, std::span<const double> box,
                         const RunContext& context)
    : boxes_(tree.node_count(), tree.points().cols(), context) {
  std::vector<double> region(box.begin(), box.end());
  add(tree, SampleTree::kRoot, region);
}

void CellRegions::add(const SampleTree& tree, SampleTree::Node node, std::vector<double>& box) {
  if (tree.is_leaf(node)) {
    if (tree.cells(node).size() == 0) return;  // the node is empty
    const Index axes = tree.points().cols();
    const double* const s = tree.points().row(Index{tree.cells(node).begin});
    std::vector<double> low, high, farthest;
    for (std::size_t k = 0; k < static_cast<std::size_t>(axes); ++k) {
      low.push_back(box[2 * k]);
      high.push_back(box[2 * k + 1]);
      farthest.push_back(s[k] - low[k] > high[k] - s[k] ? low[k] : high[k]);
    }
    const double square = squared_distance(s, farthest.data(), axes);
    boxes_.add_point(node, low.data(), square);
    boxes_.add_point(node, high.data(), square);
    return;
  }
  const std::size_t side = 2 * std::size_t{tree.axis(node)};
  for (const bool is_right : {false, true}) {
    const SampleTree::Node child = is_right ? tree.right(node) : tree.left(node);
    if (tree.cells(child).size() == 0) continue;
    if (tree.cells(child).size() == tree.cells(node).size()) {
      add(tree, child, box);
    } else {
      double& end = box[side + (is_right ? 0 : 1)];
      const double before = std::exchange(end, tree.value(node));
      add(tree, child, box);
      end = before;  // mutant: cloud-region-end
    }
    boxes_.add(node, boxes_, child);
  }
}

NearPoints::NearPoints(const SampleTree& tree, const Bottlenecks& bottlenecks,
                       const CellRegions& regions, const CellBoxes& boxes, std::size_t first_cell,
                       std::uint32_t block, double limit, const RunContext& context)
    : tree_(tree),
      bottlenecks_(bottlenecks),
      block_(block),
      own_(tree.node_of_block(block)),
      limit_(squared(limit)),
      longest_(squared(bottlenecks.within(SampleTree::kRoot))),
      cell_boxes_(boxes),
      first_cell_(first_cell),
      boxes_(tree.end_below(own_) - own_, tree.points().cols(), context),
      kinds_(tree.node_count(), Kind::hopeless, &context.memory) {
  for (Node node = tree.end_below(own_); node-- > own_;) {
    if (!tree.is_leaf(node)) {
      boxes_.add(node - own_, boxes_, tree.left(node) - own_);
      boxes_.add(node - own_, boxes_, tree.right(node) - own_);
    } else if (tree.cells(node).size() > 0) {
      boxes_.add(node - own_, boxes, box_of(node));
      boxes_.add(node - own_, boxes, box_of(node) + 1);
    }
  }
  context.poll();
  mark(SampleTree::kRoot, regions);
}

// The blocks are arranged in a circle. Each block looks for edges to the blocks in the half of the
// circle ahead of it. If two blocks are opposite each other, the parity of the smaller number
// decides which of the two blocks looks for edges.
bool NearPoints::looks_for(std::uint32_t block, std::uint32_t other, std::uint32_t blocks) {
  if (block == other) return false;
  const std::uint64_t ahead = (std::uint64_t{other} + blocks - block) % blocks;
  if (2 * ahead != blocks) return 2 * ahead < blocks;
  return (std::min(block, other) % 2 == 0) == (block < other);  // mutant: cloud-opposite
}

/// Sets the kinds of a node and of the nodes below it. @return true if one of these nodes is not
/// hopeless.
bool NearPoints::mark(Node node, const CellRegions& regions) {
  if (node == own_) {
    kinds_[node] = Kind::own;
    return true;
  }
  const SampleTree::Range blocks = tree_.blocks(node);
  if (tree_.cells(node).size() == 0) return false;
  const bool has_own = blocks.begin <= block_ && block_ < blocks.end;
  if (!has_own) {
    const std::uint32_t all = tree_.blocks(SampleTree::kRoot).size();
    if (blocks.size() == 1 && !looks_for(block_, blocks.begin, all)) return false;
    if (!may_be_near(node, regions)) return false;
    if (tree_.is_leaf(node)) {
      kinds_[node] = Kind::cell;
      return true;
    }
  }
  const bool left = mark(tree_.left(node), regions), right = mark(tree_.right(node), regions);
  if (left || right) kinds_[node] = Kind::mixed;
  return left || right;
}

// The caller only compares the gap with the result. The bottleneck between two cells takes time to
// compute. It is therefore computed only if the outcome of the comparison depends on it.
double NearPoints::reach(Node own, double square, double within, SampleTree::Cell cell,
                         double gap) const {
  const double least = reach_of(
      std::min(limit_, std::max({square, squared(within), squared(bottlenecks_.within(own))})));
  if (gap <= least || gap > reach_of(longest_)) return least;
  const double between = bottlenecks_.between(tree_.cells(own).begin, cell);
  return std::max(least, reach_of(std::min(limit_, squared(between))));  // mutant: cloud-hop
}

bool NearPoints::may_be_near(Node node, const CellRegions& regions) const {
  const double* const box = regions.boxes().box(node).data();
  const double square = regions.boxes().square(node), within = bottlenecks_.within(node);
  const SampleTree::Range cells = tree_.cells(node);
  const auto search = [&](const auto& self, Node own) -> bool {
    if (tree_.cells(own).size() == 0) return false;
    const double gap = boxes_.gap(own - own_, box, box + 1, 2);
    const double farthest = std::max(boxes_.square(own - own_), square);
    if (gap > reach(own, farthest, within, cells.begin, gap)) return false;
    // The search continues with the children of `own` as long as `own` has more cells than the
    // other node.
    if (tree_.is_leaf(own) || tree_.cells(own).size() <= cells.size()) return true;
    return self(self, tree_.left(own)) || self(self, tree_.right(own));
  };
  return search(search, own_);
}

bool NearPoints::is_near(const double* x, Node leaf) const {
  const SampleTree::Cell cell = tree_.cells(leaf).begin;
  const std::uint32_t block = tree_.blocks(leaf).begin;
  NearSample sample{cell,
                    squared_distance(x, tree_.points().row(Index{cell}), tree_.points().cols())};
  bool is_nearest = false;
  const auto is_beyond = [&](Node own, const CellBoxes& boxes, std::size_t i) {
    const double gap = boxes.gap(i, x, x, 1);
    // mutant: cloud-near-sample
    return gap > reach(own, std::max(boxes.square(i), sample.square), 0, sample.cell, gap);
  };
  std::array<Node, 64> stack;  // at most as deep as the tree
  std::size_t height = 0;
  for (Node own = own_;;) {
    if (!is_beyond(own, boxes_, own - own_)) {
      if (!is_nearest && sample.square > bottlenecks_.square_around(sample.cell)) {
        is_nearest = true;
        sample = nearest_sample(tree_, block, x, sample);
        continue;
      }
      if (!tree_.is_leaf(own)) {
        stack[height++] = tree_.right(own);
        own = tree_.left(own);
        continue;
      }
      const std::size_t i = box_of(own);
      if (!is_beyond(own, cell_boxes_, i) || !is_beyond(own, cell_boxes_, i + 1)) return true;
    }
    if (height == 0) return false;
    own = stack[--height];
  }
}

}  // namespace ph
