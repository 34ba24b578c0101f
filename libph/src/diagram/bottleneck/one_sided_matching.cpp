// SPDX-License-Identifier: MIT
#include "libph/src/diagram/bottleneck/one_sided_matching.hpp"

#include <algorithm>

#include "libph/src/diagram/diagram_parts.hpp"

namespace ph::diagram {

OneSidedMatching::OneSidedMatching(std::span<const Point> from, std::span<const Point> to,
                                   const RunContext& context)
    : from_(from), to_(to), context_(context), ticker_(context, "bottleneck distance") {}

double OneSidedMatching::lower_bound(double bound) {
  if (from_.empty() || to_diagonal(from_.front()) <= bound) return bound;
  if (to_.empty()) return to_diagonal(from_.front());
  tree_.emplace(to_, context_);
  free_.emplace(*tree_, context_);
  paired_with_.assign(to_.size(), kNone);
  for (std::uint32_t place = 0; place < from_.size(); ++place) {
    const Point& p = from_[place];
    const double alone = to_diagonal(p);
    if (alone <= bound) break;
    ticker_.work();
    const PointsLeft::Nearest nearest = free_->nearest(p, alone);
    bound = std::max(bound, nearest.distance);
    // If no bar is closer than the diagonal, searches may start at any position.
    candidates_.push_back({p, alone, place, nearest.position == kNone ? 0 : nearest.position});
  }
  return bound;
}

DistanceBounds OneSidedMatching::narrow(const DistanceBounds& bounds,
                                        const DistanceLimits& limits) {
  std::erase_if(candidates_, [&](const Candidate& c) { return c.to_diagonal <= bounds.lower; });
  DistanceBounds found{bounds.lower, bounds.lower};
  for (const Candidate& c : candidates_) found.value = std::max(found.value, c.to_diagonal);
  std::ranges::sort(candidates_, [](const Candidate& a, const Candidate& b) {
    return a.nearest != b.nearest ? a.nearest < b.nearest : a.place < b.place;
  });
  partner_.assign(candidates_.size(), kNone);

  const auto is_done = [&] { return found.value <= bounds.value || is_enough(found, limits); };
  const auto probe = [&](double radius) {
    if (const auto bound = hall_bound(radius)) {
      found.lower = *bound;
      return false;
    }
    found.value = std::clamp(cost(), found.lower, std::min(found.value, radius));
    return true;
  };
  if (!is_done() && limits.at_most >= found.lower && limits.at_most < found.value)
    probe(limits.at_most);
  // The largest radius that ends the search if all long bars can be paired within it.
  const auto last = [&] {
    return std::max(found.lower * (1 + limits.relative_error), std::min(bounds.value, found.value));
  };
  // The search moves away from the lower bound in growing steps, because the least radius is
  // usually near this bound.
  bool is_possible = is_done() || probe(last());
  for (double step = 1.01; !is_done() && !is_possible; step *= step) {
    const double radius = std::max(found.lower * step, last());
    if (!(radius < found.value)) break;
    is_possible = probe(radius);
  }
  // The search continues between the bounds. Every fourth probe uses the radius that would end the
  // search, because the lower bound may already be the answer.
  for (int i = 1; !is_done(); ++i) {
    const double middle = found.lower + (found.value - found.lower) / 2;
    probe(i % 4 == 0 || middle >= found.value ? last() : middle);
  }
  return found;
}

std::optional<double> OneSidedMatching::hall_bound(double radius) {
  if (candidates_.empty()) return std::nullopt;
  if (!unseen_) {
    unseen_.emplace(*tree_, context_);
    reached_from_.resize(to_.size());
    root_of_.resize(candidates_.size());
  }
  keep_pairs_within(radius);
  std::vector<Number> alone = pair_with_free(radius);
  // The search is depth first as long as each pass pairs at least half of the remaining bars. This
  // happens when most bars have many possible partners.
  for (std::size_t before = 2 * alone.size(); alone.size() <= before / 2 && !alone.empty();) {
    before = alone.size();
    search_in_depth(alone, radius);
  }
  while (!alone.empty()) {
    // The search from one unpaired bar is exhaustive. If it fails, no other bar has to be tried.
    std::swap(alone[random_() % alone.size()], alone.back());
    std::vector<Number> one = {alone.back()};
    alone.pop_back();
    grow_trees(one, radius);
    if (!one.empty()) return least_way_out();
    if (!alone.empty()) grow_trees(alone, radius);
  }
  return std::nullopt;
}

void OneSidedMatching::keep_pairs_within(double radius) {
  for (Number a = 0; a < candidates_.size(); ++a) {
    const Position b = partner_[a];
    if (b == kNone) continue;
    const Candidate& candidate = candidates_[a];
    if (candidate.to_diagonal > radius && distance(candidate.point, tree_->point(b)) <= radius)
      continue;
    partner_[a] = paired_with_[b] = kNone;
  }
  free_->restore([&](Position b) { return paired_with_[b] == kNone; });
}

std::vector<OneSidedMatching::Number> OneSidedMatching::pair_with_free(double radius) {
  std::vector<Number> alone;
  for (Number a = 0; a < candidates_.size(); ++a) {
    if (partner_[a] != kNone || candidates_[a].to_diagonal <= radius) continue;
    ticker_.work();
    const Position b = free_->take(candidates_[a].point, radius, candidates_[a].nearest);
    if (b == kNone) {
      alone.push_back(a);
    } else {
      partner_[a] = b;
      paired_with_[b] = a;
    }
  }
  return alone;
}

void OneSidedMatching::search_in_depth(std::vector<Number>& roots, double radius) {
  unseen_->restore_all();
  std::vector<Number> path;
  std::erase_if(roots, [&](Number root) {
    path.assign(1, root);
    while (!path.empty()) {
      const Number a = path.back();
      const Candidate& candidate = candidates_[a];
      ticker_.work();
      Position b = free_->take(candidate.point, radius, candidate.nearest);
      if (b != kNone) {
        pair_along(root, a, b);
        return true;
      }
      b = unseen_->take(candidate.point, radius, candidate.nearest);
      if (b == kNone) {
        path.pop_back();
      } else {
        reached_from_[b] = a;
        path.push_back(paired_with_[b]);
      }
    }
    return false;
  });
}

void OneSidedMatching::grow_trees(std::vector<Number>& roots, double radius) {
  unseen_->restore_all();
  nodes_.clear();
  const auto is_paired = [&](Number root) { return partner_[root] != kNone; };
  // A bar looks for a free bar as soon as it is reached. The last layer of a tree, which is the
  // largest, is therefore never expanded.
  const auto reach = [&](Number a, Number root) {
    root_of_[a] = root;
    nodes_.push_back(a);
    ticker_.work();
    const Candidate& candidate = candidates_[a];
    const Position b = free_->take(candidate.point, radius, candidate.nearest);
    if (b != kNone) pair_along(root, a, b);
  };
  for (const Number root : roots) reach(root, root);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Number a = nodes_[i], root = root_of_[a];
    if (is_paired(root)) continue;
    ticker_.work();
    unseen_->take_all(candidates_[a].point, radius, [&](Position b) {
      if (is_paired(root)) return;
      reached_from_[b] = a;
      reach(paired_with_[b], root);
    });
  }
  std::erase_if(roots, is_paired);
}

