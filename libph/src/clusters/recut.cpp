// SPDX-License-Identifier: MIT
// Makes a ClusterTree from one with a smaller least size, without the edges.
#include <fmt/format.h>

#include <algorithm>

#include "libph/src/clusters/cluster_data.hpp"
#include "ph/error.hpp"

namespace ph {

// A cluster of the finest tree is real if it has `min_size` points just below its top. Its own life
// as a real cluster begins at `start`: the value at which it splits into real clusters, or at which
// it has that many points. If exactly one of its children is real, that child goes on as the
// cluster, and both are one cluster of the new tree.
class ClusterTree::Recutter {
 public:
  Recutter(const Data& finest, Data& made)
      : finest_(finest), made_(made), parts_(finest.clusters.size()) {}

  void run() {
    const auto clusters = static_cast<std::uint32_t>(parts_.size());
    for (std::uint32_t c = 0; c < clusters; ++c) {
      begin(c);
      if (parts_[c].made != kNone) live_with_own_points(c);
      if (c + 1 < clusters) tell_parent(c);
    }
    if (clusters == 0) return;
    Cluster& root = made_.clusters.back();
    root.size = finest_.clusters.back().size;
    growth_.live(static_cast<std::uint32_t>(made_.clusters.size() - 1), kInfinity);
    assign_points();
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  struct Part {
    std::uint32_t made = kNone;        // the cluster of the new tree; kNone if it is not real
    std::uint32_t last_child = kNone;  // the children are a list
    std::uint32_t sibling = kNone;
    std::uint32_t real_children = 0;
    Index below = 0;  // points of all children
    double start = 0;
  };

  bool is_root(std::uint32_t c) const { return c + 1 == parts_.size(); }
  double value_of(std::uint32_t place) const { return finest_.leaves_at[finest_.order[place]]; }

  /// Finds the cluster of the new tree, and the value at which it begins or goes on as `c`.
  void begin(std::uint32_t c) {
    Part& part = parts_[c];
    const Cluster& cluster = finest_.clusters[c];
    part.start = cluster.bottom;
    if (part.real_children == 0) {
      if (cluster.size < made_.min_size && !is_root(c)) return;  // mutant: cluster-recut
      part.start = start_of_leaf(c);
      part.made = growth_.add(part.start);
      return;
    }
    if (part.real_children > 1) part.made = growth_.add(part.start);
    for (std::uint32_t child = part.last_child; child != kNone; child = parts_[child].sibling) {
      const std::uint32_t of_child = parts_[child].made;
      if (of_child == kNone) continue;
      growth_.live(of_child, part.start);
      if (part.real_children == 1)
        part.made = of_child;
      else
        growth_.join(of_child, part.made, part.start);
    }
  }
  /// The value at which a cluster without real children has `min_size` points. A root may never
  /// have as many.
  double start_of_leaf(std::uint32_t c) const {
    const Index wanted = made_.min_size - parts_[c].below,
                own = Index{finest_.first[c + 1]} - Index{finest_.first[c]};
    if (wanted <= 0 || own == 0) return finest_.clusters[c].bottom;
    const Index place = Index{finest_.first[c]} + std::min(wanted, own) - 1;
    return std::max(finest_.clusters[c].bottom, value_of(static_cast<std::uint32_t>(place)));
  }
  /// The points of `c` itself leave it after its children have begun or joined it.
  void live_with_own_points(std::uint32_t c) {
    const Part& part = parts_[c];
    Cluster& made = made_.clusters[part.made];
    std::uint32_t place = finest_.first[c];
    const std::uint32_t end = finest_.first[c + 1];
    while (place < end && value_of(place) <= part.start) ++place;
    made.size = part.below + Index{place} - Index{finest_.first[c]};
    while (place < end) {
      const double value = value_of(place);
      growth_.live(part.made, value);
      for (; place < end && value_of(place) == value; ++place) ++made.size;
    }
  }
  void tell_parent(std::uint32_t c) {
    Part& parent = parts_[static_cast<std::size_t>(finest_.clusters[c].parent)];
    if (parts_[c].made != kNone) ++parent.real_children;
    parent.below += finest_.clusters[c].size;
    parts_[c].sibling = parent.last_child;
    parent.last_child = c;
  }

  void assign_points() {
    std::vector<std::uint32_t> real(parts_.size());  // the first real cluster at or above
    for (std::size_t c = parts_.size(); c-- > 0;)
      real[c] = parts_[c].made != kNone
                    ? static_cast<std::uint32_t>(c)
                    : real[static_cast<std::size_t>(finest_.clusters[c].parent)];
    for (std::size_t p = 0; p < made_.cluster_of.size(); ++p) {
      const std::uint32_t c = finest_.cluster_of[p], at = real[c];
      const double start = parts_[at].start;
      made_.cluster_of[p] = parts_[at].made;
      made_.leaves_at[p] = at == c ? std::max(finest_.leaves_at[p], start) : start;
    }
  }

  const Data& finest_;
  Data& made_;
  Growth growth_{made_};
  std::vector<Part> parts_;  // by cluster of the finest tree
};

ClusterTree ClusterTree::with_min_size(Index min_size, const RunContext& context) const {
  const Data& finest = *finest_;
  if (min_size < finest.min_size)
    throw Error(ErrorKind::usage,
                fmt::format("min_size: found {}, expected at least {}, with which the tree was "
                            "made; make a tree with that size",
                            min_size, finest.min_size));
  if (min_size == finest.min_size) return {finest_, finest_};
  const std::size_t n = finest.cluster_of.size();
  context.memory.require(n * (sizeof(std::uint32_t) + sizeof(double)));
  auto made = std::make_shared<Data>(Data{min_size,
                                          finest.scale,
                                          finest.life,
                                          {},
                                          std::vector<std::uint32_t>(n),
                                          std::vector<double>(n)});
  Recutter(finest, *made).run();
  return {std::move(made), finest_};
}

}  // namespace ph