void OneSidedMatching::pair_along(Number root, Number last, Position free) {
  for (Position b = free;;) {
    const Number a = b == free ? last : reached_from_[b];
    const Position before = partner_[a];
    partner_[a] = b;
    paired_with_[b] = a;
    if (a == root) return;
    b = before;
  }
}

double OneSidedMatching::least_way_out() {
  double bound = kInfinity;
  // mutant: bottleneck-alone
  for (const Number a : nodes_) bound = std::min(bound, candidates_[a].to_diagonal);
  for (const Number a : nodes_) {
    ticker_.work();
    bound = unseen_->nearest(candidates_[a].point, bound).distance;  // mutant: bottleneck-unseen
  }
  return bound;
}

double OneSidedMatching::cost() const {
  double cost = 0;
  for (Number a = 0; a < candidates_.size(); ++a) {
    const Candidate& c = candidates_[a];
    const double apart =
        partner_[a] == kNone ? c.to_diagonal : distance(c.point, tree_->point(partner_[a]));
    cost = std::max(cost, std::min(c.to_diagonal, apart));
  }
  return cost;
}

std::vector<std::uint32_t> OneSidedMatching::partners_of_from() const {
  std::vector<std::uint32_t> partners(from_.size(), kNone);
  for (Number a = 0; a < candidates_.size(); ++a)
    if (partner_[a] != kNone) partners[candidates_[a].place] = tree_->places()[partner_[a]];
  return partners;
}

std::vector<std::uint32_t> OneSidedMatching::partners_of_to() const {
  std::vector<std::uint32_t> partners(to_.size(), kNone);
  for (Number a = 0; a < candidates_.size(); ++a)
    if (partner_[a] != kNone) partners[tree_->places()[partner_[a]]] = candidates_[a].place;
  return partners;
}

}  // namespace ph::diagram
